// SPDX-License-Identifier: MPL-2.0
#include "molsurf/pockets/basins.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace molsurf
{

namespace
{

/// The active voxels, those of large clearance first.
std::vector<VoxelPlace> fallingVoxels(const VoidField& space)
{
    std::vector<std::pair<float, VoxelPlace>> order;
    for (std::size_t n = 0; n < space.table.size(); ++n)
        space.table.active(n).forEach([&](int v) {
            order.emplace_back(-space.clearance.leaf(n)[v],
                               VoxelPlace(n * leafSize + std::size_t(v)));
        });
    tbb::parallel_sort(order.begin(), order.end());
    std::vector<VoxelPlace> out;
    out.reserve(order.size());
    for (const auto& [value, place] : order) out.push_back(place);
    return out;
}

/// Parts that grow and join.
class Parts
{
public:
    explicit Parts(double share) : share_(float(share)) {}

    std::int32_t add(float peak)
    {
        const auto part = std::int32_t(parents_.size());
        parents_.push_back(part);
        peaks_.push_back(peak);
        return part;
    }

    std::int32_t find(std::int32_t part)
    {
        while (parents_[std::size_t(part)] != part) {
            auto& up = parents_[std::size_t(part)];
            up = parents_[std::size_t(up)];
            part = up;
        }
        return part;
    }

    /// Two roots meet.
    /// @return the root of the one that they become, or the first
    std::int32_t meet(std::int32_t a, std::int32_t b, float clearance)
    {
        // Parts are made in the order of falling peaks: the later one has the lower peak.
        if (clearance >= share_ * peaks_[std::size_t(std::max(a, b))]) return join(a, b);
        auto& neck = necks_[std::minmax(a, b)];
        neck = std::max(neck, clearance);
        return a;
    }

    std::int32_t join(std::int32_t a, std::int32_t b)
    {
        const auto [first, last] = std::minmax(a, b);
        parents_[std::size_t(last)] = first;
        return first;
    }

    /// The necks between roots, without those within one.
    std::map<std::pair<std::int32_t, std::int32_t>, float> necks()
    {
        std::map<std::pair<std::int32_t, std::int32_t>, float> out;
        for (const auto& [pair, clearance] : necks_) {
            const std::int32_t a = find(pair.first), b = find(pair.second);
            if (a == b) continue;
            auto& neck = out[std::minmax(a, b)];
            neck = std::max(neck, clearance);
        }
        return out;
    }

    std::size_t size() const { return parents_.size(); }
    float peak(std::int32_t part) const { return peaks_[std::size_t(part)]; }

private:
    float share_;
    std::vector<std::int32_t> parents_;
    std::vector<float> peaks_;
    std::map<std::pair<std::int32_t, std::int32_t>, float> necks_;
};

/// Small parts join the neighbour with the widest neck, the smallest first.
void joinSmall(const std::vector<std::size_t>& sizes, double leastVoxels, Parts& parts)
{
    using Neighbour = std::pair<float, std::int32_t>; // by a neck, and it
    std::vector<std::size_t> size(parts.size(), 0);
    for (std::size_t p = 0; p < sizes.size(); ++p)
        size[std::size_t(parts.find(std::int32_t(p)))] += sizes[p];
    std::vector<std::vector<Neighbour>> near(parts.size());
    for (const auto& [pair, clearance] : parts.necks()) {
        near[std::size_t(pair.first)].emplace_back(clearance, pair.second);
        near[std::size_t(pair.second)].emplace_back(clearance, pair.first);
    }
    std::vector<std::int32_t> small;
    for (std::size_t p = 0; p < size.size(); ++p)
        if (size[p] > 0 && double(size[p]) < leastVoxels) small.push_back(std::int32_t(p));
    std::sort(small.begin(), small.end(), [&](std::int32_t a, std::int32_t b) {
        return std::pair(size[std::size_t(a)], a) < std::pair(size[std::size_t(b)], b);
    });
    for (const std::int32_t p : small) {
        const std::int32_t own = parts.find(p); // another one that was small, perhaps
        if (double(size[std::size_t(own)]) >= leastVoxels) continue;
        Neighbour best(-1.0f, -1);
        for (const auto& [clearance, other] : near[std::size_t(own)]) {
            const std::int32_t root = parts.find(other);
            if (root != own) best = std::max(best, Neighbour(clearance, root));
        }
        if (best.second < 0) continue;
        const std::int32_t root = parts.join(own, best.second),
                           last = root == own ? best.second : own;
        size[std::size_t(root)] += size[std::size_t(last)];
        auto& kept = near[std::size_t(root)];
        kept.insert(kept.end(), near[std::size_t(last)].begin(), near[std::size_t(last)].end());
    }
}

} // namespace

Basins splitAtNecks(const VoidField& space, double share, double leastVoxels)
{
    Basins out;
    out.of = LeafArray<std::int32_t>(space.table.size());
    for (std::size_t n = 0; n < space.table.size(); ++n) std::fill_n(out.of.leaf(n), leafSize, -1);
    const auto at = [&](VoxelPlace place) -> std::int32_t& {
        return out.of.leaf(place / leafSize)[place % leafSize];
    };
    const auto clearanceAt = [&](VoxelPlace place) {
        return space.clearance.leaf(place / leafSize)[place % leafSize];
    };
    Parts parts(share);
    std::vector<std::size_t> sizes;
    const std::vector<VoxelPlace> order = fallingVoxels(space);
    for (const VoxelPlace place : order) {
        std::int32_t own = -1;
        float highest = 0.0f;
        forEachJoined(space.table, place, [&](VoxelPlace other) {
            if (at(other) < 0 || clearanceAt(other) <= highest) return;
            highest = clearanceAt(other);
            own = at(other);
        });
        if (own < 0) {
            own = parts.add(clearanceAt(place));
            sizes.push_back(0);
        }
        at(place) = own;
        ++sizes[std::size_t(own)];
        std::int32_t root = parts.find(own);
        forEachJoined(space.table, place, [&](VoxelPlace other) {
            if (at(other) < 0) return;
            const std::int32_t met = parts.find(at(other));
            if (met != root) root = parts.meet(root, met, clearanceAt(place));
        });
    }
    joinSmall(sizes, leastVoxels, parts);

    std::vector<std::int32_t> numbers(parts.size(), -1);
    for (std::size_t p = 0; p < numbers.size(); ++p) {
        const std::int32_t root = parts.find(std::int32_t(p));
        auto& number = numbers[std::size_t(root)];
        if (number < 0) {
            number = std::int32_t(out.peaks.size());
            out.peaks.push_back(parts.peak(root));
        }
        numbers[p] = number;
    }
    for (const VoxelPlace place : order) at(place) = numbers[std::size_t(at(place))];
    for (const auto& [pair, clearance] : parts.necks()) {
        const auto [a, b] =
            std::minmax(numbers[std::size_t(pair.first)], numbers[std::size_t(pair.second)]);
        out.necks.push_back({{a, b}, clearance});
    }
    return out;
}

} // namespace molsurf
