#!/usr/bin/env bash
# bash.sh PROGRAM COMPLETION: bash completes commands, options, names and files, with the functions of bash-completion and
# without them.
set -u
here=$(cd "$(dirname "$0")" && pwd)
completion=$2
. "$here/../prelude.sh"
. "$here/said.sh"

# complete_words WORDS…: how the last of them may go on, in COMPREPLY
complete_words() {
  COMP_WORDS=("$@")
  COMP_CWORD=$(($# - 1))
  COMP_LINE="$*"
  COMP_POINT=${#COMP_LINE}
  COMPREPLY=()
  _rehearse 2>/dev/null
  COMPREPLY=("${COMPREPLY[@]%/}")
}

# is WANTED WORDS…: exactly these words, in any order
is() {
  local wanted=$1 word different=0
  shift
  complete_words "$@"
  for word in $wanted; do [[ " ${COMPREPLY[*]} " == *" $word "* ]] || different=1; done
  for word in "${COMPREPLY[@]}"; do [[ " $wanted " == *" $word "* ]] || different=1; done
  [ $different = 0 ] || fail "'$*' goes on with '${COMPREPLY[*]}', must with '$wanted'"
}

lacks_none() { # every flag of every command
  local command flag missing=0
  for command in $commands; do
    complete_words rehearse "$command" --
    for flag in ${flags[$command]}; do
      [[ " ${COMPREPLY[*]} " == *" $flag "* ]] || { echo "$command does not go on with $flag"; missing=1; }
    done
  done
  return $missing
}

check() {
  echo "$1"
  is "$commands --help --version" rehearse ""
  is "learn list" rehearse l
  lacks_none || fail "an option is missing"
  is "$scenarios robot.toml folder" rehearse learn ""
  is "$learners $scenarios robot.toml folder" rehearse list ""
  is "$learners" rehearse learn pendubot --learner ""
  is "pilco pilco-prior" rehearse learn pendubot --learner pil
  is "pilco pilco-prior" rehearse learn pendubot --learner = pil
  is "$learners" rehearse learn pendubot --learner =
  is "as-published robot.toml folder" rehearse learn pendubot --preset ""
  is "useful tunable misleading partial oracle" rehearse learn pendubot --prior ""
  is "useful,misleading" rehearse learn pendubot --prior useful,mis
  is "plant.b1= plant.b2=" rehearse learn pendubot --set plant.b
  is "" rehearse learn pendubot --set plant.b1 =
  is "" rehearse learn pendubot --set plant.b1 = 0
  is "" rehearse learn pendubot --trials ""
  is "" rehearse learn pendubot ""
  is "folder" rehearse report ""
  is "folder" rehearse report --out = page.html ""
  is "log.csv folder" rehearse tell folder ""
  is "log.csv folder" rehearse tell folder log.csv --threads 1 ""
  is "policy.json folder" rehearse learn pendubot --policy ""
  is "folder log.csv policy.json robot.toml" rehearse export folder --out ""
  is "" rehearse new ""
}

commands=$(commands_said | xargs) scenarios=$(names_said Scenarios | xargs) learners=$(names_said Learners | xargs)
declare -A flags
for command in $commands; do flags[$command]=$(flags_said "$command"); done
mkdir folder
touch robot.toml log.csv policy.json
. "$completion"
complete -p rehearse | grep -q -- "-F _rehearse" || fail "bash is not told of the function"
check "without bash-completion"
. /usr/share/bash-completion/bash_completion 2>/dev/null
if declare -F _filedir >/dev/null; then
  check "with bash-completion"
else
  echo "bash-completion is not there: its functions were not tried"
fi
for flag in until-solved held-out; do
  sed "s/\"\([^\"]*\) --$flag/\"\1/" "$completion" >shorter
  . ./shorter
  lacks_none >/dev/null && fail "it is not noticed that --$flag is missing"
done
finish
