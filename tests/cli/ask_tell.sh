#!/usr/bin/env bash
# ask_tell.sh PROGRAM TRIALS: trials that are asked for and told are those that are driven, also when every step is killed on
# its way; a file counts once; wrong files change nothing; logs come first; status says what is next.
. "$(dirname "$0")/../prelude.sh"
trials=$2

# With this seed no two trials are alike: an episode that was told before does not count again.
short=(--set search.race.max_evaluations=600 --set search.race.descents=2 --set search.selection=10 --seed 2)
other=("${short[@]:0:6}" --seed 5)  # whose first policy is another
results=(trials.csv errors.csv notes.csv policy.json trajectories/trial-002.csv predictions/trial-003.csv)

# killed SECONDS ARGS… : a command that is killed on its way, then done to its end
killed() {
  local seconds=$1
  shift
  timeout -s KILL "$seconds" "$program" "$@" >/dev/null 2>&1
  "$program" "$@" >stdout 2>stderr || fail "$*: $(cat stderr)"
}

# told SCENARIO LEARNER TRIALS : trials that are told from those of a run that is driven
told() {
  local scenario=$1 learner=$2 trials=$3 trial
  "$program" learn "$scenario" --learner "$learner" "${short[@]}" --trials "$trials" --out "$learner-driven" >/dev/null ||
    fail "$learner"
  "$program" learn "$scenario" --learner "$learner" "${short[@]}" --trials 0 --out "$learner-told" >/dev/null ||
    fail "$learner --trials 0"
  for trial in $(seq -f %03g "$trials"); do
    killed "0.0$((RANDOM % 90 + 10))" ask "$learner-told"
    [ -s "$learner-told/next/policy.json" ] || fail "no policy of trial $trial"
    killed "0.0$((RANDOM % 90 + 10))" tell "$learner-told" "$learner-driven/trajectories/trial-$trial.csv"
  done
  same "$learner-driven" "$learner-told" "${results[@]}"
}
told pendulum gp-mi "$trials"
told pendulum black-drops 3

# The status says what is known and what comes next.
"$program" status gp-mi-told >stdout || fail "status"
grep -q "next: rehearse ask gp-mi-told" stdout || fail "status does not say what is next: $(cat stdout)"
"$program" status gp-mi-driven | grep -q "next: rehearse report gp-mi-driven shows it" || fail "status of a run that is complete"
"$program" ask gp-mi-told >stdout || fail "ask again"
grep -q "trial $((trials + 1)): run the policy of gp-mi-told/next" stdout || fail "ask says $(cat stdout)"
grep -q "columns: time \[s\], " stdout || fail "ask does not say what is expected: $(cat stdout)"
"$program" status gp-mi-told | grep -q "trial $((trials + 1)): run the policy" || fail "status forgets what was asked"

# refused TEXT ARGS… : exit 2, a line with the text, nothing changed
refused() {
  local text=$1
  shift
  cp gp-mi-told/checkpoint before
  "$program" "$@" >stdout 2>stderr
  [ $? = 2 ] || fail "$*: not refused"
  grep -q -- "$text" stderr || fail "$*: $(cat stderr)"
  cmp before gp-mi-told/checkpoint || fail "$*: it changed something"
}
episode=gp-mi-driven/trajectories/trial-003.csv
head -20 $episode >short.csv
sed '1s/action/actoin/; 1s/torque/torqeu/; 1s/time/tiem/' $episode >misspelt.csv
sed '5s/[0-9]/x/' $episode >letters.csv
refused "18 of 40 steps, which take 41 rows" tell gp-mi-told short.csv
refused "tiem" tell gp-mi-told misspelt.csv
refused "row 5" tell gp-mi-told letters.csv
refused "one file tells it, but 2 are named" tell gp-mi-told short.csv letters.csv
refused "none.csv" tell gp-mi-told none.csv
refused "no-fault goes with" tell gp-mi-told short.csv --no-fault
refused "says no reason" tell gp-mi-told short.csv --stopped ""
refused "is not a folder" ask nowhere
refused "is not a folder" status nowhere
refused "goes on by .ask. and .tell." resume gp-mi-told
"$program" tell gp-mi-told $episode | grep -q "told before, nothing is changed" || fail "a file counts twice"
for copy in gp-mi-told/trajectories/trial-003.csv windows.csv; do
  sed 's/$/\r/' $episode >windows.csv
  "$program" tell gp-mi-told $copy | grep -q "told before, nothing is changed" || fail "$copy counts as another episode"
done
cp gp-mi-told/checkpoint untold
"$program" tell gp-mi-told short.csv --stopped "a cable came off" --no-fault >stdout 2>stderr || fail "$(cat stderr)"
grep -q "a cable came off" gp-mi-told/notes.csv || fail "the reason is lost"

# The last file can be taken back.
refused "goes with nothing else" tell gp-mi-told short.csv --undo
refused "goes with nothing else" tell gp-mi-told --undo --no-fault
refused "FILE.csv is required" tell gp-mi-told
cp -r gp-mi-told kept
"$program" ask gp-mi-told >/dev/null || fail "ask"
awk -F, -v OFS=, 'NR == 42 { $3 += 0.001 } 1' $episode >wrong.csv
"$program" tell gp-mi-told wrong.csv >stdout 2>stderr || fail "tell: $(cat stderr)"
"$program" tell gp-mi-told --undo >stdout 2>stderr || fail "undo: $(cat stderr)"
grep -q "trial $((trials + 2)) is taken back" stdout || fail "undo says $(cat stdout)"
grep -q "^next: rehearse tell gp-mi-told EPISODE.csv$" stdout || fail "after undo the next is $(cat stdout)"
cmp wrong.csv gp-mi-told/taken-back/*-wrong.csv || fail "what was taken back is lost"
"$program" tell gp-mi-told --undo >stdout 2>stderr || fail "undo again: $(cat stderr)"
cmp untold gp-mi-told/checkpoint || fail "the run is not as it was before"
"$program" tell gp-mi-told short.csv --stopped "a cable came off" --no-fault >stdout 2>stderr || fail "$(cat stderr)"
diff -r kept gp-mi-told --exclude timings.csv --exclude checkpoint --exclude taken-back --exclude lock ||
  fail "told again, the run is another"

# A run at work gets no advice that would be refused; what is advised can be copied, spaces and all.
exec 9>>gp-mi-told/lock
flock 9
"$program" status gp-mi-told >stdout || fail "status of a run at work"
grep -q "a process is at work on it" stdout || fail "status does not see the process: $(cat stdout)"
grep -qE "next:|then:" stdout && fail "status advises what would be refused: $(cat stdout)"
exec 9>&-
cp -r gp-mi-told "it's told"
"$program" status "it's told" >stdout || fail "status of a folder with a space"
grep -qF "next: rehearse ask 'it'\\''s told'" stdout || fail "what is advised cannot be copied: $(cat stdout)"

# The files of a policy that is asked for are named with commands that run.
"$program" ask "it's told" >stdout || fail "ask in a folder with a space"
grep -q "numbers: policy.json" stdout || fail "ask does not name the files: $(cat stdout)"
of_c=$(sed -n 's/^  C: policy.h, its test: //p' stdout) of_python=$(sed -n 's/^  Python with NumPy: policy.py, its test: //p' stdout)
[ -n "$of_c" ] && [ -n "$of_python" ] || fail "ask does not say how policies are tested: $(cat stdout)"
if command -v cc >/dev/null; then bash -c "$of_c" >said 2>&1 || fail "$of_c: $(cat said)"; fi
if python3 -c 'import numpy' 2>/dev/null; then bash -c "$of_python" >said 2>&1 || fail "$of_python: $(cat said)"; fi

# Logs first: the first policy of a learner without a prior is not random any more.
"$program" learn pendulum --learner black-drops "${other[@]}" --trials 0 --out logs >/dev/null || fail "logs"
"$program" tell logs black-drops-driven/trajectories/trial-001.csv black-drops-driven/trajectories/trial-002.csv \
  >stdout 2>stderr || fail "tell logs: $(cat stderr)"
grep -q "log trial-001.csv: " stdout || fail "tell says $(cat stdout)"
[ "$(wc -l <logs/logs.csv)" = 3 ] && [ -s logs/logs/log-002.csv ] || fail "logs are not kept"
"$program" ask logs >stdout || fail "ask after logs"
grep -q '"policy": "schedule"' logs/next/policy.json && fail "the first policy is still random"
grep -q "predicted return" stdout || fail "nothing is predicted after logs"

# The episode of the policy that was asked for is no log.
"$program" learn pendulum --learner black-drops "${short[@]}" --trials 0 --out glob >/dev/null || fail "glob"
"$program" ask glob >/dev/null || fail "ask before a glob"
"$program" tell glob black-drops-driven/trajectories/trial-00?.csv 2>stderr && fail "the trial becomes a log"
grep -q "trial-001.csv has the actions of the policy that was asked for: tell it alone, as trial 1" stderr ||
  fail "tell says $(cat stderr)"

# Several files are logs after `ask`, too, and all is as if it had not been asked.
"$program" learn pendulum --learner black-drops "${other[@]}" --trials 0 --out late >/dev/null || fail "late"
"$program" ask late >/dev/null || fail "ask before logs"
killed 0.05 tell late black-drops-driven/trajectories/trial-001.csv black-drops-driven/trajectories/trial-002.csv
grep -q "log trial-002.csv: " stdout || fail "several files after ask are no logs: $(cat stdout)"
[ ! -e late/next ] || fail "the policy that was dropped is still there"
"$program" tell late --undo | grep -q "the logs are taken back" || fail "logs after ask cannot be taken back"
"$program" ask late >/dev/null || fail "ask again"
"$program" tell late black-drops-driven/trajectories/trial-001.csv black-drops-driven/trajectories/trial-002.csv \
  >stdout 2>stderr || fail "tell logs after ask: $(cat stderr)"
grep -q "the policy that was asked for is dropped" stdout || fail "tell says $(cat stdout)"
[ ! -e late/predictions/trial-001.csv ] || fail "the prediction of the policy that was dropped is still there"
"$program" ask late >/dev/null || fail "ask after late logs"
same logs late logs.csv logs/log-001.csv trials.csv next/policy.json predictions/trial-001.csv
sed $'1s/$/,\xc2\x9b2J/; 2,$s/$/,0/' black-drops-driven/trajectories/trial-002.csv >controls.csv
"$program" learn pendulum --learner black-drops "${short[@]}" --trials 0 --out controls >/dev/null || fail "controls"
for command in "tell controls controls.csv" "status controls"; do
  "$program" $command >stdout 2>stderr || fail "$command: $(cat stderr)"
  grep -q 'not used: \\x9b2J' stdout || fail "$command gives a terminal what a column is named: $(cat -v stdout)"
done
killed 0.05 tell logs black-drops-driven/trajectories/trial-003.csv
killed 0.05 ask logs
grep -q "^1," logs/trials.csv || fail "the trial after logs is lost"
finish
