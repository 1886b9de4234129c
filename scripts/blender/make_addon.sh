#!/bin/bash
# Packs the add-on of Blender: molsurf_addon.zip in the present folder, or the file that is named.
#     scripts/blender/make_addon.sh [FILE.zip]
set -euo pipefail
to=$(realpath -m "${1:-molsurf_addon.zip}")
cd "$(dirname "$0")"
rm -f "$to"
python3 - "$to" << 'END'
import sys, zipfile
with zipfile.ZipFile(sys.argv[1], "w", zipfile.ZIP_DEFLATED) as file:  # with its folder, as Blender wants it
    file.write("molsurf_addon/__init__.py")
END
echo "$to"
