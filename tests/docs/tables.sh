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
cp "$root"/scripts/{tables,*.py} "$copy"/scripts
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

python3 - "$root" <<'END' || fail "the median trial of solved and unsolved runs"
import os, sys
sys.path.insert(0, os.path.join(sys.argv[1], "scripts"))
from columns import median_first
from runs import Run

def runs(*trials):  # each first solved at one of these; None: never
    for seed, first in enumerate(trials):
        run = Run(("gp-mi", "useful", "", seed))
        run.trials = [{"solved": "1" if k == first else "0"} for k in range(1, 10)]
        yield run

for trials, text in [((8, 6, 7, 7, 8, 8), "7.5 (7 to 8)"), ((2, 2, 2, None), "2 (2 to –)"), ((None, 3), "– (– to –)"),
                     ((4,), "4 (4 to 4)"), ((1, 2, 3, None, None), "3 (2 to –)")]:
    said = median_first("")[1](list(runs(*trials)))
    assert said == text, f"{trials}: {said}, not {text}"
END

echo "$failures failures"
exit $((failures > 0))
