#!/bin/bash
# Installs everything that building, testing and using vdb_molsurf needs on Debian 12, this list and
# nothing else. Does nothing, and needs no rights, if all of it is there. Further packages may be
# given as arguments.
set -euo pipefail

packages=(
  # build
  g++ cmake ninja-build
  libopenvdb-dev libtbb-dev libimath-dev libblosc-dev
  libboost-dev libboost-iostreams-dev libboost-program-options-dev
  gemmi-dev tao-pegtl-dev libstb-dev # gemmi's headers include the other two without saying so
  nlohmann-json3-dev libpng-dev libfreetype-dev fonts-dejavu-core zlib1g-dev libssl-dev libembree-dev
  lib3mf-dev
  # tests and benchmarks
  libgtest-dev libbenchmark-dev python3 python3-openvdb python3-numpy libopenvdb-tools libcgal-dev
  "$@"
)

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
if [[ ${#missing[@]} -eq 0 ]]; then
  exit 0
fi

as_root=()
if [[ $EUID -ne 0 ]]; then
  as_root=(sudo)
fi
export DEBIAN_FRONTEND=noninteractive
echo "Installing: ${missing[*]}"
"${as_root[@]}" apt-get update -q
"${as_root[@]}" apt-get install -q -y --no-install-recommends "${missing[@]}"
