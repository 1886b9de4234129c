#!/bin/bash
# The pictures of docs/artists.md. Needs blender, chromium and python3-pil; BPY_PYTHON, a Python that has the module bpy,
# takes the place of blender, and its denoiser that of three rays in four. STRUCTURES has 1f2n.cif.gz of the Protein Data Bank,
# without which the capsid is left out.
# usage: artist_pictures.sh VDB_MOLSURF [OUTPUT_FOLDER [STRUCTURES]]
set -euo pipefail
tool=$(realpath "$1")
out=$(realpath "${2:-$(dirname "$0")/../docs/pictures}")
structures=${3:+$(realpath "$3")}
cd "$(dirname "$0")/.."
scripts=$PWD/scripts/blender
data=$PWD/tests/data
blender=(blender -b --factory-startup --python-exit-code 1 --python)
fewer=1
[[ -n ${BPY_PYTHON:-} ]] && blender=("$BPY_PYTHON") fewer=4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

keep() # PICTURE FILE: pixels alone, since Blender writes times beside them
{
  /usr/bin/python3 -c "
import sys
from PIL import Image
Image.open(sys.argv[1]).convert('RGB').save(sys.argv[2], optimize=True)" "$@"
}

draw() # NAME SAMPLES SCRIPT WORD...
{
  "${blender[@]}" "$scripts/$3" -- "${@:4}" --size "${size:-600}" --samples $(($2 / fewer)) --render "$1.png" > blender.log 2>&1 ||
    { cat blender.log; exit 1; }
  keep "$1.png" "$out/$1.png"
}

# Of the first part of the page, by its commands.
unit=("$data/1a8o.cif.gz" --assembly 1 --size 300 --force -q)
"$tool" "${unit[@]}" --for blender=nm --fog-density 0.2 -o "$out/art_still.png"
"$tool" "$data/2buk.pdb.gz" --assembly 1 --instances --color copy --size 300 --force -q -o "$out/art_shell.png"
"$tool" "${unit[@]}" --print-scale 0.5 --min-thickness 2 --group-by copy --split group --color group -o "$out/art_print.png"
"$tool" "$data/1d3z.pdb.gz" --voxel 1 --frames 1-3 --first-frame 1001 --fps 24 --fields v --color element --for usd=nm -q -o film.usda
size=300 draw art_film 96 open_in_blender.py film.usda --frame 1002 --blur

"$tool" "$data/1a8o.cif.gz" --assembly 1 --voxel 0.25 --for blender -q -o mesh.vdb -o mesh.ply
"$tool" "$data/1a8o.cif.gz" --assembly 1 --for blender -q -o fog.vdb
draw blender_mesh 160 open_in_blender.py mesh.vdb --color
draw blender_fog 160 open_in_blender.py fog.vdb --show volume
if [[ -n $structures ]]; then
  "$tool" "$structures/1f2n.cif.gz" --assembly 1 --instances --voxel 0.5 --color chain -q -o unit.ply -o copies.json
  draw blender_capsid 96 place_copies.py copies.json unit.ply --color --cut 0
fi

"$tool" "$data/4at1.ent.gz" --color chain --size 700 --force -q -o "$out/4at1_chains.png"

"$tool" "$data/1a8o.cif.gz" --assembly 1 --voxel 0.25 --color mean-curvature -q -o view.html
chromium --headless=new --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader \
  --window-size=900,640 --hide-scrollbars --user-data-dir="$work/profile" \
  --virtual-time-budget=8000 --screenshot=view.png "file://$work/view.html" 2> browser.log
keep view.png "$out/view_html.png"
