#!/bin/bash
# Builds the documentation as a site in build-docs/site, which can be read without a network and without
# a server: open build-docs/site/index.html. (The search box alone needs one: /usr/bin/python3 -m http.server -d
# build-docs/site.) Installs mkdocs and its theme from Debian 12 if there is no mkdocs.
# Ends with an error if a link between pages or to a picture leads to nothing, if a page is not in the
# menu, or if a page would load something from the network.
set -euo pipefail
cd "$(dirname "$0")/.."

command -v mkdocs > /dev/null || scripts/install_deps.sh mkdocs mkdocs-material

rm -rf build-docs
mkdir -p build-docs/pages
# What pages link to, beside each other; scripts/check_docs.py holds the links against this list.
copied=(README.md CONTRIBUTING.md SECURITY.md SUPPORT.md CODE_OF_CONDUCT.md CHANGELOG.md LICENSE docs scripts/workflow/config.yaml
  scripts/blender/make_addon.sh scripts/blender/open_in_blender.py scripts/blender/place_copies.py
  scripts/houdini/load_in_houdini.py scripts/pymol/molsurf.py)
cp -r --parents "${copied[@]}" build-docs/pages/
mkdocs build >build-docs/log 2>&1 || { cat build-docs/log >&2; exit 1; }

cd build-docs
# Tables on the git host want | as \| in code, too; Python's Markdown shows the backslash.
find site -name '*.html' -exec sed -i 's/\\|/|/g' {} +
missing=$(cd pages && find . -name '*.md' ! -name README.md | sed 's/\.md$/.html/' | sort |
  while read -r page; do grep -qF "${page##*/}\" class=\"md-nav__link" ../site/index.html || echo "$page"; done)
if [[ -n $missing ]]; then
  echo "not in the menu of mkdocs.yml: $missing" >&2
  exit 1
fi
if grep -rnE --include='*.html' '<(link|script|img)[^>]*(href|src)="?(https?:)?//' site; then
  echo "these pages load something from the network" >&2
  exit 1
fi
echo "Made in build-docs/site: $(find site -name '*.html' | wc -l) pages; open build-docs/site/index.html."
