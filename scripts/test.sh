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
scripts/install_deps.sh "${sets[@]}"
cmake --preset release "$@"
cmake --build --preset release
status=0
ctest --preset release --parallel "$(nproc)" --output-junit "$PWD/build-release/tests.xml" || status=$?
python3 scripts/not_tested.py build-release/tests.xml
exit $status
