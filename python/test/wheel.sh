#!/usr/bin/env bash
# wheel.sh ROOT BUILD PYTHON: `pip install` in a fresh virtual environment that sees the system's NumPy, without a network.
set -euo pipefail
root=$1 build=$2 python=$3
[ "$build" = "$root/build/release" ] || { echo "only the release build's module goes into a wheel"; exit 77; }
unset PYTHONPATH
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$python" -m venv --system-site-packages "$folder/environment"
cd "$folder"
PIP_NO_INDEX=1 environment/bin/pip install --quiet --disable-pip-version-check "$root"
environment/bin/python -c '
import rehearse
run = rehearse.learn("pendulum", "mi", trials=1, progress=None, options={"search.race.max_evaluations": 200}, out="run")
assert len(run.trials) == 1
assert str(rehearse.__file__).startswith("'"$folder"'"), rehearse.__file__
assert run.report().stat().st_size > 100000'
[[ $(environment/bin/rehearse list) == *pendubot* ]]
[[ $(environment/bin/python -m rehearse status run) == *"trial 1"* ]]
environment/bin/pip uninstall --quiet --yes rehearse
! environment/bin/python -c "import rehearse" 2>/dev/null
