#!/bin/bash
# The pictures of docs/complexes.md, and the capsid of README.md.
# usage: complex_pictures.sh VDB_MOLSURF FOLDER_WITH_1HZH_1K4R_AND_1M4X [OUTPUT_FOLDER]
set -euo pipefail
tool=$(realpath "$1")
structures=$(realpath "$2")
out=$(realpath "${3:-$(dirname "$0")/../docs/pictures}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

cat > antibody <<'END'
legs /1/L,M|/1/H,K/1-230 #d55e00
body /1/H,K/231-500 #0072b2
END
antibody() # LEGS BODY NAME
{
  "$tool" "$structures/1hzh.pdb.gz" --select H,L,K,M --resolution "/1/L,M|/1/H,K/1-230=$1" \
    --resolution "/1/H,K/231-500=$2" --groups antibody --color group --size 700 --legend off --force -q \
    -o "$out/$3.png"
}
antibody 5 10 1hzh_legs
antibody 10 5 1hzh_body

cat > domains <<'END'
# of the dengue envelope protein
I   */1-52|*/133-193|*/281-296 #d7301f
II  */53-132|*/194-280 #ffd92f
III */297-394 #2b6cb0
END
"$tool" "$structures/1k4r.pdb.gz" --select A,B --groups domains --color group --size 700 --legend off --force -q \
  -o "$out/1k4r_domains.png"
"$tool" "$structures/1k4r.pdb.gz" --assembly 1 --voxel 1 --groups domains --color group --size 700 --legend off \
  --view 0.5257,0,0.8507 --force -q -o "$out/1k4r_shell.png"
unit() # FOLD COLOUR AXIS
{
  echo "unit * copies=fold:$1 $2" > unit
  "$tool" "$structures/1k4r.pdb.gz" --assembly 1 --voxel 1 --groups unit --color group \
    --surface vdw --surface-of unit=variational --size 700 --legend off --view "$3" --force -q \
    -o "$out/1k4r_fold$1.png"
}
unit 3 '#d55e00' 0,-0.3568,0.9342
unit 5 '#0072b2' 0.5257,0,0.8507

"$tool" "$structures/1m4x.cif.gz" --assembly 1 --by-symmetry --color radius --voxel 1 --size 800 --force -q \
  -o "$out/pbcv1.png"
