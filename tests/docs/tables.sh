#!/usr/bin/env bash
# tables.sh ROOT: the marked tables of docs follow from results/*.csv, and scripts/tables notices where one does not.
set -u
export PYTHONDONTWRITEBYTECODE=1
root=$(realpath "$1")
failures=0
fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

"$root"/scripts/tables --check || fail "docs differ from results/*.csv; scripts/tables writes them anew"

copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
mkdir "$copy"/{scripts,results}
cp "$root"/scripts/{tables,runs.py} "$copy"/scripts
cp "$root"/results/*.csv "$copy"/results
cp -r "$root"/docs "$copy"
document=$copy/docs/results/priors.md
sed -i 's/^| useful | 7 23 |/| useful | 8 22 |/' "$document"
"$copy"/scripts/tables --check >"$copy"/said && fail "a changed number is not noticed"
grep -q '^-| useful | 8 22 |' "$copy"/said && grep -q '^+| useful | 7 23 |' "$copy"/said || fail "it says $(cat "$copy"/said)"
"$copy"/scripts/tables || fail "tables are not written"
cmp "$root"/docs/results/priors.md "$document" || fail "a table that is written anew differs"

document=$copy/docs/results/noise.md
sed -i '0,/<!-- table: noise -->/s//<!-- table: nosie -->/' "$document"
"$copy"/scripts/tables --check 2>/dev/null && fail "an unknown table is not noticed"
sed -i '0,/<!-- table: nosie -->/s//<!-- table: noise -->/; 0,/<!-- \/table -->/s///' "$document"
"$copy"/scripts/tables --check 2>/dev/null >&2 && fail "a table without an end is not noticed"
cp "$root"/docs/results/noise.md "$document"
sed -i '/<!-- table: noise -->/,/<!-- \/table -->/d' "$document"
"$copy"/scripts/tables --check 2>/dev/null && fail "a table that no document has is not noticed"

echo "$failures failures"
exit $((failures > 0))
