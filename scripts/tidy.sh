#!/bin/bash
# Runs clang-tidy, by .clang-tidy, over the library and the programs, or over the files given:
#     scripts/tidy.sh [FILE...]
# All of it takes 40 minutes of one core; .ci/run leaves it out.
set -euo pipefail
cd "$(dirname "$0")/.."

tidy=$(command -v run-clang-tidy || command -v run-clang-tidy-14) ||
  { echo "tidy.sh: clang-tidy is missing [hint: apt-get install clang-tidy]" >&2; exit 2; }
cmake --preset dev > /dev/null
[[ $# -gt 0 ]] || set -- "$PWD/src/molsurf/" "$PWD/tools/"
"$tidy" -quiet -p build-dev "$@"
