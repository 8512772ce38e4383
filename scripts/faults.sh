#!/bin/bash
# Lets each system call of the program fail, kills it in every stage, and reports the results. The tests
# do so with some calls; this takes minutes.
# Usage: scripts/faults.sh TEST_PROGRAM JOBS
set -u
export TOUCHDOWN_ALL_FAULTS=1 GTEST_TOTAL_SHARDS=$2 GTEST_BRIEF=1
shards=()
for ((shard = 0; shard < $2; ++shard)); do
  GTEST_SHARD_INDEX=$shard "$1" &
  shards+=($!)
done
status=0
for shard in "${shards[@]}"; do wait "$shard" || status=1; done
exit $status
