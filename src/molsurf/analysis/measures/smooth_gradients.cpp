// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/smooth_gradients.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/flow/equilibrium.h"
#include "molsurf/kernel/flow/evolve.h"
#include "molsurf/kernel/levelset/gaussian_sum.h"
#include "molsurf/kernel/mesh/patch_gradients.h"
#include "molsurf/kernel/pipeline/carrier_of.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/kernel/topology/gaps_of_sum.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

namespace molsurf
{

using openvdb::Mat3d;
using openvdb::Vec3d;

namespace
{

/// A term of the sum at a point: its share p of it, and u = 2 C (x - x_i). So grad psi is minus the
/// mean of u, and its Hessian the mean of u u - 2 C, less mean times mean.
struct Share {
    std::int32_t ball;
    double p, rate; ///< rate: C [1/Å^2]
    Vec3d u;        ///< [1/Å]
};

/// The terms at a point, and what is made of them.
struct PointTerms {
    std::vector<Share> shares;
    Vec3d mean{0.0};              ///< of u
    Mat3d square = Mat3d::zero(); ///< of u u - 2 C

    /// Makes the shares by softmax, without terms of less than e^-negligible of the largest.
    void find(const GaussianSum& sum, const Vec3d& x)
    {
        shares.clear();
        double top = -1e30, total = 0.0;
        sum.forEachTerm(x, [&](std::int32_t ball, double exponent, double rate, const Vec3d& way) {
            shares.push_back({ball, exponent, rate, 2.0 * rate * way}); // p: the exponent, for now
            top = std::max(top, exponent);
        });
        const auto isSmall = [&](const Share& s) { return s.p < top - double(negligible); };
        shares.erase(std::remove_if(shares.begin(), shares.end(), isSmall), shares.end());
        for (Share& s : shares) total += s.p = std::exp(s.p - top);
        mean = Vec3d(0.0);
        square = Mat3d::zero();
        for (Share& s : shares) {
            s.p /= total;
            mean += s.p * s.u;
            for (int a = 0; a < 3; ++a) {
                for (int b = 0; b < 3; ++b) square(a, b) += s.p * s.u[a] * s.u[b];
                square(a, a) -= s.p * 2.0 * s.rate;
            }
        }
    }
};

/// The derivatives of psi - v at a fixed point by the places of the balls that have terms there.
class LevelResponse
{
public:
    /// @param[in] jet    of psi, with bumps
    /// @param[in] level  at rest, with its derivatives
    LevelResponse(const PointTerms& terms, const PsiJet& jet, const RestLevel& level)
        : terms_(terms), level_(level), slope_(jet.gradient.length()), up_(jet.gradient / slope_),
          along_(jet.hessian * up_)
    {
    }

    /// d(psi - v)/dx_i of a term [1/Å] by the chain rule: v depends on the slope a = |grad psi|,
    /// the second derivative m = N.Hess psi N and the curvature kappa = (m - trace Hess psi)/a.
    Vec3d of(const Share& s) const
    {
        const Vec3d& N = up_;
        const auto ofGradient = [&](const Vec3d& w) { // d(w . grad psi)
            return -s.p * (w.dot(s.u - terms_.mean) * s.u - 2.0 * s.rate * w);
        };
        const double NMN = N.dot(terms_.square * N), Nu = N.dot(s.u), C = s.rate;
        const double trace = terms_.square(0, 0) + terms_.square(1, 1) + terms_.square(2, 2);
        const Vec3d dSlope = ofGradient(N);
        const Vec3d dSecond = s.p * ((Nu * Nu - 2.0 * C - NMN) * s.u - 4.0 * C * Nu * N) +
                              2.0 * N.dot(terms_.mean) * dSlope +
                              2.0 / slope_ * ofGradient(along_ - N.dot(along_) * N);
        const Vec3d dTrace =
            s.p * (s.u.lengthSqr() - 10.0 * C - trace) * s.u + 2.0 * ofGradient(terms_.mean);
        const Vec3d dKappa = (dSecond - dTrace - level_.kappa * dSlope) / slope_;
        return s.p * s.u -
               (level_.bySlope * dSlope + level_.bySecond * dSecond + level_.byKappa * dKappa);
    }

private:
    const PointTerms& terms_;
    const RestLevel& level_;
    double slope_;
    Vec3d up_, along_; // N = grad psi/|grad psi| and Hess psi N
};

/// The bumps that move with balls, by the cells of space that they reach.
class MovingBumps
{
public:
    explicit MovingBumps(std::vector<BumpMotion> motions) : motions_(std::move(motions))
    {
        for (const BumpMotion& motion : motions_) {
            const Vec3d reach(reachOf(motion.bump));
            const openvdb::CoordBBox cells(cellOf(motion.bump.place - reach),
                                           cellOf(motion.bump.place + reach));
            for (auto cell = cells.begin(); cell; ++cell) cells_[*cell].push_back(&motion);
        }
    }

    /// Calls f(ball, d) for the balls that move a bump about a point, d being the derivatives of
    /// psi - v there [1/Å].
    template<typename F>
    void forEach(const Vec3d& x, const PsiJet& jet, const RestLevel& level, const F& f) const
    {
        const auto found = cells_.find(cellOf(x));
        if (found == cells_.end()) return;
        for (const BumpMotion* motion : found->second) {
            if ((x - motion->bump.place).length() > reachOf(motion->bump)) continue;
            Vec3d change(0.0);
            for (int a = 0; a < 3; ++a)
                change[a] = levelChange(jet, level, jetChange(*motion, a, x));
            f(motion->ball, change);
        }
    }

private:
    static openvdb::Coord cellOf(const Vec3d& x)
    {
        constexpr double edge = 4.0; // [Å]
        return openvdb::Coord::floor(x / edge);
    }

    /// The derivatives of a bump's jet at a point by coordinate a of the ball.
    static PsiJet jetChange(const BumpMotion& motion, int a, const Vec3d& x)
    {
        constexpr double step = 1e-3; // [Å]
        const auto moved = [&](double way) {
            Bump bump = motion.bump;
            bump.place += way * Vec3d(motion.place(0, a), motion.place(1, a), motion.place(2, a));
            bump.amplitude += way * motion.amplitude[a];
            bump.rate += way * motion.rate[a];
            return jetOf(bump, x);
        };
        const PsiJet up = moved(step), down = moved(-step);
        constexpr double per = 1.0 / (2.0 * step);
        return {per * (up.psi - down.psi), per * (up.gradient - down.gradient),
                (up.hessian - down.hessian) * per};
    }

    /// The change of psi - v by that of the jet.
    static double levelChange(const PsiJet& jet, const RestLevel& level, const PsiJet& by)
    {
        const double slope = jet.gradient.length();
        const Vec3d N = jet.gradient / slope;
        const double dSlope = N.dot(by.gradient);
        const Vec3d dN = (by.gradient - dSlope * N) / slope;
        const double dSecond = N.dot(by.hessian * N) + 2.0 * dN.dot(jet.hessian * N);
        const double dTrace = by.hessian(0, 0) + by.hessian(1, 1) + by.hessian(2, 2);
        const double dKappa = (dSecond - dTrace - level.kappa * dSlope) / slope;
        return by.psi -
               (level.bySlope * dSlope + level.bySecond * dSecond + level.byKappa * dKappa);
    }

    std::vector<BumpMotion> motions_;
    std::unordered_map<openvdb::Coord, std::vector<const BumpMotion*>> cells_;
};

/// The interface that a surface lies inside of by an offset.
struct Interface {
    const GaussianSum& sum;
    const MovingBumps& bumps;
    double offset;     ///< [Å]
    double leastSlope; ///< psi counts as at least so steep [1/Å]
    Weights weights;

    RestLevel levelOf(const PsiJet& jet) const { return levelAtRest(jet, leastSlope, weights); }
    double at(const Vec3d& x) const
    {
        const PsiJet jet = sum.jetWithBumps(x);
        return jet.psi - levelOf(jet).v;
    }
    /// The derivative of psi - v along a direction, inward: positive.
    double slopeAlong(const Vec3d& x, const Vec3d& outward) const
    {
        constexpr double step = 0.01; // [Å]
        return std::max((at(x - step * outward) - at(x + step * outward)) / (2.0 * step),
                        leastSlope);
    }
};

/// The way from a point of the surface to the interface along the normal, less the offset [Å], by
/// two Newton steps from where the offset expects it.
double beyondOffset(const Interface& interface, const Vec3d& point, const Vec3d& normal)
{
    constexpr int steps = 2;
    constexpr double farthest = 0.3; // from where it is expected [Å]
    double way = 0.0;
    for (int i = 0; i < steps; ++i) {
        const PsiJet jet = interface.sum.jetWithBumps(point + (interface.offset + way) * normal);
        const double slope = std::max(-jet.gradient.dot(normal), interface.leastSlope);
        way += (jet.psi - interface.levelOf(jet).v) / slope;
        way = std::clamp(way, -farthest, farthest);
    }
    return way;
}

/// Derivatives of a ball from some nodes.
struct Sum {
    Vec3d volume{0.0}, area{0.0};
    double roundedVolume = 0.0, roundedArea = 0.0; ///< sizes of what nodes of ridges add

    void operator+=(const Sum& o)
    {
        volume += o.volume;
        area += o.area;
        roundedVolume += o.roundedVolume;
        roundedArea += o.roundedArea;
    }
};
using Sums = std::map<std::int32_t, Sum>;

/// Adds what the motion of a node contributes to the derivatives by the balls that have terms at
/// its foot. Each x_i moves it by `speed` along the normal, and by p tangentially.
void addNode(const Interface& interface, const PatchNodes& nodes, std::size_t node,
             PointTerms& terms, Sums& sums)
{
    constexpr double rounded = 0.005; // a node that lies so far from the offset is of a ridge [Å]
    const Vec3d &point = nodes.points[node], &normal = nodes.normals[node];
    const double beyond = beyondOffset(interface, point, normal);
    const Vec3d foot = point + (interface.offset + beyond) * normal;
    const bool isRounded = interface.offset > 0.0 && std::abs(beyond) > rounded;
    const PsiJet jet = interface.sum.jetWithBumps(foot);
    const bool isKnown = jet.gradient.length() > 1e-3; // else psi does not say where to
    terms.find(interface.sum, foot);
    const RestLevel level = interface.levelOf(jet);
    const LevelResponse response(terms, jet, level);
    const double slope = interface.slopeAlong(foot, normal);
    thread_local std::vector<Vec3d> speeds; // of the node along the normal, by each x_i
    speeds.clear();
    Vec3d rest = normal; // what they lack: a translation of all balls is one of the node
    for (const Share& s : terms.shares)
        speeds.push_back(isKnown ? response.of(s) / slope : Vec3d(0.0));
    if (isKnown)
        interface.bumps.forEach(foot, jet, level, [&](std::int32_t ball, const Vec3d& change) {
            const auto share = std::find_if(terms.shares.begin(), terms.shares.end(),
                                            [&](const Share& s) { return s.ball == ball; });
            if (share != terms.shares.end())
                speeds[std::size_t(share - terms.shares.begin())] += change / slope;
        });
    for (const Vec3d& speed : speeds) rest -= speed;
    for (std::size_t i = 0; i < terms.shares.size(); ++i) {
        const Share& s = terms.shares[i];
        const Vec3d speed = speeds[i] + s.p * rest;
        const auto motion = [&](const Vec3d& by) {
            const double along = by.dot(normal);
            return along * speed + s.p * (by - along * normal);
        };
        Sum& sum = sums[s.ball];
        const Vec3d volume = motion(nodes.volume[node]), area = motion(nodes.area[node]);
        sum.volume += volume;
        sum.area += area;
        if (!isRounded) continue;
        sum.roundedVolume += volume.length();
        sum.roundedArea += area.length();
    }
}

/// Marks the balls with a share of psi at the place of a bump. Inside of an interface, ridges about
/// the place are rounded, and how that follows the balls is left out.
std::vector<char> ballsBesideGaps(const GaussianSum& sum, std::size_t balls)
{
    constexpr double leastShare = 0.05; // of the terms there
    std::vector<char> out(balls, 0);
    for (const Bump& bump : sum.bumps().all()) {
        const double psi = sum.jet(bump.place).psi;
        sum.forEachTerm(bump.place, [&](std::int32_t ball, double exponent, double, const Vec3d&) {
            if (std::exp(exponent - psi) > leastShare) out[std::size_t(ball)] = 1;
        });
    }
    return out;
}

/// Marks the balls of whose derivatives nodes of ridges make up a part that counts. A ridge is
/// rounded, and how the rounding follows the balls is left out.
std::vector<char> ballsBesideRidges(const std::vector<Sum>& sums)
{
    constexpr double counts = 0.005; // of the root mean square of all components
    Vec3d squares(0.0);              // of volume and area
    for (const Sum& sum : sums) squares += Vec3d(sum.volume.lengthSqr(), sum.area.lengthSqr(), 0.0);
    const double least = counts / std::sqrt(3.0 * double(sums.size()));
    std::vector<char> out;
    for (const Sum& sum : sums)
        out.push_back(sum.roundedVolume > least * std::sqrt(squares.x()) ||
                      sum.roundedArea > least * std::sqrt(squares.y()));
    return out;
}

} // namespace

BallGradients smoothGradients(const BallSet& atoms, const SurfaceSpec& spec, const Mesh& mesh,
                              const Progress& progress)
{
    constexpr std::size_t chunk = 1024;
    constexpr double leastShare = 0.2; // of the slope of a lone ball, as in flow/equilibrium.cpp
    const EvolveOptions flow = flowOptions(spec);
    const Weights weights = weightsOf(flow);
    const GaussianOptions gaussian = gaussianOptions(spec);
    GaussianSum sum(atoms.balls, gaussian, atoms.decays);
    DecidedGaps gaps;
    if (auto rule = gapRuleOf(spec)) { // then psi has the bumps of gaps
        rule->countsClosed = false;
        sum.band(0, progress, openvdb::CoordBBox::inf(), [&](const SparseField& psi) {
            GapReport unused;
            return bumpsOfGaps(sum, psi, *rule, progress, unused, &gaps);
        });
    }
    const MovingBumps bumps(motionsOfBumps(sum, gaps, gaussian.voxelSize, progress));
    const std::vector<double> slopes = slopesOf(atoms.balls, gaussian, atoms.decays);
    const double leastSlope = leastShare * *std::min_element(slopes.begin(), slopes.end());
    const Interface interface {
        sum, bumps, offsetOf(spec), leastSlope, weights
    };
    const PatchNodes nodes = patchNodes(mesh, progress);
    std::vector<Sums> parts((nodes.points.size() + chunk - 1) / chunk);
    parallelFor(parts.size(), progress, [&](std::size_t c) {
        thread_local PointTerms terms;
        for (std::size_t n = c * chunk; n < std::min(nodes.points.size(), (c + 1) * chunk); ++n)
            addNode(interface, nodes, n, terms, parts[c]);
    });
    std::vector<Sum> sums(atoms.balls.size());
    for (const Sums& part : parts)
        for (const auto& [ball, added] : part) sums[std::size_t(ball)] += added;
    BallGradients out;
    for (const Sum& own : sums) {
        out.volume.push_back(own.volume);
        out.area.push_back(own.area);
    }
    out.besideGap = offsetOf(spec) > 0.0 ? ballsBesideGaps(sum, atoms.balls.size())
                                         : std::vector<char>(atoms.balls.size(), 0);
    out.besideRidge = ballsBesideRidges(sums);
    return out;
}

} // namespace molsurf
