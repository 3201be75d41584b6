#!/bin/bash
# triaxial/slurm/campaign.sbatch in a real Slurm: one node, started here under a temporary folder by
# whoever runs this, ended with it. Of an array of three tasks
#   1 finds its shard taken by another process, which ends after a while,
#   2 is requeued in the middle of its runs,
#   3 is killed in the middle of its runs and submitted again alone;
# the results are those of one process without Slurm. Exit code 77: Slurm is not installed.
#
# usage: run_array.sh PROGRAM
set -euo pipefail
PATH=$PATH:/usr/sbin:/sbin
program=$(realpath "$1")
script=$(realpath "$(dirname "$0")/../../triaxial/slurm/campaign.sbatch")
realizations=60 # of two cases: some three seconds a task

for command in slurmctld slurmd sbatch scontrol squeue sinfo flock; do
    command -v $command >/dev/null && continue
    echo "not run: no $command (apt-get install slurmctld slurmd slurm-client)"
    exit 77
done

place=$(mktemp -d "${TMPDIR:-/tmp}/grainfield-slurm.XXXXXX")
unset "${!SLURM@}" "${!SBATCH@}" "${!GRAINFIELD@}" # of a user of another Slurm
export SLURM_CONF=$place/slurm.conf
cd "$place"

# Ends all that this test started, first the daemons: it has the folder in its environment.
clean_up() {
    for _ in 1 2; do
        for environment in /proc/[0-9]*/environ; do
            process=${environment//[!0-9]/}
            [ "$process" != $$ ] || continue
            grep -qas "SLURM_CONF=$place/" "$environment" || continue
            kill -KILL "$process" || true
        done
        wait
    done 2>/dev/null
    cd / && rm -rf "$place"
}
trap clean_up EXIT
trap 'exit 1' HUP INT TERM

fail() {
    set +e
    echo "FAILED: $*"
    squeue
    tail -n 20 slurmctld.log slurmd.log ./*.err campaign-*.log
    exit 1
} 2>&1

# wait_until SECONDS WHAT COMMAND...: until the command succeeds.
wait_until() {
    local end=$((SECONDS + $1)) what=$2
    shift 2
    until "$@"; do
        [ $SECONDS -lt $end ] || fail "in vain for $what"
        sleep 0.05
    done
}

start_slurm() {
    local port=$((20000 + $$ % 10000)) name
    name=$(uname -n)
    name=${name%%.*}
    while (: >/dev/tcp/127.0.0.1/$port) 2>/dev/null ||
        (: >/dev/tcp/127.0.0.1/$((port + 1))) 2>/dev/null; do
        port=$((port + 2))
    done
    mkdir state spool
    # As many CPUs as there are tasks, whatever the machine has. A requeued task waits until its old
    # credential has expired and the scheduler looks again: seconds here, two minutes by default.
    cat >slurm.conf <<END
ClusterName=test
SlurmctldHost=$name(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/none
CredType=cred/none
AuthInfo=cred_expire=5
StateSaveLocation=$place/state
SlurmdSpoolDir=$place/spool
SlurmctldPidFile=$place/slurmctld.pid
SlurmdPidFile=$place/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=1
SlurmdParameters=config_overrides
ReturnToService=2
NodeName=$name NodeAddr=127.0.0.1 CPUs=3 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP
END
    slurmctld -D >slurmctld.log 2>&1 &
    slurmd -D >slurmd.log 2>&1 &
    wait_until 30 'a node that is idle' node_is idle
}
node_is() { [ "$(sinfo --noheader --format %t 2>/dev/null)" = "$1" ]; }

# A campaign on 432 spheres, a disordered lattice.
write_campaign() {
    awk 'BEGIN {
        srand(7)
        print "x,y,z,radius"
        d = 0.05
        for (i = 0; i < 6; ++i) for (j = 0; j < 12; ++j) for (k = 0; k < 6; ++k) {
            r = d * (0.40 + 0.06 * rand())
            room = d / 2 - r
            printf "%.9f,%.9f,%.9f,%.9f\n", (i + 0.5) * d + room * (2 * rand() - 1),
                (j + 0.5) * d + room * (2 * rand() - 1), (k + 0.5) * d + room * (2 * rand() - 1), r
        }
    }' >spheres.csv
    cat >campaign.toml <<END
[packing]
blocks = [2, 4, 2]
block = [0.15, 0.15, 0.15]
[field]
variable = "stiffness"
[triaxial]
max_axial_strain = 0.015 # about where the peak is
[montecarlo]
realizations = $realizations
[montecarlo.sweep]
"field.stiffness.cov" = [0.4, 0.8]
END
}

# run FOLDER OPTIONS...: the campaign without Slurm.
run() {
    exec "$program" montecarlo campaign.toml --out "$1" --threads 1 --packing spheres.csv "${@:2}"
}
# submit ARRAY: an array of tasks; prints the number of the job.
submit() {
    GRAINFIELD=$program sbatch --parsable --array="$1" --cpus-per-task=1 \
        "$script" campaign.toml shared --packing spheres.csv
}
rows() { wc -l <"shared/rows-$1-of-3.journal"; }
has_rows() { [ -e "shared/rows-$1-of-3.journal" ] && [ "$(rows "$1")" -ge 2 ]; }
# The process that holds a shard.
holder() { sed 's/process \([0-9]*\) on .*/\1/' "shared/shard-$1-of-3.lock"; }
# state_is TASK STATE: as the queue shows it; a task that has ended has none.
state_is() { state=$(squeue --noheader --jobs "$1" --format %T) && [ "$state" = "$2" ]; }
queue_is_empty() { queue=$(squeue --noheader) && [ -z "$queue" ]; }
log_says() { grep -qs "$2" "campaign-$1.log"; }
# job_has JOB TEXT: what Slurm knows of a task.
job_has() { scontrol show job "$1" | grep -q "\<$2\>" || fail "task $1 is not $2"; }
# results FOLDER FILE: without the wall times.
results() { cut -d, -f1-9,11- "$1/$2"; }

write_campaign
(run whole) >whole.err 2>&1 || fail 'the campaign without Slurm'
all=$(wc -l <whole/rows-1-of-1.journal)
[ "$(wc -l <whole/results.csv)" -eq $((1 + 2 * realizations)) ] || fail 'rows are missing: whole'
start_slurm

# A process that keeps shard 1, as on another node would the one that a requeued task left there.
(run shared --shard 1/3) >old.err 2>&1 &
old=$!
wait_until 20 'rows of the process outside' has_rows 1
kill -STOP $old

job=$(submit 1-3)
wait_until 20 'rows of task 2' has_rows 2
state_is "${job}_2" RUNNING || fail 'task 2 has ended before it was requeued'
scontrol requeue "${job}_2" || fail 'task 2 was not requeued'
wait_until 20 'the end of the requeued task' state_is "${job}_2" PENDING
requeued=$(rows 2)

wait_until 20 'rows of task 3' has_rows 3
kill -KILL "$(holder 3)"
wait_until 20 'the end of the killed task' state_is "${job}_3" ''
killed=$(rows 3)
job_has "${job}_3" JobState=FAILED
job_has "${job}_3" ExitCode=0:9
again=$(GRAINFIELD_SHARDS=3 submit 3)

wait_until 20 'task 1, which should wait' log_says "${job}_1" "waiting for process $old on"
state_is "${job}_1" RUNNING || fail 'task 1 does not wait for its shard'
{ kill -KILL $old && wait $old; } 2>/dev/null || true
wait_until 60 'the end of all tasks' queue_is_empty

for task in "${job}_1" "${job}_2" "${again}_3"; do
    job_has "$task" JobState=COMPLETED
done
job_has "${job}_1" Restarts=0
job_has "${job}_2" Restarts=1
log_says "${job}_2" 'shard 2/3 on .*, restarts: 0' || fail 'no log of the first start of task 2'
log_says "${job}_2" 'shard 2/3 on .*, restarts: 1' || fail 'no log of the second start of task 2'
[ "$requeued" -lt "$(rows 2)" ] || fail 'the requeued task had nothing left to do'
[ "$killed" -lt "$(rows 3)" ] || fail 'the killed task had nothing left to do'

for file in results.csv deterministic.csv; do
    diff <(results whole $file) <(results shared $file) >differences ||
        fail "$file differs: $(cat differences)"
done
[ "$(cat shared/*.journal | wc -l)" -eq "$all" ] || fail 'rows were computed twice'
echo "$all rows; $requeued of $(rows 2) when task 2 was requeued," \
    "$killed of $(rows 3) when task 3 was killed; $SECONDS s"
