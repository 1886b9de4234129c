// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/flow/edge_crossings.h"

#include <cmath>

namespace molsurf
{

namespace
{

/// Catmull-Rom interpolation between 0 and 1, at t: the cubic with the values there, and with the
/// slopes that central differences of those at -1 to 2 give.
double cubic(const float* p, int step, double t)
{
    const double a = p[-step], b = p[0], c = p[step], d = p[2 * step];
    return b +
           0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
}

/// Where the cubic vanishes between 0 and 1, b and c being of opposite signs.
double crossing(const float* p, int step)
{
    double low = 0.0, high = 1.0, t = double(p[0]) / (double(p[0]) - double(p[step]));
    for (int i = 0; i < 4; ++i) { // Newton's method: the cubic is nearly straight
        const double value = cubic(p, step, t);
        ((value < 0.0) == (p[0] < 0.0f) ? low : high) = t;
        const double slope = (cubic(p, step, t + 1e-3) - value) * 1e3;
        if (std::abs(value) <= 1e-6 * std::abs(slope)) break;
        const double next = t - value / slope;
        t = next > low && next < high ? next : 0.5 * (low + high);
    }
    return t;
}

} // namespace

void EdgeCrossings::find(const Block& phi, const LeafMask& active)
{
    constexpr int steps[3] = {Block::strideX, Block::strideY, Block::strideZ};
    points.clear();
    weights.clear();
    edges.clear();
    active.forEach([&](int v) {
        const int place[3] = {v >> 6, v >> 3 & 7, v & 7};
        const float* p = phi.at(place[0], place[1], place[2]);
        for (int a = 0; a < 3; ++a) {
            if ((p[0] < 0.0f) == (p[steps[a]] < 0.0f)) continue;
            const double t = crossing(p, steps[a]);
            double n[3], length = 0.0;
            for (int b = 0; b < 3; ++b) {
                const auto slope = [&](const float* q) {
                    return 0.5 * (double(q[steps[b]]) - double(q[-steps[b]]));
                };
                n[b] = (1.0 - t) * slope(p) + t * slope(p + steps[a]);
                length += n[b] * n[b];
            }
            if (length == 0.0) continue;
            float at[3] = {float(place[0]), float(place[1]), float(place[2])};
            at[a] += float(t);
            points.push_back({at[0], at[1], at[2]});
            weights.push_back(std::abs(n[a]) / std::sqrt(length));
            edges.push_back({v, p - phi.values, steps[a], t});
        }
    });
}

} // namespace molsurf
