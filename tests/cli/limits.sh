#!/usr/bin/env bash
# limits.sh PROGRAM: a robot with a limit: said, kept, recorded, resumed; and who refuses it.
source "$(dirname "$0")/../prelude.sh"

few=(--set search.race.max_evaluations=600 --set search.race.descents=2 --set search.selection=10
  --set search.safety.rollouts=100)
files=(trials.csv limits.csv notes.csv trajectories/trial-002.csv)

"$program" new fast >/dev/null || fail "new"
printf '[[limit]]\nname = "speed"\nkeep = "abs(dtheta) < 3"\nrisk = 0.1\n' >>fast.toml
"$program" check fast.toml >output 2>&1 || fail "check: $(cat output)"
grep -q "speed: abs(dtheta) < 3 at every step, in all but 10 % of episodes" output || fail "check says: $(cat output)"

"$program" learn fast.toml --learner gp-mi --trials 2 "${few[@]}" --threads 1 --out alone >output 2>&1 || fail "learn: $(cat output)"
grep -Eq "safe: speed, risk [0-9.]+ % \([0-9.e-]+ to [0-9.]+\)" output || fail "no risk in the lines: $(cat output)"
[ "$(head -1 alone/limits.csv)" = "trial,limit,allowed_risk,predicted_risk,low,high,broken" ] || fail "limits.csv"
[ "$(wc -l <alone/limits.csv)" = 3 ] || fail "limits.csv: $(cat alone/limits.csv)"
"$program" learn fast.toml --learner gp-mi --trials 1 "${few[@]}" --threads 2 --out extended >/dev/null || fail "one trial"
"$program" resume extended --trials 2 --threads 2 >output 2>&1 || fail "resume: $(cat output)"
same alone extended "${files[@]}"

# A track of 1 mm: random actions leave it in trial 1, which is stopped and recorded.
"$program" learn cartpole --learner black-drops --set track=0.001 --trials 1 --threads 1 --out short >output 2>&1 || fail "$(cat output)"
grep -q "risk not known  broke track" output || fail "no broken limit: $(cat output)"
grep -q "^1,track,0.05,,,,1$" short/limits.csv || fail "limits.csv: $(cat short/limits.csv)"
"$program" status short | grep -q "^trial 1: return .*, broke track$" || fail "status: $("$program" status short)"
[ "$(wc -l <short/trajectories/trial-001.csv)" -lt 42 ] || fail "the episode was not stopped"

expect 0 "broke track    3 of 3 episodes" evaluate short --episodes 3
[ "$(grep -c ',track$' short/evaluation.csv)" = 3 ] || fail "evaluation.csv: $(cat short/evaluation.csv)"

# A limit that the start breaks is found before anything is learned; one that random actions break is counted.
sed 's/abs(dtheta) < 3/theta > 3/' fast.toml >wrong_way.toml
expect 2 "limit speed: the start breaks it, and the first step of every episode" check wrong_way.toml
sed 's/abs(dtheta) < 3/abs(dtheta) < 1e-6/' fast.toml >still.toml
expect 0 "3 of 3 episodes broke the limit speed" check still.toml

# A limit that every policy breaks: its risk in plain digits.
"$program" learn still.toml --learner gp-mi --trials 0 "${few[@]}" --out still >/dev/null || fail "still"
"$program" ask still >output || fail "ask: $(cat output)"
grep -q "limit speed: risk 100 % (95 %: [0-9.]* to 100), 10 % is allowed: not safe" output || fail "ask says: $(cat output)"

"$program" learn fast.toml --learner pilco --out left >output 2>&1
[ $? = 2 ] && grep -q "the task has limits, which pilco does not keep: choose the learner black-drops" output ||
  fail "pilco: $(cat output)"
[ -e left ] && fail "pilco leaves a folder"

finish
