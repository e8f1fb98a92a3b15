#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# abilities.sh CHECKER README check|write: the table between the marks of README is what the suite sees of the plugins now;
# `write` puts it there.
set -eu
checker=$1 readme=$2 mode=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for mark in begin end; do
  [ "$(grep -c "^<!-- abilities: $mark -->$" "$readme")" = 1 ] || { echo "$readme lacks the mark: abilities: $mark"; exit 1; }
done

unset PLUMB_PLUGIN_PATH
"$checker" --table >"$work/table" || { cat "$work/table"; echo "a plugin does not keep what it claims"; exit 1; }
awk -v table="$work/table" '
  /^<!-- abilities: end -->$/ { inside = 0 }
  !inside { print }
  /^<!-- abilities: begin -->$/ { inside = 1; while ((getline line < table) > 0) print line }' "$readme" >"$work/readme"

case "$mode" in
  write) cat "$work/readme" >"$readme" ;;
  check)
    diff -u "$readme" "$work/readme" || { echo "the table is not current: cmake --build BUILD --target plumb_plugin_abilities"; exit 1; } ;;
  *) echo "abilities.sh: $mode is neither check nor write"; exit 2 ;;
esac
