#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# layers.sh ROOT: a folder of core/ includes only what stands before it in the line of layers.
set -eu
root=$1
layers="math scene world constraints schedule kernels effects step measure host reader output study app"

rank() { local i=0 layer; for layer in $layers; do i=$((i + 1)); [ "$layer" = "$1" ] && { echo $i; return; }; done; echo 0; }

bad=0
for folder in $layers; do
  [ -d "$root/core/$folder" ] || continue
  mine=$(rank "$folder")
  while IFS=: read -r file line text; do
    included=$(printf '%s' "$text" | sed -n 's|.*#include "\([a-z_]*\)/.*|\1|p')
    [ -n "$included" ] || continue
    theirs=$(rank "$included")
    if [ "$theirs" = 0 ] || [ "$theirs" -gt "$mine" ]; then
      echo "$file:$line: $folder/ includes $included/, which does not stand before it ($layers)"
      bad=1
    fi
  done < <(grep -rnH '#include "' "$root/core/$folder" --include='*.h' --include='*.cpp' || true)
done

# The contract needs nothing but the standard library; plugins know the contract alone.
if grep -rnH '#include "' "$root/interfaces" ; then echo "interfaces/ includes more than the standard library"; bad=1; fi
if grep -rnHE '#include "(math|scene|world|constraints|schedule|kernels|effects|step|measure|host|reader|output|app)/' "$root/plugins"; then
  echo "plugins/ includes core/"; bad=1
fi
exit $bad
