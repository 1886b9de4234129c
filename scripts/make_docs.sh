#!/bin/bash
# Makes what README.md and docs/ have from the program anew: docs/options.md, docs/cli-help.txt, the numbers and tables
# that come from runs, and the pictures:
#     scripts/make_docs.sh [--program vdb_molsurf] [--structures FOLDER]
# FOLDER has structures that are not part of the project, 1hzh.pdb.gz, 1k4r.pdb.gz and 1m4x.cif.gz for pictures and those
# that `scripts/check_docs.py --figures` names; what needs them stays as it is without. Two files stay in any case, since
# they tell of times, which a machine that does nothing else has to measure: docs/performance.md and its picture
# scaling.png, which bench/scaling.py draws. Look at the pictures afterwards; it takes twenty minutes on 2 busy cores.
set -euo pipefail
cd "$(dirname "$0")/.."

program=build-release/tools/vdb_molsurf structures=
while [[ $# -gt 0 ]]; do
  case $1 in
    --program) program=${2:?--program needs a file} && shift ;;
    --structures) structures=${2:?--structures needs a folder} && shift ;;
    *) echo "make_docs.sh: expected an option, got $1 [hint: see the first lines of this script]" >&2; exit 2 ;;
  esac
  shift
done
scripts/install_deps.sh blender chromium python3-pil python3-numpy fonts-dejavu-core gemmi pdb2pqr apbs-data

scripts/make_pictures.py "$program" docs/pictures
scripts/gallery.py "$program"
scripts/artist_pictures.sh "$program"
[[ -z $structures ]] || scripts/complex_pictures.sh "$program" "$structures"

scripts/paper_structures.sh paper
renew=(scripts/check_docs.py --program "$program" --renew)
"${renew[@]}" --figures ${structures:+--structures "$structures"} || echo "Numbers were corrected, see above."
"${renew[@]}"
git status --short README.md docs
