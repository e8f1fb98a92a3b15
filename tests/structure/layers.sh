#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# layers.sh ROOT: a folder of core/ includes only what stands before it in the line of layers, interfaces/ only the
# standard library and itself, and plugins/ nothing of core/. Names each include that breaks this, with its line.
set -eu
root=$1
layers="math scene geometry world constraints schedule ties kernels effects contacts solve trees islands step measure host reader output study app"
sources() { find "$root/$1" \( -name '*.h' -o -name '*.cpp' \) -print0 | sort -z; }

# Splits each include into its first folder (empty: a file alone) and hands it to `complaint`, which the caller defines.
each_include='
  BEGIN { count = split(layers, names, " "); for (i = 1; i <= count; i++) rank[names[i]] = i }
  /^[ \t]*#[ \t]*include[ \t]*["<]/ {
    quoted = /include[ \t]*"/
    target = $0; sub(/^[^"<]*["<]/, "", target); sub(/[">].*/, "", target)
    folder = target ~ /\// ? substr(target, 1, index(target, "/") - 1) : ""
    said = complaint()
    if (said != "") { print FILENAME ":" FNR ": " said; bad = 1 }
  }
  END { exit bad }'

core='
  function complaint(    mine) {
    mine = substr(FILENAME, length(root) + length("/core/") + 1); sub(/\/.*/, "", mine)
    if (!(mine in rank)) return "core/" mine " has no place in the line of layers: " layers
    if (target ~ /\.\.\//) return "\"" target "\" hides the folder that it comes from"
    if (quoted && folder != "" && !(folder in rank)) return "\"" target "\" is of no layer: " layers
    if (folder in rank && rank[folder] > rank[mine])
      return mine "/ includes " folder "/, which does not stand before it: " layers
  }'
interfaces='
  function complaint() {
    if (quoted || (folder != "" && folder != "plumb") || (folder == "" && target ~ /\./))
      return target " is neither of the standard library nor of interfaces/"
  }'
plugins='
  function complaint() { if (target ~ /\.\.\// || folder in rank) return "plugins/ includes " target ", not of the contract" }'

bad=0
sources core | xargs -0 -r awk -v root="$root" -v layers="$layers" "$core $each_include" || bad=1
sources interfaces | xargs -0 -r awk -v layers="$layers" "$interfaces $each_include" || bad=1
sources plugins | xargs -0 -r awk -v layers="$layers" "$plugins $each_include" || bad=1
exit $bad
