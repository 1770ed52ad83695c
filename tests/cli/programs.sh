#!/usr/bin/env bash
# programs.sh PROGRAM EXAMPLES: robots whose dynamics are programs and models of MuJoCo, and what goes wrong with them.
examples=$(realpath "$2")
source "$(dirname "$0")/../prelude.sh"
PATH=/usr/bin:$PATH # Debian's Python, which has NumPy

few=(--set search.race.max_evaluations=400 --set search.race.descents=2 --set search.selection=10)
files=(spec.toml robot.toml trials.csv errors.csv policy.json trajectories/trial-002.csv)
cp -r "$examples"/* .
cc -O2 -o programs/pendubot programs/pendubot.c -lm || fail "the example in C"

"$program" learn programs/pendubot.toml --learner gp-mi --trials 2 "${few[@]}" --threads 1 --out one >output 2>&1 ||
  fail "a program in C: $(cat output)"
"$program" learn programs/pendubot.toml --learner gp-mi --trials 2 "${few[@]}" --threads 2 --out two >/dev/null 2>&1
same one two "${files[@]}"
"$program" learn programs/pendubot.toml --learner gp-mi --trials 1 "${few[@]}" --out extended >/dev/null 2>&1
rm programs/pendubot # the run has its own
"$program" resume extended --trials 2 >output 2>&1 || fail "resume: $(cat output)"
same one extended "${files[@]}"
# A run's robot.toml is a robot, with the files that the run keeps.
"$program" check one/robot.toml >output 2>&1 || fail "check of a run's robot: $(cat output)"
"$program" learn one/robot.toml --learner gp-mi --trials 0 --out of_kept >output 2>&1 || fail "learn of a run's robot: $(cat output)"
cmp one/robot/pendubot of_kept/robot/pendubot || fail "the run of a run's robot keeps another program"
echo "an addition" >>extended/robot/pendubot
"$program" resume extended --trials 3 >output 2>&1
[ $? = 2 ] && grep -q "has another robot than this run began with" output || fail "another program: $(cat output)"

"$program" check programs/furuta.toml >output 2>&1 || fail "NumPy: $(cat output)"
"$program" learn programs/pendulum.toml --learner gp-mi --trials 1 "${few[@]}" --out node >output 2>&1 ||
  fail "JavaScript: $(cat output)"

if ! "$program" list | grep -q "MuJoCo was not found\|mujoco.*not built"; then
  "$program" learn models/acrobot.toml --learner mi --trials 1 "${few[@]}" --out model >output 2>&1 || fail "MJCF: $(cat output)"
  [ -e model/motion/trial-001.json ] && cmp models/acrobot.xml model/robot/acrobot.xml || fail "the model is not kept"
  "$program" check models/servo_arm.toml >output 2>&1 || fail "servos: $(cat output)"
  sed 's/body upper mass/body uper mass/' models/acrobot.toml >models/misspelt.toml
  "$program" check models/misspelt.toml >output 2>&1
  [ $? = 2 ] && grep -q "upper" output || fail "a misspelt body: $(cat output)"
fi

# A simulator that ends after so many answers in all, however often it is started, and that a file repairs.
cat >tired.py <<'PY'
import json, os, sys
count = sys.argv[1]
print('{"rehearse": 1}', flush=True)
sys.stdin.readline()
for line in sys.stdin:
    used = os.path.getsize(count) if os.path.exists(count) else 0
    if used > 400 and not os.path.exists(count + ".repaired"):
        sys.exit("the licence has ended")
    with open(count, "a") as file:
        file.write("x")
    asked = json.loads(line)["change"]
    rows = [[(u[0] - 0.01 * x[0]) * 0.3, 0.1 * x[0]] for x, u in zip(asked["states"], asked["actions"])]
    print(json.dumps({"change": rows}), flush=True)
PY
"$program" new tired >/dev/null
{
  sed '/^\[prior.useful\]/,$d' tired.toml
  printf '%s\n' '[dynamics.slow]' "program = [\"python3\", \"tired.py\", \"$PWD/count\"]" '[prior.slow]' 'dynamics = "slow"'
} >t && mv t tired.toml
learn_tired() { "$program" learn tired.toml --learner black-drops-prior --trials 2 "${few[@]}" --threads 1 --out "$1" >output 2>&1; }
touch count.repaired
learn_tired whole || fail "a program that is repaired: $(cat output)"
rm count count.repaired
learn_tired tired_run
[ $? = 1 ] && grep -q "the licence has ended" output || fail "a program that ends for good: $(cat output)"
grep -q "the run keeps the robot's files as they were, in tired_run/robot" output || fail "no word of its copies: $(cat output)"
touch count.repaired
"$program" resume tired_run --threads 1 >output 2>&1 || fail "resume of a program that is repaired: $(cat output)"
same whole tired_run trials.csv policy.json

# The driver of a robot that fails in the first trial, until a file repairs it.
cat >driver.py <<'PY'
import json, os, sys
for line in sys.stdin:
    message = json.loads(line)
    if "step" in message and not os.path.exists(sys.argv[1]):
        sys.exit("the bus is off")
    answer = {"rehearse": 1, "messages": ["reset", "step"]} if "rehearse" in message else {"state": [0.0, 0.0]}
    print(json.dumps(answer), flush=True)
PY
"$program" new driven >/dev/null
printf '%s\n' "/^\\[plant\\]/,/^\$/s/\"rod\"/\"driver\"/" '/^\[plant\]/i [dynamics.driver]' \
  "/^\\[plant\\]/i program = [\"python3\", \"driver.py\", \"$PWD/repaired\"]" >edit
sed -i -f edit driven.toml
"$program" learn driven.toml --learner gp-mi --trials 1 "${few[@]}" --threads 1 --out driven >output 2>&1
[ $? = 1 ] && grep -q "the bus is off" output || fail "a driver that fails: $(cat output)"
"$program" status driven >output || fail "status: $(cat output)"
grep -q "next: .* resume driven, which drives the plant" output && ! grep -q "run the policy of" output ||
  fail "the plant is Rehearse's to drive: $(cat output)"
touch repaired
"$program" resume driven --threads 1 >output 2>&1 || fail "resume of a driver that is repaired: $(cat output)"

# A driver that understands `end` is told of it where Ctrl-C stops a check.
cat >slow_driver.py <<'PY'
import json, sys, time
for line in sys.stdin:
    kind, = {"rehearse", "reset", "step", "end"} & json.loads(line).keys()
    with open(sys.argv[1], "a") as log:
        log.write(kind + "\n")
    slow = kind == "step" and open(sys.argv[1]).read().count("end") >= int(sys.argv[2])
    time.sleep(0.1 if slow else 0)
    answers = {"rehearse": {"rehearse": 1, "messages": ["reset", "step", "end"]}, "end": {"end": True}}
    print(json.dumps(answers.get(kind, {"state": [0.0, 0.0]})), flush=True)
PY
# stopped EPISODES [ARGUMENTS]: Ctrl-C after so many episodes of a check.
stopped() {
  rm -f log
  sed "s|\"driver.py\".*|\"slow_driver.py\", \"$PWD/log\", \"$1\"]|" driven.toml >slow.toml
  "$program" check slow.toml "${@:2}" >output 2>&1 &
  process=$!
  until [ "$(grep -c end log 2>/dev/null)" = "$1" ] && [ "$(tail -n 1 log)" = step ] || ! kill -0 $process 2>/dev/null; do sleep 0.05; done
  kill -INT $process
  wait $process
  [ $? = 130 ] || fail "a check that is stopped after $1 episodes: $(cat output)"
  [ "$(tail -n 1 log)" = end ] || fail "a driver whose check is stopped after $1 episodes is told $(tail -n 1 log)"
}
stopped 6 --out motion.html # its own episode, after those that are tried
[ -e motion.html ] && fail "a check that is stopped leaves a page"
stopped 0

# A driver whose robot is left alone is not even started.
rm log
"$program" check slow.toml --no-plant >output 2>&1 || fail "check without the plant: $(cat output)"
"$program" learn slow.toml --learner gp-mi --trials 0 --out alone >output 2>&1 || fail "a run to be told: $(cat output)"
[ -e log ] && fail "a driver is started whose robot is left alone: $(cat log)"

# refused PATTERN SED : exit 2 before there is a folder
refused() {
  sed "$2" tired.toml >wrong.toml
  "$program" learn wrong.toml --learner mi --out left >output 2>&1
  [ $? = 2 ] && grep -q "$1" output || fail "$2 says $(cat output)"
  [ -e left ] && fail "$2 leaves a folder"
}
refused "'tyred.py' is no file in the folder" 's/"tired.py"/"tyred.py"/'
refused "'no-python' cannot be started" 's/"python3"/"no-python"/'
refused "exit status 1; its standard error ends with" 's/"tired.py", /"-c", "import nothing", /'
rm count.repaired

# check_prior CHANGE: `check` of a prior in Python with this change of the first state.
check_prior() {
  printf '%s\n' 'import json, random, sys' 'print(json.dumps({"rehearse": 1}), flush=True)' 'sys.stdin.readline()' \
    'for line in sys.stdin:' '    asked = json.loads(line)["change"]' \
    "    rows = [[$1, 0.1 * x[0]] for i, (x, u) in enumerate(zip(asked['states'], asked['actions']))]" \
    '    print(json.dumps({"change": rows}), flush=True)' >own.py
  sed 's/"tired.py".*/"own.py"]/' tired.toml >own.toml
  timeout 120 "$program" check own.toml >output 2>&1
  status=$?
}
check_prior 'u[0]'
[ $status = 0 ] && grep -q "dynamics slow, the program 'python3 own.py'" output || fail "check: $(cat output)"
check_prior 'u[0] + random.random()'
[ $status = 2 ] && grep -q "prior slow: predicts something else .* a second time" output || fail "a noisy prior: $(cat output)"
check_prior 'u[0] + 0.1 * i'
[ $status = 2 ] && grep -q "prior slow: .* same rows in another batch" output || fail "a place in the batch: $(cat output)"
check_prior 'u[0] if abs(u[0]) < 2 else float("nan")'
[ $status = 0 ] && grep -q "slow: .*[1-9] of 120 rows failed" output || fail "NaN: $(cat output)"
grep -q "its program failed" output && fail "NaN costs processes: $(cat output)"
check_prior 'str(u[0])'
[ $status = 2 ] && grep -q "which is neither a number nor null" output || fail "texts: $(cat output)"

# A program that answers twice: no answer can be trusted.
sed 's/print(json.dumps({"change": rows}), flush=True)/print(json.dumps({"change": rows}) + "\\n" + json.dumps({"change": rows}), flush=True)/' \
  tired.py >twice.py
sed 's|tired\.py|twice.py|; s|/count"|/answers"|' tired.toml >twice.toml
touch answers.repaired
"$program" learn twice.toml --learner black-drops-prior --trials 1 "${few[@]}" --threads 1 --out twice >output 2>&1
[ $? = 1 ] && grep -q "an answer that nobody asked for" output || fail "a program that answers twice: $(cat output)"

# A program that hangs does not outlive Rehearse.
cat >hangs.py <<'PY'
import os, sys
print('{"rehearse": 1}', flush=True)
sys.stdin.readline()
sys.stdin.readline()
with open(sys.argv[1] + ".new", "w") as file:
    file.write(str(os.getpid()))
os.rename(sys.argv[1] + ".new", sys.argv[1])
while True:
    pass
PY
for signals in INT "INT INT"; do
  rm -f hung
  sed "s|\"tired.py\".*|\"hangs.py\", \"$PWD/hung\"]\nanswer_s = 1000|" tired.toml >hangs.toml
  "$program" learn hangs.toml --learner black-drops-prior --trials 1 --threads 1 --out "hangs $signals" >output 2>&1 &
  process=$!
  until [ -e hung ] || ! kill -0 $process 2>/dev/null; do sleep 0.05; done
  for signal in $signals; do
    kill -"$signal" $process
    sleep 0.3
  done
  wait $process
  [ $? = 130 ] || fail "a program that hangs, $signals: $(cat output)"
  for ((i = 0; i < 100; ++i)); do kill -0 "$(cat hung)" 2>/dev/null || break; sleep 0.1; done # the system may be slow to clear up
  kill -9 "$(cat hung)" 2>/dev/null && fail "a program that hangs outlives $signals"
done

finish
