#!/bin/bash
# Fuzzes the readers: scripts/fuzz.sh [SECONDS [TARGET ...]]. Each target (tests/fuzz) runs so many seconds, 60
# unless told, as many at once as there are cores, from the corpus in the repository and what earlier runs have
# found in build-fuzz/corpus. The last line of each says how many inputs it has tried. An input that ends a
# target by a signal, a sanitizer, 1 GB of memory or 10 s lies in build-fuzz/findings then, and the status is 1.
# The target vdb has to be named: OpenVDB's own reader leaks and takes memory on some damaged files.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-60}
shift || true
targets=${*:-structure trajectory mesh text brick}
cmake --preset fuzz > /dev/null
cmake --build --preset fuzz $(printf -- '--target fuzz_%s ' $targets)
mkdir -p build-fuzz/findings

run() {
  mkdir -p "build-fuzz/corpus/$1"
  local leaks=1
  [ "$1" = vdb ] && leaks=0
  # OpenVDB and TBB are not built with sanitizers, so their containers cannot be followed.
  if ASAN_OPTIONS=detect_container_overflow=0:allocator_may_return_null=0 \
    "build-fuzz/tests/fuzz/fuzz_$1" -max_total_time="$2" -timeout=10 -rss_limit_mb=1024 -malloc_limit_mb=1024 \
    -artifact_prefix="build-fuzz/findings/$1." -detect_leaks=$leaks "build-fuzz/corpus/$1" "tests/fuzz/corpus/$1" \
    > "build-fuzz/findings/$1.log" 2>&1; then
    echo "$1: $(grep -E '^Done' "build-fuzz/findings/$1.log")"
  else
    echo "$1: a finding, see build-fuzz/findings/$1.log"
    return 1
  fi
}
export -f run
printf '%s\n' $targets | xargs -P "$(nproc)" -I TARGET bash -c "run TARGET $seconds"
