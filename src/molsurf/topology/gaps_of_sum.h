// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The gaps of a sum of Gaussians: found, decided and held.

#include "molsurf/levelset/gaussian_sum.h"
#include "molsurf/topology/gaps.h"

namespace molsurf
{

/// Finds the gaps of a sum, decides them by decideGaps(), and makes the bumps of holdGaps().
/// @param[in]  psi     of the sum where bounds do not decide its sign: see GaussianSum::BumpsFor
/// @param[out] report  how they were decided, and what the field closes if the rule says so
/// @return for GaussianSum::band()
Bumps bumpsOfGaps(const GaussianSum& sum, const SparseField& psi, const GapRule& rule,
                  const Progress& progress, GapReport& report);

} // namespace molsurf
