// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Which gaps of a molecule are open. The topology of psi = 0 changes at critical points of psi
/// only. Where one is near the level, a grid, its place and the steps of a flow would decide.
/// Instead psi decides, and is changed there such that voxels hold the decision. docs/math.md,
/// section 2.

#include "molsurf/levelset/bumps.h"
#include "molsurf/report.h"

#include <functional>
#include <optional>
#include <vector>

namespace molsurf
{

/// psi, its gradient and its Hessian at a point.
struct PsiJet {
    double psi;
    openvdb::Vec3d gradient; ///< [1/Å]
    openvdb::Mat3d hessian;  ///< [1/Å^2]
};
using PsiJetAt = std::function<PsiJet(const openvdb::Vec3d&)>;

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
    bool countsClosed = true; ///< whether the report has what the field closes: not where balls
                              ///< have rates of their own
};

/// The gaps farther than this from psi = 0 are none.
constexpr double farthestGap = 1.6;

/// psi at places that no ball covers is at most this, the logarithm of the number of balls about
/// them.
constexpr double highestUncovered = 4.6;

/// The gap that Newton's method leads to from a point, if it does not lead farther than `reach`
/// [Å], and if there is one.
/// @param[in] highest  psi is at most this there
std::optional<Gap> gapNear(const PsiJetAt& jet, const openvdb::Vec3d& from, double reach,
                           double highest = farthestGap);

/// A place as a gap, if its curvatures can be found.
std::optional<Gap> gapAt(const openvdb::Vec3d& place, const PsiJet& there);

/// Sorts by place and removes duplicates.
std::vector<Gap> distinct(std::vector<Gap> gaps);

/// Whether one of some that ascend by places, the last of which has no larger x, is at a place.
template<typename Placed>
bool standsAmong(const std::vector<Placed>& some, const openvdb::Vec3d& place, double same)
{
    for (auto o = some.rbegin(); o != some.rend() && place.x() - o->place.x() <= same; ++o)
        if ((place - o->place).length() < same) return true;
    return false;
}

using GapReport = EvolutionReport::Gaps;

/// Decides gaps. Where one is closed, psi becomes positive about it, and where it is open it
/// becomes at least as wide as voxels hold.
/// @param[in]     gaps   distinct; those above farthestGap are left out
/// @param[in,out] bumps  those that do so are added
GapReport decideGaps(const PsiJetAt& jet, std::vector<Gap> gaps, const GapRule& rule,
                     double voxelSize, Bumps& bumps);

} // namespace molsurf
