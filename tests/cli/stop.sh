#!/usr/bin/env bash
# stop.sh PROGRAM: SIGINT and SIGTERM end a run in time wherever it is, with a folder that can be resumed, and a plant that
# cannot be followed ends it with the reason.
. "$(dirname "$0")/../prelude.sh"

most=4000  # ms; 2 s is what is promised, the rest is for a machine that does much else

# stopped SIGNAL CODE NAME SECONDS ARGS… : a run that is told to stop SECONDS after its folder is there
stopped() {
  local signal=$1 code=$2 name=$3 seconds=$4 begin process ended took
  shift 4
  "$program" learn "$@" --threads 2 --out "$name" >stdout 2>stderr &
  process=$!
  until [ -d "$name" ] || ! kill -0 $process 2>/dev/null; do sleep 0.02; done
  sleep "$seconds"
  kill -0 $process 2>/dev/null || fail "$name ended before it was stopped: $(cat stderr)"
  begin=$(milliseconds)
  kill -"$signal" $process
  wait $process
  ended=$?
  took=$(($(milliseconds) - begin))
  echo "$name: $ended after $took ms"
  [ $ended = "$code" ] || fail "$name exits with $ended: $(cat stderr)"
  [ $took -lt $most ] || fail "$name stops after $took ms"
  grep -q "stopping; again to end at once" stderr || fail "$name says: $(cat stderr)"
  grep -q "to continue: rehearse resume $name" stderr || fail "$name does not say how to go on: $(cat stderr)"
  [ "$(grep -c "to continue" stderr)" = 1 ] || fail "$name says it twice: $(cat stderr)"
  [ -s "$name/spec.toml" ] || fail "$name cannot be resumed"
}

# In a plant's episode, in simulated ones that are long or many, and in a search that factorises a large matrix at once.
stopped INT 130 plant 0.3 cartpole --learner black-drops --trials 2 --set horizon=1000000
stopped TERM 143 friction 2 pendulum --learner mi --trials 2 --set plant.b=1e6
stopped INT 130 horizon 0.3 cartpole --learner mi --trials 1 --set horizon=1000000
stopped INT 130 selection 1 pendulum --learner gp-mi --trials 2 --set search.selection=1000000
stopped INT 130 niches 1 pendubot --learner ite --trials 2 --set archive.niches=1000000
stopped INT 130 hidden 1 pendubot --learner gp-mi --trials 2 --set hidden=300

# A run that was left where it was goes on to the bytes of one that was not.
short=(pendulum --learner gp-mi --trials 2 --set search.race.max_evaluations=3000)
"$program" learn "${short[@]}" --out whole >/dev/null || fail "the whole run"
"$program" learn "${short[@]}" --out part >stdout 2>stderr &
process=$!
until [ -s part/trials.csv ] || ! kill -0 $process 2>/dev/null; do sleep 0.01; done
kill -INT $process
wait $process
[ -e part/done ] || "$program" resume part >/dev/null || fail "resuming"
same whole part trials.csv

"$program" learn pendulum --learner mi --trials 1 --set plant.b=1e9 --out stiff >stdout 2>stderr
code=$?
[ $code = 1 ] || fail "a plant that cannot be followed exits with $code"
grep -q "the plant failed: the equation was evaluated" stderr || fail "a plant that cannot be followed says: $(cat stderr)"

finish
