// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How far a step of the flow moved the interface, the repair of the distance after it included.

#include "molsurf/kernel/flow/displacement.h"
#include "molsurf/kernel/grid/region.h"
#include "molsurf/kernel/levelset/reinitialize.h"

#include <tbb/enumerable_thread_specific.h>

#include <vector>

namespace molsurf
{

/// Measures the way of an interface: at each edge between two voxels of a leaf that it crosses, how
/// far the crossing has moved along the normal.
///
/// What Newton's method solves for is no such measure. At creases, which voxels do not resolve, it
/// asks for some hundredths of a voxel for ever, and reinitialize() takes as much back: the
/// interface stands.
class InterfaceMotion
{
public:
    /// @param[in] table      of the field; it has to live as long
    /// @param[in] region     whose own leaves are added up; likewise
    /// @param[in] voxelSize  edge h of a voxel [Å]
    InterfaceMotion(const LeafTable& table, const Region& region, double voxelSize)
        : table_(table), region_(region), inverse_(float(1.0 / voxelSize)),
          largest_(table.size(), 0.0f)
    {
    }

    /// For reinitialize(), whose scratch has the field before the step.
    InterfaceWatch watch();

    /// All ways [voxel].
    Displacements sum() const;

    const LeafTable& table() const { return table_; }

    /// The longest way in each leaf [voxel].
    const std::vector<float>& largest() const { return largest_; }

private:
    const LeafTable& table_;
    const Region& region_;
    float inverse_;
    std::vector<float> largest_;
    tbb::enumerable_thread_specific<Displacements> parts_;
};

} // namespace molsurf
