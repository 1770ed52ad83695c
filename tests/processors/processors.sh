#!/usr/bin/env bash
# processors.sh PROGRAM QEMU EMULATED: short runs of every learner have the same bytes with all vector instructions of this
# processor, with kernels kept to AVX2, and, where QEMU's user mode is installed, on an emulated Haswell (2013). A
# processor without AVX2 is refused.
source "$(dirname "$0")/../prelude.sh"
qemu=$2 emulated=$3

few=(--set search.race.max_evaluations=600 --set search.race.descents=2 --set search.selection=10)
short=(--set search.line_searches=3 --set search.restarts=0 --set policy=rbf --set centres=10)
"$program" new short.toml >output || fail "new: $(cat output)"
sed -i 's/^horizon = .*/horizon = 12/' short.toml  # emulation is slow
run() { # run FOLDER RUN LAUNCHER… : the run named RUN
  local out=$1 name=$2
  shift 2
  local arguments
  case $name in
    gp-mi) arguments=(pendubot --learner gp-mi --prior partial "${few[@]}") ;;
    gp-mi-noise) arguments=(pendubot --learner gp-mi --prior useful "${few[@]}" --set measurement_noise=0.01 --set start_noise=0.001) ;;
    mi) arguments=(pendubot --learner mi --prior misleading "${few[@]}") ;;
    black-drops) arguments=(cartpole --learner black-drops "${few[@]}") ;;
    black-drops-prior) arguments=(pendulum --learner black-drops-prior "${few[@]}" --set model.gp.mirror=on) ;;
    gp-mi-pendulum) arguments=(pendulum --learner gp-mi "${few[@]}") ;;
    gp-mi-short) arguments=(short.toml --learner gp-mi "${few[@]}" --set search.race.max_evaluations=200) ;;
    pilco) arguments=(pendulum --learner pilco "${short[@]}") ;;
    pilco-prior) arguments=(pendulum --learner pilco-prior "${short[@]}" --set pilco.prior_episodes=2) ;;
    pi-rem) arguments=(pendubot --learner pi-rem --prior useful --set centres=10 "${short[@]}") ;;
    ite) arguments=(pendubot --learner ite --prior misleading --set archive.niches=200 --set archive.evaluations=3000) ;;
    gp-ilqg) arguments=(pendubot --learner gp-ilqg --prior useful --set search.starts=4 --set search.iterations=20
      --set model.gp.mirror=on) ;;
    hexapod) arguments=(hexapod --learner gp-mi --set damage=rear-left --set horizon=10 --set search.race.max_evaluations=12
      --set search.race.descents=2 --set search.selection=1 --set retry.searches=0) ;;
  esac
  "$@" "$program" learn "${arguments[@]}" --trials 2 --seed 5 --threads 2 --out "$out" >/dev/null || fail "$out"
}

# compare A B: everything that a run comes to
compare() {
  same "$1" "$2" trials.csv errors.csv policy.json trajectories/trial-00{1,2}.csv
  local file
  for file in "$1"/predictions/*; do same "$1" "$2" "predictions/${file##*/}"; done
}

runs=(gp-mi gp-mi-noise gp-mi-pendulum gp-mi-short mi black-drops black-drops-prior pilco pilco-prior pi-rem ite gp-ilqg)
"$program" list | grep -q '^ *hexapod' && runs+=(hexapod)
for name in "${runs[@]}"; do
  begin=$(milliseconds)
  run "native-$name" "$name" env
  run "avx2-$name" "$name" env REHEARSE_KERNELS=avx2
  compare "native-$name" "avx2-$name"
  echo "$name: $(($(milliseconds) - begin)) ms"
done

REHEARSE_KERNELS=sse "$program" list >output 2>&1
[ $? = 2 ] && grep -q "^rehearse: REHEARSE_KERNELS = 'sse', must be avx2 or not set" output || fail "a wrong name: $(cat output)"

if [ -z "$qemu" ] || [[ $qemu = *NOTFOUND ]]; then
  echo "no QEMU: the emulated processors are left out"
  finish
fi
"$qemu" -cpu Nehalem "$program" list >output 2>&1
[ $? = 2 ] && grep -q "^rehearse: this processor lacks AVX2" output || fail "a processor of 2008: $(cat output)"
for name in ${REHEARSE_EMULATED:-$emulated}; do
  begin=$(milliseconds)
  run "haswell-$name" "$name" "$qemu" -cpu Haswell-noTSX 2>>warnings  # of features that QEMU leaves out
  compare "native-$name" "haswell-$name"
  echo "$name on an emulated Haswell: $(($(milliseconds) - begin)) ms"
done
finish
