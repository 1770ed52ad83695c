#!/usr/bin/env bash
# pages.sh PROGRAM REFERENCE ROOT: docs/command-line.md is what the command line says of itself, docs/robot-file.md what the
# schema of robots' files says; every command has a manual page with all of its options, in which groff and mandoc find
# nothing wrong.
set -u
here=$(cd "$(dirname "$0")" && pwd)
reference=$2 root=$3
. "$here/../prelude.sh"
. "$here/said.sh"

for page in command-line robot-file; do
  diff "$root/docs/$page.md" "$reference/$page.md" || fail "docs/$page.md: scripts/published makes it anew"
done
for key in $("$program" list --schema | grep -oE '"[a-z_]+": \{' | tr -d '": {' | grep -vx -e items -e properties -e not | sort -u); do
  grep -qE "[.\`[]$key(\.NAME)?[]\`]" "$root/docs/robot-file.md" || fail "docs/robot-file.md lacks $key"
done
[ "$(commands_said | wc -l)" -gt 10 ] || fail "--help shows few commands: $(commands_said)"

has_all() { # COMMAND PAGE: its options, as bold words
  local flag text
  text=$(<"$2")
  for flag in $(flags_said "$1"); do
    [[ $text == *"\\fB${flag//-/\\-}\\fR"* ]] || { echo "no $flag in $2"; return 1; }
  done
}
for command in $(commands_said); do
  page=$reference/man/rehearse-$command.1
  [ -f "$page" ] || { fail "$command has no manual page"; continue; }
  has_all "$command" "$page" || fail "the manual page of $command lacks an option"
  grep -q "rehearse.-$command (1)" "$reference/man/rehearse.1" || fail "rehearse.1 does not name $command"
done
sed '/until..solved/d' "$reference/man/rehearse-learn.1" >shorter.1
has_all learn shorter.1 >said && fail "a missing option is not noticed"

pages=("$reference"/man/*.1)
gzip -dc "${pages[@]/%/.gz}" | cmp - <(cat "${pages[@]}") || fail "compressed pages are others"
if command -v groff >/dev/null; then
  groff -man -Tutf8 -ww "${pages[@]}" 2>warnings >/dev/null
  [ -s warnings ] && fail "groff: $(cat warnings)"
fi
if command -v mandoc >/dev/null; then mandoc -T lint -W warning "${pages[@]}" || fail "mandoc finds something"; fi
for tool in groff mandoc; do command -v $tool >/dev/null || echo "$tool is not there and was not asked"; done
finish
