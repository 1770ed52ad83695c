#!/usr/bin/env bash
# A campaign as one Slurm job on several nodes: rank 0 hands out the runs to all ranks, and writes the tables.
#
#   sbatch campaigns/slurm-mpi.sh FILE.toml DIR
#
# DIR must be on a file system that all nodes share. Submitted again, it continues. For one long run, the same with
# `learn … --out DIR`, then `resume DIR`.
#SBATCH --job-name=rehearse
#SBATCH --ntasks=40
#SBATCH --cpus-per-task=1
#SBATCH --time=12:00:00
#SBATCH --requeue
set -euo pipefail
# Or mpirun, which asks Slurm for the nodes itself:  mpirun rehearse campaign …
exec srun --mpi=pmix "${REHEARSE:-rehearse}" campaign "$1" --out "$2" --threads "${SLURM_CPUS_PER_TASK:-1}"
