#!/bin/bash
# What became of the Slurm job $1, in Snakemake's words: running, success or failed. Without it Snakemake
# would wait for ever for a job that was killed. Slurm's controller forgets a job MinJobAge seconds
# after its end; then the accounting is asked, where there is one.
answer=$(scontrol show job --oneliner "$1" 2>&1)
if [[ $answer =~ JobState=([A-Z_]+) ]]; then
  state=${BASH_REMATCH[1]}
elif [[ $answer == *"Invalid job id"* ]]; then
  state=$(sacct --noheader --parsable2 --allocations --format=State --jobs="$1" 2>/dev/null | head -n 1)
else
  state=RUNNING # the controller does not answer: ask again later
fi

case $state in
  COMPLETED) echo success ;;
  PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | STOPPED | REQUEUE* | RESIZING | SIGNALING | STAGE_OUT)
    echo running ;;
  *) echo failed ;;
esac
