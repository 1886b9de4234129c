// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/bead_radii.h"

#include "molsurf/error.h"
#include "molsurf/kernel/balls/power_cells.h"
#include "molsurf/molecule/selection/coarse_grain.h"
#include "molsurf/molecule/selection/select_balls.h"
#include "support/molecules.h"
#include "support/runs.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

namespace molsurf
{
namespace
{

using openvdb::Vec3f;
using Members = std::vector<std::vector<std::size_t>>;

const Progress quiet;

BallSet beadsOf(const std::string& file, const SurfaceOptions& options,
                const std::vector<std::string>& rules)
{
    SelectOptions select;
    for (const std::string& rule : rules) select.coarse.push_back(parseCoarse(rule));
    return selectBalls(readStructure(std::string(MOLSURF_TEST_DATA) + "/" + file), select, {},
                       probeOf(options), quiet);
}

/// Parts of balls that are grown by a probe.
std::vector<double> partsOf(std::vector<Ball> balls, double probe)
{
    for (Ball& b : balls) b.radius += float(probe);
    return powerCells(balls, quiet).volumes;
}

TEST(SizeBeads, ABeadOfTwoAtomsFarFromOthersHasTheirVolume)
{
    const std::vector<Ball> atoms = {{Vec3f(0, 0, 0), 1.7f, 0}, {Vec3f(1.5f, 0, 0), 1.5f, 1}};
    for (const double probe : {0.0, 1.4}) {
        std::vector<Ball> bead = {{Vec3f(0.7f, 0, 0), 0.0f, 0}};
        sizeBeads(atoms, {{0, 1}}, probe, bead, quiet);
        const std::vector<double> parts = partsOf(atoms, probe);
        const double expected = std::cbrt((parts[0] + parts[1]) * 0.75 / M_PI) - probe;
        EXPECT_NEAR(bead[0].radius, expected, 1e-4) << probe;
    }
}

TEST(SizeBeads, EveryBeadHasThePartsOfItsAtoms)
{
    const std::vector<Ball> atoms = test::randomBalls(300, 14.0, openvdb::Vec3d(0.0), 11);
    Members members(60);
    std::vector<Ball> beads;
    for (std::size_t i = 0; i < atoms.size(); ++i) members[i / 5].push_back(i);
    for (const auto& m : members) beads.push_back({atoms[m[2]].center, 0.0f, std::int32_t(m[2])});
    for (const double probe : {0.0, 1.4}) {
        std::vector<Ball> sized = beads;
        sizeBeads(atoms, members, probe, sized, quiet);
        // Random balls are not packed as atoms are: some beads hit the least radius.
        const std::vector<double> wanted = partsOf(atoms, probe), found = partsOf(sized, probe);
        for (std::size_t b = 0; b < beads.size(); ++b) {
            double sum = 0.0;
            for (const std::size_t i : members[b]) sum += wanted[i];
            EXPECT_GE(sized[b].radius, 0.1f);
            EXPECT_NEAR(found[b], sum, 2e-4 * sum) << b << " probe " << probe;
        }
    }
}

TEST(SizeBeads, AtomsKeepTheirRadii)
{
    const Structure crambin = readStructure(std::string(MOLSURF_TEST_DATA) + "/1crn.pdb");
    const BallSet mixed = beadsOf("1crn.pdb", {}, {"A/1-20=residue"});
    const BallSet atoms = beadsOf("1crn.pdb", {}, {});
    EXPECT_GT(mixed.record.beads, 30u);
    std::size_t kept = 0;
    for (const Ball& ball : mixed.balls) {
        const Ball& atom = atoms.balls[std::size_t(ball.atom)];
        const auto residue = std::size_t(crambin.atoms[std::size_t(ball.atom)].residue);
        if (crambin.residues[residue].number <= 20) continue;
        EXPECT_EQ(ball.radius, atom.radius);
        ++kept;
    }
    EXPECT_EQ(kept, mixed.balls.size() - mixed.record.beads);
    EXPECT_EQ(mixed.balls.size() - mixed.record.beads + mixed.record.beadAtoms, 327u);
}

TEST(SizeBeads, BeadsOfOneCentreAreAnError)
{
    const std::vector<Ball> atoms = {{Vec3f(0, 0, 0), 1.7f, 0},
                                     {Vec3f(1.5f, 0, 0), 1.5f, 1},
                                     {Vec3f(0, 1.5f, 0), 1.5f, 2},
                                     {Vec3f(1.5f, 1.5f, 0), 1.5f, 3}};
    std::vector<Ball> beads = {{Vec3f(0.7f, 0.7f, 0), 0.0f, 0}, {Vec3f(0.7f, 0.7f, 0), 0.0f, 2}};
    try {
        sizeBeads(atoms, {{0, 1}, {2, 3}}, 1.4, beads, quiet);
        FAIL() << "expected an Error";
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Numeric);
    }
}

TEST(SizeBeads, TheSameBitsForAnyNumberOfThreads)
{
    const BallSet many = beadsOf("1a8o.cif.gz", {}, {"residue"});
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    const BallSet one = beadsOf("1a8o.cif.gz", {}, {"residue"});
    ASSERT_EQ(one.balls.size(), many.balls.size());
    for (std::size_t i = 0; i < one.balls.size(); ++i) {
        EXPECT_EQ(one.balls[i].radius, many.balls[i].radius);
        EXPECT_EQ(one.balls[i].center, many.balls[i].center);
    }
}

// The union of the balls that the surface is made of keeps its volume, the variational and the
// solvent-excluded surface nearly so.
TEST(SizeBeads, ResidueBeadsKeepTheVolumeOf1A8O)
{
    struct Case {
        SurfaceKind kind;
        double tolerance;
    };
    for (const Case& c : {Case{SurfaceKind::VanDerWaals, 1e-3},
                          {SurfaceKind::SolventAccessible, 1e-3},
                          {SurfaceKind::SolventExcluded, 0.05},
                          {SurfaceKind::Variational, 0.05}}) {
        SurfaceOptions options;
        options.kind = c.kind;
        Progress progress;
        const double fine = makeSurface(beadsOf("1a8o.cif.gz", options, {}), options, &progress)
                                .report.surface.outerVolume;
        const MolecularSurface coarse =
            makeSurface(beadsOf("1a8o.cif.gz", options, {"residue"}), options, &progress);
        EXPECT_NEAR(coarse.report.surface.outerVolume / fine, 1.0, c.tolerance) << int(c.kind);
        ASSERT_TRUE(coarse.report.coarse);
        EXPECT_EQ(coarse.report.coarse->beads, 136u);
        EXPECT_EQ(coarse.report.coarse->atoms, 556u);
    }
}

} // namespace
} // namespace molsurf
