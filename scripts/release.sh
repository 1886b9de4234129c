#!/bin/bash
# Makes a release of HEAD and tries each part of it where nothing is installed:
#     scripts/release.sh [NAME...]
# Without a NAME it makes all:
#     sources  the sources as .tar.gz; scripts/example.sh runs in them on a bare Debian 12
#     debian   scripts/package.sh: Debian's packages, tried on a bare Debian 12
#     tarball  the programs with their libraries, tried on a bare Debian 12 and 13
#     wheel    scripts/wheel.sh: the wheel and the sdist of the Python module, in python/; the wheel is tried on a bare
#              Debian 12, whose Python 3.11 it is for. NEWER_PYTHON names a Python of 3.12 or newer: the wheel of that
#              one is for all later ones, too, and is tried on a bare Debian 13, whose Python is 3.13
# All goes to build-dist/, with SHA256SUMS and a log of each part. The version is that of CMakeLists.txt; the files that
# repeat it have to agree. It needs what scripts/fresh_machine.sh needs, and an hour on 2 cores.
set -euo pipefail
cd "$(dirname "$0")/.."

dist=build-dist
version=$(sed -n 's/^project(molsurf VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
prefix=vdb_molsurf-$version

# Each file that repeats the version, and the words about it.
check_version() {
  local wrong=0 file before
  while IFS='|' read -r file before; do # a blank at the end stays
    grep -qF -- "$before$version" "$file" || { echo "$file: expected '$before$version'" >&2; wrong=1; }
  done << EOF
CHANGELOG.md|## 
CITATION.cff|version: 
codemeta.json|"version": "
debian/changelog|vdb-molsurf (
packaging/conda/meta.yaml|version: 
packaging/Dockerfile|org.opencontainers.image.version="
packaging/vdb_molsurf.def|org.opencontainers.image.version 
README.md|vdb-molsurf_
docs/install.md|vdb-molsurf_
EOF
  return $wrong
}

# Tries commands on bare systems, with build-dist as /srv/shared: bare SUITE[,SUITE] COMMAND...
bare() {
  local suite suites=${1//,/ }
  shift
  for suite in $suites; do
    scripts/fresh_machine.sh --suite "$suite" --share $dist "$@"
  done
}

sources() {
  git archive --prefix="$prefix/" -o "$dist/$prefix.tar.gz" HEAD
  bare bookworm "tar -C /srv -xf /srv/shared/$prefix.tar.gz" "cd /srv/$prefix && scripts/example.sh"
}

debian() {
  scripts/package.sh
  cp build-package/*.deb $dist/
}

tarball() {
  cmake --workflow --preset tarball
  cp "build-tarball/$prefix-linux-x86_64.tar.gz" $dist/
  bare bookworm,trixie "tar -C /opt -xf /srv/shared/$prefix-linux-x86_64.tar.gz" \
    "/opt/$prefix-linux-x86_64/bin/vdb_molsurf tests/data/1crn.pdb -o /tmp/1crn.vdb -o /tmp/1crn.ply -o /tmp/1crn.png" \
    "/opt/$prefix-linux-x86_64/bin/vdb_molsurf info /tmp/1crn.vdb"
}

# Tries the wheel of a Python on a bare system: try_wheel SUITE VERSION WHEEL
try_wheel() {
  # What it needs of PyPI is downloaded here: the bare system knows no certificate of a proxy.
  /usr/bin/python3 -m venv build-python/pip
  build-python/pip/bin/pip download -q --python-version "$2" --only-binary=:all: -d "$dist/pypi" numpy pytest
  bare "$1" "apt-get update -q && apt-get install -q -y --no-install-recommends python3-venv > /dev/null" \
    "python3 -m venv /srv/env && /srv/env/bin/pip install -q --no-index --find-links /srv/shared/pypi /srv/shared/python/$3 pytest" \
    "cp -r python tests docs /srv/ && cd / && /srv/env/bin/python -m pytest -q -p no:cacheprovider /srv/python/tests" \
    "/srv/env/bin/vdb_molsurf tests/data/1crn.pdb -o /tmp/1crn.ply"
}

wheel() {
  scripts/wheel.sh "$PWD/$dist/python"
  try_wheel bookworm 3.11 '*-cp311-*.whl'
  [[ -n ${NEWER_PYTHON:-} ]] || return 0
  PYTHON=$NEWER_PYTHON scripts/wheel.sh "$PWD/$dist/newer"
  mv $dist/newer/*.whl $dist/python/
  try_wheel trixie 3.13 '*-abi3-*.whl'
}

parts=("$@")
[[ ${#parts[@]} -gt 0 ]] || parts=(sources debian tarball wheel)
for part in "${parts[@]}"; do
  [[ $part =~ ^(sources|debian|tarball|wheel)$ ]] ||
    { echo "release.sh: expected a part, got $part [hint: see the first lines of this script]" >&2; exit 2; }
done
check_version
mkdir -p $dist
table=()
for part in "${parts[@]}"; do
  echo "== $part"
  began=$SECONDS
  # Not a condition, in which a function would not end at its first error.
  set +e
  (set -e; "$part") < /dev/null > "$dist/$part.log" 2>&1
  status=$?
  set -e
  [[ $status -eq 0 ]] || { tail -n 20 "$dist/$part.log" >&2; echo "release.sh: $part failed, see $dist/$part.log" >&2; exit 1; }
  table+=("$(printf '%-8s %3d:%02d' "$part" $(((SECONDS - began) / 60)) $(((SECONDS - began) % 60)))")
done
(cd $dist && find . -maxdepth 2 \( -name 'vdb*.tar.gz' -o -name '*.deb' -o -name 'vdb*.whl' \) ! -path './newer/*' -print0 |
  sort -z | xargs -0 sha256sum > SHA256SUMS)
printf '\npart     minutes\n'
printf '%s\n' "${table[@]}"
(cd $dist && sha256sum --check --quiet SHA256SUMS && cat SHA256SUMS)
