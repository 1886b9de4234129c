// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/displacement.h"

#include <cmath>

namespace molsurf
{

Displacements& Displacements::operator+=(const Displacements& o)
{
    count += o.count;
    moved += o.moved;
    square += o.square;
    for (std::size_t i = 0; i < bins.size(); ++i) bins[i] += o.bins[i];
    return *this;
}

double Displacements::rms() const
{
    return count ? std::sqrt(double(square) / unit / double(count)) : 0.0;
}

double Displacements::shareAbove(double size) const
{
    std::uint64_t sum = 0;
    for (int i = binOf(float(size)); i < int(bins.size()); ++i) sum += bins[std::size_t(i)];
    return count ? double(sum) / double(count) : 0.0;
}

double Displacements::quantile(double share) const
{
    std::uint64_t sum = 0;
    for (int i = 0; i < int(bins.size()); ++i) {
        sum += bins[std::size_t(i)];
        if (sum > 0 && double(sum) >= share * double(count)) return double(endOf(i));
    }
    return 0.0;
}

} // namespace molsurf
