// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/pipeline/check_balls.h"

#include "molsurf/error.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/pipeline/surface_kind.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace molsurf
{

namespace
{

std::string placeText(const openvdb::Vec3d& x)
{
    return formatted("(%g, %g, %g) Å", x[0], x[1], x[2]);
}

} // namespace

void checkFinite(const std::vector<Ball>& balls)
{
    constexpr double farthest = 1e6; // [Å]
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Ball& b = balls[i];
        const bool placed = std::abs(b.center.x()) <= farthest &&
                            std::abs(b.center.y()) <= farthest &&
                            std::abs(b.center.z()) <= farthest;
        if (placed && b.radius > 0.0 && b.radius <= farthest) continue;
        throw Error(
            ErrorKind::Input,
            "ball " + std::to_string(i) +
                (placed ? formatted(": expected a radius above 0 and up to 1e6 Å, got %g", b.radius)
                        : ": expected coordinates within 1e6 Å, got " + placeText(b.center)));
    }
}

std::string packingWarning(const std::vector<Ball>& balls)
{
    // Diamond has 0.18 atoms in an Å^3; coordinates in nanometres make that 180.
    constexpr double densest = 1.0; // [1/Å^3]
    constexpr std::size_t few = 10;
    if (balls.size() < few) return {};
    openvdb::BBoxd box;
    for (const Ball& ball : balls) box.expand(openvdb::Vec3d(ball.center));
    const openvdb::Vec3d size = box.extents() + openvdb::Vec3d(1.0); // of flat ones, too
    const double density = double(balls.size()) / (size[0] * size[1] * size[2]);
    if (!(density > densest)) return {};
    return formatted(
        "there are %.3g atoms in an Å^3, where diamond has 0.18: are the coordinates in "
        "nanometres? [hint: multiply them by 10]",
        density);
}

void checkBalls(const std::vector<Ball>& balls, const SurfaceSpec& spec, Pieces pieces,
                std::size_t memory)
{
    if (balls.empty()) throw Error(ErrorKind::Input, "no atoms");
    checkFinite(balls);
    if (pieces == Pieces::NoGrid) return;

    // The band of the surface has 6 voxels across. A run took 59 bytes for each at the least, on a
    // ball of 200 Å; the merge of bricks takes 7.
    constexpr double band = 6.0, share = 0.9;
    const double bytesPerVoxel = pieces == Pieces::One ? 50.0 : 6.0;
    const double radius = largestRadius(balls);
    const double bytes = bytesPerVoxel * band * 4.0 * M_PI * std::pow(radius / spec.voxel, 2);
    if (bytes <= share * double(memory)) return;
    constexpr double margin = 3.0; // what it takes above the least
    const double voxel = spec.voxel * std::sqrt(margin * bytes / double(memory));
    const std::string text =
        formatted("a ball of radius %.6g Å takes at least %s at a voxel of %g Å, and there are %s",
                  radius, sizeText(bytes).c_str(), spec.voxel, sizeText(double(memory)).c_str());
    throw Error(ErrorKind::Input,
                voxel <= maxVoxel ? text + formatted(" [hint: `voxel` %.2g]", voxel + 0.05) : text,
                true);
}

} // namespace molsurf
