#!/bin/bash
# Makes viewer.min.js of viewer.js and three.js, and takes three.js's licence along. Needs npm; the
# result is in the repository, so that a build of the program does not.
set -euo pipefail
cd "$(dirname "$0")"
out=${1:-$PWD}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp package.json viewer.js "$work"
cd "$work"
npm install --no-audit --no-fund --silent
version=$(node -p 'JSON.parse(require("fs").readFileSync("node_modules/three/package.json")).version')
npx esbuild viewer.js --bundle --minify --format=iife --target=es2020 --charset=ascii \
  --legal-comments=none --log-level=warning --outfile=bundle.js
{
  echo "/* vdb_molsurf's viewer, MPL-2.0, with three.js $version:"
  sed 's/^/   /' node_modules/three/LICENSE
  echo "*/"
  # The text of a script element must not end it, or open a comment of HTML.
  sed 's/<\/script/<\\\/script/g; s/<!--/<\\!--/g' bundle.js
} > "$out/viewer.min.js"
cp node_modules/three/LICENSE "$out/LICENSE.three"
