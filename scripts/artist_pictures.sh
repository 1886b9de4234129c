#!/bin/bash
# The pictures of docs/artists.md. Needs blender, chromium and python3-pil.
# usage: artist_pictures.sh VDB_MOLSURF [OUTPUT_FOLDER]
set -euo pipefail
tool=$(realpath "$1")
out=$(realpath "${2:-$(dirname "$0")/../docs/pictures}")
cd "$(dirname "$0")/.."
script=$PWD/scripts/blender/open_in_blender.py
data=$PWD/tests/data
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

keep() # PICTURE MODE FILE: pixels alone, since Blender writes times beside them
{
  /usr/bin/python3 -c "
import sys
from PIL import Image
Image.open(sys.argv[1]).convert(sys.argv[2]).save(sys.argv[3], optimize=True)" "$@"
}

"$tool" "$data/1a8o.cif.gz" --assembly 1 --voxel 0.25 --for blender -q -o mesh.vdb
"$tool" "$data/1a8o.cif.gz" --assembly 1 --for blender -q -o fog.vdb
for show in mesh fog; do
  words=(--show volume)
  samples=64
  [[ $show == mesh ]] && words=(--color) samples=160
  blender -b --factory-startup --python-exit-code 1 --python "$script" -- "$show.vdb" "${words[@]}" \
    --size 480 --samples "$samples" --render "blender_$show.png" > blender.log || cat blender.log
  keep "blender_$show.png" RGBA "$out/blender_$show.png"
done

"$tool" "$data/4at1.ent.gz" --color chain --size 700 --force -q -o "$out/4at1_chains.png"

"$tool" "$data/1a8o.cif.gz" --assembly 1 --voxel 0.25 --color mean-curvature -q -o view.html
chromium --headless=new --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader \
  --window-size=900,640 --hide-scrollbars --user-data-dir="$work/profile" \
  --virtual-time-budget=8000 --screenshot=view.png "file://$work/view.html" 2> browser.log
keep view.png RGB "$out/view_html.png"
