#!/bin/bash
#SBATCH --ntasks=1 --cpus-per-task=1 --time=1:00:00 --requeue --signal=B:USR1@60
#SBATCH --open-mode=append --output=requeue.log
# sbatch requeue.sh MODEL OUT SHARDS [OPTION]…: one mesh, in parts, by a job that may need more time
# than it gets. A minute before its time is over, Slurm sends it USR1, and it asks to be queued
# again. Parts that are there are not made again. Options are those of simdbezier tessellate.
model=$1 out=$2 shards=$3
shift 3
trap 'scontrol requeue "$SLURM_JOB_ID"; exit 1' USR1
echo "starts for the $((${SLURM_RESTART_COUNT:-0} + 1)). time"
for (( shard = 1; shard <= shards; ++shard )); do
  simdbezier tessellate "$model" -o "$out" --shard "$shard/$shards" \
    --threads="${SLURM_CPUS_PER_TASK:-1}" "$@" &
  wait $! || exit # a signal is handled during `wait`, and not while a command is in the foreground
done
exec simdbezier join -o "$out" --shards "$shards" --remove-parts
