#!/usr/bin/env bash
# robot_file.sh PROGRAM: begins a robot, checks it, learns it, and does what goes wrong.
source "$(dirname "$0")/../prelude.sh"

few=(--set search.race.max_evaluations=600 --set search.race.descents=2 --set search.selection=10 --threads 1)
files=(spec.toml robot.toml trials.csv errors.csv policy.json trajectories/trial-002.csv predictions/trial-002.csv
  motion/trial-002.json)

"$program" new my_robot >output || fail "new: $(cat output)"
grep -q "rehearse check my_robot.toml" output || fail "new does not say what comes next: $(cat output)"
grep -q "Try it:  rehearse check my_robot.toml" my_robot.toml || fail "the head of a new file: $(head -3 my_robot.toml)"
grep -q "examples/robots\|built-in" my_robot.toml && fail "the head of a new file: $(head -3 my_robot.toml)"
"$program" new with_ending.toml >output || fail "new with an ending: $(cat output)"
grep -q '^name = "with_ending"' with_ending.toml || fail "new with an ending has another name"
"$program" check my_robot.toml >output 2>&1 || fail "check: $(cat output)"
grep -q "rehearse learn my_robot.toml --learner gp-mi" output || fail "check does not say what comes next: $(cat output)"

grep -q "solved: .* at the end\|solved: .* for the last" output || fail "check does not say what success is: $(cat output)"
sed '/^\[plant\]/,/^measurement_noise/d' my_robot.toml >untried.toml
sed 's/^\[reward\]/&\ncost = "0.01 * u^2"/' my_robot.toml >costly.toml
"$program" check costly.toml >output 2>&1 || fail "check of a cost: $(cat output)"
grep -q "which PILCO can learn with; PILCO takes no cost" output || fail "check of a cost: $(cat output)"
"$program" check untried.toml >output 2>&1 || fail "check of a robot without a plant: $(cat output)"
grep -q "(the first prior plays the robot)" output && ! grep -q "the prior errs by" output ||
  fail "a prior that plays the robot itself has errors: $(cat output)"
sed '/^\[dynamics.rod\]/,/^tune =/d' my_robot.toml >bare.toml
"$program" check bare.toml >output 2>&1 || fail "check of a robot with neither a plant nor a prior: $(cat output)"
grep -q "nothing was tried, as there is neither a plant nor a prior; to learn: .* --learner black-drops --trials 0" output &&
  ! grep -q "on 0 steps" output || fail "check of a robot with neither a plant nor a prior: $(cat output)"
sed 's/"-cos(theta)"\]/"-l * cos(theta)"]/' my_robot.toml >long.toml
"$program" check long.toml >output 2>&1
[ $? = 2 ] && grep -q "'l' is a parameter, which the formulas of \[dynamics.rod\] alone know" output ||
  fail "a body that uses a parameter: $(cat output)"
"$program" list my_robot.toml >output 2>&1 || fail "list of a file: $(cat output)"
grep -q "^scenario my_robot: .*solved: " output && grep -q "^plant.m " output || fail "list of a file: $(cat output)"
"$program" list my_robot.toml --json | grep -q '"name": "my_robot"' || fail "list --json of a file"

"$program" check my_robot.toml --out motion.html >output 2>&1 || fail "check --out: $(cat output)"
grep -q "my_robot: an episode of random actions" motion.html || fail "check --out has another headline"

"$program" learn my_robot.toml --learner gp-mi --trials 2 "${few[@]}" --out alone >output 2>&1 || fail "learn: $(cat output)"
"$program" learn my_robot.toml --learner gp-mi --trials 1 "${few[@]}" --out extended >output 2>&1 || fail "one trial"
grep -q "seed 1: 1 trial of 4 s in extended" output || fail "a trial is none of several: $(cat output)"
sed '/^\[success\]/,/^last_s/d' my_robot.toml >endless.toml
"$program" learn endless.toml --learner gp-mi --trials 1 "${few[@]}" --out endless >output 2>&1 || fail "endless: $(cat output)"
grep -q "^1 trial, best return" output || fail "nobody can say whether it is solved: $(cat output)"
echo "name = \"another\"" >my_robot.toml # what is done to the file later does not matter
"$program" resume extended --trials 2 --threads 1 >output 2>&1 || fail "resume: $(cat output)"
same alone extended "${files[@]}"
"$program" learn alone/spec.toml --out again --threads 2 >output 2>&1 || fail "learn of spec.toml: $(cat output)"
same alone again "${files[@]}"

sed -i 's/horizon = 40/horizon = 41/' extended/robot.toml
"$program" resume extended --trials 3 >output 2>&1
[ $? = 2 ] && grep -q "has another robot than this run began with" output || fail "another robot: $(cat output)"
rm extended/robot.toml
"$program" resume extended --trials 3 >output 2>&1
[ $? = 2 ] && grep -q "unknown scenario 'my_robot'" output || fail "no robot: $(cat output)"

"$program" new many >/dev/null
printf '%s\n' 'format = 1' 'scenario = "many.toml"' 'learners = ["mi"]' 'seeds = "1-2"' 'trials = 1' '[set]' \
  'search.race.max_evaluations = 600' 'search.race.descents = 2' 'search.selection = 10' >c.toml
"$program" campaign c.toml --out campaign --threads 1 >output 2>&1 || fail "campaign: $(cat output)"
"$program" campaign c.toml --out campaign --threads 1 >output 2>&1 || fail "campaign again: $(cat output)"
grep -q "^many-mi-useful-1,many,mi" campaign/campaign.csv || fail "the campaign's table: $(cat campaign/campaign.csv)"

sed -i 's/horizon = 40/horizon = 41/' many.toml
cp -r campaign before
"$program" campaign c.toml --out campaign --threads 1 >output 2>&1
[ $? = 2 ] && grep -q "campaign was begun with another robot many: its file, or one that it names, has changed" output ||
  fail "a campaign with another robot: $(cat output)"
diff -r before campaign >output || fail "a campaign that was refused has changed: $(cat output)"

"$program" new pilco_robot >/dev/null
"$program" learn pilco_robot.toml --learner pilco --trials 2 --set search.line_searches=3 --set search.restarts=0 \
  --out pilco >output 2>&1 || fail "pilco: $(cat output)"

# refused PATTERN COMMAND… : exit 2, the pattern, and nothing is left
refused() {
  local pattern=$1
  shift
  "$program" "$@" >output 2>&1
  [ $? = 2 ] && grep -q "$pattern" output || fail "$* says $(cat output)"
  [ -e left ] && fail "$* leaves a folder"
}
refused "is not overwritten" new pilco_robot
refused "^rehearse: a robot cannot be called 'my robot'" new "my robot"
refused "name = 'pendulum' is that of another scenario" new pendulum
[ -e pendulum.toml ] && fail "a robot that is refused has a file"
refused "cannot read nowhere.toml" check nowhere.toml
refused "cannot read nowhere.toml" list nowhere.toml
printf "format = 1\nname = \"x\"\nhorizon = -1\n" >wrong.toml
refused "wrong.toml: line 3" check wrong.toml
sed 's/"pilco_robot"/"pendulum"/' pilco_robot.toml >taken.toml
refused "is that of another scenario" learn taken.toml --learner mi --out left
sed 's/sin(theta)"\]/sine(theta)"]/' pilco_robot.toml >misspelt.toml
refused "misspelt.toml: line [0-9]*: reward.distance" learn misspelt.toml --learner mi --out left
sed 's/tune = { m/tune = { b = [0, 1], m/; s/u - b \* dtheta/u/' pilco_robot.toml >idle.toml
refused "prior useful: b changes no prediction" check idle.toml

sed 's/^horizon = .*/&\nended = "abs(dtheta) > 30"/; s/^distance = .*/formula = "-1"/; /^width = /d' pilco_robot.toml >falls.toml
"$program" check falls.toml >output 2>&1 || fail "what may be wrong is refused: $(cat output)"
grep -q "earn about -1, .*falling pays.*floor = -1" output && grep -q "see what is noted above" output || fail "falls: $(cat output)"
sed 's/^when = .*/when = "abs(theta - pi) < 0.2"/' pilco_robot.toml >turns.toml
"$program" check turns.toml >output 2>&1 || fail "whole turns are refused: $(cat output)"
grep -q "success says something else when theta is a whole turn further" output || fail "turns: $(cat output)"

"$program" check pendubot >output 2>&1 || fail "check of a built-in robot: $(cat output)"
grep -q "misleading: .* rows a second" output && grep -q "learn pendubot --learner gp-mi" output || fail "check: $(cat output)"
refused "there is no scenario 'many'; the file is many.toml" check many
refused "there is no scenario 'many'; the file is many.toml" list many
refused "there is no scenario 'many'; the file is many.toml" learn many --learner gp-mi
cp many.toml many.txt
refused "there is no scenario 'many.txt'; the name of a robot's file ends in .toml" check many.txt
refused "there is no scenario 'many.txt'; the name of a robot's file ends in .toml" learn many.txt --learner gp-mi --out left
sed 's/^\[plant\]/&\nparameters.m = 0/' pilco_robot.toml >no_mass.toml
refused "no_mass.toml: line [0-9]*: plant: rate.dtheta: .* is not finite at the start" learn no_mass.toml --learner mi --out left
refused "no_mass.toml: line [0-9]*: plant: rate.dtheta: .* is not finite at the start" check no_mass.toml
refused "unknown scenario 'pendubut', did you mean 'pendubot'?" check pendubut
refused "unknown scenario 'xxx" check "$(printf 'x%.0s' {1..300})"

# Settings that are valid, but probably not meant, give a warning.
sed '/^tune = /d' pilco_robot.toml >fixed.toml
"$program" check fixed.toml >output 2>&1 || fail "check of a fixed prior: $(cat output)"
grep -q "nothing to tune: gp-mi and mi learn no parameters of it" output || fail "check: $(cat output)"
"$program" learn fixed.toml --learner gp-mi --trials 0 --out fixed >output 2>&1 || fail "learn of a fixed prior"
grep -q "warning: prior useful has nothing to tune, so gp-mi learns no parameters" output || fail "learn: $(cat output)"
"$program" learn fixed.toml --learner black-drops-prior --trials 0 --out fixed-gp >output 2>&1 || fail "learn"
grep -q warning output && fail "a warning of what is meant: $(cat output)"
sed 's/^\[plant\]/&\ndelay_s = { u = 0.2 }/' pilco_robot.toml >late.toml
"$program" check late.toml >output 2>&1 || fail "check of a late plant: $(cat output)"
grep -q "oracle: not all of the plant. u: the plant has delay_s = 0.2" output || fail "check: $(cat output)"
"$program" learn late.toml --learner gp-mi --prior oracle --trials 0 --out late >output 2>&1 || fail "learn from oracle"
grep -q "warning: the oracle is not all of the plant: u: the plant has delay_s = 0.2" output || fail "learn: $(cat output)"
refused "learner ite needs a descriptor, .*not a robot's file" learn late.toml --learner ite --out left

# Trials that do not get better are looked at again, whoever drives the robot.
delay="actions seem to act 0.2 s later than their rows say"
"$program" learn late.toml --learner gp-mi --prior useful --trials 3 "${few[@]}" --out unsolved >output 2>&1 || fail "unsolved: $(cat output)"
grep -q "not solved in 3 trials" output && grep -q "$delay" output && grep -q "what to look at.*does-not-learn" output ||
  fail "nothing is said of a delay: $(cat output)"
"$program" learn late.toml --learner gp-mi --prior useful --trials 0 "${few[@]}" --out told >/dev/null 2>&1
for trial in 1 2 3; do
  "$program" ask told --threads 1 >/dev/null 2>&1
  "$program" tell told unsolved/trajectories/trial-00$trial.csv >output 2>&1 || fail "tell: $(cat output)"
done
grep -q "$delay" output || fail "tell says nothing of a delay: $(cat output)"

finish
