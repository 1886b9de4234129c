#!/bin/bash
# Fuzzes the readers of files, each target for some seconds, as many at once as there are processors:
#     scripts/fuzz.sh [SECONDS] [TARGET...]
# Without targets it runs all (tests/fuzz/CMakeLists.txt), without seconds each for 60. It needs clang and libclang-rt-dev.
# What libFuzzer learns stays in build-fuzz/corpus/, what it finds in build-fuzz/findings/. The exit status is 1
# if there is a finding: a crash, a report of a sanitizer, a leak, more than a second or 400 MB. (The sanitizers
# themselves need half of this.)
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=60
if [[ ${1:-} =~ ^[0-9]+$ ]]; then
  seconds=$1
  shift
fi
command -v clang++ > /dev/null || { echo "fuzz.sh: clang is missing [hint: apt-get install clang libclang-rt-dev]" >&2; exit 2; }
cmake --preset fuzz > /dev/null
cmake --build --preset fuzz
targets=("$@")
if [[ ${#targets[@]} -eq 0 ]]; then
  mapfile -t targets < <(sed -n 's/^molsurf_fuzz(\([a-z0-9]*\) .*/\1/p' tests/fuzz/CMakeLists.txt)
fi

run() {
  local target=$1 log=build-fuzz/$1.log options=()
  mkdir -p "build-fuzz/corpus/$target" build-fuzz/findings
  [[ ! -f tests/fuzz/$target.dict ]] || options+=("-dict=tests/fuzz/$target.dict")
  local status=0
  "build-fuzz/tests/fuzz/fuzz_$target" -max_total_time="$seconds" -timeout=1 -rss_limit_mb=400 -max_len=65536 \
    -artifact_prefix="build-fuzz/findings/$target-" -print_final_stats=1 "${options[@]}" \
    "build-fuzz/corpus/$target" "tests/fuzz/corpus/$target" > "$log" 2>&1 || status=$?
  printf '%-12s %s, %s\n' "$target" "$(sed -n 's/stat::number_of_executed_units: */executions /p' "$log")" \
    "$(grep -o 'cov: [0-9]* ft: [0-9]*' "$log" | tail -1)"
  [[ $status -eq 0 ]] && return
  echo "$target: a finding, see $log and build-fuzz/findings/"
  grep -m1 -E 'ERROR|runtime error|SUMMARY' "$log" || true
  return 1
}
export -f run
export seconds LSAN_OPTIONS=suppressions=$PWD/tests/lsan.supp:print_suppressions=0
# Freed memory that waits for late readers counts, too. OpenVDB and TBB do not mark the ends of their vectors.
export ASAN_OPTIONS=quarantine_size_mb=32:detect_container_overflow=0
export TBB_NUM_THREADS=1
printf '%s\n' "${targets[@]}" | xargs -P "$(nproc)" -I {} bash -c 'run {}'
