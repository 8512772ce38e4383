#!/bin/bash
# Prints the table "What each way gives" of docs/tutorials/your_labels.md for a robot, in three minutes.
# Usage: scripts/label_ways.sh ROBOT.yaml RUN "FITTED SCENES" "TESTED SCENES", in an empty folder
set -u
robot=$1 run=$2 prior=models/evidence_curves.npz
read -ra fitted <<<"$3"
read -ra tested <<<"$4"
simulate() {
  touchdown simulate "scenarios/$1.yaml" --set "robot=$robot" --sensors noise/profiles/upkie.yaml "${@:2}" 2>/dev/null
}
# The mean over the test's logs, and the score of each.
score() {
  for scene in "${tested[@]}"; do touchdown estimate "test_$scene.mpack" "${@:2}" 2>/dev/null; done |
    awk -v way="$1" '/^truth/ {sum += $5; all = all " " $5; ++n} END {printf "%-28s %.3f %s\n", way, n ? sum / n : 0, all}'
}
fit() {
  rm -f model.npz
  touchdown fit "${@:2}" --robot "$robot" --no-accuracy -o model.npz >/dev/null && score "$1" --model model.npz
}
logs=() labels=()
for scene in "${tested[@]}"; do simulate "$scene" --seed 2 --run "$run" -o "test_$scene.mpack"; done
for scene in "${fitted[@]}"; do
  simulate "$scene" --run 0 -o "fit_$scene.mpack"
  touchdown label "fit_$scene.mpack" --robot "$robot" --transfer -o "$scene.csv" >/dev/null
  logs+=("fit_$scene.mpack") labels+=(--labels "$scene.csv")
done
simulate flat -o rolling.mpack
simulate hang -o hanging.mpack
score shipped --robot "$robot" --transfer
fit rolling_and_hanging --contact rolling.mpack --no-contact hanging.mpack
fit proposals "${logs[@]}" "${labels[@]}"
fit proposals_prior "${logs[@]}" "${labels[@]}" --prior "$prior"
# Simulated truth stands for corrected labels.
fit corrected "${logs[@]}"
fit corrected_prior "${logs[@]}" --prior "$prior"
fit corrected_prior_servo_load "${logs[@]}" --prior "$prior" --servo-load
