#!/bin/bash
# Installs packages of Debian 12, those of this list and no others:
#     scripts/install_deps.sh [--test] [--check] [--optional] [PACKAGE...]
# What the program and the Python module need to be built, always; with --test what all tests need; with --check
# what formatting and the benchmarks need; with --optional the programs of others that some tests run, which are
# skipped without. Does nothing, and needs no rights, if all of it is there.
set -euo pipefail
cd "$(dirname "$0")/.."

packages=(
  g++ cmake ninja-build
  libopenvdb-dev libnanovdb-dev libtbb-dev libimath-dev libblosc-dev
  libboost-dev libboost-iostreams-dev libboost-program-options-dev
  gemmi-dev tao-pegtl-dev libstb-dev # gemmi's headers include the other two without saying so
  nlohmann-json3-dev libfreetype-dev fonts-dejavu-core zlib1g-dev libsodium-dev libembree-dev
  python3-dev python3-venv # of the Python module, whose other tools pip loads
)
test=(libgtest-dev libcgal-dev libpng-dev pkg-config python3 python3-openvdb python3-numpy python3-biopython libopenvdb-tools)
check=(clang-format libbenchmark-dev universal-ctags)
optional=(apbs blender chromium ffmpeg fish freesasa gmsh groff munge pymol slurm-wlm snakemake strace tetgen zsh) # 1.4 GB
# Node.js may be there from elsewhere, whose packages do not go together with Debian's.
command -v node > /dev/null || optional+=(nodejs)
command -v npm > /dev/null || optional+=(npm)

validator=
for word in "$@"; do
  case $word in
    --test) packages+=("${test[@]}") ;;
    --check) packages+=("${check[@]}") ;;
    --optional) packages+=("${optional[@]}") validator=yes ;;
    -*) echo "install_deps.sh: unknown option $word" >&2; exit 2 ;;
    *) packages+=("$word") ;;
  esac
done

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
if [[ ${#missing[@]} -gt 0 ]]; then
  as_root=()
  if [[ $EUID -ne 0 ]]; then
    as_root=(sudo)
  fi
  export DEBIAN_FRONTEND=noninteractive
  echo "Installing: ${missing[*]}"
  "${as_root[@]}" apt-get update -q
  "${as_root[@]}" apt-get install -q -y --no-install-recommends "${missing[@]}"
fi

# Khronos' checker of .glb files is no package of Debian; git ignores the folder.
if [[ -n $validator && ! -d build-tools/node_modules/gltf-validator ]]; then
  npm install --prefix build-tools --no-audit --no-fund gltf-validator@2.0.0-dev.3.10
fi
