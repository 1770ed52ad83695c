#!/usr/bin/env bash
# evaluate.sh PROGRAM: policies of runs in more, longer and other episodes, and what is refused.
source "$(dirname "$0")/../prelude.sh"

quick=(--set search.race.max_evaluations=300 --set search.race.descents=1 --set search.selection=2)
expect 0 "best return" learn pendulum --learner gp-mi --trials 2 "${quick[@]}" --out run
cp -r run kept

expect 0 "run/evaluation.csv has the numbers" evaluate run --episodes 20 --threads 1
grep -qE '^solved at [0-9.]+ s +[0-9]+ of 20 episodes, ' said || fail "no rate: $(cat said)"
header=trial,settings,seed,seconds,episode,return,solved,solved_at_end,ended_s,broke
[ "$(head -1 run/evaluation.csv)" = $header ] || fail "evaluation.csv begins with $(head -1 run/evaluation.csv)"
[ "$(wc -l <run/evaluation.csv)" = 21 ] || fail "evaluation.csv has $(wc -l <run/evaluation.csv) lines"
cp run/evaluation.csv one
expect 0 "run/evaluation.csv is kept as run/evaluation-001.csv" evaluate run --episodes 20 --threads 2
cmp one run/evaluation.csv || fail "two threads give other bytes than one"
cmp one run/evaluation-001.csv || fail "an older evaluation is lost"

expect 0 "solved at 10 s" evaluate run --episodes 5 --seconds 10 --set plant.m=1.1 --seed 7 --out long.csv
grep -q '^[12],plant.m=1.1,7,10,5,' long.csv || fail "long.csv has $(cat long.csv)"
expect 0 "trial 1 (" evaluate run --trial 1 --episodes 5 --out first.csv
expect 0 "policy.json: the policy" export run --trial 1 --out policy.json
expect 0 "policy.json (" evaluate run --policy policy.json --episodes 5 --out given.csv
cmp first.csv given.csv || fail "a policy of a file does other than that of its trial"

# A policy of a file needs no trial; one that is asked for has no return yet.
expect 0 "fresh is ready" learn pendulum --learner gp-mi "${quick[@]}" --trials 0 --out fresh
expect 2 "no trial is done yet" evaluate fresh
expect 0 "policy.json (" evaluate fresh --policy policy.json --episodes 5 --out fresh.csv
cmp first.csv fresh.csv || fail "a policy of a file does otherwise in a run without trials"
expect 0 "trial 1: run the policy" ask fresh
expect 2 "no trial is done yet; trial 1 is asked for, --trial 1" evaluate fresh
expect 2 "no trial is done yet; trial 1 is asked for, --trial 1" export fresh --out asked.json
expect 0 "the policy of trial 1: 5 episodes" evaluate fresh --trial 1 --episodes 5 --out asked.csv
expect 0 "fresh/next/policy.json: 5 episodes" evaluate fresh --policy fresh/next/policy.json --episodes 5 --out next.csv
cmp asked.csv next.csv || fail "the file of a policy that is asked for does other than that of its trial"
expect 0 "asked.json: the policy of trial 1, which is to come" export fresh --trial 1 --out asked.json
cmp asked.json fresh/next/policy.json || fail "export writes another policy than ask"

expect 0 "run/robustness.csv has the numbers" evaluate run --robustness --episodes 5
header=trial,settings,seed,seconds,parameter,factor,value,episodes,
[[ $(head -1 run/robustness.csv) = $header* ]] || fail "robustness.csv begins with $(head -1 run/robustness.csv)"
[ "$(cut -d, -f5 run/robustness.csv | sort | uniq -c | grep -c '^ *5 ')" -ge 1 ] || fail "robustness.csv has $(cat run/robustness.csv)"
for file in trials.csv checkpoint spec.toml policy.json; do cmp kept/$file run/$file || fail "evaluations change $file"; done

expect 0 "first-robustness.csv has the numbers" evaluate run --trial 1 --robustness --episodes 2 --seconds 8 --seed 7 \
  --set measurement_noise=0.01 --out first-robustness.csv
[ "$(sed 1d first-robustness.csv | cut -d, -f1-4 | uniq)" = 1,measurement_noise=0.01,7,8 ] ||
  fail "first-robustness.csv has $(cat first-robustness.csv)"

# A table takes the place of tables alone, of one only once the new one is there, and never after the episodes.
cp run/evaluation.csv one
echo mine >mine.txt
for there in run run/checkpoint mine.txt; do
  expect 2 "$there is no table of Rehearse and is left as it is; --out FILE.csv names another file" \
    evaluate run --episodes 5 --out $there
done
expect 2 "--out needs the name of a file" evaluate run --out ""
expect 2 "cannot write nodir/x.csv: there is no folder nodir" evaluate run --out nodir/x.csv
grep -q "episodes of" said && fail "episodes are run before --out is looked at"
expect 0 "long.csv is kept as long-001.csv" evaluate run --episodes 5 --out long.csv
(
  trap '' XFSZ
  ulimit -f 8
  expect 1 "cannot write run/evaluation.csv" evaluate run --episodes 500
  exit $failures
) || fail "see above"
cmp one run/evaluation.csv || fail "a full disk takes the older evaluation"
for file in trials.csv checkpoint spec.toml policy.json; do cmp kept/$file run/$file || fail "a refused --out changes $file"; done

expect 2 "trial = 3, must be between 1 and 2" evaluate run --trial 3
expect 2 "--trial = x" evaluate run --trial x --episodes 0 --seconds -1 --out ""
[ "$(wc -l <said)" = 4 ] || fail "of four wrong arguments it says $(cat said)"
expect 2 "--trial and --policy name two policies" evaluate run --trial 1 --policy policy.json
expect 2 "seconds = 0.5, must be between" evaluate run --seconds 0.5
expect 2 "--episodes = 0, must be between" evaluate run --episodes 0
expect 2 "unknown option 'plant.q'" evaluate run --set plant.q=1
expect 2 "prior.m changes no episode: no prior plays the robot; what can be set: plant.m, " evaluate run --set prior.m=2 --set hidden=3
grep -q "hidden changes no episode: it is an option of the policy" said || fail "an option of the policy: $(cat said)"
expect 2 "search.finalists changes no episode: it is an option of the learner" evaluate run --set search.finalists=2
expect 2 "--set plant.m: must be KEY=VALUE" evaluate run --set plant.m
expect 2 "nothing is not a folder" evaluate nothing
expect 2 "is no policy that" evaluate run --policy run/spec.toml
expect 0 "best return" learn cartpole --learner gp-mi --trials 1 "${quick[@]}" --out other
expect 2 "its states are others" evaluate other --policy policy.json

# A robot that drifts past its goal, whatever its policy: where episodes are longer, an option that looks further is named.
cat >drift.toml <<'TOML'
format = 1
name = "drift"
dt_s = 0.1
horizon = 10
[[state]]
name = "x"
[[action]]
name = "u"
bounds = [-1, 1]
[reward]
distance = ["x"]
width = 1
[success]
when = "x < 0.5"
last_s = 0.5
[dynamics.pushed]
rate.x = "0.2 + u / 1000"
[plant]
dynamics = "pushed"
[prior.known]
dynamics = "pushed"
TOML
expect 0 "solved at trial 1" learn drift.toml --learner black-drops --trials 1 --out drift
advice="--set search.hand_over=true or search.extra_s=SECONDS"
expect 0 "$advice" evaluate drift --seconds 5 --episodes 2
expect 0 "solved at 1 s  2 of 2" evaluate drift --episodes 2
grep -q "holds longer" said && fail "episodes of a trial's length are advised on: $(cat said)"
expect 0 "solved at trial 1" learn drift.toml --learner black-drops --trials 1 --set search.hand_over=true --out taken
expect 0 "holds longer: --set search.extra_s=SECONDS (" evaluate taken --seconds 5 --episodes 2

# Without a plant and a prior there are no episodes, and nothing else is said.
sed '/^\[plant\]/,+1d' drift.toml >alone.toml
expect 0 "alone is ready" learn alone.toml --learner black-drops --trials 0 --out alone
expect 2 "drift has no plant that episodes could run on, and the run has no prior that could play it, or several. A copy of" evaluate alone
[ "$(wc -l <said)" = 1 ] || fail "without a plant it says $(cat said)"

# The prior plays a robot that has no plant, as the newest model has it.
"$program" new own >/dev/null
sed '/^\[plant\]/,+2d' own.toml >told.toml
expect 0 "told is ready" learn told.toml --trials 0 "${quick[@]}" --out told
expect 0 "to try it on the prior first: rehearse evaluate told --trial 1 --robustness" ask told
expect 0 "the prior useful plays the robot, as it was identified" evaluate told --trial 1 --episodes 5 --threads 1
grep -q "^1,prior.m=[0-9.]* prior.l=[0-9.]*,1,4,5," told/evaluation.csv || fail "told has $(cat told/evaluation.csv)"
expect 0 "told/evaluation.csv has the numbers" evaluate told --trial 1 --episodes 5 --set prior.m=2
grep -q "prior.m=2,1,4,5," told/evaluation.csv || fail "what is set comes first: $(cat told/evaluation.csv)"
expect 0 "told/robustness.csv has the numbers" evaluate told --trial 1 --episodes 5 --robustness
grep -q ",m,0.75," told/robustness.csv || fail "the prior's parameters are not changed: $(cat told/robustness.csv)"
expect 0 "told/robustness.csv has the numbers" evaluate told --trial 1 --episodes 5 --robustness --set prior.m=2
grep -q ",m,1.25,2.5," told/robustness.csv || fail "beyond the bounds of learning: $(cat told/robustness.csv)"

# A robot of a file.
expect 0 "best return" learn own.toml --learner gp-mi --trials 1 "${quick[@]}" --out own
rm own.toml
expect 0 "own/evaluation.csv has the numbers" evaluate own --episodes 5
expect 0 "own/robustness.csv has the numbers" evaluate own --episodes 5 --robustness

# A robot that fails where it is light.
"$program" new light >/dev/null
sed -i 's|dtheta = "(u|dtheta = "where(u == 0, 0, 1e-9 * sqrt(m - 0.85)) + (u|' light.toml
expect 0 "best return" learn light.toml --learner gp-mi --trials 1 "${quick[@]}" --out light
expect 0 "light/robustness.csv has the numbers" evaluate light --episodes 2 --robustness
grep -q "^m  *fails  *[0-9]" said || fail "the table has no failure: $(cat said)"
grep -q "^  m 0.75: .*dtheta = -\?nan, must be finite" said || fail "why it fails is not said: $(cat said)"
grep -q ",m,0.75," light/robustness.csv && fail "a robot that fails has a row: $(cat light/robustness.csv)"
finish
