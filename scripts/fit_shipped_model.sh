#!/usr/bin/env bash
# Fits the shipped model, in three minutes: Upkie crouched, with ideal and with real actuators, in both
# engines, on the scenes that the benchmark fits and hanging. A quarter of the runs has nearly straight
# legs, mostly in scenes that lift off or land. The draws differ from the benchmark's.
# Usage: scripts/fit_shipped_model.sh build/release/touchdown models/touchdown.npz
set -euo pipefail
program="$(realpath "$1")"
output="$(realpath -m "$2")"
cd "$(dirname "$0")/.."

readonly seed=3
readonly simulators=(mujoco bullet)
readonly robots=(upkie.xml upkie_actuated.yaml upkie_straight.yaml)
readonly scenes=(stairs roam lift_slowly push_off hop hang)

# Rolling and hanging on straight legs inform little about contact, but teach that any load is possible.
# So they get one run each.
runs_of() { # robot, scene
  case "$1 $2" in
    "upkie_straight.yaml roam" | "upkie_straight.yaml hang") echo 1 ;;
    *) echo 4 ;;
  esac
}

logs="$(mktemp -d)"
trap 'rm -rf "$logs"' EXIT
count=0
for robot in "${robots[@]}"; do
  for scene in "${scenes[@]}"; do
    runs="$(runs_of "$robot" "$scene")"
    for simulator in "${simulators[@]}"; do
      for ((run = 0; run < runs; ++run)); do
        "$program" simulate "scenarios/$scene.yaml" --simulator "$simulator" --seed "$seed" --run "$run" \
          --set "robot=models/$robot" -o "$logs/${robot%.*}_${scene}_${simulator}_$run.mpack" >/dev/null 2>&1
        count=$((count + 1))
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
  "simulators": [$(words "${simulators[@]}")],
  "seed": $seed,
  "runs": $count,
  "version": "$("$program" --version)"
}
END
