#!/usr/bin/env bash
# install.sh BUILD_DIR EXAMPLES_DIR: installs into an empty folder and builds and runs each example against that alone.
set -euo pipefail
build=$1 examples=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" >"$work/install.log"

# run EXAMPLE: builds it and shows what it prints, which is $work/output, too
run() {
  cmake -S "$examples/$1" -B "$work/$1" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release \
    >"$work/configure.log" || { cat "$work/configure.log"; exit 1; }
  cmake --build "$work/$1"
  "$work/$1/$1" | tee "$work/output"
}

run own_robot
for trial in 2 3; do
  grep -q "^trial $trial: return 1[0-9]\.[0-9]*, mass 1\.6[0-9]* kg$" "$work/output" ||
    { echo "trial $trial did not find the mass of 1.6 kg and a good policy" >&2; exit 1; }
done

run own_learner # fails where the learner breaks a law
grep -q "^trial 3: return " "$work/output" || { echo "own_learner did not do three trials" >&2; exit 1; }

(cd "$work" && prefix/bin/rehearse list >listed)
grep -q "as-published" "$work/listed" || { echo "the installed program has no presets" >&2; exit 1; }
