#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# sbatch --array=1-N --exclusive bench/many_machines/slurm.sh DIR [plumb cost's arguments]: a sweep in N parts as an array of jobs on
# a folder that all nodes share. Then: plumb cost --merge DIR/part* --out DIR. A part that was cut off goes on when the
# same array is submitted again.
#SBATCH --job-name=plumb-cost
#SBATCH --ntasks=1
set -eu
folder=$1
shift
part=$SLURM_ARRAY_TASK_ID
exec "${PLUMB:-plumb}" cost "$@" --shard "$part/$SLURM_ARRAY_TASK_COUNT" --out "$folder/part$part" --quiet
