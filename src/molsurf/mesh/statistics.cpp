// SPDX-License-Identifier: MPL-2.0
#include "molsurf/mesh/statistics.h"

#include "molsurf/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

/// Unsigned integers in the order of the floats that they stand for.
std::uint32_t orderOf(float value)
{
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits >> 31 ? ~bits : bits | 0x80000000u;
}

} // namespace

Statistics statistics(const std::vector<float>& values, const std::vector<float>& weights)
{
    // The weight of all values that begin with the same 16 bits; only those of the bins that hold a
    // percentile are then sorted.
    constexpr int binBits = 16;
    std::vector<double> bins(1u << binBits, 0.0);
    const auto binOf = [](float value) { return orderOf(value) >> (32 - binBits); };
    Statistics out;
    double weight = 0.0, sum = 0.0;
    out.min = std::numeric_limits<double>::max();
    out.max = -out.min;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!(weights[i] > 0.0f)) continue;
        bins[binOf(values[i])] += weights[i];
        weight += weights[i];
        sum += double(weights[i]) * values[i];
        out.min = std::min(out.min, double(values[i]));
        out.max = std::max(out.max, double(values[i]));
    }
    if (weight == 0.0) return Statistics();
    out.mean = sum / weight;

    struct Bin {
        double below;                                 // weight before it
        std::size_t end;                              // one past its last percentile
        std::vector<std::pair<float, float>> samples; // value, weight
    };
    std::vector<Bin> wanted;
    std::vector<std::int8_t> place(bins.size(), -1); // among those wanted
    double below = 0.0;
    std::size_t next = 0;
    for (std::size_t b = 0; b < bins.size(); ++b) {
        const std::size_t before = next;
        const double upTo = below + bins[b];
        while (next < percents.size() && upTo >= 0.01 * percents[next] * weight) ++next;
        if (next > before) {
            place[b] = std::int8_t(wanted.size());
            wanted.push_back({below, next, {}});
        }
        below = upTo;
    }
    double squares = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!(weights[i] > 0.0f)) continue;
        squares += weights[i] * (values[i] - out.mean) * (values[i] - out.mean);
        const int bin = place[binOf(values[i])];
        if (bin >= 0) wanted[std::size_t(bin)].samples.emplace_back(values[i], weights[i]);
    }
    out.standardDeviation = std::sqrt(squares / weight);
    next = 0;
    for (Bin& bin : wanted) {
        std::sort(bin.samples.begin(), bin.samples.end());
        below = bin.below;
        for (const auto& [value, w] : bin.samples) {
            below += w;
            while (next < bin.end && below >= 0.01 * percents[next] * weight)
                out.percentiles[next++] = value;
        }
        // lost to rounding
        while (next < bin.end) out.percentiles[next++] = bin.samples.back().first;
    }
    while (next < percents.size()) out.percentiles[next++] = out.max;
    return out;
}

std::vector<float> vertexAreas(const Mesh& mesh, const Progress& progress)
{
    constexpr std::size_t run = 1 << 18; // triangles whose thirds stay in the cache
    std::vector<float> areas(mesh.positions.size(), 0.0f), thirds(run);
    for (std::size_t begin = 0; begin < mesh.triangles.size(); begin += run) {
        const std::size_t count = std::min(run, mesh.triangles.size() - begin);
        parallelFor(count, progress, [&](std::size_t i) {
            const auto& t = mesh.triangles[begin + i];
            const Vec3d p(mesh.positions[t[0]]);
            const Vec3d normal =
                (Vec3d(mesh.positions[t[1]]) - p).cross(Vec3d(mesh.positions[t[2]]) - p);
            thirds[i] = float(normal.length() / 6.0);
        });
        for (std::size_t i = 0; i < count; ++i)
            for (const std::uint32_t v : mesh.triangles[begin + i]) areas[v] += thirds[i];
    }
    return areas;
}

} // namespace molsurf
