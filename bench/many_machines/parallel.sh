#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bash bench/many_machines/parallel.sh N DIR [plumb cost's arguments]: a sweep in N parts by GNU parallel, merged in DIR.
# PARALLEL="--sshloginfile hosts" spreads the parts over hosts that share the folder. Times want one part a core at most,
# of machines that are alike and do nothing else.
set -eu
parts=$1 folder=$2
shift 2
plumb=${PLUMB:-plumb}
seq "$parts" | parallel --jobs "${JOBS:-1}" --workdir "$PWD" \
  "$plumb" cost "$@" --shard "{}/$parts" --out "$folder/part{}" --quiet
"$plumb" cost --merge "$folder"/part* --out "$folder"
