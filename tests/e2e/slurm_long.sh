#!/usr/bin/env bash
# examples/farm/slurm_array.sh on a real Slurm of one node, started here and ended here: 24 frames over 4
# tasks, one task cancelled in the middle and requeued; at the end 24 right frames.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/frames.sh"
skip() { echo "slurm_long.sh: skipped: $1"; exit 0; }
[ "$(id -u)" -eq 0 ] || skip "starting Slurm's daemons needs root"
.ci/ensure_packages farm || skip "Slurm cannot be installed here"

host=$(hostname -s)
cat >"$work/slurm.conf" <<CONF
ClusterName=kagefude
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=16817
SlurmdPort=16818
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ReturnToService=2
KillWait=5
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
CONF
export SLURM_CONF=$work/slurm.conf
mkdir -p "$work/state" "$work/spool" "$work/munge"
chmod 755 "$work" "$work/munge"
head -c 1024 /dev/urandom >"$work/munge/key"
chmod 600 "$work/munge/key"
daemons=()
end_daemons() {
  for process in "${daemons[@]}"; do kill "$process" 2>/dev/null || true; done
  for process in "${daemons[@]}"; do wait "$process" 2>/dev/null || true; done
  finish
}
trap end_daemons EXIT
munged --foreground --force --socket="$work/munge/socket" --key-file="$work/munge/key" \
  --pid-file="$work/munge/pid" --log-file="$work/munge/log" --seed-file="$work/munge/seed" >/dev/null 2>&1 &
daemons+=($!)
for _ in $(seq 50); do [ -S "$work/munge/socket" ] && break; sleep 0.1; done
slurmctld -D -c >/dev/null 2>&1 &
daemons+=($!)
slurmd -D -N "$host" -f "$work/slurm.conf" >/dev/null 2>&1 &
daemons+=($!)
for _ in $(seq 150); do
  [ "$(sinfo -h -o %T 2>/dev/null)" = idle ] && break
  sleep 0.2
done
[ "$(sinfo -h -o %T 2>/dev/null)" = idle ] ||
  skip "Slurm does not come up here: $(tail -n 2 "$work/slurmctld.log" "$work/slurmd.log" 2>&1 | tr '\n' ' ')"

# Frames that take long enough for a task to be caught in the middle.
mkdir "$work/in" "$work/out"
cp "$data/shot.Key.depth.0001.exr" "$work/in/"
command=(oiiotool "$data/shot.0001.exr")
for i in $(seq 24); do
  name=$(printf 'shot.%04d' "$i")
  command+=(--dup --cut "160x90+$((4 * i))+$((2 * i))" --resample 800x450 -o "$work/in/$name.exr" --pop)
  sed "s/shot.0001.exr/$name.exr/; s/\"frame\": 1,/\"frame\": $i,/" "$data/shot.0001.json" >"$work/in/$name.json"
done
"${command[@]}"
echo >"$work/look.toml"
"$kagefude" comp "$work/look.toml" "$work/in/shot.####.exr" -o "$work/whole/shot.####.exr" --progress none

export KAGEFUDE=$kagefude
job=$(sbatch --parsable --array=1-4 --cpus-per-task=1 --output="$work/task-%a.log" --chdir="$PWD" examples/farm/slurm_array.sh \
  "$work/look.toml" "$work/in/shot.####.exr" "$work/out/shot.####.exr" 1-24)
echo "array job $job"
caught=
for _ in $(seq 600); do
  made=$(find "$work/out" -name 'shot.000[1-6].exr' 2>/dev/null | wc -l)
  if [ "$made" -ge 1 ] && [ "$made" -le 4 ]; then
    scontrol requeue "${job}_1"
    caught=$made
    break
  fi
  [ "$made" -lt 5 ] || break
  sleep 0.05
done
check "the first task was not caught in the middle" test -n "$caught"
echo "the first task is cancelled and requeued after $caught of its 6 frames"
sleep 1
for _ in $(seq 300); do
  # Slurm would hold a requeued task back for two minutes.
  scontrol update "jobid=${job}_1" StartTime=now 2>/dev/null || true
  [ -n "$(squeue -h -j "$job" 2>/dev/null)" ] || break
  sleep 0.3
done
check "the array has not ended: $(squeue 2>&1)" test -z "$(squeue -h -j "$job" 2>/dev/null)"
check "the requeued task kept nothing: $(cat "$work/task-1.log")" grep -q 'kept' "$work/task-1.log"
check "24 right frames" same_files "$work/whole" "$work/out"
tail -qn 1 "$work"/task-*.log
summary
