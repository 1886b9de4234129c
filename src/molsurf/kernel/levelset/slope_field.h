// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How steep psi is where one ball is alone.

#include "molsurf/kernel/grid/leaf_table.h"

#include <array>
#include <utility>

namespace molsurf
{

/// |grad psi| where the balls around are flat [1/Å]: psi varies by nearly that where one ball is
/// near, whatever lies beside it. One number where all balls have the same, else one a voxel.
class SlopeField
{
public:
    explicit SlopeField(float same) { same_.fill(same); }
    explicit SlopeField(LeafField field) : field_(std::move(field)) {}

    /// The values of the leaf with this index in the table of psi.
    const float* leaf(std::size_t n) const
    {
        return field_.leafCount() > 0 ? field_.leaf(n) : same_.data();
    }

private:
    alignas(64) std::array<float, leafSize> same_{};
    LeafField field_;
};

} // namespace molsurf
