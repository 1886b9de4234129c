// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The gaps of a sum of Gaussians: found, decided and held.

#include "molsurf/kernel/levelset/gaussian_sum.h"
#include "molsurf/kernel/topology/closed_passages.h"
#include "molsurf/kernel/topology/gaps.h"

#include <cstdint>
#include <vector>

namespace molsurf
{

/// Gaps and what is decided of each, and what the field closes.
struct DecidedGaps {
    std::vector<Gap> gaps;
    std::vector<Decision> decisions;
    std::vector<ClosedPassage> passages; ///< if the rule asks for them
};

/// Finds the gaps of a sum, decides them by decideGaps(), and makes the bumps of holdGaps().
/// @param[in]  psi     of the sum where bounds do not decide its sign: see GaussianSum::BumpsFor
/// @param[out] report   how they were decided
/// @param[out] decided  null, or the gaps and their decisions, and what the field closes
/// @return for GaussianSum::band()
Bumps bumpsOfGaps(const GaussianSum& sum, const SparseField& psi, const GapRule& rule,
                  const Progress& progress, GapReport& report, DecidedGaps* decided = nullptr);

/// How a bump changes as a ball moves: derivatives by the place of the ball.
struct BumpMotion {
    std::int32_t ball;
    Bump bump;
    openvdb::Mat3d place;     ///< column a is that of the bump's place by coordinate a, no unit
    openvdb::Vec3d amplitude; ///< [1/Å]
    openvdb::Vec3d rate;      ///< [1/Å^3]
};

/// Finds how the bumps of gaps follow the balls about them while decisions stay: a gap moves to
/// where grad psi is 0 again, and its bump is made anew. By central differences.
/// @param[in] sum      without or with its bumps
/// @param[in] voxel    that the bumps were made for [Å]
/// @return in the order of balls; without those whose terms are below a thousandth at every gap
std::vector<BumpMotion> motionsOfBumps(const GaussianSum& sum, const DecidedGaps& decided,
                                       double voxel, const Progress& progress);

} // namespace molsurf
