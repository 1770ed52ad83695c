#!/usr/bin/env bash
# install.sh BUILD_DIR EXAMPLES_DIR: installs into an empty folder, and builds and runs each example against that alone.
set -euo pipefail
build=$1 examples=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export REHEARSE_CACHE=off
cmake --install "$build" --prefix "$work/prefix" >"$work/install.log"
cd "$work"

# make EXAMPLE [FLAG]: builds it as its own files say
make() {
  cmake -S "$examples/$1" -B "$1" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_FLAGS="${2:-}" >configure.log ||
    { cat configure.log; exit 1; }
  grep -q -- "-O3" "$1/build.ninja" || { echo "$1 is not optimised unless it is asked for" >&2; exit 1; }
  cmake --build "$1"
}

# says CODE PATTERN COMMAND… : it exits so, and prints a line like that
says() {
  local code=$1 pattern=$2 got=0
  shift 2
  "$@" >said 2>&1 || got=$?
  cat said
  [ "$got" = "$code" ] || { echo "$*: exit $got, must be $code" >&2; exit 1; }
  grep -q -- "$pattern" said || { echo "$*: does not say '$pattern'" >&2; exit 1; }
}

make own_robot -mavx2 # with which Eigen would allocate in another way than the library
robot=own_robot/own_robot
few=(--threads 1 --set search.race.max_evaluations=4000 --set search.race.descents=4 --set search.race.rounds=2)
says 0 "^  cart  *push a cart" $robot list
says 0 "^  as-published" $robot list
says 0 "^plant.mass  *1.6 " $robot list cart
says 2 "^own_robot: unknown scenario 'carp', did you mean 'cart'?" $robot learn carp --learner gp-mi
says 2 "^own_robot: unknown option 'plant.weight'" $robot learn cart --learner gp-mi --set plant.weight=2
says 0 "^trial  2/2  return  *1[0-9]\..* mass 1\.6" $robot learn cart --learner gp-mi --trials 2 --out run "${few[@]}"
says 0 "^trial  3/3  return  *1[0-9]\..* mass 1\.6" $robot resume run --trials 3 --threads 1
says 0 "^trial  1/1 " $robot learn cart --learner mi --set plant.mass=2 --trials 1 --out heavy "${few[@]}"
says 2 "^rehearse: unknown scenario 'cart'" prefix/bin/rehearse resume run --trials 4
if [ -f prefix/share/rehearse/report.html ]; then
  says 0 "^run/report.html .* opens in a browser" $robot report run
else
  says 2 "the page of reports is not built" $robot report run
fi
cat >carts.toml <<TOML
format = 1
scenario = "cart"
learners = ["mi"]
seeds = "1-2"
trials = 1
[set]
search.race.max_evaluations = 800
search.race.descents = 2
TOML
says 0 "mi" $robot campaign carts.toml --out carts --threads 1

says 0 "^trial 3: return .*, mass 1\.6.*, solved" own_robot/gp_mi # fails where the policy breaks a law
cc -std=c99 -DREHEARSE_POLICY_MAIN -x c policy.h -o policy_test -lm
says 0 "as it should be" ./policy_test
says 0 "^trial 2: return .*, solved" own_robot/own_loop told
says 0 "^trial 4: return .*, solved" own_robot/own_loop told

make own_learner
says 0 "^trial 3: return " own_learner/by_hand # fails where the learner breaks a law
says 0 "^  random-search  *the best of many" own_learner/own_learner list
says 0 "^trial  1/1 " own_learner/own_learner learn pendulum --learner random-search --trials 1 --out random --threads 1
says 0 "^trial  2/2 " own_learner/own_learner resume random --trials 2 --threads 1

says 0 "^  as-published" prefix/bin/rehearse list

examples=prefix/share/doc/rehearse/examples
says 0 "^pendulum-file: 40 steps" prefix/bin/rehearse check $examples/robots/pendulum.toml
says 0 "18 runs" prefix/bin/rehearse campaign $examples/campaigns/pendubot-short.toml --dry-run
for file in man/man1/rehearse-learn.1.gz bash-completion/completions/rehearse zsh/vendor-completions/_rehearse \
  fish/vendor_completions.d/rehearse.fish rehearse/schemas/robot.json doc/rehearse/docs/install.md \
  doc/rehearse/examples/contest/robot.h doc/rehearse/examples/same_robot/model.toml; do
  [ -s prefix/share/$file ] || { echo "share/$file is not installed" >&2; exit 1; }
done
[ ! -e prefix/lib/python3 ] || { echo "the module of Python is installed unasked" >&2; exit 1; }
