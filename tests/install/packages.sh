#!/usr/bin/env bash
# packages.sh DEBS [BASE]: installs the packages of a folder on a clean Debian 12 as a user does, tries what they hold, and
# removes them. It needs root, debootstrap, and the sources of this machine's apt; exit 77 where it lacks one of them. BASE: a
# folder that debootstrap filled before, to be copied.
set -euo pipefail
debs=$(realpath "$1")
names=(rehearse librehearse-dev python3-rehearse rehearse-doc)
[ "$(id -u)" = 0 ] || { echo "skipped: only root can make another root folder"; exit 77; }
[ -n "${2:-}" ] || command -v debootstrap >/dev/null || { echo "skipped: debootstrap is not installed"; exit 77; }
# In a namespace of its own, so that no mount outlives it.
[ -n "${OWN_MOUNTS:-}" ] || exec env OWN_MOUNTS=1 unshare --mount --propagation private bash "$0" "$@"

fail() {
  echo "FAILED: $*" >&2
  exit 1
}
step() { echo "$(printf '%5d' $SECONDS) s  $*"; }
work=$(mktemp -d)
root=$work/root
clean() {
  umount "$root/proc" 2>/dev/null || true
  rm -rf --one-file-system "$work"
}
trap clean EXIT

step "the packages themselves"
for name in "${names[@]}"; do
  deb=$(echo "$debs/${name}"_*.deb)
  [ -f "$deb" ] || fail "there is no package $name in $debs"
  dpkg-deb -c "$deb" >"$work/contents"
  awk '$2 != "root/root"' "$work/contents" | grep . && fail "$name: files of other owners"
  awk '$6 !~ "^./(usr/.*)?$"' "$work/contents" | grep . && fail "$name: files outside of /usr"
  grep -vE '^(drwxr-xr-x|-rw-r--r--|-rwxr-xr-x) ' "$work/contents" && fail "$name: other permissions"
  grep -E '__pycache__|\.orig$|~$' "$work/contents" && fail "$name: leavings"
  for file in copyright changelog.gz; do
    grep -q " ./usr/share/doc/$name/$file$" "$work/contents" || fail "$name has no $file"
  done
  if command -v lintian >/dev/null; then
    lintian --fail-on error,warning "$deb" 2>"$work/lintian" || fail "$name: lintian"
  fi
done
mkdir "$work/program"
dpkg-deb -x "$debs"/rehearse_*.deb "$work/program"
readelf -S "$work/program/usr/bin/rehearse" | grep -q '\.symtab' && fail "the program is not stripped"

step "a clean Debian 12"
sources() { apt-get indextargets --format '$(ORIGIN) deb $(SITE) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' | sed -n 's/^Debian //p'; }
if [ -n "${2:-}" ]; then
  cp -a "$2" "$root"
else
  debootstrap --variant=minbase bookworm "$root" "$(sources | awk '$3 == "bookworm" {print $2; exit}')" >"$work/log" ||
    { tail "$work/log"; fail "debootstrap"; }
fi
sources | sort -u >"$root/etc/apt/sources.list"
apt-config dump Acquire | grep -E '^Acquire::(Check-|https?::)' >"$root/etc/apt/apt.conf.d/90host" || true
cp -L /etc/resolv.conf /etc/hosts "$root/etc/"
if [ -d /etc/ssl/certs ]; then mkdir -p "$root/etc/ssl" && cp -rLn /etc/ssl/certs "$root/etc/ssl/" 2>/dev/null || true; fi
mount -t proc proc "$root/proc"
mkdir "$root/debs"
cp "$debs"/*.deb "$root/debs"

inside() {
  chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    bash -ec "$*" >"$work/log" 2>&1 </dev/null || { tail -n 30 "$work/log"; fail "$*"; }
}
as_user() { inside "su user -s /bin/bash -c 'cd && set -e && $*'"; }
inside "apt-get update -q && useradd --create-home user"
ours() { find "$root" -xdev -iname '*rehearse*' -not -path "$root/debs/*" -not -path "$root/proc/*" -not -path "$root/home/*" \
  -not -path "$root/var/log/*" -not -path "$root/var/cache/*" | sed "s,^$root,,"; }
[ -z "$(ours)" ] || fail "a clean Debian has $(ours)"
places=(usr/share/zsh usr/share/fish usr/share/bash-completion usr/share/man/man1 usr/lib/cmake)
before=$(cd "$root" && ls -d "${places[@]}" 2>/dev/null || true)

step "apt install: the program and the module of Python"
inside "apt-get install -q -y --no-install-recommends /debs/rehearse_*.deb /debs/python3-rehearse_*.deb"
step "the first example"
as_user "rehearse learn pendubot --learner gp-mi --prior misleading --trials 2 --out runs/first"
grep -E '^trial' "$work/log"
as_user "rehearse report runs/first && test -s runs/first/report.html"
step "robots that come with it"
few="--trials 1 --set search.race.max_evaluations=800 --set search.race.descents=2"
as_user "rehearse learn /usr/share/doc/rehearse/examples/robots/pendulum.toml --learner mi $few --out robot"
as_user "rehearse check /usr/share/doc/rehearse/examples/models/acrobot.toml"
as_user "rehearse campaign /usr/share/doc/rehearse/examples/campaigns/pendubot-short.toml --dry-run"
step "the module of Python"
as_user "python3 -c \"import rehearse; print(rehearse.__version__)\""
as_user "python3 -m rehearse report runs/first"
as_user "python3 -m rehearse --version && rehearse --version"
[ "$(sort -u "$work/log" | wc -l)" = 1 ] || fail "program and module have other versions: $(cat "$work/log")"

step "apt install: the libraries and the documents"
inside "apt-get install -q -y --no-install-recommends /debs/librehearse-dev_*.deb /debs/rehearse-doc_*.deb g++ cmake make"
step "a robot in C++"
as_user "cp -r /usr/share/doc/rehearse/examples/own_robot . && cmake -S own_robot -B build && cmake --build build"
as_user "build/own_robot learn cart --learner gp-mi $few --out cart && build/own_robot report cart"

step "apt remove, apt purge"
inside "apt-get remove -q -y ${names[*]}"
grep -i "not empty so not removed" "$work/log" && fail "something is left"
left=$(ours)
[ -z "$left" ] || fail "apt remove leaves $left"
inside "apt-get install -q -y --no-install-recommends /debs/*.deb"
inside "python3 -c \"import rehearse\" && apt-get purge -q -y ${names[*]}"
left=$(ours)
[ -z "$left" ] || fail "apt purge leaves $left"
inside "dpkg-query -W -f \"\\\${Package}\\n\""
grep rehearse "$work/log" && fail "dpkg still knows it"
inside "apt-get autoremove -q -y --purge"
for place in $(cd "$root" && ls -d "${places[@]}" 2>/dev/null); do
  grep -qx "$place" <<<"$before" || [ -n "$(find "$root/$place" -type f)" ] || fail "an empty folder is left: $place"
done
step "nothing is left"
