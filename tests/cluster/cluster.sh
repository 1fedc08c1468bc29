#!/usr/bin/env bash
# cluster.sh PROGRAMS FOLDER: simdbezier and simdbezier-mpi from the folder PROGRAMS under a real
# Slurm, whose three nodes this machine plays. As root. docs/guide/clusters.md has the same scripts.
set -euo pipefail
here=$(dirname "$(realpath "$0")")
examples=$(realpath "$here/../../examples/cluster")
export PATH
PATH=$(realpath "$1"):$PATH
folder=$(realpath -m "$2")
rm -rf "$folder"
mkdir -p "$folder/work"
cd "$folder/work"
slurm=$folder/slurm
export SLURM_CONF=$slurm/slurm.conf
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1

finish() {
  "$here/slurm.sh" stop "$slurm" || true
  mountpoint -q "$folder/full" && umount "$folder/full"
  return 0
}
trap finish EXIT
"$here/slurm.sh" start "$slurm" 3

check() { # WHAT COMMAND…
  local what=$1
  shift
  if "$@"; then echo "ok    $what"; else echo "FAILED $what: $*" >&2; exit 1; fi
}
absent() { local name; for name in "$@"; do [[ ! -e $name ]] || return 1; done; }
wait_for() { # SECONDS COMMAND…
  local end=$((SECONDS + $1))
  shift
  until "$@"; do (( SECONDS < end )) || return 1; sleep 0.2; done
}
is_over() { [[ -z $(squeue -h -j "$1" 2>/dev/null) ]]; }

# A sheet of N x N patches, scattered in the file, higher with each frame.
sheet() { # N FRAME
  awk -v n="$1" -v frame="$2" 'BEGIN { print n * n
    for (k = 0; k < n * n; ++k) { at = k * 2531 % (n * n)
      for (p = 0; p < 16; ++p) { x = 3 * (at % n) + p % 4; y = 3 * int(at / n) + int(p / 4)
        print x, y, frame * (x * 37 + y * 101) % 64 / 16 } } }'
}
sheet 64 1 >model.bez
simdbezier convert model.bez --sort -o model.sbp
options=(--relative 1e-5 --crease 30)
simdbezier tessellate model.sbp "${options[@]}" -o whole.ply

# An array of shards, and the mesh when all of them are there.
cat >shards.sh <<'SCRIPT'
#!/bin/bash
#SBATCH --array=1-6 --ntasks=1 --cpus-per-task=1 --requeue --output=shards-%a.log
echo "$$ $PPID" >"pids-$SLURM_ARRAY_TASK_ID"
[[ -e slow ]] && sleep 5
exec simdbezier tessellate model.sbp "$@" --threads="$SLURM_CPUS_PER_TASK" --shard=slurm/6
SCRIPT
array() { # OUT
  local job
  job=$(sbatch --parsable shards.sh "${options[@]}" -o "$1")
  sbatch --parsable --dependency=afterok:"$job" --kill-on-invalid-dep=yes --output=join.log \
    --wrap="simdbezier join -o $1 --shards 6"
}
job=$(array array.ply)
check "an array of shards ends" wait_for 90 is_over "$job"
check "an array of shards makes the program's bytes" cmp whole.ply array.ply

# A sequence of frames; of those that are there, none is made again.
mkdir frames
for k in 1 2 3 4; do sheet 16 "$k" >"frames/000$k.bez"; done
job=$(sbatch --parsable "$examples/frames.sh" --grid 5)
check "an array of frames ends" wait_for 120 is_over "$job"
for k in 1 2 3 4; do
  simdbezier tessellate "frames/000$k.bez" --grid 5 -o frame.ply
  check "frame $k has the program's bytes" cmp frame.ply "meshes/000$k.ply"
done
rm meshes/0002.ply
stat -c '%n %y' meshes/* >before
job=$(sbatch --parsable "$examples/frames.sh" --grid 5)
check "the array of frames ends again" wait_for 120 is_over "$job"
check "the frame that was missing is there" test -s meshes/0002.ply
check "no other frame was made again" diff before <(stat -c '%n %y' meshes/000[134].ply)

# A job whose time is nearly over is queued again, and goes on where it was.
job=$(sbatch --parsable "$examples/requeue.sh" model.sbp requeued.ply 12 --grid 40)
check "the first part is there" wait_for 120 test -e requeued.ply.shard-1-of-12
scancel --signal=USR1 --batch "$job"
check "a job that was queued again ends" wait_for 300 is_over "$job"
check "it was queued again" test "$(grep -c '^starts' requeue.log)" -eq 2
check "it did not make a part twice" grep -q 'shard-1-of-12 is there already' requeue.log
simdbezier tessellate model.sbp --grid 40 -o once.ply
check "it makes the program's bytes" cmp once.ply requeued.ply
check "and leaves no parts" test -z "$(find . -name '*requeued.ply.*')"

# Ranks of mpirun within an allocation, and of srun where Slurm and Open MPI know PMIx.
cat >ranks.sh <<'SCRIPT'
#!/bin/bash
#SBATCH --nodes=1 --ntasks=3 --cpus-per-task=1 --output=ranks.log
export OMP_NUM_THREADS=$SLURM_CPUS_PER_TASK
exec mpirun --bind-to none simdbezier-mpi tessellate model.sbp "$@"
SCRIPT
job=$(sbatch --parsable ranks.sh "${options[@]}" -o mpirun.ply --shard-patches 700)
check "ranks of mpirun end" wait_for 90 is_over "$job"
check "ranks of mpirun make the program's bytes" cmp whole.ply mpirun.ply
if srun --mpi=pmix -n 2 true 2>/dev/null; then
  check "ranks of srun run" timeout 90 srun --mpi=pmix -N 3 -n 3 \
    simdbezier-mpi tessellate model.sbp "${options[@]}" -o srun.ply
  check "ranks of srun make the program's bytes" cmp whole.ply srun.ply
else
  echo "skipped: srun knows no PMIx"
fi

# A node is lost while its shards run: they are queued again, and what was done is not done twice.
touch slow
job=$(array lost.ply)
check "shards have begun" wait_for 30 test -e pids-1 -a -e pids-6
sleep 1
"$here/slurm.sh" lose "$slurm" n0
for pids in pids-*; do
  read -r task daemon <"$pids"
  if ls -l /proc/"$daemon"/fd 2>/dev/null | grep -q 'slurmd-n0.log\|spool-n0'; then
    kill -KILL "$daemon" "$task" 2>/dev/null || true # a daemon that lives on reports the task
  fi
done
rm -f slow
check "what is left of the array ends" wait_for 180 is_over "$job"
if [[ ! -e lost.ply ]]; then # shards that Slurm took for failed rather than lost
  stat -c '%n %Y' lost.ply.shard-* >before 2>/dev/null || true
  job=$(array lost.ply)
  check "the array runs again" wait_for 180 is_over "$job"
  while read -r name time; do
    check "$name was not made twice" test "$(stat -c %Y "$name")" = "$time"
  done <before
fi
check "the mesh is whole after a node was lost" cmp whole.ply lost.ply

# A shard is killed while it writes: the next run removes what it left.
shard=(simdbezier tessellate model.sbp --grid 60 --shard 1/2 -o part.ply)
left() { [[ -n $(find . -maxdepth 1 -name '.part.ply.shard-1-of-2.simdbezier-*.tmp' -size +1M) ]]; }
"${shard[@]}" &
check "a shard writes" wait_for 60 left
kill -KILL $!
wait $! 2>/dev/null || true
check "a killed shard leaves no part" absent part.ply.shard-1-of-2
check "a killed shard leaves what it wrote" left
check "the shard again" "${shard[@]}"
check "the shard is there" test -s part.ply.shard-1-of-2
check "nothing else is left of it" test -z "$(find . -name '.part.ply*')"
rm part.ply.shard-1-of-2

# A rank is killed while it writes: there is no mesh, and the next run removes what it left.
ranks=(mpirun --oversubscribe --bind-to none -n 3 simdbezier-mpi tessellate model.sbp --grid 60)
"${ranks[@]}" -o killed.ply 2>killed.log &
check "ranks write" wait_for 60 test -e .killed.ply.simdbezier-mpi.tmp
for rank in $(pgrep -P $!); do kill -KILL "$rank" 2>/dev/null && break; done
code=0
wait $! || code=$?
check "a killed rank is a failure" test "$code" -ne 0
check "a killed rank leaves no mesh" absent killed.ply
check "the next run" "${ranks[@]}" -o killed.ply
simdbezier tessellate model.sbp --grid 60 -o once.ply
check "the next run makes the program's bytes" cmp once.ply killed.ply
check "nothing is left" absent .killed.ply.simdbezier-mpi.tmp

# A full disk.
mkdir "$folder/full"
if mount -t tmpfs -o size=2m tmpfs "$folder/full" 2>/dev/null; then
  for out in out.ply out.hdf; do
    code=0
    "${ranks[@]}" -o "$folder/full/$out" 2>full.log || code=$?
    check "a full disk is a failure for $out" test "$code" -eq 1
    check "a full disk has its message for $out" grep -q "expected room" full.log
  done
  code=0
  simdbezier tessellate model.sbp --grid 60 --shard 1/2 -o "$folder/full/out.ply" 2>full.log || code=$?
  check "a full disk is a failure for a shard" test "$code" -eq 1
  check "a full disk has its message for a shard" grep -q "expected room" full.log
  check "nothing is left on it" test -z "$(ls -A "$folder/full")"
else
  echo "skipped: no tmpfs can be mounted"
fi
echo "cluster: all is well"
