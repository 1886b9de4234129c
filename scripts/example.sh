#!/bin/bash
# Installs what building needs, builds the program, and makes the surface of a small protein (the C-terminal domain
# of the HIV capsid, a dimer) in example/.
set -euo pipefail
cd "$(dirname "$0")/.."

echo "== 1 of 3: packages of Debian that building needs; a minute or two if none is there, apt prints their size"
scripts/install_deps.sh
echo "== 2 of 3: the program, without its tests; 5 minutes on 2 cores when it is built for the first time"
# A folder that is configured already, with tests perhaps, stays as it is.
[[ -f build-release/build.ninja ]] || cmake --preset release -DMOLSURF_BUILD_TESTS=OFF
cmake --build --preset release --target vdb_molsurf
echo "== 3 of 3: the surface of 1A8O; a second or two"
mkdir -p example
build-release/tools/vdb_molsurf tests/data/1a8o.cif.gz --assembly 1 --force \
  -o example/1a8o.vdb -o example/1a8o.ply -o example/1a8o.json -o example/1a8o.png
echo
echo "Made in $PWD/example:"
while read -r name how; do
  printf '  %-9s %5d kB  %s\n' "$name" "$(($(stat -c %s "example/$name") / 1000))" "$how"
done <<'END'
1a8o.vdb the level set: File > Import > OpenVDB in Blender, or a File node in Houdini
1a8o.ply the mesh with curvatures: Blender, MeshLab, ParaView, ChimeraX
1a8o.png a picture: any viewer
1a8o.json the report, with area, volume and cavities: any editor
END
echo "The program is build-release/tools/vdb_molsurf; build-release/tools/vdb_molsurf --help lists what it can do."
