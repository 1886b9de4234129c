#!/bin/bash
# Tells which lines of the library and of the programs no test runs, by folder and by file:
#     scripts/coverage.sh
# The pages are in build-coverage/lines/.
set -euo pipefail
cd "$(dirname "$0")/.."

command -v gcovr > /dev/null || { echo "coverage.sh: gcovr is missing [hint: apt-get install gcovr]" >&2; exit 2; }
cmake --preset coverage
cmake --build --preset coverage
find build-coverage -name '*.gcda' -delete
ctest --preset coverage --parallel "$(nproc)"
mkdir -p build-coverage/lines
gcovr --root . --object-directory build-coverage --filter src/ --filter tools/ --exclude-throw-branches \
  --html-details build-coverage/lines/index.html --txt --print-summary
