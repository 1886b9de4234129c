// SPDX-License-Identifier: MPL-2.0
#include "molsurf/levelset/cavities.h"

#include <deque>

namespace molsurf
{

std::vector<LeafMask> connectedTo(const LeafTable& table, const std::vector<LeafMask>& allowed,
                                  const std::vector<LeafMask>& seeds)
{
    std::vector<LeafMask> reached(table.size());
    std::deque<std::size_t> queue; // leaves that may grow
    std::vector<bool> queued(table.size(), false);
    const auto enqueue = [&](std::size_t n) {
        if (queued[n]) return;
        queued[n] = true;
        queue.push_back(n);
    };
    for (std::size_t n = 0; n < table.size(); ++n) {
        reached[n] = seeds[n] & allowed[n];
        if (!reached[n].any()) continue;
        for (const std::int32_t m : table.neighbours(n)) {
            if (m != noLeaf) enqueue(std::size_t(m));
        }
    }
    while (!queue.empty()) {
        const std::size_t n = queue.front();
        queue.pop_front();
        queued[n] = false;
        bool grown = false;
        for (;;) {
            const LeafMask next = (dilatedMask(table, reached, n, false) & allowed[n]) | reached[n];
            if (next.words == reached[n].words) break;
            reached[n] = next;
            grown = true;
        }
        if (!grown) continue;
        for (const std::int32_t m : table.neighbours(n)) {
            if (m != noLeaf) enqueue(std::size_t(m));
        }
    }
    return reached;
}

} // namespace molsurf
