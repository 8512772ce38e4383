#!/bin/bash
# Chooses the hyperparameters of experiments/benchmark.yaml: scripts/tune_benchmark.sh PROGRAM [FOLDER]
#
# Runs the tuning of experiments/benchmark_full.yaml alone, about five minutes of processor time, and copies its
# choices to experiments/hyperparameters/benchmark.yaml. `load_filter` keeps its constants, because they are one
# choice for all robots. FOLDER keeps the run, which resumes there.
set -euo pipefail

program=$(realpath "${1:?the program touchdown}")
cd "$(dirname "$0")/.."
run=${2:-$(mktemp -d)/tuning}
"$program" run experiments/benchmark_full.yaml --out "$run" --no-pictures \
  --set 'estimators=[robust,measurement_only,paper,free_fall,upkie_observer,nmn,nmn_retrained]' \
  --set 'benchmark={}' \
  --set 'test.scenarios=[scenarios/kerb.yaml]' --set test.runs=1
{
  echo "# Hyperparameters of experiments/benchmark.yaml, by engine: the best of every estimator's trials in cross-validation."
  echo "# Made by scripts/tune_benchmark.sh. Estimators without an entry keep their defaults."
  grep -v '^#' "$run/tables/hyperparameters.yaml"
} > experiments/hyperparameters/benchmark.yaml
