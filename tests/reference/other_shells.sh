#!/usr/bin/env bash
# other_shells.sh PROGRAM REFERENCE: zsh and fish complete, too.
set -u
here=$(cd "$(dirname "$0")" && pwd)
reference=$2
. "$here/../prelude.sh"
. "$here/said.sh"
export HOME=$folder XDG_CONFIG_HOME=$folder XDG_DATA_HOME=$folder
tried=0

for command in $(commands_said); do
  sed -n "/^ *$command)\$/,/;;/p" "$reference/zsh/_rehearse" >zsh.part
  grep -F -- "'__rehearse_has_command $command'" "$reference/fish/rehearse.fish" >fish.part
  for flag in $(flags_said "$command"); do
    grep -q -- " -l ${flag#--} " fish.part || fail "fish: $command $flag"
    grep -q -- "'\**$flag[=[]" zsh.part || fail "zsh: $command $flag"
  done
done

if command -v fish >/dev/null; then
  tried=1
  fished() { # LINE: how it goes on
    fish --no-config -c "source '$reference/fish/rehearse.fish'; complete -C '$1'" 2>&1 | cut -f1 | sort | xargs
  }
  [ "$(fished 'rehearse le')" = learn ] || fail "fish: $(fished 'rehearse le')"
  [ "$(fished 'rehearse learn pendubot --learner pil')" = "pilco pilco-prior" ] || fail "fish: learners"
  [ "$(fished 'rehearse learn pendubot --prior ')" = "misleading oracle partial tunable useful" ] || fail "fish: priors"
  [ "$(fished 'rehearse learn pendubot --set plant.b')" = "plant.b1= plant.b2=" ] || fail "fish: keys"
  [ "$(fished 'rehearse learn --until')" = --until-solved ] || fail "fish: flags"
fi
if command -v zsh >/dev/null; then
  tried=1
  cat >capture.zsh <<'ZSH'
zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell "PS1=; fpath=($1 \$fpath); autoload -Uz compinit; compinit -u -D; bindkey '^I' complete-word; echo rea\dy"
zpty -r -m shell line '*ready*'
shift
while (( $# )); do
  zpty -w -n shell "$1"$'\t'
  zpty -r -m shell line "*$2*"
  zpty -w -n shell $'\C-u'
  shift 2
done
zpty -d shell
ZSH
  timeout 60 zsh -f capture.zsh "$reference/zsh" 'rehearse lea' 'rehearse learn' \
    'rehearse learn pendubot --learner gp-m' 'gp-mi' 'rehearse learn pendubot --set plant.b' 'plant.b2' \
    'rehearse learn pendubot --prior mis' misleading || fail "zsh does not complete"
fi
[ $tried = 1 ] || echo "neither fish nor zsh is there: only their files were read"
finish
