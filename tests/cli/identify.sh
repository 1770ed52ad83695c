#!/usr/bin/env bash
# identify.sh PROGRAM: learns a robot from trials of a run as logs, and does what goes wrong.
source "$(dirname "$0")/../prelude.sh"

"$program" new my_robot >/dev/null
for seed in 1 2 3; do
  "$program" learn my_robot.toml --learner black-drops --trials 1 --seed $seed --out run$seed >/dev/null || fail "learn $seed"
done
log() { echo "run$1/trajectories/trial-001.csv"; }
few=(--set beyond=nothing --set particles=5 --set every_s=0.2)

"$program" identify my_robot.toml "$(log 1)" "$(log 2)" --held-out "$(log 3)" "${few[@]}" --threads 1 --out one >output 2>&1 ||
  fail "identify: $(cat output)"
grep -q "^Held-out logs" output || fail "the held-out log is not forecast: $(cat output)"
"$program" identify my_robot.toml "$(log 1)" "$(log 2)" --held-out "$(log 3)" "${few[@]}" --threads 2 --out two >/dev/null 2>&1
same one two parameters.csv zeros.csv accuracy.csv steps.csv warnings.csv forecasts-1-0.5s.csv identify.html

# refused PATTERN ARGUMENTS… : exit 2, the pattern, and nothing is written
refused() {
  local pattern=$1
  shift
  "$program" identify "$@" --out never >output 2>&1
  [ $? = 2 ] && grep -q "$pattern" output && [ ! -e never ] || fail "'$pattern' is not what it says: $(cat output)"
}
sed 's/\[rad\/s\]/[furlong]/' "$(log 1)" >units.csv
refused "units.csv: row 1: .* is in 'furlong'" my_robot.toml units.csv
refused "cannot read none.csv: it is not there" my_robot.toml none.csv
refused "unknown option 'rowz', did you mean 'rows'" my_robot.toml "$(log 1)" --set rowz=3
refused "zeros: there is no state 'thet'" my_robot.toml "$(log 1)" --set zeros=thet
refused "fit_horizon_s = 1e+300, must be > 0 and ≤ 1000000" my_robot.toml "$(log 1)" --set fit_horizon_s=1e300
refused "zeros = theta,theta has 'theta' twice" my_robot.toml "$(log 1)" --set zeros=theta,theta
refused "unknown scenario 'my_robo'" my_robo "$(log 1)"
cp "$(log 1)" copy.csv
refused "$(log 1) and copy.csv are the same" my_robot.toml "$(log 1)" "$(log 2)" --held-out copy.csv
refused "units.csv: row 1" my_robot.toml units.csv copy.csv "$(log 1)"
grep -q "are the same" output || fail "of two wrong things it says $(cat output)"
refused "must have at most 100" my_robot.toml "$(log 1)" --set read.max_bytes=100
refused "particles = 0" my_robot.toml "$(log 1)" --set particles=0 --threads 0 --prior nope
grep -q "unknown prior 'nope'" output && grep -q -- "--threads = 0" output || fail "not all at once: $(cat output)"

refused "cannot read nope.toml" nope.toml "$(log 1)" --threads 0 --set rows
grep -q -- "--threads = 0" output && grep -q -- "--set rows: must be" output || fail "not all at once: $(cat output)"

# Logs of one name are told apart by their paths.
mkdir d1 d2 && cp "$(log 1)" d1/log.csv && cp "$(log 2)" d2/log.csv
"$program" identify my_robot.toml d1/log.csv d2/log.csv "${few[@]}" --out twins >output 2>&1 || fail "twins: $(cat output)"
head -1 twins/parameters.csv | grep -q "value without d1/log.csv,.*value without d2/log.csv," ||
  fail "parameters.csv begins with $(head -1 twins/parameters.csv)"
touch file && "$program" identify my_robot.toml "$(log 1)" --out file/never >output 2>&1
[ $? = 2 ] && grep -q "cannot create file/never" output && ! grep -q "Parameters" output || fail "not known before: $(cat output)"
refused "\`list\` of identify or the robot names all" my_robot.toml "$(log 1)" --set zzzzz=1
[ -z "$(find . -maxdepth 1 -name '.*.[0-9]*')" ] || fail "it leaves $(find . -maxdepth 1 -name '.*.[0-9]*')"
"$program" identify my_robot.toml "$(log 1)" "$(log 2)" --set particles=10000 --set every_s=0.05 --threads 1 --out killed >output 2>&1 &
while kill -0 $! 2>/dev/null && [ ! -s output ]; do sleep 0.05; done # until the study says how far it is
kill -KILL $! 2>/dev/null
wait $! 2>/dev/null
[ $? = 137 ] || fail "it was not killed: $(cat output)"
[ -z "$(find . -maxdepth 1 -name '*killed*')" ] || fail "a kill leaves $(find . -maxdepth 1 -name '*killed*')"
mkdir never && "$program" identify my_robot.toml "$(log 1)" --out never >output 2>&1
[ $? = 2 ] && grep -q "never exists already" output || fail "an existing folder: $(cat output)"
finish
