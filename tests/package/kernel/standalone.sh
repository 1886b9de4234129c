#!/bin/bash
# Configures and builds the kernel without the packages that it does not need, and runs its example:
#     tests/package/kernel/standalone.sh [FOLDER]
# FOLDER (a temporary one) holds the build. Prints the CPU time of the build, with one compiler at a time.
set -euo pipefail
cd "$(dirname "$0")/../../.."
build=${1:-$(mktemp -d)}
without=()
for package in nlohmann_json Freetype PNG embree GTest; do
  without+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
cmake -S . -B "$build" -G Ninja -DMOLSURF_ONLY=kernel -DMOLSURF_OPENVDB=system "${without[@]}"
/usr/bin/time -f "%U s of CPU, %e s" cmake --build "$build" -- -j1
printf '%s\n' "0 0 0 1.7" "1.5 0 0 1.52" > "$build/two.xyzr"
"$build/tests/package/kernel/xyzr_to_vdb" "$build/two.xyzr" "$build/two.vdb"
