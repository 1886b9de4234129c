// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Whole runs, and the spline that they leave.

#include "molsurf/error.h"
#include "molsurf/kernel/spline/spline.h"
#include "molsurf/surface.h"
#include "support/molecules.h"

#include <utility>
#include <vector>

namespace molsurf::test
{

inline MolecularSurface runOn(const std::vector<Ball>& balls, const SurfaceOptions& options = {})
{
    Progress progress;
    return makeSurface(balls, options, &progress);
}

/// S as the field "spline" holds it.
inline Spline splineFrom(const MolecularSurface& result)
{
    for (const auto& field : result.fields) {
        if (field->getName() == "spline")
            return {fromGrid(dynamic_cast<const openvdb::FloatGrid&>(*field))};
    }
    return Spline();
}

/// Largest rise of the energy in a step, relative.
inline double largestRise(const EvolutionReport& report)
{
    double rise = 0.0;
    for (std::size_t i = 1; i < report.energy.size(); ++i)
        rise = std::max(rise, report.energy[i] / report.energy[i - 1] - 1.0);
    return rise;
}

} // namespace molsurf::test
