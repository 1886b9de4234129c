// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/topology/gaps.h"

#include "molsurf/kernel/core/parallel.h"

#include <openvdb/math/Mat3.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// Places and amplitudes are multiples of this, so that what is computed about them has the same
/// bits from wherever they were found; places in Å.
constexpr double finest = 0x1p-16;

double rounded(double x)
{
    return std::round(x / finest) * finest;
}

/// The gradient of psi at a critical point is below this [1/Å]. Where it turns by 1/Å^2, the point
/// is known to as much [Å], and two that are nearer are one.
constexpr double exact = 1e-3;

/// The bump at a gap with which psi is `least` at it, and within `reach` of it along its thin axis
/// not of the other sign.
/// @param[in] solid  whether the gap is closed: psi is positive there
/// @param[in] psi    with the bumps so far at the gap, and `reach` on both sides of it
Bump bumpAt(const Gap& gap, bool solid, double reach, double rate, const std::array<double, 3>& psi)
{
    constexpr double least = 0.15;  // psi at the gap
    constexpr double slowest = 0.3; // [1/Å^2]
    // With `side` psi is to be positive in both cases.
    const double side = solid ? 1.0 : -1.0, here = side * psi[0];
    // A pocket that closes is to be covered as far as it reaches: psi is 0 at x^2 = -2 here / rise,
    // where the bump falls to 1/e.
    for (int i = 0; i < 3 && here < 0.0; ++i) {
        const double rise = side * gap.curvatures[i];
        if (rise > 0.0) rate = std::clamp(-0.5 * rise / here, std::min(slowest, rate), rate);
    }
    double amplitude = least - here;
    const double thin = solid ? -gap.curvatures[0] : gap.curvatures[2];
    if (thin > 0.0) {
        const double lacks = least - std::min(side * psi[1], side * psi[2]);
        amplitude = std::max(amplitude, lacks * std::exp(rate * reach * reach));
    }
    return {gap.place, side * rounded(amplitude), rate};
}

/// The rate of the bump at a gap that is no wide pocket: half of it is left one voxel away [1/Å^2].
double rateFor(double voxelSize)
{
    constexpr double sharpest = 1.4; // [1/Å^2]
    return std::min(sharpest, 0.7 / (voxelSize * voxelSize));
}

} // namespace

double gapReach(double voxelSize)
{
    return std::max(1.5 * voxelSize, 0.75);
}

double bumpReach(double voxelSize)
{
    return reachOf({Vec3d(0.0), 1.0, rateFor(voxelSize)});
}

double Gap::closedAbove(double gradient, double area) const
{
    // Between slits, cylinders and balls, for which psi quadratic gives it in closed form: with m
    // the curvature across, at 1, 3.93 and 7.46 lambda m. Real gaps close at twice that: their
    // walls are straighter than parabolas.
    constexpr double walls = 2.0, most = 1.5;
    double m[3];
    for (int i = 0; i < 3; ++i) m[i] = std::max(curvatures[2 - i], 0.0);
    double level = gradient * (m[0] + 2.93 * m[1] + 3.53 * m[2]);
    if (m[0] > 0.0) level += std::sqrt(area * (1.25 * m[1] + 1.75 * m[2]) / m[0]);
    return -std::min(walls * level, most);
}

std::vector<Gap> distinct(std::vector<Gap> gaps)
{
    std::sort(gaps.begin(), gaps.end(),
              [](const Gap& a, const Gap& b) { return a.place < b.place; });
    std::vector<Gap> out;
    for (const Gap& gap : gaps)
        if (!isAmong(out, gap.place, exact)) out.push_back(gap);
    return out;
}

std::optional<Gap> gapAt(const Vec3d& place, const PsiJet& there)
{
    openvdb::Mat3d axes;
    Vec3d values;
    if (!openvdb::math::diagonalizeSymmetricMatrix(there.hessian, axes, values)) return {};
    int order[3] = {0, 1, 2};
    std::sort(order, order + 3, [&](int a, int b) { return values[a] < values[b]; });
    return Gap{place,
               there.psi,
               Vec3d(values[order[0]], values[order[1]], values[order[2]]),
               {axes.col(order[0]), axes.col(order[2])}};
}

std::optional<Gap> gapNear(const PsiJetAt& jet, const Vec3d& from, double reach, double highest)
{
    constexpr double longest = 0.3; // a step [Å]
    constexpr int steps = 12;
    Vec3d x = from, last(0.0);
    for (int i = 0; i < steps; ++i) {
        const PsiJet at = jet(x);
        if (std::abs(at.hessian.det()) < 1e-6) return {};
        Vec3d step = at.hessian.inverse() * at.gradient;
        const double length = step.length();
        if (length > longest) step *= longest / length;
        if (step.dot(last) < -0.9 * last.lengthSqr()) return {}; // to and fro, for ever
        last = step;
        x -= step;
        if ((x - from).length() > reach) return {};
        if (length < finest) break;
    }
    for (int a = 0; a < 3; ++a) x[a] = rounded(x[a]);
    const PsiJet at = jet(x);
    if (at.gradient.length() > exact || at.psi < -farthestGap || at.psi > highest) return {};
    return gapAt(x, at);
}

std::vector<Decision> decideGaps(const std::vector<Gap>& gaps, const GapRule& rule)
{
    std::vector<Decision> out;
    for (const Gap& gap : gaps) {
        const double level = gap.closedAbove(rule.gradient, rule.area);
        out.push_back({gap.place, gap.psi - level, gap.psi >= 0.0});
    }
    return out;
}

void holdGaps(const PsiJetAt& jet, const std::vector<Gap>& gaps,
              const std::vector<Decision>& decisions, double voxelSize, Bumps& bumps)
{
    constexpr double held = 0.7;   // half a gap that voxels hold [voxel]
    constexpr double widest = 0.5; // [Å]
    const double reach = std::min(held * voxelSize, widest), rate = rateFor(voxelSize);
    std::vector<std::array<Vec3d, 3>> places(gaps.size());
    std::vector<std::array<double, 3>> alone(gaps.size()); // psi there, without bumps
    parallelFor(gaps.size(), Progress(), [&](std::size_t i) {
        const Vec3d way = reach * gaps[i].axes[decisions[i].closed() ? 0 : 1];
        places[i] = {gaps[i].place, gaps[i].place - way, gaps[i].place + way};
        for (std::size_t k = 0; k < 3; ++k) alone[i][k] = jet(places[i][k]).psi;
    });
    for (int pass = 0; pass < 2; ++pass) { // what is done for one may undo what was for another
        for (std::size_t i = 0; i < gaps.size(); ++i) {
            const bool solid = decisions[i].closed();
            std::array<double, 3> psi = alone[i];
            for (std::size_t k = 0; k < 3; ++k) psi[k] += bumps.at(places[i][k]);
            const Bump bump = bumpAt(gaps[i], solid, reach, rate, psi);
            if (bump.amplitude * (solid ? 1.0 : -1.0) > 1e-6) bumps.add(bump);
        }
    }
}

} // namespace molsurf
