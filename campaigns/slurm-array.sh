#!/usr/bin/env bash
# A campaign as a Slurm job array, without MPI: every task does its share of the runs in the same folder.
#
#   job=$(sbatch --parsable campaigns/slurm-array.sh FILE.toml DIR)
#   sbatch --dependency=afterany:"$job" --wrap "rehearse campaign FILE.toml --out DIR"
#
# The second writes the tables, and does what a lost task has left undone. DIR must be on a file system that all nodes
# share. Submitted again, the array continues: finished runs are not repeated.
#SBATCH --job-name=rehearse
#SBATCH --array=1-20
#SBATCH --cpus-per-task=4
#SBATCH --time=12:00:00
#SBATCH --requeue
set -euo pipefail
# The whole array from 1 to its end must be submitted, because the shares are counted by its end.
exec "${REHEARSE:-rehearse}" campaign "$1" --out "$2" --share "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_MAX" \
  --threads "$SLURM_CPUS_PER_TASK"
