#!/bin/bash
# Packs the add-on of Blender: molsurf_addon.zip in the present folder, or the file that is named. Blender 4.2 and later
# take it as an extension, earlier ones as an add-on.
#     scripts/blender/make_addon.sh [FILE.zip]
set -euo pipefail
to=$(realpath -m "${1:-molsurf_addon.zip}")
cd "$(dirname "$0")"
rm -f "$to"
python3 - "$to" << 'END'
import sys, zipfile
with zipfile.ZipFile(sys.argv[1], "w", zipfile.ZIP_DEFLATED) as file:  # with its folder, as Blender wants it
    for name in ("__init__.py", "blender_manifest.toml"):
        file.write(f"molsurf_addon/{name}")
END
echo "$to"
