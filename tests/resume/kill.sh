#!/usr/bin/env bash
# kill.sh PROGRAM LEARNER: kills a short run with SIGKILL at ten instants spread over its length, resumes each, and
# compares what is left with the run that was never interrupted; then compares numbers of threads and of trials.
source "$(dirname "$0")/../prelude.sh"
learner=$2

arguments=(pendubot --learner "$learner" --seed 5)
files=()
if [ "$learner" = ite ]; then
  arguments+=(--prior misleading --set archive.niches=500 --set archive.evaluations=60000)
  files=(archive.bin)
else
  arguments+=(--set search.race.max_evaluations=6000 --set search.race.descents=2 --set search.selection=20)
  [ "$learner" = black-drops ] || arguments+=(--prior misleading --set model.subplex.max_evaluations=15)
fi

learn() { # learn FOLDER ARGS…
  "$program" learn "${arguments[@]}" --out "$@" >/dev/null
}

begin=$(milliseconds)
learn whole --trials 3 --threads 2 || exit 1
length=$(($(milliseconds) - begin))
echo "the whole run takes $length ms"

for instant in 1 2 3 4 5 6 7 8 9 10; do
  run=killed-$instant
  rm -rf "$REHEARSE_CACHE"
  "$program" learn "${arguments[@]}" --out $run --trials 3 --threads 2 >/dev/null &  # itself, not a shell around it
  process=$!
  until [ -d $run ] || ! kill -0 $process 2>/dev/null; do sleep 0.002; done
  sleep "$(printf '%d.%03d' $((length * instant / 12 / 1000)) $((length * instant / 12 % 1000)))"
  kill -KILL $process 2>/dev/null
  wait $process 2>/dev/null
  finished="and was complete"
  [ -e $run/done ] || finished="after $(($(wc -l <$run/trials.csv 2>/dev/null || echo 1) - 1)) trials"
  echo "killed at instant $instant, $finished"
  "$program" resume $run >/dev/null || fail "resuming $run"
  same whole $run spec.toml trials.csv errors.csv doubts.csv notes.csv policy.json done \
    trajectories/trial-00{1,2,3}.csv "${files[@]}"
done

learn one-thread --trials 3 --threads 1
same whole one-thread trials.csv errors.csv policy.json "${files[@]}"
learn fewer --trials 2 --threads 2
head -c "$(wc -c <fewer/trials.csv)" whole/trials.csv | cmp - fewer/trials.csv || fail "rows of two trials"
"$program" resume fewer --trials 3 >/dev/null || fail "resuming with more trials"
same whole fewer spec.toml trials.csv

cat whole/trials.csv
finish
