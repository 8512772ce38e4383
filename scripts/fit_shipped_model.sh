#!/usr/bin/env bash
# Fits the shipped models, in minutes: Upkie crouched and with nearly straight legs, with ideal and with
# real actuators, in both engines, with Upkie's sensors, on scenes drawn from all families.
# The balanced and the quiet model are the same fit at two operating points, which
# scripts/choose_operating_points.py chose. Logs without targets of joints get the second set of curves.
# Usage: scripts/fit_shipped_model.sh build/release/touchdown models/evidence_curves.npz
set -euo pipefail
program="$(realpath "$1")"
output="$(realpath -m "$2")"
quiet="${output%.npz}_quiet.npz"
cd "$(dirname "$0")/.."

readonly seed=103
readonly simulators=(mujoco bullet)
readonly robots=(upkie.xml upkie_actuated.yaml upkie_straight.yaml upkie_straight_actuated.yaml)
readonly sensors=noise/profiles/upkie.yaml
# leave_below, return_above, settle_at and settle_after of both operating points
readonly balanced_point=(0.7 0.98 0.8 0.02) quiet_point=(0.5 0.99 0.9 0)

# Drawn scenes of each robot. Families take turns, so 22 are one of each.
scenes_of() { # robot
  case "$1" in
    upkie_straight.yaml) echo 22 ;;
    upkie_straight_actuated.yaml) echo 44 ;;
    *) echo 66 ;;
  esac
}

logs="$(mktemp -d)"
trap 'rm -rf "$logs"' EXIT
count=0
for robot in "${robots[@]}"; do
  scenes="$logs/${robot%.*}"
  "$program" generate --seed "$seed" --count "$(scenes_of "$robot")" -o "$scenes" >/dev/null
  for scene in "$scenes"/*.yaml; do
    for simulator in "${simulators[@]}"; do
      "$program" simulate "$scene" --simulator "$simulator" --seed "$seed" --run "$count" \
        --set "robot=models/$robot" --sensors "$sensors" -o "$logs/$(printf '%04d' "$count").mpack" >/dev/null 2>&1
      count=$((count + 1))
    done
  done
done
"$program" fit "$logs"/*.mpack --estimator evidence_curves --servo-load --robot upkie \
  --no-accuracy -o "$logs/fit.npz"
at_point() { # leave_below return_above settle_at settle_after model
  "$program" export "$logs/fit.npz" --set leave_below="$1" --set return_above="$2" --set settle_at="$3" \
    --set settle_after="$4" -o "$5"
}
at_point "${balanced_point[@]}" "$output"
at_point "${quiet_point[@]}" "$quiet"

words() { printf '"%s", ' "$@" | sed 's/, $//'; }
describe() { # model, operating point
  cat >"${1%.npz}.json" <<END
{
  "model": "evidence_curves",
  "operating_point": "$2",
  "command": "scripts/fit_shipped_model.sh build/release/touchdown models/evidence_curves.npz",
  "sha256": "$(sha256sum "$1" | cut -d' ' -f1)",
  "scenes": "drawn from all families",
  "robots": [$(words "${robots[@]}")],
  "sensors": "$sensors",
  "simulators": [$(words "${simulators[@]}")],
  "seed": $seed,
  "runs": $count,
  "version": "$("$program" --version)"
}
END
}
describe "$output" balanced
describe "$quiet" quiet
