// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Passages that the field closes although a probe fits into them: psi adds up the balls about a
/// passage, so that it may be positive where no ball covers it. docs/math.md, section 2.

#include "molsurf/kernel/topology/gaps.h"
#include "molsurf/progress.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace molsurf
{

/// psi and the balls that it is of.
struct PassageField {
    PsiJetAt jet;
    /// How far a point lies outside all balls of radius R_i [Å]; negative inside one.
    std::function<double(const openvdb::Vec3d&)> room;
    /// psi at a point, with a tolerance so many times smaller.
    std::function<PsiJet(const openvdb::Vec3d&, double)> sharpened;
};

/// A place that the field closes although no ball covers it.
struct ClosedPassage {
    openvdb::Vec3d place; ///< [Å]
    double room;          ///< beside the probe [Å], > 0
    double opensBelow;    ///< the tolerance eps at which it opens [Å]
    std::size_t pore;     ///< of those with this number, no ball lies between one and the next
};

/// Finds the places that the field closes.
/// @param[in] gaps  distinct
std::vector<ClosedPassage> closedPassages(const std::vector<Gap>& gaps, const PassageField& field,
                                          const GapRule& rule, double epsilon,
                                          const Progress& progress);

/// Counts the pores in which a surface is closed. It may lie inside of the interface, and then is
/// open where what closes that is thin.
/// @param[in] isClosed  whether a place lies inside of the surface
/// @param[in,out] report  gets closedByField, widestClosed and opensBelow
void countClosed(const std::vector<ClosedPassage>& passages,
                 const std::function<bool(const openvdb::Vec3d&)>& isClosed, GapReport& report);

} // namespace molsurf
