// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/sphere_points.h"

#include "molsurf/kernel/core/simd.h"

#include <algorithm>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

constexpr std::size_t word = ExcludedSampler::Spread::run;
static_assert(word == 32, "a word has a bit for each point of a run");

/// One bit for each of the 32 directions u with u.(x, y, z) > least.
MOLSURF_KERNEL std::uint32_t bitsBeyond(const double* ux, const double* uy, const double* uz,
                                        const Vec3d& way, double least)
{
    Longs bits = {};
    for (std::size_t k = 0; k < word; k += doubleLanes) {
        const Doubles along =
            load(ux + k) * way.x() + load(uy + k) * way.y() + load(uz + k) * way.z();
        bits |= (along > least) & (Longs{1, 2, 4, 8} << std::int64_t(k));
    }
    return std::uint32_t(bits[0] | bits[1] | bits[2] | bits[3]);
}

} // namespace

SpherePoints::SpherePoints(const ExcludedSampler::Spread& spread, double chord)
    : spread_(spread), chord_(chord), near_(spread.directions.size())
{
    for (std::vector<double>* list : {&x_, &y_, &z_}) list->resize(spread.runs.size() * word);
    for (std::size_t k = 0; k < spread.directions.size(); ++k) {
        x_[k] = spread.directions[k].x();
        y_[k] = spread.directions[k].y();
        z_[k] = spread.directions[k].z();
    }
}

void SpherePoints::addCap(const Vec3d& way, double least, Set& set) const
{
    const double length = way.length();
    for (std::size_t n = 0; n < set.size(); ++n) {
        const Ball& about = spread_.runs[n];
        const double along = about.center.dot(way), range = about.radius * length;
        if (along + range <= least) continue;
        const std::size_t points = std::min(word, near_.size() - n * word);
        set[n] |= along - range > least && points == word
                      ? ~std::uint32_t(0)
                      : bitsBeyond(&x_[n * word], &y_[n * word], &z_[n * word], way, least) &
                            ~std::uint32_t(0) >> (word - points);
    }
}

void SpherePoints::findNear(std::size_t point)
{
    std::vector<Near>& near = near_[point];
    const Vec3d& u = spread_.directions[point];
    for (std::size_t n = 0; n < spread_.runs.size(); ++n) {
        const Ball& about = spread_.runs[n];
        const double reach = about.radius + chord_;
        if ((about.center - u).lengthSqr() > reach * reach) continue;
        std::uint32_t points = 0;
        for (std::size_t k = n * word; k < std::min((n + 1) * word, near_.size()); ++k)
            if ((spread_.directions[k] - u).lengthSqr() < chord_ * chord_)
                points |= std::uint32_t(1) << (k - n * word);
        if (points != 0) near.push_back({std::uint32_t(n), points});
    }
}

std::size_t SpherePoints::count(const Set& set)
{
    std::size_t sum = 0;
    for (const std::uint32_t word : set) sum += std::size_t(__builtin_popcount(word));
    return sum;
}

SpherePoints::Set SpherePoints::eroded(const Set& set)
{
    Set out = set;
    forEach(set, [&](std::size_t k) {
        if (near_[k].empty()) findNear(k); // it is near itself
        const std::vector<Near>& near = near_[k];
        if (std::any_of(near.begin(), near.end(),
                        [&](const Near& one) { return (one.points & ~set[one.run]) != 0; }))
            out[k / word] &= ~(std::uint32_t(1) << k % word);
    });
    return out;
}

} // namespace molsurf
