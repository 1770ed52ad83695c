#!/usr/bin/env bash
# kill.sh PROGRAM LEARNER INSTANTS: kills a short run with SIGKILL at so many instants spread over its length, resumes each, and
# compares what is left with the run that was never interrupted; then compares numbers of threads and of trials, and runs
# with a cache.
source "$(dirname "$0")/../prelude.sh"
learner=$2 instants=$3

race=(--set search.race.max_evaluations=1000 --set search.race.descents=2 --set search.selection=10 --set retry.searches=1)
files=()
case $learner in
  black-drops) arguments=(pendubot "${race[@]}") ;;
  pilco-prior)  # most instants are in the episodes on the prior
    arguments=(pendulum --set policy=rbf --set pilco.prior_episodes=3 --set search.line_searches=4 --set model.inducing=40) ;;
  pi-rem)
    arguments=(pendulum --set centres=10 --set search.line_searches=8 --set search.prior_searches=3
      --set model.identify=true) ;;
  ite)
    arguments=(pendubot --prior misleading --set archive.niches=500 --set archive.evaluations=10000)
    files=(archive.bin elites.csv tried.csv) ;;
  gp-ilqg)
    arguments=(pendubot --prior useful --set identify=true --set search.starts=2 --set search.first_iterations=5
      --set search.iterations=8) ;;
  *) arguments=(pendubot --prior misleading --set model.subplex.max_evaluations=15 "${race[@]}") ;;
esac
arguments+=(--learner "$learner" --seed 5)

learn() { # learn FOLDER ARGS…
  "$program" learn "${arguments[@]}" --out "$@" >/dev/null
}

begin=$(milliseconds)
learn whole --trials 3 --threads 2 || exit 1
length=$(($(milliseconds) - begin))
echo "the whole run takes $length ms"

for instant in $(seq "$instants"); do
  run=killed-$instant
  "$program" learn "${arguments[@]}" --out $run --trials 3 --threads 2 >/dev/null &  # itself, not a shell around it
  process=$!
  until [ -d $run ] || ! kill -0 $process 2>/dev/null; do sleep 0.002; done
  after=$((length * instant / (instants + 2)))
  sleep "$(printf '%d.%03d' $((after / 1000)) $((after % 1000)))"
  kill -KILL $process 2>/dev/null
  wait $process 2>/dev/null
  finished="and was complete"
  [ -e $run/done ] || finished="after $(($(wc -l <$run/trials.csv 2>/dev/null || echo 1) - 1)) trials"
  echo "killed at instant $instant, $finished"
  "$program" resume $run >/dev/null || fail "resuming $run"
  same whole $run spec.toml trials.csv errors.csv identifiability.csv notes.csv policy.json done \
    trajectories/trial-00{1,2,3}.csv "${files[@]}"
done

learn one-thread --trials 3 --threads 1
same whole one-thread trials.csv errors.csv policy.json "${files[@]}"
learn fewer --trials 2 --threads 2
head -c "$(wc -c <fewer/trials.csv)" whole/trials.csv | cmp - fewer/trials.csv || fail "rows of two trials"
"$program" resume fewer --trials 3 >/dev/null || fail "resuming with more trials"
same whole fewer spec.toml trials.csv

if [[ $learner =~ ^(pilco-prior|pi-rem|ite)$ ]]; then
  REHEARSE_CACHE=cache learn filling --trials 3 --threads 2
  REHEARSE_CACHE=cache learn cached --trials 3 --threads 2
  same whole cached spec.toml trials.csv errors.csv notes.csv policy.json
  [ -e filling/kept ] || fail "nothing was kept in the run folder"
  [ ! -e cached/kept ] || fail "the cache was not used"
  [ "$(find cache -type f | wc -l)" = 1 ] || fail "the cache holds $(find cache -type f)"
fi

cat whole/trials.csv
finish
