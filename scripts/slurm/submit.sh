#!/usr/bin/env bash
# scripts/slurm/submit.sh EXPERIMENT SHARDS [SBATCH OPTION...]
# Runs an experiment on a Slurm cluster: an array job of SHARDS tasks, and a job that makes
# the results when all are done. Call it in the folder for the results, on a file system that all nodes
# share. TOUCHDOWN_PROGRAM names the program if it is not this checkout's. See docs/guides/shards.md.
set -euo pipefail

complain() {
  echo "touchdown: submit: $1" >&2
  exit "${2:-2}"
}

here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
task="$here/task.sh"
checkout="$(dirname "$(dirname "$here")")"

(($# >= 2)) || complain "expected EXPERIMENT SHARDS [SBATCH OPTION...], for example experiments/noise_study.yaml 8"
experiment="$1"
shards="$2"
shift 2
[[ "$shards" =~ ^[1-9][0-9]{0,4}$ ]] || complain "'$shards' is no number of shards: expected 1 to 99999"
command -v sbatch >/dev/null || complain "no sbatch here: call this where Slurm's commands are installed" 1

if [[ -n "${TOUCHDOWN_PROGRAM:-}" ]]; then
  program="$TOUCHDOWN_PROGRAM"
elif [[ -x "$checkout/build/release/touchdown" ]]; then
  program="$checkout/build/release/touchdown"
else
  program="$(command -v touchdown || true)"
fi
[[ -n "$program" && -x "$program" ]] ||
  complain "no program ${program:-$checkout/build/release/touchdown}: build it first, with 'make build'" 1
program="$(realpath "$program")"

# A dry run here reports errors of the experiment once, instead of in every task.
plan="$("$program" run "$experiment" --dry-run)" || exit $?
directory="$(sed -n 's/^results *//p' <<<"$plan")"
parts="$(sed -n 's/^parts *//p' <<<"$plan")"
if ((shards > 1 && parts < 8 * shards)); then
  echo "touchdown: submit: $shards shards of $parts parts: starting a task may take longer than its work" >&2
fi

mkdir -p "$directory/logs"
log="$directory/logs/%x_%A_%a.txt"
array="$(sbatch --parsable --output="$log" --job-name="shard" "$@" --array="1-$shards" \
  "$task" shard "$program" "$experiment" "$shards")" || exit $?
array="${array%%;*}" # the name of a cluster may follow
results="$(sbatch --parsable --output="$directory/logs/%x_%j.txt" --job-name="results" "$@" \
  --dependency="afterok:$array" --kill-on-invalid-dep=yes "$task" results "$program" "$directory")" ||
  complain "the shards are job $array; when they are done: touchdown run $directory" 1
results="${results%%;*}"

echo "array     $array: $shards tasks, $((parts / shards)) to $(((parts + shards - 1) / shards)) of $parts parts each"
echo "last      $results: when all of them are done"
echo "results   $directory"
