// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/tomogram_map.h"

#include "molsurf/analysis/proximity/distance.h"
#include "molsurf/error.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/strings.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

constexpr int block = 8;                 // pixels that one task takes, on each axis it cuts
constexpr double pixelsOfDefault = 3.0;  // of a resolution that nobody asked for
constexpr double negligibleDecay = 16.0; // exp(-16) is 1e-7

// measured: build -o NAME.density.mrc, NAME.mask.mrc of 1CRN, 4AT1, 4V5A, pixels of 1 to 10 Å
constexpr double secondsPerTerm = 1.5e-9; // of an atom on a pixel
constexpr double secondsPerMasked = 8e-7; // pixel of the box
constexpr double bytesPerPixel = 4.0;

/// The atomic number that weighs a ball.
double weightOf(const BallSet& atoms, std::size_t i)
{
    constexpr std::uint8_t carbon = 6;
    const std::uint8_t element = atoms.names ? atoms.names->atoms[i].element : 0;
    return double(element > 0 ? element : carbon);
}

/// The rate C of exp(-C r^2) [1/Å^2].
double rateOf(const BallSet& atoms, std::size_t i, double pixel)
{
    if (!atoms.decays.empty() && atoms.decays[i].rate > 0.0f) return double(atoms.decays[i].rate);
    const double resolution = pixelsOfDefault * pixel;
    return M_PI * M_PI / (resolution * resolution);
}

Vec3d centreOf(const BallSet& atoms)
{
    Vec3d sum(0.0);
    double weights = 0.0;
    for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
        const double weight = weightOf(atoms, i);
        sum += weight * atoms.balls[i].center;
        weights += weight;
    }
    return sum / weights;
}

/// How far from a centre, along the axes, balls and what is grown on them reach [Å].
template<typename Growth>
double reachOf(const BallSet& atoms, const Vec3d& centre, const Growth& growth)
{
    double reach = 0.0;
    for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
        const Vec3d away = atoms.balls[i].center - centre;
        for (const double along : {away.x(), away.y(), away.z()})
            reach = std::max(reach, std::abs(along) + growth(i));
    }
    return reach;
}

/// The least even box whose pixels reach so far on both sides of the one in the middle.
int boxFor(double reach, double pixel)
{
    constexpr double most = 1e6;
    return 2 * (int(std::min(std::ceil(reach / pixel - 1e-9), most)) + 1);
}

/// Sets exp(-C d^2), d growing by a pixel from a first one [Å].
void setDecay(double rate, double from, double pixel, std::vector<double>& values)
{
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double d = from + double(k) * pixel;
        values[k] = std::exp(-rate * d * d);
    }
}

/// Some pixels of an axis.
struct PixelRange {
    int begin, end;

    std::size_t size() const { return std::size_t(end - begin); }
};

/// Those of a range that lie within a reach of a place, all counted from a corner [Å].
PixelRange within(const PixelRange& all, double place, double reach, double pixel)
{
    const auto pixelAt = [&](double x) { return std::clamp(x / pixel, -1.0, 1e6); };
    const int begin = std::clamp(int(std::ceil(pixelAt(place - reach))), all.begin, all.end);
    return {begin, std::clamp(int(std::floor(pixelAt(place + reach))) + 1, begin, all.end)};
}

/// A Gaussian factor exp(-rate |x - centre|^2).
struct Gaussian {
    Vec3d centre;
    double factor, rate;
};

/// Adds Gaussians to planes of pixels.
class PlaneAdder
{
public:
    PlaneAdder(const PixelBox& box, PixelRange planes, std::vector<float>& values)
        : box_(box), planes_(planes), values_(values)
    {
    }

    void add(const Gaussian& g)
    {
        const double reach = std::sqrt(negligibleDecay / g.rate);
        std::array<PixelRange, 3> range;
        for (std::size_t a = 0; a < 3; ++a) {
            const double place = g.centre[int(a)] - box_.corner[int(a)];
            range[a] =
                within(a == 2 ? planes_ : PixelRange{0, box_.count}, place, reach, box_.pixel);
            axis_[a].resize(range[a].size());
            setDecay(g.rate, range[a].begin * box_.pixel - place, box_.pixel, axis_[a]);
        }
        for (std::size_t z = 0; z < range[2].size(); ++z)
            for (std::size_t y = 0; y < range[1].size(); ++y) {
                const double row = g.factor * axis_[2][z] * axis_[1][y];
                float* to = &values_[box_.at(range[0].begin, range[1].begin + int(y),
                                             range[2].begin + int(z))];
                for (const double x : axis_[0]) *to++ += float(row * x);
            }
    }

private:
    const PixelBox& box_;
    PixelRange planes_;
    std::vector<float>& values_;
    std::array<std::vector<double>, 3> axis_; // of the last one
};

/// A value of the mask by the signed distance from the surface [Å].
float maskAt(double distance, const TomogramSettings& settings, double pixel)
{
    const double beyond = distance / pixel - settings.maskExtend;
    if (beyond <= 0.0) return 1.0f;
    if (beyond >= settings.maskEdge) return 0.0f;
    return float(0.5 + 0.5 * std::cos(M_PI * beyond / settings.maskEdge));
}

} // namespace

PixelBox tomogramBox(const BallSet& atoms, const TomogramSettings& settings)
{
    const double pixel = settings.pixel;
    if (!(pixel > 0.0))
        throw Error(ErrorKind::Usage, "a map of pixels: expected `pixelSize`, got none");
    if (!atoms.placement.isWhole())
        throw Error(ErrorKind::Usage, "a map of pixels: expected one surface, and not `instances` "
                                      "or `bySymmetry`");
    const Vec3d centre = centreOf(atoms);
    const auto radius = [&](std::size_t i) { return double(atoms.balls[i].radius); };
    const double rim = (settings.maskExtend + settings.maskEdge) * pixel;
    const int whole = boxFor(reachOf(atoms, centre,
                                     [&](std::size_t i) {
                                         const double blur =
                                             M_PI / std::sqrt(rateOf(atoms, i, pixel));
                                         return std::max(radius(i) + rim, blur);
                                     }),
                             pixel);
    const int count = settings.box > 0 ? settings.box : whole;
    const int least = boxFor(reachOf(atoms, centre, radius), pixel);
    if (count < least)
        throw Error(ErrorKind::Input,
                    formatted("`boxSize`: expected at least %d pixels, which hold the molecule at "
                              "%g Å a pixel, got %d [hint: %d hold its mask, too]",
                              least, pixel, count, whole));
    constexpr int most = 1290; // 2^31 points
    if (count > most)
        throw Error(ErrorKind::Input,
                    formatted("`pixelSize` %g: the box has %d pixels an edge, expected at most %d "
                              "[hint: larger pixels]",
                              pixel, count, most));
    return {count, centre - Vec3d(0.5 * count * pixel), pixel};
}

std::vector<float> tomogramDensity(const BallSet& atoms, const TomogramSettings& settings,
                                   const PixelBox& box, const Progress& progress)
{
    std::vector<float> values(box.size());
    const double sign = settings.invert ? -1.0 : 1.0;
    parallelFor(std::size_t((box.count + block - 1) / block), progress, [&](std::size_t slab) {
        const int low = int(slab) * block, high = std::min(low + block, box.count);
        PlaneAdder planes(box, {low, high}, values);
        for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
            const double rate = rateOf(atoms, i, box.pixel);
            planes.add({atoms.balls[i].center,
                        sign * weightOf(atoms, i) * std::pow(rate / M_PI, 1.5), rate});
        }
    });
    return values;
}

std::vector<float> softMask(const Mesh& mesh, const TomogramSettings& settings, const PixelBox& box,
                            const Progress& progress)
{
    const Surface surface{mesh, true, {}, Motion::identity()};
    const DistanceTo to(surface);
    std::vector<float> values(box.size());
    const int blocks = (box.count + block - 1) / block;
    const double half = 0.5 * (block - 1), around = std::sqrt(3.0) * half * box.pixel;
    const double rim = (settings.maskExtend + settings.maskEdge) * box.pixel;
    const auto signedAt = [](DistanceTo::Query& query, const Vec3d& x) {
        const Distance d = query.at(x);
        return d.inside ? -d.value : d.value;
    };
    parallelFor(std::size_t(blocks) * std::size_t(blocks), progress, [&](std::size_t column) {
        DistanceTo::Query query(to);
        const int y0 = int(column) % blocks * block, z0 = int(column) / blocks * block;
        for (int x0 = 0; x0 < box.count; x0 += block) {
            const double middle = signedAt(query, box.place(x0 + half, y0 + half, z0 + half));
            if (middle >= rim + around) continue; // 0, as is all of the block
            const bool isInside = middle <= -around;
            for (int z = z0; z < std::min(z0 + block, box.count); ++z)
                for (int y = y0; y < std::min(y0 + block, box.count); ++y)
                    for (int x = x0; x < std::min(x0 + block, box.count); ++x)
                        values[box.at(x, y, z)] =
                            isInside
                                ? 1.0f
                                : maskAt(signedAt(query, box.place(x, y, z)), settings, box.pixel);
        }
    });
    return values;
}

Cost costOfDensity(const BallSet& atoms, const TomogramSettings& settings)
{
    const PixelBox box = tomogramBox(atoms, settings);
    double terms = 0.0;
    for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
        const double edge =
            2.0 * std::sqrt(negligibleDecay / rateOf(atoms, i, box.pixel)) / box.pixel + 1.0;
        terms += std::pow(std::min(edge, double(box.count)), 3.0);
    }
    return {secondsPerTerm * terms, bytesPerPixel * double(box.size())};
}

Cost costOfMask(const BallSet& atoms, const TomogramSettings& settings)
{
    const double pixels = double(tomogramBox(atoms, settings).size());
    return {secondsPerMasked * pixels, bytesPerPixel * pixels};
}

} // namespace molsurf
