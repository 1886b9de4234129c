#!/bin/bash
# Copies what Debian's packages say of their licences: of libraries that are handed on beside the programs, and of the
# packages that are compiled into them.
#     scripts/licences.sh FOLDER LIBRARY...
# A LIBRARY is a path or the name of a file of a package that is installed.
set -euo pipefail

folder=$1
shift
compiled_in=(libopenvdb-dev libnanovdb-dev libimath-dev libblosc-dev gemmi-dev tao-pegtl-dev libstb-dev nlohmann-json3-dev
             fonts-dejavu-core) # and headers of Boost, whose licence asks for no copy beside what a compiler made of them
mkdir -p "$folder"
for package in "${compiled_in[@]}"; do
  cp "/usr/share/doc/$package/copyright" "$folder/$package"
done
for library; do
  package=$(dpkg-query -S "*/$(basename "$library")" | sed 's/[:,].*//;q')
  [[ $package == libboost* ]] ||
    cp "/usr/share/doc/$package/copyright" "$folder/$package"
done
cp "$(dirname "$0")/../src/molsurf/show/picture/viewer/LICENSE.three" "$folder/three.js"
