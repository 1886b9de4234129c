// SPDX-License-Identifier: MPL-2.0
#include "molsurf/topology/gaps_of_sum.h"

#include "molsurf/topology/closed_passages.h"
#include "molsurf/topology/critical_points.h"

#include <algorithm>
#include <iterator>

namespace molsurf
{

using openvdb::Vec3d;

Bumps bumpsOfGaps(const GaussianSum& sum, const SparseField& psi, const GapRule& rule,
                  const Progress& progress, GapReport& report)
{
    const PsiJetAt jet = [&](const Vec3d& x) { return sum.jet(x); };
    const auto covered = [&](const Vec3d& x, double more) { return sum.isCovered(x, more); };
    const std::vector<Gap> all = findCriticalPoints(psi, jet, covered, progress);
    std::vector<Gap> gaps;
    std::copy_if(all.begin(), all.end(), std::back_inserter(gaps),
                 [](const Gap& gap) { return gap.psi <= farthestGap; });
    const std::vector<Decision> decisions = decideGaps(gaps, rule);
    Bumps bumps(psi.voxelSize);
    holdGaps(jet, gaps, decisions, psi.voxelSize, bumps);
    report = reportOf(decisions, farthestGap);
    if (rule.countsClosed) {
        const PassageField field{
            jet, [&](const Vec3d& x) { return sum.roomAt(x); },
            [&](const Vec3d& x, double times) { return sum.sharpenedJet(x, times); }};
        countClosedByField(all, field, rule, sum.epsilon(), report);
    }
    return bumps;
}

} // namespace molsurf
