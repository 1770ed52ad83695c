#!/usr/bin/env bash
# example.sh PYTHON FILE: runs an example in an empty folder.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$1" "$2"
