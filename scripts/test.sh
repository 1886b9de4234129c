#!/bin/bash
# Installs what is needed, builds, and runs all tests. Arguments go to the configuration, for example
#     scripts/test.sh -DMOLSURF_WERROR=ON
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_deps.sh --test
cmake --preset release "$@"
cmake --build --preset release
ctest --preset release --parallel "$(nproc)"
