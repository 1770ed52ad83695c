#!/usr/bin/env bash
# shares.sh PROGRAM ARRAY: the tasks of a Slurm job array, started at the same time in one folder; some of them are killed,
# and all are started again. ARRAY: the file of the array.
set -u
REHEARSE=$(realpath "$1")
export REHEARSE
array=$(realpath "$2")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

cat >c.toml <<'TOML'
format = 1
scenario = "pendubot"
learners = ["mi", "black-drops-prior"]
priors = ["misleading"]
seeds = "1-4"
trials = 2

[set]
search.race.max_evaluations = 800
search.race.descents = 2
search.selection = 10
model.subplex.max_evaluations = 100
TOML

submit() { # every task in the background; their processes in `tasks`
  tasks=()
  for task in 1 2 3; do
    SLURM_ARRAY_TASK_ID=$task SLURM_ARRAY_TASK_MAX=3 SLURM_CPUS_PER_TASK=1 "$array" c.toml shares >output-$task 2>&1 &
    tasks+=($!)
  done
}
same() { for file in campaign.csv summary.json; do cmp one/$file shares/$file || fail "$file"; done; }

"$REHEARSE" campaign c.toml --out one >/dev/null || fail "the campaign of one process"

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
"$REHEARSE" campaign c.toml --out shares >output || fail "the tables of the shares"
grep -q "8 of 8 runs done already" output || fail "the shares leave runs to do: $(cat output)"
same

echo "$failures failures"
exit $((failures > 0))
