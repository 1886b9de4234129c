#!/bin/bash
# Runs the unit tests under sanitizers:
#     scripts/sanitizers.sh [asan] [tsan]
# asan is the address and the undefined behaviour sanitizer of clang (gcc takes six times as long to compile them), in
# build-fuzz/ with the library of the fuzz targets; tsan is gcc's thread sanitizer. Without words both run. tsan
# reports races that there are none unless oneTBB is instrumented too: the script gets Debian's source (2 MB) and builds
# it once, in build-tsan/onetbb/. What stays uninstrumented is in tests/tsan.supp.
set -euo pipefail
cd "$(dirname "$0")/.."

onetbb=$PWD/build-tsan/onetbb

# Debian's source of the package that is installed, without a line in /etc/apt.
get_onetbb() {
  mkdir -p "$onetbb/lists/partial"
  local key=/usr/share/keyrings/debian-archive-keyring.gpg
  echo "deb-src [signed-by=$key] http://deb.debian.org/debian bookworm main" > "$onetbb/sources.list"
  local apt=(apt-get -q -o "Dir::Etc::SourceList=$onetbb/sources.list" -o Dir::Etc::SourceParts=/dev/null
             -o "Dir::State::Lists=$onetbb/lists" -o "Dir::Cache=$onetbb/cache" -o "APT::Sandbox::User=$(id -un)")
  command -v dpkg-source > /dev/null ||
    { echo "sanitizers.sh: dpkg-source is missing [hint: apt-get install dpkg-dev]" >&2; exit 2; }
  (cd "$onetbb" && "${apt[@]}" update && "${apt[@]}" source onetbb)
}

build_onetbb() {
  [[ -e $onetbb/libtbb.so.12 ]] && return
  get_onetbb
  cmake -G Ninja -S "$onetbb"/onetbb-*/ -B "$onetbb/build" -DCMAKE_BUILD_TYPE=RelWithDebInfo -DTBB_TEST=OFF \
    -DTBB_STRICT=OFF -DCMAKE_CXX_FLAGS="-fsanitize=thread -fno-omit-frame-pointer"
  cmake --build "$onetbb/build" --target tbb
  cp -P "$onetbb"/build/*/libtbb.so* "$onetbb"
}

[[ $# -gt 0 ]] || set -- asan tsan
for preset in "$@"; do
  configured=$preset without=()
  case $preset in
    asan)
      command -v clang++ > /dev/null || { echo "sanitizers.sh: clang is missing [hint: apt-get install clang libclang-rt-dev]" >&2; exit 2; }
      configured=fuzz
      ;;
    tsan)
      build_onetbb
      export LD_LIBRARY_PATH=$onetbb${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
      # A thousand molecules take an hour, and so does a hundred thousand broken bricks, which one thread reads.
      without=(--exclude-regex '^Properties\.|^HostileBricks\.MutatedOnes')
      ;;
    *) echo "usage: scripts/sanitizers.sh [asan] [tsan]" >&2; exit 2 ;;
  esac
  cmake --preset "$configured"
  cmake --build --preset "$preset"
  ctest --preset "$preset" --parallel "$(nproc)" --label-exclude 'cli|package' "${without[@]}"
done
