#!/bin/bash
# Makes the surface of structure files at 0.5 Å, or at the voxel edge VOXEL, and has CGAL judge the
# meshes:
#     scripts/check_mesh.sh FILE...
# BUILD names the build folder. Options for the tool may be given in OPTIONS.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
build=${BUILD:-$root/build-release}
voxel=${VOXEL:-0.5}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

status=0
for file in "$@"; do
  echo "$file at $voxel Å"
  # shellcheck disable=SC2086 # OPTIONS is a list
  "$build/tools/vdb_molsurf" "$file" -q --force --voxel "$voxel" ${OPTIONS:-} -o "$work/s.vdb" -o "$work/s.ply" ||
    [[ $? -eq 3 ]] || { status=1; continue; }
  "$build/tests/check_mesh" "$work/s.ply" "$work/s.vdb" || status=1
done
exit $status
