// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/pipeline/carrier_of.h"

#include "molsurf/kernel/flow/initial_surface.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "support/fields.h"

#include <gtest/gtest.h>

#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

// A ball's psi is C (R^2 - r^2), over its slope 2 C R at r = R: C is gone, and with it the slopes
// of other balls.
TEST(CarrierOf, BallsOfAnySizeHaveTheirOwnSlopes)
{
    BallModel atoms;
    atoms.balls = {{Vec3d(0.1, 0.2, 0.3), 1.5, 0}, {Vec3d(25.1, 0.2, 0.3), 4.5, 1}};
    SurfaceSpec options;
    options.kind = SurfaceKind::Gaussian;
    const double h = options.voxel, width = bandWidthVox * h;
    SparseField psi =
        GaussianSum(atoms.balls, gaussianOptions(options)).band(bandWidthVox, Progress());
    const NarrowBand band{initialSurface(psi, width, {}, Progress()), std::move(psi.values)};
    const SparseField carrier = carrierOf(atoms, options, {}, band, Bumps(h), Progress());
    std::size_t seen[2] = {};
    test::forEachActive(carrier.table, h, [&](std::size_t n, int v, const Vec3d& x) {
        const std::size_t i = x.x() > 10.0;
        const double R = atoms.balls[i].radius, r = (x - atoms.balls[i].center).length();
        if (std::abs(r - R) > h) return;
        ++seen[i];
        ASSERT_NEAR(carrier.leaf(n)[v], (r * r - R * R) / (2.0 * R), 2e-3) << R;
    });
    EXPECT_GT(std::min(seen[0], seen[1]), 100u);
}

} // namespace
} // namespace molsurf
