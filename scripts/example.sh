#!/bin/bash
# Installs what building needs, builds, and makes the surface of a small protein (the C-terminal domain of
# the HIV capsid, a dimer) in example/.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_deps.sh
cmake --preset release
cmake --build --preset release --target vdb_molsurf
mkdir -p example
build-release/tools/vdb_molsurf tests/data/1a8o.cif.gz --assembly 1 --force \
  -o example/1a8o.vdb -o example/1a8o.ply -o example/1a8o.json -o example/1a8o.png
echo
echo "Made in example/:"
cd example
wc -c 1a8o.vdb 1a8o.ply 1a8o.json 1a8o.png
