# Sourced by every test of the program with its arguments, the first of which is the program: works in a folder of its own
# and counts failures.
set -u
program=$(realpath "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
export REHEARSE_CACHE=off  # what another test kept would hide what is wrong
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

finish() {
  echo "$failures failures"
  exit $((failures > 0))
}

# expect CODE PATTERN ARGS… : the exit code of the program, and what it says, which is in `said`
expect() {
  local code=$1 pattern=$2
  shift 2
  "$program" "$@" >said 2>&1
  local got=$?
  [ $got = "$code" ] || fail "'$*' exits with $got, must be $code: $(cat said)"
  grep -qF -- "$pattern" said || fail "'$*' does not say '$pattern' but: $(cat said)"
}

# same A B FILES… : the same bytes in both folders
same() {
  local a=$1 b=$2 file
  shift 2
  for file in "$@"; do cmp "$a/$file" "$b/$file" || fail "$b/$file differs from $a's"; done
}

# short_campaign LEARNERS SEEDS: a campaign file of two trials and few rollouts, to which more may be added
short_campaign() {
  cat <<TOML
format = 1
scenario = "pendubot"
learners = $1
priors = ["misleading"]
seeds = "$2"
trials = 2

[set]
search.race.max_evaluations = 800
search.race.descents = 2
search.selection = 10
model.subplex.max_evaluations = 100
TOML
}
tables=(campaign.csv summary.json)
milliseconds() { echo $(($(date +%s%N) / 1000000)); }
