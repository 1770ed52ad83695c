#!/usr/bin/env bash
# report.sh PROGRAM BUILD BROWSER_TEST CHROMIUM: reports of a run, a trial, a damaged campaign, a robot in space, one of many
# states and an archive, whole and damaged, opened in a browser.
# Exits with 77 where the page is not built or there is no browser.
set -euo pipefail
here=$(realpath "$(dirname "$0")")
program=$(realpath "$1") build=$2 browser_test=$3 chromium=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# refused PATTERN ARGS…: exit code 2 and one line on standard error that holds the pattern.
refused() {
  local pattern=$1 code=0
  shift
  "$@" >stdout 2>stderr || code=$?
  [ $code = 2 ] || fail "'$*' exits with $code: $(cat stderr)"
  grep -qF -- "$pattern" stderr || fail "'$*' does not say '$pattern' but: $(cat stderr)"
  [ "$(wc -l <stderr)" = 1 ] || fail "'$*' says more than one line: $(cat stderr)"
}

quick=(search.race.max_evaluations=100 search.race.descents=1 search.selection=2)
"$program" learn pendubot --learner gp-mi --trials 2 "${quick[@]/#/--set=}" --out run >/dev/null
"$program" evaluate run --episodes 6 --set measurement_noise=0.01 --robustness >/dev/null

mkdir bare
cp "$program" bare/rehearse
refused "--target page" bare/rehearse report run
[ ! -e run/report.html ] || fail "a report without a page is written"

[ -f "$build/share/rehearse/report.html" ] || { echo "the page is not built: cmake --build $build --target page"; exit 77; }
"$program" learn cartpole --learner pilco --trials 2 --set policy=rbf --set search.line_searches=5 --out moments >/dev/null
refused "is neither a run folder" "$program" report bare
refused "trial 3 is not in run" "$program" replay run --trial 3
refused "--trial = 0" "$program" replay run --trial 0
refused "cannot write" "$program" report run --out nowhere/report.html
cp run/checkpoint kept
refused "is no page of Rehearse" "$program" report run --out run/checkpoint
refused "is no page of Rehearse" "$program" report run --out bare
refused "needs the name of a file" "$program" report run --out ""
cmp -s kept run/checkpoint || fail "a report takes the place of a checkpoint"
[ -z "$(find . -name '*.tmp')" ] || fail "reports that cannot be written leave $(find . -name '*.tmp')"

echo '2,"m1 and m2 cannot be told apart by these data"' >>run/identifiability.csv
"$program" report run >stdout 2>stderr
[ ! -s stderr ] || fail "the report of a whole run complains: $(cat stderr)"
"$program" report moments >/dev/null
grep -q "^run/report.html (0\.[0-9] MB) opens in a browser$" stdout || fail "the report says $(cat stdout)"
"$program" replay run --trial 2 --out replay.html >/dev/null

cat >campaign.toml <<'END'
format = 1
scenario = "pendubot"
learners = ["gp-mi", "black-drops"]
seeds = "1-2"
trials = 2
END
printf '[set]\n%s\n' "$(printf '%s\n' "${quick[@]}")" >>campaign.toml
cat >>campaign.toml <<'END'
[[claim]]
text = "GP-MI solves it at once"
learner = "gp-mi"
solved_by = 1
at_least_rate = 0.5
END
"$program" campaign campaign.toml --out campaign >/dev/null
runs=(campaign/runs/*)
truncate -s -9 "${runs[0]}/trials.csv"
sed -i 's/^format = 1/format = 9/' "${runs[1]}/spec.toml"
echo stray >campaign/runs/stray.txt
"$program" report campaign 2>stderr >/dev/null
for problem in "${runs[0]}/trials.csv: row 3 is cut short" \
  "${runs[1]}/spec.toml: format 9 is that of another version" "campaign/runs/stray.txt: "; do
  grep -qF "rehearse: $problem" stderr || fail "the report does not say '$problem' but: $(cat stderr)"
done
[ "$(wc -l <stderr)" = 3 ] || fail "the report names other problems: $(cat stderr)"

cp -r campaign partial
sed -i 's/"claims": \[/"claims": null, "others": [/' partial/summary.json
refused "partial/summary.json: claims must be a list" "$program" report partial

"$program" learn pendubot --learner ite --prior misleading --trials 3 --set archive.niches=400 \
  --set archive.evaluations=3000 --set adaptation.max_trials=2 --set adaptation.stop_ratio=0 --out ite >/dev/null
"$program" report ite >/dev/null 2>stderr
[ ! -s stderr ] || fail "the report of a whole archive complains: $(cat stderr)"
cp -r ite damaged
truncate -s -9 damaged/archive.bin
"$program" report damaged >/dev/null 2>stderr
grep -q "damaged/archive.bin: it is no usable archive: truncated" stderr || fail "the report says $(cat stderr)"
[ "$(wc -l <stderr)" = 1 ] || fail "the report names other problems: $(cat stderr)"

cp -r run hostile
head -c 100000 /dev/zero | tr '\0' '[' >hostile/motion/trial-001.json
sed 's/"frames":\[\[/"frames":[[1e999,/' run/motion/trial-002.json >hostile/motion/trial-002.json
rm hostile/timings.csv && mkfifo hostile/timings.csv
for command in "report hostile" "replay hostile --trial 1" "replay hostile --trial 2"; do
  timeout 60 "$program" $command >/dev/null 2>>hostile/said || fail "'$command' exits with $?"
done
for problem in "motion/trial-001.json: it is nested deeper than 64 levels" \
  "motion/trial-002.json: it has a number that is too large" "timings.csv: it is no regular file"; do
  [ "$(grep -cF "rehearse: hostile/$problem" hostile/said)" -ge 2 ] || fail "reports do not say '$problem' but: $(cat hostile/said)"
done

cp -r run bent
sed -i '3s/^2,[^,]*,[^,]*,/2,five,7.0x3,/' bent/trials.csv
"$program" report bent >/dev/null 2>stderr
grep -q "bent/trials.csv: row 3: return = 7.0x3, must be a number" stderr || fail "the report says $(cat stderr)"

[ -x "$chromium" ] || { echo "there is no chromium"; exit 77; }
cp -r run walker
"$program" identify pendubot run/trajectories/trial-001.csv --set beyond=nothing --set particles=5 --set every_s=0.5 \
  --out logs >/dev/null 2>&1 || fail "identify"
node "$here/walker.mjs" walker 2 50
"$program" report walker >/dev/null
cp -r run many
node "$here/many.mjs" many
"$program" report many >/dev/null 2>stderr
[ ! -s stderr ] || fail "the report of a robot with many states complains: $(cat stderr)"
node "$browser_test" "$chromium" "$build/web/page" "$work"
