#!/usr/bin/env bash
# submit.sh submits this: one task of the array, or the results.
#   task.sh shard PROGRAM EXPERIMENT SHARDS
#   task.sh results PROGRAM DIRECTORY
# A task that Slurm requeues, because it was preempted or its node failed, continues from its saved
# parts. A task requeues itself if its program is killed or its time runs out.
#SBATCH --cpus-per-task=4
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:USR1@60
set -u

# Limits for tasks that are killed repeatedly, or make no progress in their time.
most_kills=3
most_restarts=100

what="$1"
program="$2"
if [[ "$what" == shard ]]; then
  job="${SLURM_ARRAY_JOB_ID}_${SLURM_ARRAY_TASK_ID}"
  command=(run "$3" --shard "$SLURM_ARRAY_TASK_ID/$4" --set "workers=${SLURM_CPUS_PER_TASK:-0}")
else
  job="$SLURM_JOB_ID"
  command=(run "$3")
fi
restarts="${SLURM_RESTART_COUNT:-0}"

to_the_queue() {
  echo "touchdown: job $job: $1; back to the queue after $restarts restarts" >&2
  scontrol requeue "$job" && sleep 600 # ended by Slurm
}

out_of_time=
# The program stops within a second, after it has saved its finished parts.
trap 'out_of_time=yes; kill -TERM "$child" 2>/dev/null' USR1
"$program" "${command[@]}" &
child=$!
wait "$child"
status=$?
while kill -0 "$child" 2>/dev/null; do # the trap ended the wait
  wait "$child"
  status=$?
done

if [[ -n "$out_of_time" ]]; then
  ((status == 0 || restarts >= most_restarts)) || to_the_queue "out of time"
elif ((status > 128 && restarts < most_kills)); then
  to_the_queue "killed by signal $((status - 128))"
fi
exit "$status"
