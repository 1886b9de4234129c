// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Passages that the field closes although a probe fits into them: psi adds up the balls about a
/// passage, so that it may be positive where no ball covers it. docs/math.md, section 2.

#include "molsurf/topology/gaps.h"

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

/// Counts the passages and voids that the field closes although no ball covers them, and in which
/// the surface is closed too: it lies rule.inset farther inside. Those in one pore are one.
/// @param[in] gaps  distinct
/// @param[in,out] report  gets closedByField, widestClosed and opensBelow
void countClosedByField(const std::vector<Gap>& gaps, const PassageField& field,
                        const GapRule& rule, double epsilon, GapReport& report);

} // namespace molsurf
