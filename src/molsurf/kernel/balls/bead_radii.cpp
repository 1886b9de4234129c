// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/bead_radii.h"

#include "molsurf/error.h"
#include "molsurf/kernel/balls/power_cells.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

using Vector = std::vector<double>;

constexpr double accuracy = 1e-4;   // of every volume
constexpr double leastVolume = 0.1; // less is nothing [Å^3]
constexpr double leastRadius = 0.1; // [Å]

double ballRadius(double volume)
{
    return std::cbrt(0.75 * volume / M_PI);
}

double norm(const Vector& v)
{
    double sum = 0.0;
    for (const double x : v) sum += x * x;
    return std::sqrt(sum);
}

/// The derivatives of the free beads' volumes by their squared radii: symmetric, with columns whose
/// sum is what the union gains.
struct Jacobian {
    Vector diagonal;
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs; // of free beads
    Vector between;                                           // one a pair, > 0

    Vector times(const Vector& x) const
    {
        Vector y(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) y[i] = diagonal[i] * x[i];
        for (std::size_t p = 0; p < pairs.size(); ++p) {
            const auto [i, j] = pairs[p];
            y[std::size_t(i)] -= between[p] * x[std::size_t(j)];
            y[std::size_t(j)] -= between[p] * x[std::size_t(i)];
        }
        return y;
    }

    /// Conjugate gradients, preconditioned by the diagonal.
    Vector solve(const Vector& right) const
    {
        constexpr int mostSteps = 2000;
        constexpr double tolerance = 1e-6;
        const std::size_t n = right.size();
        Vector x(n), r = right, p(n);
        double old = 0.0;
        for (int step = 0; step < mostSteps && norm(r) > tolerance * norm(right); ++step) {
            double rz = 0.0;
            for (std::size_t i = 0; i < n; ++i) rz += r[i] * r[i] / diagonal[i];
            const double beta = step == 0 ? 0.0 : rz / old;
            for (std::size_t i = 0; i < n; ++i) p[i] = r[i] / diagonal[i] + beta * p[i];
            const Vector q = times(p);
            double pq = 0.0;
            for (std::size_t i = 0; i < n; ++i) pq += p[i] * q[i];
            for (std::size_t i = 0; i < n; ++i) {
                x[i] += rz / pq * p[i];
                r[i] -= rz / pq * q[i];
            }
            old = rz;
        }
        return x;
    }
};

/// Beads with squared radii, some of which are to be found.
class Sizing
{
public:
    Sizing(std::vector<Ball>& beads, std::vector<std::size_t> free, Vector wanted,
           const Progress& progress)
        : beads_(beads), free_(std::move(free)), wanted_(std::move(wanted)), progress_(progress),
          place_(beads.size(), -1), squares_(free_.size())
    {
        for (std::size_t n = 0; n < free_.size(); ++n) place_[free_[n]] = std::int32_t(n);
    }

    /// Takes Newton steps until each bead has its volume.
    /// @throws Error(ErrorKind::Numeric) if they do not converge
    void solve()
    {
        start();
        const double floor = 0.5 * std::min(*std::min_element(wanted_.begin(), wanted_.end()),
                                            *std::min_element(found_.begin(), found_.end()));
        constexpr int mostSteps = 100;
        for (int step = 0; !done(); ++step) {
            if (step == mostSteps || floor <= 0.0 || !advance(floor)) {
                throw Error(ErrorKind::Numeric,
                            "`coarse`: no radii give the beads their volumes [hint: are there "
                            "atoms more than once?]");
            }
        }
    }

private:
    /// Equal radii, as large as any fixed one: no part is empty then.
    void start()
    {
        double mean = 0.0, largest = 0.0;
        for (const double w : wanted_) mean += w / double(wanted_.size());
        for (const Ball& bead : beads_) largest = std::max(largest, bead.radius);
        const double radius = std::max(ballRadius(mean), largest);
        std::fill(squares_.begin(), squares_.end(), radius * radius);
        measure();
    }

    void measure()
    {
        for (std::size_t n = 0; n < free_.size(); ++n) {
            beads_[free_[n]].radius = std::sqrt(squares_[n]);
        }
        cells_ = powerCells(beads_, progress_);
        found_.resize(free_.size());
        missing_.resize(free_.size());
        for (std::size_t n = 0; n < free_.size(); ++n) {
            found_[n] = cells_.volumes[free_[n]];
            missing_[n] = wanted_[n] - found_[n];
        }
    }

    bool done() const
    {
        for (std::size_t n = 0; n < free_.size(); ++n) {
            if (std::abs(missing_[n]) > accuracy * wanted_[n]) return false;
        }
        return true;
    }

    /// dV_i = (area_i / 2 r_i + sum_j facet_ij / 2 d_ij) d(r_i^2) - sum_j facet_ij / 2 d_ij
    /// d(r_j^2)
    Jacobian jacobian() const
    {
        Jacobian out;
        out.diagonal.resize(free_.size());
        for (std::size_t n = 0; n < free_.size(); ++n) {
            out.diagonal[n] = 0.5 * cells_.areas[free_[n]] / std::sqrt(squares_[n]);
        }
        for (const PowerFacet& facet : cells_.facets) {
            const std::int32_t i = place_[std::size_t(facet.balls[0])],
                               j = place_[std::size_t(facet.balls[1])];
            const double slope = 0.5 * facet.area / facet.distance;
            if (i >= 0) out.diagonal[std::size_t(i)] += slope;
            if (j >= 0) out.diagonal[std::size_t(j)] += slope;
            if (i < 0 || j < 0) continue;
            out.pairs.emplace_back(i, j);
            out.between.push_back(slope);
        }
        return out;
    }

    /// One Newton step, shortened until no part is nearly empty and the error falls.
    bool advance(double floor)
    {
        const Vector before = squares_, change = jacobian().solve(missing_);
        const double error = norm(missing_);
        constexpr double shortest = 1e-6;
        for (double length = 1.0; length > shortest; length *= 0.5) {
            bool good = true;
            for (std::size_t n = 0; n < free_.size(); ++n) {
                squares_[n] = before[n] + length * change[n];
                good = good && squares_[n] > 0.0;
            }
            if (!good) continue;
            measure();
            if (*std::min_element(found_.begin(), found_.end()) >= floor &&
                norm(missing_) <= (1.0 - 0.5 * length) * error) {
                return true;
            }
        }
        return false;
    }

    std::vector<Ball>& beads_;
    std::vector<std::size_t> free_; // indices of the beads whose radii are to be found
    Vector wanted_;                 // their volumes
    const Progress& progress_;
    std::vector<std::int32_t> place_; // of every bead in free_, or -1
    Vector squares_, found_, missing_;
    PowerCells cells_;
};

} // namespace

void sizeBeads(const std::vector<Ball>& balls, const std::vector<std::vector<std::size_t>>& members,
               double probe, std::vector<Ball>& beads, const Progress& progress)
{
    std::vector<Ball> grown = balls, sized = beads;
    for (Ball& ball : grown) ball.radius += probe;
    const PowerCells cells = powerCells(grown, progress);
    std::vector<std::size_t> free;
    Vector wanted;
    for (std::size_t b = 0; b < beads.size(); ++b) {
        sized[b].radius += probe;
        if (beads[b].radius > 0.0) continue;
        sized[b].radius += leastRadius;
        double volume = 0.0;
        for (const std::size_t i : members[b]) volume += cells.volumes[i];
        if (volume < leastVolume) continue;
        free.push_back(b);
        wanted.push_back(volume);
    }
    if (!free.empty()) Sizing(sized, std::move(free), std::move(wanted), progress).solve();
    for (std::size_t b = 0; b < beads.size(); ++b) {
        if (beads[b].radius > 0.0) continue;
        beads[b].radius = std::max(sized[b].radius - probe, leastRadius);
    }
}

} // namespace molsurf
