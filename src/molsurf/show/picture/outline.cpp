// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/outline.h"

#include "molsurf/kernel/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

std::vector<std::uint8_t> inkOf(std::size_t width, const std::vector<std::uint8_t>& edges,
                                const std::vector<float>& radii, const Progress& progress)
{
    const std::size_t height = edges.size() / width;
    const auto rows = std::ptrdiff_t(height), columns = std::ptrdiff_t(width);
    std::vector<std::vector<std::ptrdiff_t>> placesOf(height);
    parallelFor(height, progress, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x)
            if (radii[edges[y * width + x]] > 0.0f) placesOf[y].push_back(std::ptrdiff_t(x));
    });
    const float widest = *std::max_element(radii.begin(), radii.end());
    const auto reach = std::ptrdiff_t(std::ceil(widest + 0.5f));
    std::vector<std::uint8_t> ink(edges.size(), 0);
    parallelFor(height, progress, [&](std::size_t row) { // each writes only its row
        const auto y = std::ptrdiff_t(row);
        for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(y - reach, 0);
             j <= std::min(y + reach, rows - 1); ++j) {
            for (const std::ptrdiff_t x : placesOf[std::size_t(j)]) {
                const float radius = radii[edges[std::size_t(j * columns + x)]];
                for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(x - reach, 0);
                     i <= std::min(x + reach, columns - 1); ++i) {
                    const float far = std::sqrt(float((i - x) * (i - x) + (j - y) * (j - y)));
                    const float share = std::clamp(radius + 0.5f - far, 0.0f, 1.0f);
                    std::uint8_t& to = ink[row * width + std::size_t(i)];
                    to = std::max(to, std::uint8_t(std::lround(255.0f * share)));
                }
            }
        }
    });
    return ink;
}

} // namespace molsurf
