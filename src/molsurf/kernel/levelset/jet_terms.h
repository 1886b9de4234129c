// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The Gaussians that count at points near each other, and psi there with its derivatives.

#include "molsurf/kernel/levelset/gaussian_terms.h"
#include "molsurf/kernel/levelset/psi_jet.h"

#include <openvdb/Types.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace molsurf
{

/// Terms exp(level - rate |x - place|^2), summed four side by side in double precision.
class JetTerms
{
public:
    void clear() { count_ = 0; }

    /// Adds those of a run of balls that count within a radius of a point.
    /// @param[in] voxelSize  of the lists [Å]
    void addNear(const GaussianLists& balls, std::int32_t begin, std::int32_t end, double voxelSize,
                 const openvdb::Vec3d& middle, double radius);

    /// To be called behind the last addNear().
    void fillUp();

    /// The logarithm of the sum with its derivatives; terms below e^-12 are left out, and without
    /// any other psi is lowestPsi.
    PsiJet jetAt(const openvdb::Vec3d& x) const;

    /// The terms with so many times the exponents: those of a tolerance so many times smaller.
    JetTerms sharpened(double times) const;

private:
    std::size_t count_ = 0;
    std::vector<double> x_, y_, z_, rate_, level_; // with room for more
};

} // namespace molsurf
