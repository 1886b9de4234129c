// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/box_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace molsurf
{

namespace
{

constexpr float never = std::numeric_limits<float>::max();

} // namespace

BoxTree::Ends BoxTree::rounded(const Box& box)
{
    constexpr double rounding = 1e-7; // of a double to a float
    Ends ends;
    for (int a = 0; a < 3; ++a) {
        const double low = box.low[a], high = box.high[a];
        ends[std::size_t(a)] = float(low - rounding * std::abs(low));
        ends[std::size_t(a + 3)] = float(high + rounding * std::abs(high));
    }
    return ends;
}

BoxTree::BoxTree(const std::vector<Box>& boxes)
{
    const auto made = [](std::size_t count) {
        Level level;
        const std::size_t padded = (count + group - 1) / group * group;
        for (std::size_t k = 0; k < 6; ++k) level[k].assign(padded, k < 3 ? never : -never);
        return level;
    };
    const auto widen = [](Level& level, std::size_t node, std::size_t k, float end) {
        float& kept = level[k][node];
        kept = k < 3 ? std::min(kept, end) : std::max(kept, end);
    };
    if (boxes.empty()) return;
    std::size_t count = (boxes.size() + group - 1) / group;
    levels_.push_back(made(count));
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const Ends ends = rounded(boxes[i]);
        for (std::size_t k = 0; k < 6; ++k) widen(levels_[0], i / group, k, ends[k]);
    }
    while (count > group) {
        const std::size_t below = count;
        count = (count + group - 1) / group;
        levels_.push_back(made(count));
        const Level& from = levels_[levels_.size() - 2];
        for (std::size_t k = 0; k < 6; ++k) {
            for (std::size_t i = 0; i < below; ++i) widen(levels_.back(), i / group, k, from[k][i]);
        }
    }
}

void BoxTree::findOctets(const Box& box, std::vector<std::size_t>& octets) const
{
    octets.clear();
    const auto add = [&](std::size_t octet) { octets.push_back(octet); };
    if (levels_.size() == 1) add(0);
    if (levels_.size() > 1) visit(rounded(box), levels_.size() - 1, 0, 1, add);
}

MOLSURF_KERNEL std::uint32_t BoxTree::meeting(const Level& level, std::size_t first,
                                              const Ends& box)
{
    Ints meets = splat(-1);
    for (std::size_t a = 0; a < 3; ++a) {
        meets &= load(level[a].data() + first) <= box[a + 3];
        meets &= load(level[a + 3].data() + first) >= box[a];
    }
    return bitsOf(meets & (splat(1) << laneNumbers()));
}

} // namespace molsurf
