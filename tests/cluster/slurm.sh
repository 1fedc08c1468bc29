#!/usr/bin/env bash
# A Slurm of its own on this machine, whose nodes are played by several slurmd. For tests, as root.
#
#   slurm.sh start FOLDER [NODES]   then: export SLURM_CONF=FOLDER/slurm.conf
#   slurm.sh lose FOLDER NODE       the node's daemon ends at once, as in a crash
#   slurm.sh stop FOLDER
#
# All that it makes is in FOLDER, and it ends only what FOLDER/run/*.pid names. Sockets listen on
# 127.0.0.1 only.
set -euo pipefail
what=$1 folder=$(realpath -m "$2")
export SLURM_CONF=$folder/slurm.conf

# wait_for SECONDS COMMAND…
wait_for() {
  local end=$((SECONDS + $1))
  shift
  until "$@" >/dev/null 2>&1; do
    (( SECONDS < end )) || { echo "slurm.sh: expected success within time of: $*" >&2; exit 1; }
    sleep 0.2
  done
}

# end_daemon PID_FILE [SIGNAL]
end_daemon() {
  [[ -s $1 ]] || return 0
  local pid
  pid=$(<"$1")
  kill "${2:--TERM}" "$pid" 2>/dev/null || true
  for (( k = 0; k < 50; ++k )); do kill -0 "$pid" 2>/dev/null || break; sleep 0.1; done
  rm -f "$1"
}

configure() {
  local host node
  host=$(hostname)
  cat <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=16917
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
AuthType=auth/munge
AuthInfo=socket=$folder/run/munge.socket,cred_expire=30
CredType=cred/munge
SlurmUser=root
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool-%n
TmpFS=$folder/tmp-%n
SlurmctldPidFile=$folder/run/slurmctld.pid
SlurmdPidFile=$folder/run/slurmd-%n.pid
SlurmctldLogFile=$folder/log/slurmctld.log
SlurmdLogFile=$folder/log/slurmd-%n.log
MailProg=/bin/true
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
SlurmdParameters=config_overrides
SlurmctldParameters=node_reg_mem_percent=1
ReturnToService=2
SlurmdTimeout=10
KillWait=5
SchedulerParameters=sched_min_interval=100000,bf_interval=1
CONF
  for (( node = 0; node < $1; ++node )); do
    echo "NodeName=n$node NodeHostname=$host NodeAddr=127.0.0.1 Port=$((16920 + node)) CPUs=4" \
      "SocketsPerBoard=1 CoresPerSocket=4 ThreadsPerCore=1 RealMemory=1000 State=UNKNOWN"
  done
  echo "PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP"
}

start() {
  local node
  mkdir -p "$folder"/{run,log,state,secret}
  chmod 755 "$folder" "$folder/run" # munged wants its socket's folder to be open to others
  chmod 700 "$folder/secret" "$folder/state"
  (umask 077; head -c 128 /dev/urandom >"$folder/secret/key")
  configure "$1" >"$SLURM_CONF"
  munged --key-file="$folder/secret/key" --socket="$folder/run/munge.socket" \
    --pid-file="$folder/run/munged.pid" --log-file="$folder/log/munged.log" \
    --seed-file="$folder/secret/seed" --num-threads=1
  slurmctld -c
  wait_for 20 scontrol ping
  for (( node = 0; node < $1; ++node )); do
    mkdir -p "$folder/spool-n$node" "$folder/tmp-n$node"
    slurmd -N "n$node"
  done
  wait_for 60 srun -N "$1" -n "$1" true
}

case $what in
  start) start "${3:-3}" ;;
  lose) end_daemon "$folder/run/slurmd-$3.pid" -KILL ;;
  stop)
    scancel --user=root 2>/dev/null || true
    for (( k = 0; k < 50; ++k )); do [[ -z $(squeue -h 2>/dev/null) ]] && break; sleep 0.2; done
    for pid in "$folder"/run/slurmd-*.pid; do end_daemon "$pid"; done
    end_daemon "$folder/run/slurmctld.pid"
    end_daemon "$folder/run/munged.pid"
    ;;
  *) echo "slurm.sh: expected start, lose or stop, found $what" >&2; exit 2 ;;
esac
