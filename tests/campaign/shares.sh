#!/usr/bin/env bash
# shares.sh PROGRAM ARRAY: the tasks of a Slurm job array, started at the same time in one folder; some of them are killed,
# and all are started again. ARRAY: the file of the array.
array=$(realpath "$2")
source "$(dirname "$0")/../prelude.sh"
export REHEARSE=$program

short_campaign '["mi", "black-drops-prior"]' 1-4 >c.toml

submit() { # every task in the background; their processes in `tasks`
  tasks=()
  for task in 1 2 3; do
    SLURM_ARRAY_TASK_ID=$task SLURM_ARRAY_TASK_MAX=3 SLURM_CPUS_PER_TASK=1 "$array" c.toml shares >output-$task 2>&1 &
    tasks+=($!)
  done
}

"$program" campaign c.toml --out one >/dev/null || fail "the campaign of one process"

submit
until [ "$(find shares/runs -name trial-001.csv -path '*trajectories*' 2>/dev/null | wc -l)" -ge 2 ]; do sleep 0.002; done
kill -KILL "${tasks[@]:1}"
wait
echo "two of three tasks killed, $(find shares/runs -name done | wc -l) of 8 runs done"
submit
wait
for task in 1 2 3; do
  grep -q "share $task of 3, $((task < 3 ? 3 : 2)) runs" output-$task || fail "task $task says $(cat output-$task)"
done
[ -e shares/campaign.csv ] && fail "a share writes tables"
"$program" campaign c.toml --out shares >output || fail "the tables of the shares"
grep -q "8 of 8 runs done already" output || fail "the shares leave runs to do: $(cat output)"
same one shares "${tables[@]}"

finish
