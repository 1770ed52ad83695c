#!/usr/bin/env bash
# kill.sh PROGRAM: kills a short campaign with SIGKILL at instants spread over its length, starts each again, and compares
# the tables with those of one that was never interrupted; then threads, damage, claims and Ctrl-C.
source "$(dirname "$0")/../prelude.sh"

short_campaign '["mi", "black-drops-prior"]' 1-3 >c.toml
cat >>c.toml <<'TOML'

[[claim]]
text = "nobody solves it with so few rollouts"
learner = "mi"
solved_by = 2
at_least_runs = 3
TOML


begin=$(milliseconds)
"$program" campaign c.toml --out whole --threads 2 >output || fail "the whole campaign: $(cat output)"
length=$(($(milliseconds) - begin))
echo "the whole campaign takes $length ms"
[ "$(wc -l <whole/campaign.csv)" = 13 ] || fail "campaign.csv has $(wc -l <whole/campaign.csv) lines"
grep -q "FAIL .*nobody solves it" output || fail "the claim is not judged"

for instant in 1 3 5 7; do
  run=killed-$instant
  "$program" campaign c.toml --out $run --threads 2 >/dev/null &
  process=$!
  until [ -d $run ] || ! kill -0 $process 2>/dev/null; do sleep 0.002; done
  sleep "$(printf '%d.%03d' $((length * instant / 8 / 1000)) $((length * instant / 8 % 1000)))"
  kill -KILL $process 2>/dev/null
  wait $process 2>/dev/null
  echo "killed at instant $instant with $(find $run/runs -name done 2>/dev/null | wc -l) of 6 runs done"
  find $run/runs -name timings.csv -newer c.toml | while read -r file; do
    [ -e "$(dirname "$file")/done" ] && echo mine >"$file"
  done
  finished=$(grep -lx mine $run/runs/*/timings.csv 2>/dev/null | wc -l)
  "$program" campaign c.toml --out $run --threads 2 >/dev/null || fail "starting $run again"
  same whole $run "${tables[@]}"
  [ "$(grep -lx mine $run/runs/*/timings.csv 2>/dev/null | wc -l)" = "$finished" ] || fail "$run repeats a finished run"
done

"$program" campaign c.toml --out one/ --threads 1 >output
grep -q "one/campaign.csv" output || fail "the tables are said to be elsewhere: $(cat output)"
same whole one "${tables[@]}"

"$program" campaign c.toml --out whole --check-claims >/dev/null
[ $? = 1 ] || fail "a claim that fails does not make --check-claims fail"

echo mine >one/runs/notes.txt
truncate -s -5 one/runs/pendubot-mi-misleading-2/checkpoint
rm one/runs/pendubot-mi-misleading-2/done
echo "format = 7" >one/runs/pendubot-mi-misleading-3/spec.toml
"$program" campaign c.toml --out one >output
[ $? = 1 ] || fail "damaged runs do not make the campaign fail"
for words in "skipped: runs/notes.txt" "misleading-2: .*the checkpoint is truncated or damaged" "misleading-3: .*spec.toml"; do
  grep -q "$words" output || fail "damage is not named ($words): $(cat output)"
done
grep -q "removed ones are begun anew" output || fail "it is not said what helps: $(cat output)"
[ "$(wc -l <one/campaign.csv)" = 9 ] || fail "campaign.csv of the rest has $(wc -l <one/campaign.csv) lines"

# Ctrl-C: 130, and it can be continued.
"$program" campaign c.toml --out stopped >/dev/null 2>output &
process=$!
until [ -d stopped/runs ] || ! kill -0 $process 2>/dev/null; do sleep 0.01; done
kill -INT $process
wait $process
code=$?
[ $code = 130 ] || fail "an interrupted campaign exits with $code: $(cat output)"
grep -q "give the same command again" output || fail "an interrupted campaign says: $(cat output)"
"$program" campaign c.toml --out stopped >/dev/null || fail "continuing after Ctrl-C"
same whole stopped "${tables[@]}"

finish
