#!/usr/bin/env bash
# install.sh BUILD_DIR EXAMPLE_DIR: installs into an empty folder and builds and runs the example against that alone.
set -euo pipefail
build=$1 example=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" >"$work/install.log"
cmake -S "$example" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release >"$work/configure.log" ||
  { cat "$work/configure.log"; exit 1; }
cmake --build "$work/build"
"$work/build/own_robot" | tee "$work/output"
for trial in 2 3; do
  grep -q "^trial $trial: return 1[0-9]\.[0-9]*, mass 1\.6[0-9]* kg$" "$work/output" ||
    { echo "trial $trial did not find the mass of 1.6 kg and a good policy" >&2; exit 1; }
done
(cd "$work" && prefix/bin/rehearse list >listed)
grep -q "as-published" "$work/listed" || { echo "the installed program has no presets" >&2; exit 1; }
