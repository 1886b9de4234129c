#!/bin/bash
# A Slurm of this one machine, from Debian's packages, without systemd or anything in /etc:
#     one_node_slurm.sh run COMMAND...   start in a temporary folder, run the command, stop
#     one_node_slurm.sh start DIR        start; configuration, state and logs are in DIR
#     one_node_slurm.sh stop DIR         stop it
# Slurm's commands find it by SLURM_CONF=DIR/slurm.conf, which `run` sets. For trials: memory limits
# of jobs are booked but not enforced, and there is no accounting.
set -euo pipefail

usage() {
  sed -n '3,5s/^#     /  /p' "$0" >&2
  exit 2
}

install_packages() {
  local packages=(slurm-wlm munge) as_root=()
  command -v snakemake >/dev/null || packages+=(snakemake)
  dpkg --status "${packages[@]}" >/dev/null 2>&1 && return
  [[ $EUID -eq 0 ]] || as_root=(sudo)
  "${as_root[@]}" apt-get update -q
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -q -y --no-install-recommends "${packages[@]}"
}

configure() {
  local dir=$1 node user memory ports
  node=$(hostname -s)
  user=$(id -un)
  memory=$(awk '/^MemTotal/ { print int($2 / 1024 * 0.9) }' /proc/meminfo)
  # Free ports, since a Slurm may be here already.
  read -r -a ports < <(/usr/bin/python3 -c 'import socket
s = [socket.socket() for _ in range(2)]
for one in s: one.bind(("127.0.0.1", 0))
print(*(one.getsockname()[1] for one in s))')
  mkdir -p "$dir/state" "$dir/spool"
  cat >"$dir/slurm.conf" <<END
ClusterName=one_node
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=${ports[0]}
SlurmdPort=${ports[1]}
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$dir/munge.socket
CredType=cred/munge
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd.pid
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/slurmd.log
# A container has no control groups to give away.
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SchedulerParameters=batch_sched_delay=1
SlurmdParameters=config_overrides
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$memory
PartitionName=main Nodes=$node Default=YES MaxTime=INFINITE
END
  echo "CgroupPlugin=cgroup/v1" >"$dir/cgroup.conf" # loaded in any case; v2 would ask for systemd
}

start() {
  local dir=$1
  mkdir -p "$dir"
  chmod 755 "$dir" # munged refuses a socket that others cannot reach
  dir=$(cd "$dir" && pwd)
  [[ ! -e $dir/slurm.conf ]] || { echo "$dir: has a Slurm already [hint: stop it]" >&2; return 1; }
  configure "$dir"
  export SLURM_CONF=$dir/slurm.conf

  (umask 077 && head -c 1024 /dev/urandom >"$dir/munge.key")
  if munged --key-file="$dir/munge.key" --socket="$dir/munge.socket" --seed-file="$dir/munge.seed" \
    --pid-file="$dir/munged.pid" --log-file="$dir/munged.log" &&
    slurmctld && slurmd && wait_until 60 is_idle; then
    return
  fi
  echo "$dir: Slurm does not start:" >&2
  tail -n 5 "$dir"/*.log >&2 || true
  stop "$dir"
  return 1
}

is_idle() { [[ $(sinfo --noheader --format=%t 2>/dev/null) == idle ]]; }
is_empty() { [[ -z $(squeue --noheader 2>/dev/null) ]]; }
is_gone() { ! kill -0 "$1" 2>/dev/null; }

# wait_until SECONDS COMMAND...
wait_until() {
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    [[ $SECONDS -lt $end ]] || return 1
    sleep 0.2
  done
}

stop() {
  local dir daemon pid
  dir=$(cd "$1" && pwd)
  export SLURM_CONF=$dir/slurm.conf
  if scancel --user="$(id -un)" 2>/dev/null; then
    wait_until 20 is_empty || true
  fi
  for daemon in slurmd slurmctld munged; do
    pid=$(cat "$dir/$daemon.pid" 2>/dev/null) || continue
    kill "$pid" 2>/dev/null || true
    wait_until 20 is_gone "$pid" || kill -KILL "$pid" || true
  done
  rm -rf "$dir/slurm.conf" "$dir/state" "$dir/spool" "$dir"/*.pid
}

PATH=$PATH:/usr/sbin
[[ $# -ge 2 ]] || usage
case $1 in
  start)
    install_packages
    start "$2"
    ;;
  stop) stop "$2" ;;
  run)
    install_packages
    dir=$(mktemp -d)
    trap 'stop "$dir"; rm -rf "$dir"' EXIT
    start "$dir"
    shift
    SLURM_CONF=$dir/slurm.conf "$@"
    ;;
  *) usage ;;
esac
