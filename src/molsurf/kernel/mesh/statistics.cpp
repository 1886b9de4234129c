// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/statistics.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/mesh/vertex_slices.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace molsurf
{

using openvdb::Vec3f;

namespace
{

constexpr int binBits = 16;
constexpr std::size_t partSize = 1 << 18; // values that are summed together

/// Where a value belongs among 65536 bins in ascending order: by its first 16 bits. The bits of
/// positive floats ascend with them; those of negative ones descend, and come first.
std::uint32_t binOf(float value)
{
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return (bits >> 31 ? ~bits : bits | 0x80000000u) >> (32 - binBits);
}

struct Sample {
    float value, weight;
};

/// The samples of a statistic; those without weight do not count.
class Samples
{
public:
    Samples(const std::vector<float>& values, const std::vector<float>& weights)
        : values_(values), weights_(weights)
    {
    }

    /// Makes a T for each part by make(sample, t) for all of its samples, and adds them up in
    /// order. Parts depend on the number of values alone.
    template<typename T, typename F>
    T sum(const T& nothing, const F& make) const
    {
        std::vector<T> parts((values_.size() + partSize - 1) / partSize, nothing);
        tbb::parallel_for(std::size_t(0), parts.size(), [&](std::size_t p) {
            const std::size_t end = std::min(values_.size(), (p + 1) * partSize);
            for (std::size_t i = p * partSize; i < end; ++i)
                if (weights_[i] > 0.0f) make(Sample{values_[i], weights_[i]}, parts[p]);
        });
        T all = nothing;
        for (const T& part : parts) all += part;
        return all;
    }

private:
    const std::vector<float>&values_, &weights_;
};

/// Sums of the first pass.
struct Tally {
    double weight = 0.0, sum = 0.0;
    double min = std::numeric_limits<double>::max(), max = -min;
    std::vector<double> bins = std::vector<double>(1u << binBits, 0.0); // weights

    Tally& operator+=(const Tally& other)
    {
        weight += other.weight;
        sum += other.sum;
        min = std::min(min, other.min);
        max = std::max(max, other.max);
        for (std::size_t b = 0; b < bins.size(); ++b) bins[b] += other.bins[b];
        return *this;
    }
};

/// A bin that holds percentiles.
struct Bin {
    double below;    // weight before it
    std::size_t end; // one past its last percentile
};

/// Sums of the second pass.
struct Details {
    double squares = 0.0;                     // about the mean
    std::vector<std::vector<Sample>> samples; // of each bin that holds percentiles

    Details& operator+=(const Details& other)
    {
        squares += other.squares;
        for (std::size_t b = 0; b < samples.size(); ++b) {
            const auto& more = other.samples[b];
            samples[b].insert(samples[b].end(), more.begin(), more.end());
        }
        return *this;
    }
};

} // namespace

Statistics statistics(const std::vector<float>& values, const std::vector<float>& weights)
{
    const Samples samples(values, weights);
    const Tally tally = samples.sum(Tally(), [](const Sample& s, Tally& t) {
        t.bins[binOf(s.value)] += s.weight;
        t.weight += s.weight;
        t.sum += double(s.weight) * s.value;
        t.min = std::min(t.min, double(s.value));
        t.max = std::max(t.max, double(s.value));
    });
    if (tally.weight == 0.0) return Statistics();
    Statistics out;
    out.min = tally.min;
    out.max = tally.max;
    out.mean = tally.sum / tally.weight;

    // Only the bins that hold a percentile are sorted.
    std::vector<Bin> bins;
    std::vector<std::int8_t> place(tally.bins.size(), -1); // among these
    double below = 0.0;
    std::size_t next = 0;
    for (std::size_t b = 0; b < tally.bins.size(); ++b) {
        const std::size_t before = next;
        const double upTo = below + tally.bins[b];
        while (next < percents.size() && upTo >= 0.01 * percents[next] * tally.weight) ++next;
        if (next > before) {
            place[b] = std::int8_t(bins.size());
            bins.push_back({below, next});
        }
        below = upTo;
    }
    Details nothing;
    nothing.samples.resize(bins.size());
    Details details = samples.sum(nothing, [&](const Sample& s, Details& d) {
        d.squares += s.weight * (s.value - out.mean) * (s.value - out.mean);
        const int bin = place[binOf(s.value)];
        if (bin >= 0) d.samples[std::size_t(bin)].push_back(s);
    });
    out.standardDeviation = std::sqrt(details.squares / tally.weight);
    next = 0;
    for (std::size_t b = 0; b < bins.size(); ++b) {
        std::vector<Sample>& inside = details.samples[b];
        std::sort(inside.begin(), inside.end(), [](const Sample& s, const Sample& t) {
            return s.value != t.value ? s.value < t.value : s.weight < t.weight;
        });
        below = bins[b].below;
        for (const Sample& s : inside) {
            below += s.weight;
            while (next < bins[b].end && below >= 0.01 * percents[next] * tally.weight)
                out.percentiles[next++] = s.value;
        }
        // lost to rounding
        while (next < bins[b].end) out.percentiles[next++] = inside.back().value;
    }
    while (next < percents.size()) out.percentiles[next++] = out.max;
    return out;
}

std::vector<float> vertexAreas(const Mesh& mesh, const Progress& progress)
{
    std::vector<float> areas(mesh.positions.size(), 0.0f);
    const VertexSlices slices(mesh, progress);
    parallelFor(slices.size(), progress, [&](std::size_t s) {
        const std::uint32_t first = slices.first(s), count = slices.first(s + 1) - first;
        slices.forEachTriangle(s, [&](std::size_t i) {
            const auto& t = mesh.triangles[i];
            // Unsigned: what is below `first` wraps to a large number.
            if (t[0] - first >= count && t[1] - first >= count && t[2] - first >= count) return;
            const Vec3f p = mesh.positions[t[0]];
            const Vec3f u = mesh.positions[t[1]] - p, v = mesh.positions[t[2]] - p;
            const float third = u.cross(v).length() / 6.0f;
            for (const std::uint32_t corner : t)
                if (corner - first < count) areas[corner] += third;
        });
    });
    return areas;
}

} // namespace molsurf
