#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# mpirun -n N bash bench/many_machines/mpi.sh DIR [plumb cost's arguments]: a sweep in N parts by the launcher of MPI (Open
# MPI, MPICH or Slurm's srun), on a folder that all ranks share. Then: plumb cost --merge DIR/part* --out DIR.
set -eu
folder=$1
shift
rank=${OMPI_COMM_WORLD_RANK:-${PMI_RANK:-${SLURM_PROCID:?is not set: run this by mpirun or srun}}}
size=${OMPI_COMM_WORLD_SIZE:-${PMI_SIZE:-${SLURM_NTASKS:?is not set}}}
part=$((rank + 1))
exec "${PLUMB:-plumb}" cost "$@" --shard "$part/$size" --out "$folder/part$part" --quiet
