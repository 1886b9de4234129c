// SPDX-License-Identifier: MPL-2.0
#include "precompiled.h"

template class openvdb::tree::Tree<openvdb::FloatTree::RootNodeType>;
template class openvdb::Grid<openvdb::FloatTree>;
