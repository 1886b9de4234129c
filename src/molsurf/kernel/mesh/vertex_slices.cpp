// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/mesh/vertex_slices.h"

#include "molsurf/kernel/core/parallel.h"

#include <numeric>

namespace molsurf
{

VertexSlices::VertexSlices(const Mesh& mesh, const Progress& progress)
    : vertices_(mesh.positions.size()), triangles_(mesh.triangles.size()),
      begins_(((vertices_ + sliceSize - 1) >> bits) + 1, 0)
{
    std::vector<std::vector<std::uint32_t>> met((triangles_ + blockSize - 1) / blockSize);
    parallelFor(met.size(), progress, [&](std::size_t b) {
        std::vector<std::uint32_t>& slices = met[b]; // two or three
        const std::size_t end = std::min(triangles_, (b + 1) * blockSize);
        std::uint32_t last = ~std::uint32_t(0);
        for (std::size_t i = b * blockSize; i < end; ++i) {
            for (const std::uint32_t v : mesh.triangles[i]) {
                if (v >> bits == last) continue;
                last = v >> bits;
                if (std::find(slices.begin(), slices.end(), last) == slices.end())
                    slices.push_back(last);
            }
        }
    });
    for (const auto& slices : met)
        for (const std::uint32_t s : slices) ++begins_[s + 1];
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    blocks_.resize(begins_.back());
    std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
    for (std::size_t b = 0; b < met.size(); ++b)
        for (const std::uint32_t s : met[b]) blocks_[next[s]++] = std::uint32_t(b);
}

} // namespace molsurf
