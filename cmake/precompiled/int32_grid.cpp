// SPDX-License-Identifier: MPL-2.0
#include "precompiled.h"

template class openvdb::tree::Tree<openvdb::Int32Tree::RootNodeType>;
template class openvdb::Grid<openvdb::Int32Tree>;
