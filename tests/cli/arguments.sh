#!/usr/bin/env bash
# arguments.sh PROGRAM: what the command line accepts and refuses, with which exit code and words.
campaigns=$(realpath "$(dirname "$0")/../../campaigns")
source "$(dirname "$0")/../prelude.sh"

# expect CODE PATTERN LINES ARGS…: the exit code, a pattern that standard error must hold (stdout for code 0), and how
# many lines there must be, but for notes, which are indented (- for any).
expect() {
  local code=$1 pattern=$2 lines=$3
  shift 3
  "$program" "$@" >stdout 2>stderr
  local got=$? stream=stderr
  [ "$code" = 0 ] && stream=stdout
  [ $got = "$code" ] || fail "'$*' exits with $got, must be $code: $(cat stderr)"
  grep -qF -- "$pattern" $stream || fail "'$*' does not say '$pattern' but: $(cat $stream)"
  [ "$lines" = - ] || [ "$(grep -vc '^  ' $stream)" = "$lines" ] || fail "'$*' says $(wc -l <$stream) lines: $(cat $stream)"
}

quick=(--trials 1 --set search.race.max_evaluations=100 --set search.race.descents=1 --set search.selection=2)

expect 0 "rehearse " 1 --version
expect 0 "Example" - --help
expect 0 "--prior" - learn --help
for command in list new check learn resume ask tell status campaign identify report replay export evaluate; do
  expect 0 "rehearse $command " - "$command" --help # an example of its own
done
expect 0 "Example" - help
expect 0 "--prior" - help learn
expect 2 "unknown command 'lern', did you mean 'learn'?" 1 help lern
expect 2 "--until-solved takes no value" 1 learn pendubot --until-solved=3
expect 2 "--json takes no value" 1 list --json=no
expect 0 "misleading" - list
expect 0 '"takes_prior": true' - list --json
expect 0 "search.race.max_evaluations = " - list --options
expect 0 "search.method = race  (the paper: restarts)" - list --options
expect 0 "takes no prior; policy = rbf, unless another is set" - list
expect 0 "as-published       the paper's settings" - list
expect 0 "more for experts: rehearse list gp-mi --expert" - list gp-mi
[ "$(grep -cE '^[a-z_]+(\.[a-z_]+)* ' stdout)" -le 46 ] || fail "'list gp-mi' shows $(wc -l <stdout) lines"
[ "$(wc -L <stdout)" -le 120 ] || fail "'list gp-mi' has a line of $(wc -L <stdout) characters"
grep -qE '^search\.method +race +restarts +race, restarts, ' stdout || fail "'list gp-mi' does not show search.method"
grep -q '^search.restarts.step ' stdout && fail "'list gp-mi' shows options for experts"
expect 0 "search.restarts.cmaes.max_condition  " - list gp-mi --expert
expect 0 "mass of the first link [kg]" - list pendubot
grep -q '^prior.m2 \[kg\] .*0.75, 0.05 to 1.2' stdout || fail "'list pendubot' does not say where priors start"
grep -q '^box_low .* 0 (the ' stdout || fail "'list pendubot' does not say whose box_low is"
expect 0 '"help": "mass of the first link [kg]"' - list pendubot --json
expect 0 "zero_range " - list identify
expect 2 "unknown scenario or learner 'gpmi', did you mean 'gp-mi'?" 1 list gpmi
expect 2 "--expert is for one scenario or learner" 1 list --expert
expect 0 '"value": "restarts"' - list --json

expect 2 "a command is missing (list, new, check, learn, " 1
expect 2 "unknown command 'lern', did you mean 'learn'?" 1 lern
expect 2 "unknown flag '--colour' of list" 1 list --colour
expect 2 "unknown flag '--prio' of learn, did you mean '--prior'?" 1 learn pendubot --prio=useful
expect 2 "unknown flag '--trail' of replay, did you mean '--trial'?" 1 replay runs/demo --trail 1
expect 2 "SCENARIO is required" 1 learn
expect 2 "--learner is given 2 times, must be once" 1 learn pendubot --learner gp-mi --learner mi
expect 2 "--seed is given 3 times, must be once" 2 learn pendubot --seed 1 --seed 2 --seed 3 --out a --out b
expect 2 "DIR is required" 1 resume

expect 0 "unnamed is ready" - learn pendubot --trials 0 --out unnamed
grep -q '^learner = "gp-mi"' unnamed/spec.toml || fail "without a learner: $(grep learner unnamed/spec.toml)"
"$program" new priorless >/dev/null && sed -i "/^\\[prior/,\$d" priorless.toml
expect 0 "priorless is ready" - learn priorless.toml --trials 0 --out priorless
grep -q '^learner = "black-drops"' priorless/spec.toml || fail "without a prior: $(grep learner priorless/spec.toml)"
expect 0 "guessed is ready" - learn priorless.toml --prior oracle --trials 0 --out guessed
grep -q '^learner = "gp-mi"' guessed/spec.toml || fail "with the oracle alone: $(grep learner guessed/spec.toml)"
expect 2 "unknown scenario 'pendubott', did you mean 'pendubot'?" 1 learn pendubott
expect 2 "unknown scenario 'pendubott', did you mean 'pendubot'?" 1 learn pendubott --learner gp-mi
expect 2 "unknown learner 'gpmi', did you mean 'gp-mi'?" 1 learn pendubot --learner gpmi
expect 2 "unknown prior 'usful' of scenario pendubot, did you mean 'useful'?" 1 learn pendubot --learner gp-mi --prior usful
expect 2 "takes no prior, but 'useful' is given" 1 learn pendubot --learner black-drops --prior useful
expect 2 "takes one prior, but 'useful,partial' names 2" 1 learn pendubot --learner black-drops-prior --prior useful,partial
expect 2 "prior 'useful' is named twice" 1 learn pendubot --learner gp-mi --prior useful,useful
expect 2 "unknown prior ''" 1 learn pendubot --learner gp-mi --prior useful,
expect 2 "--trials = -3, must be between 0 and" 1 learn pendubot --learner gp-mi --trials -3
expect 2 "--trials = ten, must be a whole number" 1 learn pendubot --learner gp-mi --trials ten
expect 2 "--trials = 2.5, must be a whole number" 1 learn pendubot --learner gp-mi --trials=2.5
expect 2 "--seed = -1, must be between 0 and" 1 learn pendubot --learner gp-mi --seed -1
expect 2 "--threads = 0, must be between 1 and" 1 learn pendubot --learner gp-mi --threads 0
expect 2 "--threads = -2, must be between 1 and" 1 learn pendubot --learner gp-mi --threads -2
expect 2 "--trials" 1 learn pendubot --learner gp-mi --trials
expect 2 "--set plant.b1: must be KEY=VALUE" 1 learn pendubot --learner gp-mi --set plant.b1
expect 2 "unknown option 'plant.b3', did you mean 'plant.b" 1 learn pendubot --learner gp-mi --set plant.b3=1
expect 2 "unknown option 'prior.l9', did you mean 'prior.l" 1 learn pendubot --learner gp-mi --set prior.l9=1
expect 2 "plant.m1 = heavy, must be a number" 1 learn pendubot --learner gp-mi --set plant.m1=heavy
expect 2 "plant.m1 = -1, must be > 0" 1 learn pendubot --learner gp-mi --set plant.m1=-1
expect 2 "box_low = 2, must be < box_high = 1.2" 1 learn pendubot --learner gp-mi --set box_low=2
expect 2 "l2 = 99, must be between" 1 learn pendubot --learner gp-mi --set prior.l2=99
expect 2 "--seed = x" 4 learn pendubot --learner gp-mi --seed x --trials -1 --set colour=red --prior usful
expect 2 "the robot has no guess of the reward" 1 learn pendubot --learner gp-mi --set reward.learned=true
expect 2 "policy = mlp has no analytic moments, which pilco needs: choose policy = rbf (--set policy=rbf)" 1 \
  learn cartpole --learner pilco --set policy=mlp
expect 2 "unknown preset 'as-publisht', did you mean 'as-published'? (known: as-published)" 1 \
  learn pendubot --learner gp-mi --preset as-publisht
expect 2 "cannot read mine.toml" 1 learn pendubot --learner gp-mi --preset mine.toml
printf 'format = 1\n[set]\nsearch.box = 4\nserch.box = 4\n' >mine.toml
expect 2 "mine.toml: line 4: unknown option 'serch.box', did you mean 'search.box'?" 1 \
  learn pendubot --learner gp-mi --preset mine.toml
expect 2 "cannot read nothing.toml" 1 learn nothing.toml
expect 2 "search.box = 1e+308, must be between 1e-06 and 1000000" 1 learn pendubot --learner gp-mi --set search.box=1e308
expect 2 "archive.box = 1e+308, must be between 1e-06 and 1000000" 1 learn pendubot --learner ite --set archive.box=1e308
expect 2 'unknown learner '"'"'\x1b[31mred\x9b\x07\xe9é'"'" 1 learn pendubot --learner $'\e[31mred\xc2\x9b\a\xe9é'
grep -q '[[:cntrl:]]' <(tr -d '\n' <stderr) && fail "escapes of a terminal are printed as they are"
for command in list "list --json" "list gp-mi" --help --version "learn --help"; do
  "$program" $command >/dev/full 2>stderr
  [ $? = 1 ] && grep -q "cannot write" stderr || fail "'$command' to a full disk exits with $?: $(cat stderr)"
done
"$program" list nope 2>/dev/full
[ $? = 2 ] || fail "an error that cannot be written exits with $?"
"$program" list >/dev/full 2>&1
[ $? = 1 ] || fail "a list and an error that cannot be written exit with $?"
printf 'format = 1\n[run]\nscenario = 3\nlearner = "gp-mi"\n' >number.toml
expect 2 "number.toml: line 3: scenario must be text in quotes" 1 learn number.toml
printf 'format = 1\nscenario = 3\nlearners = "gp-mi"\nseeds = 1\n' >number.toml
expect 2 "number.toml: line 2: scenario must be text in quotes" 1 campaign number.toml --dry-run
printf 'format = 1\ntitle = "\\u001b[31mred"\nscenario = "pendubot"\nlearners = "mi"\nseeds = 1\n' >coloured.toml
expect 0 '\x1b[31mred: 1 run' - campaign coloured.toml --dry-run
mkfifo fifo.toml
expect 2 "cannot read fifo.toml: it is no regular file" 1 learn fifo.toml
expect 2 "cannot read fifo.toml: it is no regular file" 1 campaign fifo.toml --dry-run
echo 'not = [toml' >broken.toml
expect 2 "broken.toml: line" 1 learn broken.toml
[ -e runs ] && fail "wrong arguments leave a folder"

expect 0 "best return" 3 learn pendubot --learner gp-mi "${quick[@]}"
run=runs/pendubot-gp-mi-useful-1
[ -f $run/done ] || fail "the default folder is not $run"
header=trial,interaction_s,return,solved,predicted_return,rollouts,failed_rollouts,log_evidence
for name in m1 m2 l1 l2; do header+=,phi.$name,phi.$name.low,phi.$name.high; done
[ "$(head -1 $run/trials.csv)" = $header ] || fail "trials.csv begins with $(head -1 $run/trials.csv)"

before=$(cat $run/* 2>/dev/null | cksum)
expect 2 "already exists and is never overwritten" 1 learn pendubot --learner gp-mi "${quick[@]}"
expect 2 "already exists and is never overwritten" 1 learn pendubot --learner gp-mi "${quick[@]}" --out $run/
expect 2 "already exists and is never overwritten" 1 learn $run/spec.toml
expect 2 "says it already" 1 learn $run/spec.toml --learner mi --out other
sed 's/^plant.b1/plant.b3/' $run/spec.toml >wrong-spec.toml
expect 2 "unknown option 'scenario.plant.b3', did you mean 'scenario.plant.b" 1 learn wrong-spec.toml --out other
expect 2 "wrong-spec.toml: line $(grep -n '^plant.b3' wrong-spec.toml | cut -d: -f1): " 1 learn wrong-spec.toml --out other
[ "$before" = "$(cat $run/* 2>/dev/null | cksum)" ] || fail "a refused run changed the folder"
expect 0 "best return" 3 learn $run/spec.toml --out again
cmp $run/trials.csv again/trials.csv || fail "spec.toml gives another trials.csv"

# A preset comes before --set; the spec is complete.
expect 0 "best return" 3 learn pendubot --learner gp-mi --preset as-published --trials 1 \
  --set search.restarts.max_evaluations=200 --set model.score=harmonic --out published
for line in 'search.method = "restarts"' 'policy_gain = 1' 'model.gp.smooth = false' 'model.score = "harmonic"'; do
  grep -qE "^$line +# [^ ]" published/spec.toml || fail "published/spec.toml has no line '$line'"
done
expect 0 "best return" 3 learn published/spec.toml --out published-again
cmp published/trials.csv published-again/trials.csv || fail "the spec of a preset gives another trials.csv"

# A learner brings the policy that it needs, in campaigns too; a preset or the user may say another.
expect 0 "best return" 3 learn cartpole --learner pilco --trials 1 --out alone
grep -q '^policy = "rbf" ' alone/spec.toml || fail "pilco alone has $(grep ^policy alone/spec.toml)"
expect 0 "best return" 3 learn pendulum --learner pilco --trials 1 --set policy=linear --set policy_squash=sine --out lines
grep -q '^policy = "linear" ' lines/spec.toml || fail "a policy that was asked for is $(grep ^policy lines/spec.toml)"
printf 'format = 1\nscenario = "pendubot"\nlearners = ["pilco", "mi"]\nseeds = 1\n' >pilco.toml
expect 0 "2 runs" - campaign pilco.toml --dry-run
printf '[set]\npolicy = "mlp"\n' >>pilco.toml
expect 2 "pilco.toml: line 6: policy = mlp has no analytic moments" 1 campaign pilco.toml --dry-run

expect 0 "best return" - resume $run
expect 2 "nothing is not a folder" 1 resume nothing
expect 2 "is not a run folder" 1 resume runs
expect 2 "--trials = -1" 1 resume $run --trials -1
expect 0 "best return" - resume again --trials 2
expect 2 "trials = 1, but 2 trials of again are done" 1 resume again --trials 1
truncate -s -1 again/checkpoint
expect 2 "the checkpoint is truncated or damaged" 1 resume again
: >again/checkpoint
expect 2 "the checkpoint is truncated" 1 resume again
head -c 300 $run/spec.toml >again/spec.toml
cp $run/checkpoint again/checkpoint
expect 2 "again" 1 resume again
rm again/spec.toml
expect 2 "it has no spec.toml" 1 resume again

# Links, FIFOs and what a kill left.
cp -r $run linked
echo precious >victim
for file in trials.csv checkpoint; do ln -s ../victim linked/$file.tmp; done
rm linked/errors.csv linked/lock
ln -s ../victim linked/errors.csv
ln -s ../nowhere linked/lock
expect 2 "cannot write linked/lock: it is a link" 1 resume linked
[ -e nowhere ] && fail "a lock is made through a link"
rm linked/lock
expect 0 "best return" - resume linked --trials 2
[ "$(cat victim)" = precious ] || fail "resume writes through a link"
[ -f linked/errors.csv ] && [ ! -L linked/errors.csv ] || fail "a link in the place of a table is not replaced"
rm linked/checkpoint linked/lock
mkfifo linked/checkpoint linked/lock
expect 2 "cannot write linked/lock: it is no regular file" 1 resume linked
rm linked/lock
expect 2 "cannot read linked/checkpoint: it is no regular file" 1 resume linked
mv linked/spec.toml kept.toml
mkfifo linked/spec.toml
expect 2 "linked/spec.toml: it is no regular file" 1 report linked
expect 2 "linked/spec.toml: it is no regular file" 1 replay linked --trial 1
expect 2 "a.svg: a page of Rehearse must end in .html or .htm" 1 report linked --out a.svg
expect 2 "a.svg: a page of Rehearse must end in .html or .htm" 2 replay linked --trial 0 --out a.svg
expect 2 "a.svg: a page of Rehearse must end in .html or .htm" 1 check pendulum --out a.svg
expect 2 "--out shows the plant's motion: leave --no-plant out" 1 check pendulum --out a.html --no-plant
expect 0 "left alone" - check pendulum --no-plant
sleep 0 & killed=$!
wait $killed
mkdir -p begun/.run.$killed/trajectories
expect 0 "best return" - learn pendubot --learner gp-mi "${quick[@]}" --out begun/run
[ "$(ls -A begun)" = run ] || fail "of a beginning that was killed remains $(ls -A begun)"

# What is wrong is said at once, wherever it is.
printf 'format = 1\nname = "broken"\ndt = 1\n' >broken.toml
expect 2 "unknown learner 'mii'" - learn broken.toml --learner mii --trials -1
grep -q "trials = -1" stderr && grep -q "unknown key 'dt'" stderr || fail "a broken file hides other errors: $(cat stderr)"
sed 's/^name = .*/name = "unnamed"/' broken.toml >unnamed.toml
expect 2 "there is no scenario 'unnamed'; the file is unnamed.toml" 3 learn unnamed --threads 0 --seed -2
expect 2 "cannot read missing.json" 2 learn pendubot --learner gp-mi --policy missing.json --seed -1
expect 2 "cannot read missing.json" 2 evaluate "$run" --policy missing.json --episodes 0
expect 2 "trial = 99, must be between" 2 evaluate "$run" --trial 99 --episodes 0
expect 2 "nowhere is not a folder" 2 evaluate nowhere --episodes 0
expect 2 "unknown option 'q'" - learn pendubot --set q=1 --out "$run"
grep -q "already exists" stderr || fail "an option hides that the folder is there: $(cat stderr)"
expect 2 "unknown option 'plant.q'" - evaluate "$run" --trial 99 --set plant.q=1
grep -q "trial = 99, must be between" stderr || fail "an option hides that there is no such trial: $(cat stderr)"

# Failures with a cause outside the run (memory, disk) end by resuming it; failures of its computation do not.
(
  ulimit -v 1000000
  "$program" list >/dev/null 2>&1 || exit 0  # not with a sanitizer
  expect 1 "there is not enough memory; the largest sizes that are asked for: learner.search.selection = 1000000, scenario.hidden = 3000" 2 \
    learn pendulum --learner gp-mi --trials 1 --threads 1 --set search.selection=1000000 --set hidden=3000 --out large
  grep -q "once the cause is gone: rehearse resume large" stderr || fail "without memory it says $(cat stderr)"
  exit $failures
) || fail "see above"
(
  trap '' XFSZ
  ulimit -f 22  # the spec fits, the prediction does not
  expect 1 "cannot write full/" 2 learn pendubot --learner gp-mi "${quick[@]}" --out full
  grep -q "once the cause is gone: rehearse resume full" stderr || fail "on a full disk it says $(cat stderr)"
  exit $failures
) || fail "see above"
expect 0 "best return" - resume full
cmp $run/trials.csv full/trials.csv || fail "a run that met a full disk ends with other bytes"

# The cache is bounded.
mkdir -p cache/0123456789abcdef
truncate -s 2G cache/0123456789abcdef/archive-0123456789abcdef
echo kept >cache/0123456789abcdef/letter
REHEARSE_CACHE=$PWD/cache "$program" learn pendubot --learner ite --trials 1 --set archive.niches=100 \
  --set archive.evaluations=500 --out cached >/dev/null || fail "a run with a cache fails"
[ ! -e cache/0123456789abcdef/archive-0123456789abcdef ] || fail "the cache is not pruned"
[ "$(ls cache/*/archive-* | wc -l)" = 1 ] && [ -f cache/0123456789abcdef/letter ] || fail "the cache has $(ls cache/*)"

# Campaigns; what is wrong with a file is tested in the room, what running one does in tests/campaign.
expect 0 "--check-claims" - campaign --help
expect 2 "FILE is required" 1 campaign
expect 2 "cannot read nothing.toml" 1 campaign nothing.toml
expect 2 "--threads = 0, must be between 1 and" 1 campaign nothing.toml --threads 0
for share in 4/3 0/3 3 x/3 1/ /3 1/2/3; do
  expect 2 "--share = $share, must be K/N with K from 1 to N" 1 campaign nothing.toml --share $share
done
expect 2 "--check-claims needs all runs" 1 campaign nothing.toml --share 1/3 --check-claims
printf 'format = 1\nscenario = "pendubot"\nlearners = "mi"\nseeds = 1\ntrails = 2\n[set]\nplant.b9 = 1\n' >wrong.toml
expect 2 "wrong.toml: line 5: unknown key 'trails', did you mean 'trials'?" 2 campaign wrong.toml --out wrong
expect 2 "wrong.toml: line 7: unknown option 'plant.b9', did you mean 'plant.b" 2 campaign wrong.toml --out wrong
printf 'format = 1\nscenario = "pendubot"\nlearners = ["black-drops", "mi"]\nseeds = 1\n[set]\nreward.learned = true\n' >wrong.toml
expect 2 "wrong.toml: line 6: reward.learned = true, but the robot has no guess of the reward" 1 campaign wrong.toml --dry-run
[ -e wrong ] && fail "a wrong campaign file leaves a folder"
ln -s "$campaigns/../results" results  # where archives are
"$program" list | sed -n '/^Not built/,/^$/p' >not-built
for file in "$campaigns"/*.toml; do
  scenario=$(sed -n 's/^scenario = "\(.*\)"/\1/p' "$file")
  if grep -q "^  $scenario " not-built; then
    expect 2 "scenario '$scenario' is not built: " 1 campaign "$file" --dry-run
  else
    expect 0 " runs (" - campaign "$file" --dry-run
  fi
done
expect 2 "is not the folder of a campaign" 1 campaign "$campaigns/pendulum.toml" --out $run

# Ctrl-C: 130, and the run can be resumed.
"$program" learn pendubot --learner gp-mi --trials 2 --out stopped >stdout 2>stderr &
process=$!
until [ -d stopped ] || ! kill -0 $process 2>/dev/null; do sleep 0.05; done
kill -INT $process
wait $process
code=$?
[ $code = 130 ] || fail "an interrupted run exits with $code: $(cat stderr)"
grep -q "to continue: rehearse resume stopped" stderr || fail "an interrupted run says: $(cat stderr)"
expect 2 "trials = 0" 1 resume stopped --trials 0

finish
