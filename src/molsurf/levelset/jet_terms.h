// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The Gaussians that count at points near each other, and psi there with its derivatives.

#include "molsurf/levelset/gaps.h"

#include <openvdb/Types.h>

#include <cstddef>
#include <vector>

namespace molsurf
{

/// Terms exp(level - rate |x - place|^2), summed four side by side in double precision.
class JetTerms
{
public:
    void clear();

    /// @param[in] rate  [1/Å^2]
    void add(const openvdb::Vec3d& place, double rate, double level);

    /// To be called behind the last add().
    void fillUp();

    std::size_t size() const { return x_.size(); }

    /// The logarithm of the sum with its derivatives; terms below e^-12 are left out, and without
    /// any other psi is lowestPsi.
    PsiJet jetAt(const openvdb::Vec3d& x) const;

    /// The terms with so many times the exponents: those of a tolerance so many times smaller.
    JetTerms sharpened(double times) const;

private:
    std::vector<double> x_, y_, z_, rate_, level_;
};

} // namespace molsurf
