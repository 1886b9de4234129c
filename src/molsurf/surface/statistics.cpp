// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/statistics.h"

#include <tbb/parallel_sort.h>

#include <cmath>
#include <utility>

namespace molsurf
{

using openvdb::Vec3d;

Statistics statistics(const std::vector<float>& values, const std::vector<float>& weights)
{
    std::vector<std::pair<float, float>> samples; // value, weight
    samples.reserve(values.size());
    double weight = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!(weights[i] > 0.0f)) continue;
        samples.emplace_back(values[i], weights[i]);
        weight += weights[i];
        sum += double(weights[i]) * values[i];
    }
    Statistics out;
    if (samples.empty()) return out;
    tbb::parallel_sort(samples.begin(), samples.end());
    out.mean = sum / weight;
    out.min = samples.front().first;
    out.max = samples.back().first;
    double squares = 0.0, below = 0.0;
    std::size_t next = 0;
    for (const auto& [value, w] : samples) {
        squares += w * (value - out.mean) * (value - out.mean);
        below += w;
        while (next < percents.size() && below >= 0.01 * percents[next] * weight)
            out.percentiles[next++] = value;
    }
    while (next < percents.size()) out.percentiles[next++] = out.max; // lost to rounding
    out.standardDeviation = std::sqrt(squares / weight);
    return out;
}

std::vector<float> vertexAreas(const Mesh& mesh)
{
    std::vector<float> areas(mesh.positions.size(), 0.0f);
    for (const auto& t : mesh.triangles) {
        const Vec3d p(mesh.positions[t[0]]);
        const Vec3d normal =
            (Vec3d(mesh.positions[t[1]]) - p).cross(Vec3d(mesh.positions[t[2]]) - p);
        const float third = float(normal.length() / 6.0);
        for (const std::uint32_t v : t) areas[v] += third;
    }
    return areas;
}

} // namespace molsurf
