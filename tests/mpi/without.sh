#!/usr/bin/env bash
# without.sh PROGRAM: a program that was built without MPI works alone, and refuses to be one of several.
source "$(dirname "$0")/../prelude.sh"

# refuses WHO VARIABLES… : one sentence from the first process, nothing from the others, exit 2, no folder
refuses() {
  local who=$1 first=$2 other=$3
  shift 3
  for rank in "$first" "$other"; do
    env "$@" "$rank" "$program" learn pendubot --learner mi --trials 1 --out run >stdout 2>stderr
    [ $? = 2 ] || fail "$* $rank: not 2"
    [ -s stdout ] && fail "$* $rank: prints $(cat stdout)"
  done
  [ -s stderr ] && fail "$* $other: says $(cat stderr)"
  env "$@" "$first" "$program" list >/dev/null 2>stderr
  [ "$(wc -l <stderr)" = 1 ] && grep -q "^rehearse: $who started this 3 times, but it was built without MPI" stderr ||
    fail "$* $first: says $(cat stderr)"
  [ -e run ] && fail "$*: leaves a folder"
}

refuses mpirun OMPI_COMM_WORLD_RANK=0 OMPI_COMM_WORLD_RANK=2 OMPI_COMM_WORLD_SIZE=3
refuses "mpirun or srun" PMI_RANK=0 PMI_RANK=1 PMI_SIZE=3
refuses srun SLURM_PROCID=0 SLURM_PROCID=1 SLURM_STEP_NUM_TASKS=3
short_campaign '["mi"]' 1-3 >c.toml
for rank in 0 1 2; do
  SLURM_PROCID=$rank SLURM_STEP_NUM_TASKS=3 "$program" campaign c.toml --out shares --threads 1 --share $((rank + 1))/3 \
    >stdout 2>&1 || fail "a share that srun started: $(cat stdout)"
  [ "$(find shares/runs -name done | wc -l)" = $((rank + 1)) ] || fail "share $((rank + 1)) of 3 did not do its run"
done
SLURM_PROCID=1 SLURM_STEP_NUM_TASKS=3 "$program" campaign c.toml --share=4/3 >stdout 2>&1
[ $? = 2 ] && grep -q "^rehearse: --share = 4/3" stdout || fail "a wrong share of the second process: $(cat stdout)"
OMPI_COMM_WORLD_SIZE=1 SLURM_STEP_NUM_TASKS=3 "$program" list | grep -q gp-mi || fail "mpirun -n 1 is refused"
"$program" list | grep -q gp-mi || fail "it does not work alone"

finish
