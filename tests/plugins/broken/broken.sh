#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# broken.sh CHECKER PLUGIN PATTERN: the suite's verdict on a plugin holds the pattern, and its exit code agrees.
set -eu
checker=$1 plugin=$2 pattern=$3
code=0
said=$("$checker" "$plugin" --limit 5 2>/dev/null) || code=$?
echo "$said"
wanted=1
[ "$pattern" != conforms ] || wanted=0
[ "$code" = "$wanted" ] || { echo "exit code $code, not $wanted"; exit 1; }
echo "$said" | grep -E "$pattern" >/dev/null || { echo "nothing says: $pattern"; exit 1; }
