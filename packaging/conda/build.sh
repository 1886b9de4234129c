#!/bin/bash
set -euo pipefail
font=$(find "$BUILD_PREFIX" -name DejaVuSans.ttf | head -n 1)
cmake -S . -B build-conda -G Ninja $CMAKE_ARGS -DCMAKE_BUILD_TYPE=Release -DMOLSURF_BUILD_TESTS=OFF -DBUILD_SHARED_LIBS=ON \
  -DMOLSURF_FONT="$font"
cmake --build build-conda -j "$CPU_COUNT"
cmake --install build-conda
