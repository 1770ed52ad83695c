#!/usr/bin/env bash
# contest.sh FOLDER: the contest's programs compile with a policy, and their script refuses what it cannot score.
source "$(dirname "$0")/../prelude.sh"
contest=$program
cat >policy.h <<'C'
static int policy_act(const double *x, double t, double *u) { return (void)x, (void)t, u[0] = 0, 1; }
C
for file in score robustness; do
  for joint in 1 2; do
    cc -std=c99 -Wall -Wextra -Werror -fsyntax-only -DJOINT=$joint -I. "$contest/$file.c" || fail "$file.c, joint $joint"
  done
done

# refused PATTERN ARGS… : the script says so and exits with 2
refused() {
  local pattern=$1
  shift
  REHEARSE=true "$contest/score" "$@" >said 2>&1
  local got=$?
  [ $got = 2 ] || fail "'score $*' exits with $got: $(cat said)"
  grep -qF -- "$pattern" said || fail "'score $*' does not say '$pattern' but: $(cat said)"
}
refused "score RUN [TRIAL]"
refused "run is no run folder" run
mkdir run
echo 'scenario = "pendubot"' >run/spec.toml
refused "run: its robot is 'pendubot', must be pendubot-contest or acrobot-contest" run
finish
