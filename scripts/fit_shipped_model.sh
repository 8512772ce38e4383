#!/usr/bin/env bash
# Fits the model that is shipped, in three minutes: Upkie crouched and on nearly straight legs, with
# ideal and with real actuators, in both engines, on what the benchmark fits and hanging; other draws.
# Usage: scripts/fit_shipped_model.sh build/release/touchdown models/touchdown.npz
set -euo pipefail
program="$(realpath "$1")"
output="$(realpath -m "$2")"
cd "$(dirname "$0")/.."

readonly seed=3 runs=4
readonly scenes=(stairs roam lift_slowly push_off hop hang)
readonly robots=(upkie.xml upkie_actuated.yaml upkie_straight.yaml upkie_straight_actuated.yaml)

logs="$(mktemp -d)"
trap 'rm -rf "$logs"' EXIT
for robot in "${robots[@]}"; do
  for scene in "${scenes[@]}"; do
    for simulator in mujoco bullet; do
      for ((run = 0; run < runs; ++run)); do
        "$program" simulate "scenarios/$scene.yaml" --simulator "$simulator" --seed "$seed" --run "$run" \
          --set "robot=models/$robot" -o "$logs/${robot%.*}_${scene}_${simulator}_$run.mpack" >/dev/null 2>&1
      done
    done
  done
done
"$program" fit "$logs"/*.mpack --estimator touchdown --robot upkie -o "$output"

words() { printf '"%s", ' "$@" | sed 's/, $//'; }
cat >"${output%.npz}.json" <<END
{
  "model": "touchdown",
  "command": "scripts/fit_shipped_model.sh build/release/touchdown models/touchdown.npz",
  "sha256": "$(sha256sum "$output" | cut -d' ' -f1)",
  "scenes": [$(words "${scenes[@]}")],
  "robots": [$(words "${robots[@]}")],
  "simulators": ["mujoco", "bullet"],
  "seed": $seed,
  "runs_of_each": $runs,
  "version": "$("$program" --version)"
}
END
