// SPDX-License-Identifier: MPL-2.0
#pragma once

// What most files include, read once by the compiler. Every file includes what it uses as if this did
// not exist; with -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON it does not.

#if defined(__GNUC__) && !defined(__clang__)
// GCC puts the virtual functions of OpenVDB's maps, 80 kB of code, into every file that sees them, since they are
// declared without inline. #pragma interface tells it that another file, in OpenVDB's library, has them; it is about
// the file in which it stands.
#line 1 "/usr/include/openvdb/math/Maps.h"
#pragma interface
#line 14 "precompiled.h"
#endif

#include <openvdb/openvdb.h>
#include <openvdb/tree/LeafManager.h>

#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// The virtual functions of a grid are 1 MB of code in every file that makes one; float_grid.cpp and so on have them.
extern template class openvdb::tree::Tree<openvdb::FloatTree::RootNodeType>;
extern template class openvdb::tree::Tree<openvdb::Int32Tree::RootNodeType>;
extern template class openvdb::tree::Tree<openvdb::Vec3STree::RootNodeType>;
extern template class openvdb::Grid<openvdb::FloatTree>;
extern template class openvdb::Grid<openvdb::Int32Tree>;
extern template class openvdb::Grid<openvdb::Vec3STree>;
