#!/bin/bash
# Runs the workflow on a real Slurm of this machine and checks what comes out:
#     scripts/workflow/test_slurm.sh [--first] [INPUT OPTIONS]
# 8 bricks of INPUT, one of them killed on the way, and 20 structures, one of them broken, in shards of two. Takes
# some four minutes, most of them waiting, since Snakemake looks after its jobs every ten seconds; with --first it
# ends when the 8 bricks are merged. BUILD names the build folder. Exits with 1 at the first thing that is not as
# it should be.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
if [[ -z ${ON_ONE_NODE:-} ]]; then
  ON_ONE_NODE=1 exec "$here/one_node_slurm.sh" run "$here/$(basename "$0")" "$@"
fi
root=$(cd "$here/../.." && pwd)
first=
[[ ${1:-} != --first ]] || { first=yes && shift; }
tool=$(realpath "${BUILD:-$root/build-release}/tools/vdb_molsurf")
input=$(realpath "${1:-$root/tests/data/4at1.ent.gz}")
options=${2:---voxel 0.25}
work=$(mktemp -d)
running= # a shell whose child is Snakemake
trap 'pkill -KILL -P "${running:-none}" 2>/dev/null || true; rm -rf "$work"' EXIT

fail() {
  echo "FAILED: $*" >&2
  tail -n 40 "$work"/*.log >&2
  exit 1
}

say() { printf '%4d s  %s\n' "$SECONDS" "$*"; }

# flow FOLDER TARGET SETTING...
flow() {
  local folder=$work/$1
  mkdir -p "$folder"
  snakemake "$2" -s "$here/Snakefile" --profile "$here/slurm" --directory "$folder" \
    --config tool="$tool" "${@:3}" >>"$folder.log" 2>&1
}

assembly() { flow "$1" assembly input="$input" options="$options" cut="--bricks 8"; }

# The process that computes a brick: brick_process FOLDER NUMBER
brick_process() {
  local pid
  for pid in $(pgrep -x vdb_molsurf); do
    if [[ $(readlink "/proc/$pid/cwd") == "$work/$1" &&
      $(tr '\0' ' ' 2>/dev/null <"/proc/$pid/cmdline") == *" bricks run bricks/plan.json $2 "* ]]; then
      echo "$pid"
      return
    fi
  done
  return 1
}

job_states() { scontrol show job --oneliner | grep -o 'JobState=[A-Z]*' | sort | uniq -c | xargs; }

say "$(sinfo --noheader --format='Slurm with %D node of %c cores, %t'), $(scontrol --version)"
assembly whole || fail "8 bricks"
[[ $(find "$work/whole/bricks" -name '*.brick' | wc -l) -eq 8 ]] || fail "expected 8 bricks"
say "8 bricks computed and merged; jobs: $(job_states)"
[[ -z $first ]] || exit 0

# How much computing brick 4 is, in ticks of the clock that /proc counts in.
number=4
mkdir "$work/alone"
cp "$work/whole/bricks"/plan.{json,atoms} "$work/alone"
TIMEFORMAT=%U
seconds=$({ time "$tool" bricks run "$work/alone/plan.json" $number -j 1 -q >/dev/null 2>&1; } 2>&1) || fail "brick $number alone"
half=$(awk "BEGIN { print int($seconds / 2 * $(getconf CLK_TCK)) }")
[[ $half -gt 10 ]] || fail "a brick of $seconds s is too short to be killed in the middle"

assembly killed &
running=$!
until pid=$(brick_process killed $number); do
  kill -0 $running 2>/dev/null || fail "brick $number was never seen"
  sleep 0.05
done
until [[ $(awk '{ print $14 }' "/proc/$pid/stat" || echo 0) -ge $half ]]; do
  kill -0 "$pid" || fail "brick $number was done before it could be killed"
  sleep 0.02
done
kill -KILL "$pid" || fail "brick $number was done before it could be killed"
say "brick $number: process $pid killed after half of the $seconds s that it computes"
status=0
wait $running || status=$?
running=
[[ $status -eq 1 ]] || fail "expected status 1 with a brick killed, got $status"
(cd "$work/killed/bricks" && ls ./*.brick) | grep -v "plan.$number.brick" >"$work/others"
[[ $(wc -l <"$work/others") -eq 7 ]] || fail "expected the other 7 bricks"
[[ ! -e $work/killed/bricks/plan.$number.brick ]] || fail "the killed brick left a file"
[[ -z $(find "$work/killed/assembly" -type f 2>/dev/null) ]] || fail "an incomplete set was merged"
say "the workflow ended with status 1, 7 bricks there; jobs: $(job_states)"

touch "$work/before"
assembly killed || fail "the second run"
redone=$(find "$work/killed/bricks" -name '*.brick' -newer "$work/before" -printf '%f ')
[[ $redone == "plan.$number.brick " ]] || fail "expected one brick done again, got $redone"
surface=$(cd "$work/whole/assembly" && basename ./*.ply .ply)
cmp "$work"/{whole,killed}/assembly/"$surface.ply" || fail "the meshes differ"
# The first 57 bytes hold a random name that OpenVDB gives every file.
cmp --ignore-initial=57 "$work"/{whole,killed}/assembly/"$surface.vdb" || fail "the level sets differ"
say "second run: $redone; the same .ply ($(stat -c %s "$work/whole/assembly/$surface.ply") bytes) and .vdb"

mkdir "$work/structures"
for residues in {28..46}; do # crambin, of 46 residues, and what is left when its end is cut off
  awk -v last="$residues" '/^ATOM/ && substr($0, 23, 4) + 0 <= last' "$root/tests/data/1crn.pdb" \
    >"$work/structures/crambin_$residues.pdb"
done
echo "not a structure" >"$work/structures/broken.pdb"
batch() { flow many batch structures="$work/structures/*" options="--voxel 0.8"; }
status=0
batch || status=$?
[[ $status -eq 1 ]] || fail "expected status 1 with a broken structure, got $status"
table=$work/many/batch/summary.csv
[[ $(cut -d, -f2 "$table" | sort | uniq -c | xargs) == "19 done 1 failed 1 status" ]] || fail "$(cat "$table")"
grep -q '/broken.pdb,failed,.*no atoms' "$table" || fail "$(cat "$table")"
[[ $(find "$work/many/batch" -name '*.ply' -size +1k | wc -l) -eq 19 ]] || fail "expected 19 meshes"
[[ $(cut -d, -f4 "$table" | sort -u | wc -l) -eq 21 ]] || fail "expected 19 different areas"
say "20 structures: 19 done, 1 failed, status 1"

cp "$root/tests/data/1ubq.pdb" "$work/structures/broken.pdb"
touch "$work/before"
batch || fail "the second run of the batch"
[[ $(find "$work/many/batch" -name '*.ply' -newer "$work/before" -printf '%f') == broken.ply ]] ||
  fail "expected one structure done again"
say "the broken one replaced: 20 done, one of them now, status 0; jobs: $(job_states)"
