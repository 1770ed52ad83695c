#!/usr/bin/env bash
# other_shells.sh PROGRAM REFERENCE: zsh and fish complete, too.
set -u
here=$(cd "$(dirname "$0")" && pwd)
reference=$2
. "$here/../prelude.sh"
. "$here/said.sh"
export LC_ALL=C HOME=$folder XDG_CONFIG_HOME=$folder XDG_DATA_HOME=$folder
tried=0

fish=$(<"$reference/fish/rehearse.fish") zsh=$(<"$reference/zsh/_rehearse")
for command in $(commands_said); do
  zsh_part=${zsh#*$'\n'*" $command)"$'\n'}
  zsh_part=${zsh_part%%;;*}
  for flag in $(flags_said "$command"); do
    [[ $fish == *"'__rehearse_has_command $command' -l ${flag#--} "* ]] || fail "fish: $command $flag"
    [[ $zsh_part == *"$flag["* || $zsh_part == *"$flag=["* ]] || fail "zsh: $command $flag"
  done
done

if command -v fish >/dev/null; then
  tried=1
  cat >capture.fish <<'FISH'
source $argv[1]/fish/rehearse.fish
for line in $argv[2..]
    echo $line: (complete -C $line | string split -f1 \t | sort)
end
FISH
  fish --no-config capture.fish "$reference" 'rehearse le' 'rehearse learn pendubot --learner pil' \
    'rehearse learn pendubot --prior ' 'rehearse learn pendubot --set plant.b' 'rehearse learn --until' >said 2>&1
  diff said - <<'SAID' || fail "fish completes otherwise"
rehearse le: learn
rehearse learn pendubot --learner pil: pilco pilco-prior
rehearse learn pendubot --prior : misleading oracle partial tunable useful
rehearse learn pendubot --set plant.b: plant.b1= plant.b2=
rehearse learn --until: --until-solved
SAID
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
