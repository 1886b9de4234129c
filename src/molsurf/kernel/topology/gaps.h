// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Which gaps of a molecule are open: the topology of psi = 0 changes at critical points of psi
/// only. Where one is near the level, psi decides. docs/math.md, section 2.

#include "molsurf/kernel/levelset/bumps.h"
#include "molsurf/kernel/levelset/psi_jet.h"
#include "molsurf/kernel/topology/decision.h"

#include <optional>
#include <vector>

namespace molsurf
{

/// A critical point of psi near its zero: the middle of a cavity, the narrowest place of a tunnel,
/// or that of a slit between two bodies.
struct Gap {
    openvdb::Vec3d place;      ///< [Å], to 2^-16
    double psi;                ///< there
    openvdb::Vec3d curvatures; ///< eigenvalues of the Hessian there, ascending [1/Å^2]
    openvdb::Vec3d axes[2];    ///< directions of the first and of the last of them

    /// The value above which tension closes it: from there on the cavity, tunnel or slit has no
    /// rest of its own, by the energies of the level sets about it.
    /// @param[in] gradient,area  lambda of the regularisers, one of them 0
    double closedAbove(double gradient, double area) const;
};

/// Weights and atoms that decide gaps.
struct GapRule {
    double gradient = 0.0;    ///< lambda of the gradient regulariser [Å^2]
    double area = 0.0;        ///< lambda of the area regulariser
    bool countsClosed = true; ///< whether what the field closes is looked for: not where balls
                              ///< have rates of their own
};

/// The gaps farther than this from psi = 0 are none.
constexpr double farthestGap = 1.6;

/// psi at places that no ball covers is at most this, the logarithm of the number of balls about
/// them.
constexpr double highestUncovered = 4.6;

/// How far from where it is looked for a gap may lie [Å].
double gapReach(double voxelSize);

/// The gap that Newton's method leads to from a point, if it does not lead farther than `reach`
/// [Å], and if there is one.
/// @param[in] highest  psi is at most this there
std::optional<Gap> gapNear(const PsiJetAt& jet, const openvdb::Vec3d& from, double reach,
                           double highest = farthestGap);

/// A place as a gap, if its curvatures can be found.
std::optional<Gap> gapAt(const openvdb::Vec3d& place, const PsiJet& there);

/// Sorts by place and removes duplicates.
std::vector<Gap> distinct(std::vector<Gap> gaps);

/// How far the bump counts that holds a gap, if it does not cover a wide pocket [Å].
double bumpReach(double voxelSize);

/// Decides gaps: each is closed if psi there is above Gap::closedAbove().
/// @param[in] gaps  distinct, none above farthestGap
/// @return one a gap
std::vector<Decision> decideGaps(const std::vector<Gap>& gaps, const GapRule& rule);

/// Holds decisions: where a gap is closed, psi becomes positive about it, and where it is open it
/// becomes at least as wide as voxels hold.
/// @param[in]     decisions  of the gaps
/// @param[in,out] bumps      those that do so are added
void holdGaps(const PsiJetAt& jet, const std::vector<Gap>& gaps,
              const std::vector<Decision>& decisions, double voxelSize, Bumps& bumps);

} // namespace molsurf
