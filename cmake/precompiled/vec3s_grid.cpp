// SPDX-License-Identifier: MPL-2.0
#include "precompiled.h"

template class openvdb::tree::Tree<openvdb::Vec3STree::RootNodeType>;
template class openvdb::Grid<openvdb::Vec3STree>;
