#!/bin/bash
# Runs every fuzzer in turn and reports its number of executions and its findings.
# Usage: scripts/fuzz.sh BUILD_FOLDER MINUTES [FUZZER...]
# Findings are in BUILD_FOLDER/found/FUZZER. Add one to the tests by minimising it with
# `fuzz_FUZZER -minimize_crash=1` and copying it to tests/fuzz/corpus/FUZZER, which every test run replays.
set -u
if ! [[ ${2:-} =~ ^[1-9][0-9]*$ ]]; then
  echo "MINUTES: expected a whole number from 1, found '${2:-}'" >&2
  exit 2
fi
build=$1
seconds=$(($2 * 60))
shift 2
cd "$(dirname "$0")/.." || exit 2
fuzzers=("$@")
if [[ ${#fuzzers[@]} == 0 ]]; then
  for program in "$build"/fuzz_*; do fuzzers+=("$(basename "$program" | cut -c6-)"); done
fi
status=0
for name in "${fuzzers[@]}"; do
  found="$build/found/$name"
  mkdir -p "$found/corpus"
  log="$found/log"
  nice "$build/fuzz_$name" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 \
    -max_len=16384 -print_final_stats=1 -artifact_prefix="$found/" \
    "$found/corpus" "tests/fuzz/corpus/$name" >"$log" 2>&1
  code=$?
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  if [[ $code == 0 ]]; then
    echo "$name: ${executions:-0} executions, no crash"
  else
    echo "$name: ${executions:-0} executions, a crash: $(grep -m1 -o 'SUMMARY: .*' "$log" || tail -1 "$log") (see $log)"
    status=1
  fi
done
exit $status
