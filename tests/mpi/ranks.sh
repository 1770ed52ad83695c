#!/usr/bin/env bash
# ranks.sh PROGRAM MPIRUN: campaigns on two and three ranks against one process; ranks that are killed; wrong
# input.
source "$(dirname "$0")/../prelude.sh"
mpirun=$2
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export ASAN_OPTIONS=detect_leaks=0 # Open MPI leaks

ranks() { # ranks N ARGS…
  (ranks_alone "$@")
}
ranks_alone() { # the same, as this process itself
  local n=$1
  shift
  exec "$mpirun" --oversubscribe --mca mpi_yield_when_idle 1 --bind-to none -n "$n" "$program" "$@"
}
# kill_rank RANK UNTIL-COMMAND… : of the ranks_alone that were started with "&" last; fails if they ended before
kill_rank() {
  local parent=$! rank=$1 child= process
  shift
  until "$@" || ! kill -0 $parent 2>/dev/null; do sleep 0.002; done
  for process in /proc/[0-9]*; do
    [ "$(readlink "$process/cwd")" = "$folder" ] && grep -qzx "OMPI_COMM_WORLD_RANK=$rank" "$process/environ" &&
      child=${process#/proc/}
  done
  [ -n "$child" ] && kill -KILL "$child" 2>/dev/null
  local struck=$?
  wait $parent && [ $struck = 0 ] && fail "mpirun does not tell that a rank was killed"
  return $struck
}
# On a busy machine the ranks may end before this script sees how far they are: some attempts.
# killed_rank RANK OUT UNTIL-COMMAND -- ARGS… : UNTIL-COMMAND is given OUT; two ranks that make the folder OUT
killed_rank() {
  local rank=$1 out=$2 until=$3
  shift 4
  for _ in 1 2 3 4 5 6; do
    rm -rf "$out"
    ranks_alone 2 "$@" --out "$out" >/dev/null 2>&1 &
    kill_rank "$rank" "$until" "$out" && return
  done
  fail "rank $rank ends before it can be killed, six times"
}

short_campaign '["mi", "black-drops-prior"]' 1-4 >c.toml  # long enough to be killed in
short_campaign '["mi", "black-drops-prior"]' 1-3 >few.toml

"$program" campaign c.toml --out one >/dev/null || fail "the campaign of one process"
"$program" campaign few.toml --out one-few >/dev/null || fail "the smaller campaign of one process"
ranks 3 campaign few.toml --out three >output 2>&1 || fail "the campaign of three ranks: $(cat output)"
same one-few three "${tables[@]}"
[ "$(grep -c '^few: 6 runs' output)" = 1 ] || fail "not one rank alone speaks: $(cat output)"
[ "$(grep -c '^\[ *[0-9]*/6\]' output)" = 6 ] || fail "not every run is told of once: $(cat output)"

"$mpirun" --oversubscribe -n 2 bash -c \
  "'$program' campaign few.toml --out shares --threads 1 --share \$((OMPI_COMM_WORLD_RANK + 1))/2" >output 2>&1 ||
  fail "shares that mpirun started: $(cat output)"
"$program" campaign few.toml --out shares >output || fail "the tables of shares that mpirun started"
grep -q "6 of 6 runs done already" output || fail "the shares leave runs to do: $(cat output)"
same one-few shares "${tables[@]}"

first_done_run() { compgen -G "$1/runs/*/done" >/dev/null; }
for rank in 0 1; do
  run=killed-$rank
  killed_rank $rank $run first_done_run -- campaign c.toml
  echo "rank $rank killed with $(find $run/runs -name done | wc -l) of 8 runs done"
  for done in "$run"/runs/*/done; do echo mine >"${done%done}timings.csv"; done
  finished=$(grep -lx mine $run/runs/*/timings.csv | wc -l)
  ranks 2 campaign c.toml --out $run >output 2>&1 || fail "starting $run again: $(cat output)"
  same one $run "${tables[@]}"
  [ "$(grep -lx mine $run/runs/*/timings.csv | wc -l)" = "$finished" ] || fail "$run repeats a finished run"
done

# refused PATTERN ARGS… : exit 2 and one message
refused() {
  local pattern=$1
  shift
  ranks 3 "$@" >output 2>&1
  [ $? = 2 ] || fail "$*: not 2"
  [ "$(grep -c '^rehearse: ' output)" = 1 ] && grep -q "^rehearse: .*$pattern" output || fail "$* says $(cat output)"
}
refused "threads = x" campaign c.toml --threads x
refused "one run is the work of one process" learn pendubot --learner mi --out two
refused "one run is the work of one process" resume one
mkdir two && touch two/else
refused "is not the folder of a campaign" campaign c.toml --out two
[ "$(ranks 3 --help | grep -c '^Usage')" = 1 ] || fail "help is printed by several"
"$mpirun" --oversubscribe -n 2 bash -c "'$program' campaign c.toml --out x\$OMPI_COMM_WORLD_RANK" >output 2>&1
grep -q "^rehearse: .*need the same arguments" output || fail "different arguments: $(cat output)"

# Ranks on different processors: one of them has AVX2 alone.
differently() {
  "$mpirun" --oversubscribe --bind-to none -n 1 "$program" "$@" : -n 1 -x REHEARSE_KERNELS=avx2 "$program" "$@" >output 2>&1
}
differently campaign few.toml --out mixed || fail "a campaign on different processors: $(cat output)"
same one-few mixed "${tables[@]}"

SLURM_STEP_NUM_TASKS=2 "$program" list >output 2>&1
[ $? = 2 ] && grep -q "Open MPI joins 1 of them" output || fail "a launcher that MPI does not know: $(cat output)"

finish
