#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# load_order.sh BUILD NAME…: in whatever order colliders are loaded into a process and used, each gives the same bits.
set -eu
program=$1/bin/plumb_load_order
shift
count=0

# permute CHOSEN… -- LEFT…: runs every order that begins with those chosen.
permute() {
  local chosen=() left=() i
  while [ "$1" != -- ]; do chosen+=("$1"); shift; done
  shift
  if [ $# = 0 ]; then try "${chosen[@]}"; return; fi
  left=("$@")
  for i in "${!left[@]}"; do
    permute "${chosen[@]}" "${left[$i]}" -- "${left[@]:0:$i}" "${left[@]:$((i + 1))}"
  done
}

try() {
  local said
  said=$("$program" "$@")
  count=$((count + 1))
  first=${first:-$said}
  [ "$said" = "$first" ] || { echo "in the order $*:"; echo "$said"; echo "and before:"; echo "$first"; exit 1; }
}

permute -- "$@"
echo "$first"
echo "the same in $count orders"
# each has been run, and they do not all run on one collider
[ "$(echo "$first" | cut -d' ' -f2 | sort -u | wc -l)" -gt 1 ]
