#!/usr/bin/env bash
# copyright.sh ROOT BUILD: packaging/copyright has every dependency, and scripts/copyright notices where it lacks one.
set -u
root=$(realpath "$1") build=$2
failures=0
fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

"$root"/scripts/copyright --check "$build" || fail "scripts/copyright writes packaging/copyright anew"

copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
mkdir "$copy/web"
cp -r "$root"/{scripts,packaging,LICENSE} "$copy"
cp "$root/web/package-lock.json" "$copy/web"
notices() { # PATTERN
  "$copy"/scripts/copyright --check "$copy" >"$copy/said" && fail "it does not notice: $1"
  grep -q -- "$1" "$copy/said" || fail "it does not say '$1' but $(cat "$copy/said")"
}
"$copy"/scripts/copyright --check "$copy" || fail "it fails without the page"
sed -i '/"node_modules\/three"/,/}/s/"version": "/&9/' "$copy/web/package-lock.json"
notices "lacks Files: web/node_modules/three/\*, Comment: Version 9"
cp "$root/web/package-lock.json" "$copy/web"
sed -i 's/libmuparser-dev/& libnew-dev/' "$copy/scripts/install-dependencies"
notices "lacks Files: libnew-dev"
cp "$root/scripts/install-dependencies" "$copy/scripts"
sed -i 's/^License: BSL-1.0$/&-other/' "$copy/packaging/copyright"
sed -i '0,/^License: BSL-1.0-other$/s//License: BSL-1.0/' "$copy/packaging/copyright"
notices "text of BSL-1.0"

echo "$failures failures"
exit $((failures > 0))
