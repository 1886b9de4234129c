// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The level set that the flow moves, and the leaves that it lies in.

#include "molsurf/kernel/grid/sparse_field.h"
#include "molsurf/progress.h"

#include <functional>

namespace molsurf
{

/// A level set in its narrow band, and the field psi that drives it.
struct NarrowBand {
    SparseField phi; ///< signed distance [Å], < 0 inside; active voxels: the band
    LeafField psi;   ///< on the leaves of phi
};

/// Width of the band on each side of the interface [voxel]: the flow acts up to 2.25 voxels away,
/// and its stencils reach less than one further.
constexpr int bandWidthVox = 3;

/// Gives psi at the 512 voxels of the leaf with this first voxel. It is called from several
/// threads.
using PsiSource = std::function<void(const openvdb::Coord& origin, float* psi)>;

/// Makes the active voxels those within the band of the interface; adds leaves as needed. None is
/// dropped: that would change what stencils beside it see, and what happens at a voxel would depend
/// on whether any leaf, anywhere, has to be added in the same step.
/// @param[in]     domain   where leaves may be
/// @param[in,out] scratch  a field that grows with the band; its values are lost
void updateBand(NarrowBand& band, const PsiSource& source, const openvdb::CoordBBox& domain,
                LeafField& scratch, Progress& progress);

} // namespace molsurf
