// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/topology/decision.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

GapReport reportOf(const std::vector<Decision>& decisions, double farthest)
{
    GapReport report;
    report.found = decisions.size();
    report.nearest = farthest;
    for (const Decision& decision : decisions) {
        report.closed += decision.closed() && !decision.byItself;
        report.nearest = std::min(report.nearest, std::abs(decision.beyond));
    }
    return report;
}

} // namespace molsurf
