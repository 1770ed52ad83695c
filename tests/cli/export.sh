#!/usr/bin/env bash
# export.sh PROGRAM: policies of runs as C, JSON and Python, and what is refused.
source "$(dirname "$0")/../prelude.sh"

quick=(--set search.race.max_evaluations=100 --set search.race.descents=1 --set search.selection=2)
expect 0 "best return" learn pendulum --learner black-drops --trials 2 "${quick[@]}" --out mlp
expect 0 "best return" learn pendulum --learner gp-mi --trials 1 "${quick[@]}" --set policy=linear --out linear
expect 0 "best return" learn pendulum --learner gp-mi --trials 1 "${quick[@]}" --set search.hand_over=true --out near
expect 0 "best return" learn pendulum --learner pilco --trials 2 --set search.restarts=0 --out rbf

# works FILE: its own test passes
works() {
  case $1 in
    *.h) cc -std=c99 -Wall -Wextra -pedantic -Werror -DREHEARSE_POLICY_MAIN -x c "$1" -o works -lm && ./works ;;
    *.py) python3 "$1" ;;
    *.json) [ "$(head -c 1 "$1")" = "{" ] ;;
  esac
}

endings=(json)
command -v cc >/dev/null && endings+=(h)
python3 -c 'import numpy' 2>/dev/null && endings+=(py)
for run in mlp linear near rbf; do
  for ending in "${endings[@]}"; do
    expect 0 "$run.$ending: the policy of trial " export $run --out $run.$ending
    works $run.$ending >said 2>&1 || fail "$run.$ending: $(cat said)"
  done
done
expect 0 "the policy of trial 1 (" export mlp --trial 1 --out schedule.h
grep -q '^ \* policy     schedule$' schedule.h || fail "the first trial of black-drops is no schedule: $(head -20 schedule.h)"

# One of ours is replaced, and that is said; anything else is left as it is.
expect 0 "schedule.h, which was there, is replaced: the policy of trial 2 (" export mlp --trial 2 --out schedule.h
echo '#define PRECIOUS' >mine.h
expect 2 "mine.h is no policy of Rehearse and is left as it is; --out FILE.h names another file" export mlp --out mine.h
[ "$(cat mine.h)" = "#define PRECIOUS" ] || fail "a file of somebody else is overwritten"
ln -s mine.h link.h
expect 2 "link.h" export mlp --out link.h
mkdir folder.py
expect 2 "folder.py is no policy of Rehearse" export mlp --out folder.py
expect 2 "nowhere/policy.h" export mlp --out nowhere/policy.h

expect 2 "--out is required" export mlp
expect 2 "--out policy.c: must end in .h (C), .json or .py (NumPy)" export mlp --out policy.c
expect 2 "trial = 3, must be between 1 and 2" export mlp --trial 3 --out policy.h
expect 2 "--trial = 0, must be" export mlp --trial 0 --out policy.h
expect 2 "--trial = two, must be a whole number" export mlp --trial two --out policy.h
expect 2 "nothing is not a folder" export nothing --out policy.h
expect 2 "is not a run folder" export folder.py --out policy.h
[ ! -e policy.h ] || fail "what was refused left a file"

# A run begins with a policy that was exported.
expect 0 "best return" learn pendulum --learner black-drops --trials 2 "${quick[@]}" --policy mlp.json --out begun
expect 0 "trial 1" export begun --trial 1 --out begun.json
theta() { tr -d ' \n' <"$1" | grep -o '"theta":\[[^]]*\]'; }
[ -n "$(theta begun.json)" ] && [ "$(theta begun.json)" = "$(theta mlp.json)" ] || fail "the first trial is another policy"
expect 0 "best return" learn begun/spec.toml --out repeated
same begun repeated trials.csv policy.json spec.toml
expect 0 "best return" learn pendulum --learner black-drops --trials 1 "${quick[@]}" --policy near.json --out begun_elsewhere
grep -q '"near"' near.json || fail "the policy of the hand-over has no feedback"
expect 0 "of 3" evaluate near --episodes 3
expect 2 "rbf.json: learner pilco cannot begin with a policy; those that can: black-drops, " learn pendulum --learner pilco --policy rbf.json --out refused
expect 2 "mlp.json: learner pilco cannot begin with a policy" learn pendulum --learner pilco --policy mlp.json --out refused
expect 2 "linear.json is a policy 'linear', but learner gp-mi begins with policies 'mlp' here" learn pendulum --learner gp-mi --policy linear.json --out refused
expect 0 "trial 1" export mlp --trial 1 --out random.json
expect 2 "random.json is a policy 'schedule', but learner gp-mi begins with policies 'mlp' here" learn pendulum --learner gp-mi --policy random.json --out refused
expect 2 "cannot read nothing.json" learn pendulum --learner gp-mi --policy nothing.json --out refused
sed 's/^start = .*/start = "1 2 x"/' begun/spec.toml >bent.toml
expect 2 "start must be the" learn bent.toml --out refused
[ ! -e refused ] || fail "what was refused left a folder"
finish
