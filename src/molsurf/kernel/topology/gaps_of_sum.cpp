// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/topology/gaps_of_sum.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/topology/closed_passages.h"
#include "molsurf/kernel/topology/critical_points.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace molsurf
{

using openvdb::Mat3d;
using openvdb::Vec3d;

Bumps bumpsOfGaps(const GaussianSum& sum, const SparseField& psi, const GapRule& rule,
                  const Progress& progress, GapReport& report, DecidedGaps* decided)
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
    if (!decided) return bumps;
    *decided = {gaps, decisions, {}};
    if (rule.countsClosed) {
        const PassageField field{
            jet, [&](const Vec3d& x) { return sum.roomAt(x); },
            [&](const Vec3d& x, double times) { return sum.sharpenedJet(x, times); }};
        decided->passages = closedPassages(all, field, rule, sum.epsilon(), progress);
    }
    return bumps;
}

namespace
{

/// The term of a ball in the sum: exp(level - rate |x - center|^2).
struct BallTerm {
    Vec3d center; ///< [Å]
    double level, rate;

    double exponent(const Vec3d& x) const { return level - rate * (x - center).lengthSqr(); }
};

/// e^(psi - psi_0) with its derivatives. It is linear in the terms of the sum.
struct SumJet {
    double value;
    Vec3d gradient;
    Mat3d hessian;

    /// Adds a term, `sign` times.
    void add(const BallTerm& term, const Vec3d& x, double psi0, double sign)
    {
        const Vec3d u = 2.0 * term.rate * (x - term.center);
        const double t = sign * std::exp(term.exponent(x) - psi0);
        value += t;
        gradient -= t * u;
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) hessian(a, b) += t * u[a] * u[b];
            hessian(a, a) -= t * 2.0 * term.rate;
        }
    }
};

Mat3d outer(const Vec3d& a, const Vec3d& b)
{
    return Mat3d(a[0] * b, a[1] * b, a[2] * b, true);
}

/// psi with one ball elsewhere.
PsiJet movedJet(const GaussianSum& sum, const BallTerm& from, const BallTerm& to, const Vec3d& x)
{
    const PsiJet jet = sum.jet(x);
    SumJet all{1.0, jet.gradient, jet.hessian + outer(jet.gradient, jet.gradient)};
    all.add(from, x, jet.psi, -1.0);
    all.add(to, x, jet.psi, 1.0);
    const Vec3d gradient = all.gradient / all.value;
    return {jet.psi + std::log(all.value), gradient,
            all.hessian * (1.0 / all.value) - outer(gradient, gradient)};
}

/// The bumps of some gaps, each of which has moved to where grad psi is 0 again; none if one has
/// gone.
std::vector<Bump> movedBumps(const PsiJetAt& jet, const DecidedGaps& some, double voxel)
{
    std::vector<Gap> gaps;
    for (const Gap& gap : some.gaps) {
        const auto moved = gapNear(jet, gap.place, gapReach(voxel), highestUncovered);
        if (!moved) return {};
        gaps.push_back(*moved);
    }
    Bumps bumps(voxel);
    holdGaps(jet, gaps, some.decisions, voxel, bumps);
    return bumps.all();
}

/// A ball and the gaps in which its term counts.
struct BallAtGaps {
    std::int32_t ball;
    BallTerm term;
    std::vector<std::size_t> gaps; ///< ascending
};

/// The balls with a share of psi at gaps, in ascending order.
std::vector<BallAtGaps> ballsAt(const GaussianSum& sum, const std::vector<Gap>& gaps)
{
    constexpr double leastShare = 1e-3;
    std::map<std::int32_t, BallAtGaps> found;
    for (std::size_t k = 0; k < gaps.size(); ++k) {
        const double least = gaps[k].psi + std::log(leastShare);
        sum.forEachTerm(
            gaps[k].place, [&](std::int32_t ball, double exponent, double rate, const Vec3d& way) {
                if (exponent < least) return;
                BallAtGaps& at = found[ball];
                at.ball = ball;
                at.term = {gaps[k].place - way, exponent + rate * way.lengthSqr(), rate};
                at.gaps.push_back(k);
            });
    }
    std::vector<BallAtGaps> out;
    for (auto& [ball, at] : found) out.push_back(std::move(at));
    return out;
}

/// Some gaps and those whose bumps are felt there, in their order.
DecidedGaps withNeighbours(const DecidedGaps& all, const std::vector<std::size_t>& some,
                           double voxel)
{
    const double felt = bumpReach(voxel);
    DecidedGaps out;
    for (std::size_t k = 0; k < all.gaps.size(); ++k) {
        const bool isNear = std::any_of(some.begin(), some.end(), [&](std::size_t i) {
            return (all.gaps[i].place - all.gaps[k].place).length() < felt;
        });
        if (!isNear) continue;
        out.gaps.push_back(all.gaps[k]);
        out.decisions.push_back(all.decisions[k]);
    }
    return out;
}

/// The motions of the bumps about one ball.
std::vector<BumpMotion> motionsBy(const BallAtGaps& at, const GaussianSum& sum,
                                  const DecidedGaps& some, double voxel)
{
    constexpr double step = 0.02; // [Å]
    const auto bumpsWith = [&](const Vec3d& way) {
        BallTerm to = at.term;
        to.center += way;
        return movedBumps([&](const Vec3d& x) { return movedJet(sum, at.term, to, x); }, some,
                          voxel);
    };
    std::vector<BumpMotion> out;
    for (const Bump& bump : bumpsWith(Vec3d(0.0)))
        out.push_back({at.ball, bump, Mat3d::zero(), Vec3d(0.0), Vec3d(0.0)});
    for (int a = 0; a < 3; ++a) {
        Vec3d way(0.0);
        way[a] = step;
        const std::vector<Bump> up = bumpsWith(way), down = bumpsWith(-way);
        if (up.size() != out.size() || down.size() != out.size()) return {}; // one comes or goes
        for (std::size_t i = 0; i < out.size(); ++i) {
            const Vec3d place = (up[i].place - down[i].place) / (2.0 * step);
            for (int b = 0; b < 3; ++b) out[i].place(b, a) = place[b];
            out[i].amplitude[a] = (up[i].amplitude - down[i].amplitude) / (2.0 * step);
            out[i].rate[a] = (up[i].rate - down[i].rate) / (2.0 * step);
        }
    }
    return out;
}

} // namespace

std::vector<BumpMotion> motionsOfBumps(const GaussianSum& sum, const DecidedGaps& decided,
                                       double voxel, const Progress& progress)
{
    const std::vector<BallAtGaps> balls = ballsAt(sum, decided.gaps);
    std::vector<std::vector<BumpMotion>> parts(balls.size());
    parallelFor(balls.size(), progress, [&](std::size_t i) {
        parts[i] = motionsBy(balls[i], sum, withNeighbours(decided, balls[i].gaps, voxel), voxel);
    });
    std::vector<BumpMotion> out;
    for (const std::vector<BumpMotion>& part : parts)
        out.insert(out.end(), part.begin(), part.end());
    return out;
}

} // namespace molsurf
