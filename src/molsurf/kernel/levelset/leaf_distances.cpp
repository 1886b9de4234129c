// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/leaf_distances.h"

#include "molsurf/kernel/levelset/closest_foot.h"
#include "molsurf/kernel/levelset/jets.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

using Lanes = FootPoints::Lanes;

constexpr float leastError = 2e-4f;    // of the expansion that is worth a step [voxel]
constexpr float settledEnough = 5e-4f; // error after which no further step is made [voxel]
constexpr float sharpest = 4.0f;       // curvature of a crease [1/voxel]

} // namespace

void LeafDistances::compute(const std::int32_t* index, const std::uint16_t* voxels, int count,
                            const LeafMask& negative, float level, float* out)
{
    constexpr float sharp = 2.0f; // from the level: where points are moved [voxel]
    waiting_ = 0;
    FootPoints feet;
    alignas(64) Lanes x[3], sign, distance, aside2, step[3];
    for (int first = 0; first < count; first += lanes) {
        const int used = std::min(lanes, count - first);
        for (int l = first + lanes; l < std::min(first + 2 * lanes, count); ++l)
            __builtin_prefetch(&near_[index[voxels[l]]]); // they lie scattered in memory
        for (int l = 0; l < lanes; ++l) {
            const int v = voxels[first + std::min(l, used - 1)];
            setLane(placeOf(v), l, x);
            sign[l] = negative.on(v) ? -1.0f : 1.0f;
            setLane(near_[index[v]], shift(near_[index[v]]), l, feet);
        }
        distances(feet, x, sign, distance, aside2);
        bool any = false;
        for (int l = 0; l < used; ++l) {
            out[voxels[first + l]] = distance[l];
            any = any || std::abs(sign[l] * distance[l] - level) < sharp;
        }
        if (!any) continue;
        stepsAlong(feet, x, step);
        for (int l = 0; l < used; ++l) {
            // The expansion's error is of third order in the distance to the normal, times the
            // change of curvature, at most some curvature a voxel: |t|^3 sqrt(k1^2 + k2^2).
            constexpr float farthest = 2.0f; // a longer step is not trusted [voxel]
            const float a2 = aside2[l];
            const float curvature2 = feet.kappa[l] * feet.kappa[l] - 2.0f * feet.gauss[l];
            const Vec3f d = lane(step, l);
            if (std::abs(sign[l] * distance[l] - level) >= sharp ||
                a2 * a2 * a2 * curvature2 < leastError * leastError) {
                continue;
            }
            const int v = voxels[first + l];
            const Seed& seed = near_[index[v]];
            if (d.lengthSqr() > farthest * farthest) {
                seekFoot(index[v], v, out);
                continue;
            }
            wait_[waiting_++] = {v,
                                 index[v],
                                 sign[l],
                                 a2,
                                 lane(feet.y, l) + d - 0.5f * d.dot(seed.bend(d)) * seed.n,
                                 near_.offset(near_[index[v]], origin_, v).lengthSqr(),
                                 0};
            while (waiting_ == lanes) polish(out);
        }
    }
    while (waiting_ > 0) polish(out);
}

/// One round for the voxels that wait: a Newton step brings their points back onto the spline's
/// zero set, with an error of fourth order in the distance moved. A point that comes nearer to its
/// voxel and its normal gives the distance, if it is settled, or waits for another round. For all
/// others seekFoot() starts anew from the seed.
void LeafDistances::polish(float* out)
{
    FootPoints feet;
    JetLanes jets{};
    alignas(64) Lanes x[3], sign, distance, aside2;
    alignas(64) Lanes step[3];
    bool good[lanes];
    for (int l = 0; l < lanes; ++l) {
        const Waiting& w = wait_[std::min(l, waiting_ - 1)];
        const Seed& seed = near_[w.seed];
        setLane(placeOf(w.v), l, x);
        sign[l] = w.sign;
        if (l >= waiting_) { // idle
            setLane(seed, Vec3f(0.0f), l, feet);
            good[l] = false;
            continue;
        }
        jetBeside(near_.coefficients, seed.leaf, w.y - shift(seed), l, jets);
        const Vec3f gradient = lane(jets.gradient, l);
        const float slope2 = gradient.lengthSqr();
        good[l] = slope2 >= 0.04f; // where it is not, a Newton step would be too long
        setLane(w.y - jets.value[l] / std::max(slope2, 0.04f) * gradient, l, feet.y);
    }
    shapeFrom(jets, feet, sharpest);
    distances(feet, x, sign, distance, aside2);
    stepsAlong(feet, x, step);
    int again = 0;
    for (int l = 0; l < waiting_; ++l) {
        Waiting w = wait_[l];
        const float r2 = (lane(x, l) - lane(feet.y, l)).lengthSqr();
        const float curvature2 = feet.kappa[l] * feet.kappa[l] - 2.0f * feet.gauss[l];
        const float a2 = aside2[l];
        const Vec3f d = lane(step, l);
        constexpr int mostRounds = 3;
        if (good[l] && r2 < w.least2 && a2 < w.aside2) {
            if (a2 * a2 * a2 * curvature2 < settledEnough * settledEnough) {
                out[w.v] = distance[l];
                continue;
            }
            if (++w.rounds < mostRounds && d.lengthSqr() < 1.0f) {
                w.aside2 = a2;
                w.least2 = r2;
                const Vec3f Ad(feet.A[0][l] * d.x() + feet.A[3][l] * d.y() + feet.A[5][l] * d.z(),
                               feet.A[3][l] * d.x() + feet.A[1][l] * d.y() + feet.A[4][l] * d.z(),
                               feet.A[5][l] * d.x() + feet.A[4][l] * d.y() + feet.A[2][l] * d.z());
                w.y = lane(feet.y, l) + d - 0.5f * d.dot(Ad) * lane(feet.n, l); // second order
                wait_[again++] = w;
                continue;
            }
        }
        seekFoot(w.seed, w.v, out);
    }
    waiting_ = again;
}

/// The distance by closestFoot() from the seed: beside creases and ridges of the interface, where
/// the surface turns within a voxel, no one step leads to the closest point. `out` keeps its value
/// if there is none.
void LeafDistances::seekFoot(std::int32_t index, int v, float* out) const
{
    const Seed& seed = near_[index];
    const Vec3d x(placeOf(v) - shift(seed));
    const auto jetAt = [&](const Vec3d& y) {
        JetLanes jets;
        jetBeside(near_.coefficients, seed.leaf, Vec3f(y), 0, jets);
        return jets.at(0);
    };
    if (const auto y = closestFoot(jetAt, x, Vec3d(seed.y))) out[v] = float((x - *y).length());
}

} // namespace molsurf
