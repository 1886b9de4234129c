// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/placed_ball.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>

namespace molsurf
{

namespace
{

using Place = std::array<std::int64_t, 3>;

Place placeOf(const Ball& ball)
{
    constexpr double most = 1.04e6; // differences of two places do not overflow [Å]
    Place place;
    for (int a = 0; a < 3; ++a) {
        const double x = std::clamp(ball.center[a], -most, most);
        place[std::size_t(a)] = std::llround(x / placeUnit);
    }
    return place;
}

/// Along a Z-order curve: the axis with the highest bit that differs decides (Chan, Closest-point
/// problems simplified on the RAM, SODA 2002).
bool isBefore(const Place& a, const Place& b)
{
    std::size_t axis = 0;
    std::uint64_t most = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        // The sign of a two's complement number weighs like its other bits.
        const std::uint64_t differing = std::uint64_t(a[k]) ^ std::uint64_t(b[k]);
        if (most < differing && most < (most ^ differing)) {
            most = differing;
            axis = k;
        }
    }
    return a[axis] < b[axis];
}

/// Not by memcmp(), which a sort would call very often.
bool differ(const Place& a, const Place& b)
{
    return ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) != 0;
}

/// SplitMix64 (Steele, Lea and Flood, Fast splittable pseudorandom number generators, OOPSLA 2014).
std::uint64_t mixed(std::uint64_t x)
{
    x += 0x9e3779b97f4a7c15ull;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ x >> 27) * 0x94d049bb133111ebull;
    return x ^ x >> 31;
}

/// Moves a place by up to mostMoved along each axis, by a hash of place and radius: a ball moves
/// the same in every list. Another salt gives other moves, for a second try.
Place moved(Place place, double radius, std::uint64_t salt)
{
    constexpr std::int64_t most = std::int64_t(mostMoved / placeUnit);
    static_assert((most & (most - 1)) == 0); // a power of two: 2 most - 1 is a mask of bits
    std::uint64_t bits;
    std::memcpy(&bits, &radius, sizeof bits);
    std::uint64_t hash = mixed(salt ^ mixed(bits));
    for (const std::int64_t x : place) hash = mixed(hash ^ std::uint64_t(x));
    for (std::int64_t& x : place) {
        x += std::int64_t(hash & (2 * most - 1)) - most;
        hash = mixed(hash);
    }
    return place;
}

struct Sorted {
    Place place;
    double radius;
    std::int32_t index;
};

std::vector<Sorted> sorted(const std::vector<Ball>& balls)
{
    std::vector<Sorted> out(balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i)
        out[i] = {placeOf(balls[i]), balls[i].radius, std::int32_t(i)};
    tbb::parallel_sort(out.begin(), out.end(), [](const Sorted& a, const Sorted& b) {
        if (differ(a.place, b.place)) return isBefore(a.place, b.place);
        return std::tie(a.radius, a.index) < std::tie(b.radius, b.index);
    });
    return out;
}

} // namespace

std::vector<PlacedBall> placedBalls(const std::vector<Ball>& balls, double probe,
                                    std::uint64_t salt)
{
    std::vector<PlacedBall> out;
    out.reserve(balls.size());
    const std::vector<Sorted> all = sorted(balls);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Sorted& s = all[i];
        if (i > 0 && s.place == all[i - 1].place && s.radius == all[i - 1].radius) continue;
        out.push_back({moved(s.place, s.radius, salt), s.radius + probe - shrinkage, s.index});
    }
    return out;
}

std::vector<std::int32_t> spatialOrder(const std::vector<Ball>& balls)
{
    std::vector<std::int32_t> out;
    out.reserve(balls.size());
    for (const Sorted& s : sorted(balls)) out.push_back(s.index);
    return out;
}

std::vector<double> inCallersOrder(const std::vector<double>& values,
                                   const std::vector<std::int32_t>& order)
{
    std::vector<double> out(values.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[std::size_t(order[i])] = values[i];
    return out;
}

} // namespace molsurf
