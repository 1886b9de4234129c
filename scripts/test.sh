#!/bin/bash
# Installs what is needed, builds, runs the tests, and lists at the end what was not tested:
#     scripts/test.sh [--all] [ARGUMENT...]
# --all installs the optional programs too, Blender and a browser among them. The other arguments go
# to the configuration, for example -DMOLSURF_WERROR=ON.
set -euo pipefail
cd "$(dirname "$0")/.."

sets=(--test)
if [[ ${1:-} == --all ]]; then
  sets+=(--optional)
  shift
fi
echo "== 1 of 3: packages of Debian that building and testing need; a minute or two if none is there, apt prints their size"
scripts/install_deps.sh "${sets[@]}"
echo "== 2 of 3: the library, the programs and the tests; 6 minutes on 2 cores when nothing is built, half of it for the tests"
cmake --preset release -DMOLSURF_BUILD_TESTS=ON "$@"
cmake --build --preset release
echo "== 3 of 3: the tests; 5 minutes on 2 cores"
status=0
ctest --preset release --parallel "$(nproc)" --output-junit "$PWD/build-release/tests.xml" || status=$?
/usr/bin/python3 scripts/not_tested.py build-release/tests.xml
exit $status
