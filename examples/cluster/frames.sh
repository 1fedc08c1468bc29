#!/bin/bash
#SBATCH --array=1-4 --ntasks=1 --cpus-per-task=1 --requeue --output=frame-%a.log
# sbatch --array=1-240 frames.sh [OPTION]…: the models frames/0001.bez … become meshes/0001.ply …,
# one task a frame. Options are those of simdbezier tessellate.
frame=$(printf '%04d' "$SLURM_ARRAY_TASK_ID")
mkdir -p meshes
# A mesh appears complete or not at all, so that one that is there needs no second run: submit the
# array again after a fault, and only what is missing is made.
[[ -e meshes/$frame.ply ]] && exit
exec simdbezier tessellate "frames/$frame.bez" -o "meshes/$frame.ply" \
  --threads="${SLURM_CPUS_PER_TASK:-1}" "$@"
