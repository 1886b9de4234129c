// SPDX-License-Identifier: MPL-2.0
#include "support/runs.h"

#include "molsurf/error.h"
#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/kernel/mesh/topology.h"
#include "molsurf/molecule/selection/scalar_map.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/scale/bricks/atoms_file.h"
#include "molsurf/scale/bricks/brick_file.h"
#include "molsurf/scale/bricks/merge_mesh.h"
#include "molsurf/scale/bricks/merge_vdb.h"
#include "molsurf/scale/bricks/merged_bricks.h"
#include "molsurf/scale/bricks/plan_bricks.h"
#include "molsurf/scale/bricks/run_brick.h"
#include "molsurf/show/io/read_mesh.h"
#include "molsurf/show/io/read_vdb.h"
#include "molsurf/show/io/write_vdb.h"
#include "molsurf/surface/field_table.h"
#include "molsurf/surface/product_table.h"
#include "support/folder.h"
#include "support/mesh_checks.h"

#include <gtest/gtest.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>

#include <unistd.h>

namespace molsurf
{
namespace
{

using openvdb::Vec3f;

/// A crooked chain of balls, some 130 Å long, which crosses itself here and there.
std::vector<Ball> chain()
{
    std::mt19937 random(11);
    std::uniform_real_distribution<float> step(-1.0f, 1.0f);
    std::vector<Ball> balls;
    Vec3f at(-60.3f, 2.1f, -7.7f), way(1.0f, 0.0f, 0.0f);
    for (int i = 0; i < 1500; ++i) {
        way += 0.7f * Vec3f{step(random) + 0.12f, step(random), step(random)};
        way -= 0.01f * Vec3f(0.0f, at.y(), at.z());
        way.normalize();
        at += 1.5f * way;
        balls.push_back({at, i % 3 ? 1.7f : 1.52f, i});
    }
    return balls;
}

class Bricks : public ::testing::Test
{
protected:
    void SetUp() override
    {
        // Where there is one, a folder in memory: every file that is written is synced.
        const std::filesystem::path memory = "/dev/shm";
        folder_ = (std::filesystem::is_directory(memory) ? memory
                                                         : std::filesystem::temp_directory_path()) /
                  ("molsurf_bricks_" + std::to_string(getpid()) + "_" +
                   ::testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::create_directories(folder_);
        openvdb::initialize();
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    /// Computes all bricks of a plan, and opens them.
    std::vector<BrickFile> bricksOf(const BallSet& atoms, const SurfaceOptions& options,
                                    const BrickPlan& plan)
    {
        Progress progress;
        std::vector<BrickFile> files;
        std::shared_ptr<const SparseField> coarse;
        const auto near = [&](const openvdb::BBoxd& space) { return ballsIn(atoms, space); };
        for (std::size_t k = 0; k < plan.bricks.size(); ++k) {
            const std::string name = path(std::to_string(k) + ".brick");
            computeBrick(near, options, plan, k + 1, "test", name, true, coarse, progress);
            files.emplace_back(name);
        }
        return files;
    }

    /// Grids as their file gives them back.
    openvdb::GridPtrVec saved(const MolecularSurface& whole)
    {
        const openvdb::GridPtrVec grids = whole.grids();
        OutputFile file(path("saved.vdb"), true);
        writeVdb({grids.begin(), grids.end()}, {}, file);
        file.commit();
        return readVdb(path("saved.vdb")).grids;
    }

    /// Compares bricks with the whole, bit by bit.
    void expectSame(const std::vector<Ball>& balls, SurfaceOptions options, std::size_t count,
                    bool exact = true)
    {
        options.evolution.steps = 6;
        Progress progress;
        BallSet atoms;
        atoms.balls = balls;
        MolecularSurface whole = makeSurface(atoms, options, &progress);
        whole.surface = openvdb::gridPtrCast<openvdb::FloatGrid>(saved(whole).at(0));
        const BrickPlan plan = planBricks(atoms, options, {count, 0}, progress);
        ASSERT_GT(plan.bricks.size(), 1u);
        const std::vector<BrickFile> bricks = bricksOf(atoms, options, plan);

        OutputFile vdb(path("whole.vdb"), true);
        writeMergedVdb(bricks, options.voxel, "test", {}, vdb, progress);
        vdb.commit();
        openvdb::io::File file(path("whole.vdb"));
        file.open();
        const auto merged = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("surface"));
        EXPECT_EQ(merged->activeVoxelCount(), whole.surface->activeVoxelCount());
        EXPECT_EQ(merged->saveFloatAsHalf(), options.halfFloats);
        auto accessor = merged->getConstAccessor();
        float worst = 0.0f;
        std::size_t wrong = 0;
        for (auto it = whole.surface->cbeginValueAll(); it; ++it) {
            // Tiles too: the flood fill of the merged tree is that of the whole.
            const openvdb::Coord c = it.getCoord();
            worst = std::max(worst, std::abs(accessor.getValue(c) - *it));
            wrong += accessor.isValueOn(c) != it.isValueOn();
        }
        EXPECT_EQ(wrong, 0u);
        EXPECT_EQ(worst, 0.0f);

        const MergedMesh mesh(bricks);
        const SurfaceReport report = mesh.report();
        const SurfaceReport& expected = whole.report.surface;
        EXPECT_TRUE(report.closed && report.manifold);
        EXPECT_EQ(report.vertices, expected.vertices);
        EXPECT_EQ(report.triangles, expected.triangles);
        const SurfaceReport meshed = measure(whole.mesh, progress); // bricks know no closed form
        const int euler = *meshed.eulerCharacteristic;
        EXPECT_EQ(report.eulerCharacteristic, euler);
        EXPECT_EQ(report.maxResidual < 1e-3, expected.maxResidual < 1e-3);
        for (const BrickFile& brick : bricks)
            EXPECT_GE(report.maxResidual, brick.header().sums.maxResidual);
        EXPECT_EQ(report.meanCurvature.percentiles, expected.meanCurvature.percentiles);
        if (exact) {
            EXPECT_NEAR(report.area, meshed.area, 1e-9 * meshed.area);
            EXPECT_NEAR(report.volume, meshed.volume, 4e-9 * meshed.volume); // sums in floats
            EXPECT_EQ(report.components, meshed.components);
            EXPECT_EQ(report.cavities.size(), meshed.cavities.size());
        }
        OutputFile ply(path("whole.ply"), true);
        mesh.writePly(ply, progress);
        ply.commit();
        // A coarse mesh may cut itself, and bounds nothing that CGAL could judge then.
        const test::MeshVerdict verdict = test::judge(test::readPly(path("whole.ply")), true);
        EXPECT_TRUE(verdict.polygonMesh && verdict.valid && verdict.closed && verdict.outward)
            << verdict;
        EXPECT_EQ(verdict.euler, euler);
    }

    std::filesystem::path folder_;
};

SurfaceOptions coarse(SurfaceKind kind = SurfaceKind::Variational)
{
    SurfaceOptions options;
    options.voxel = 0.8;
    options.kind = kind;
    return options;
}

TEST_F(Bricks, VariationalSurfaceIsThatOfTheWhole)
{
    expectSame(chain(), coarse(), 5);
}

// With a large lambda fronts come from far; the rest on coarser voxels is that of the whole.
TEST_F(Bricks, FrontsAreThoseOfTheWhole)
{
    SurfaceOptions options = coarse();
    options.voxel = 0.5;
    options.evolution.lambda = 0.1;
    expectSame(chain(), options, 3);
}

// Fine enough for ridges to be rounded, over some voxels beyond a brick.
TEST_F(Bricks, RoundedRidgesAreThoseOfTheWhole)
{
    SurfaceOptions options = coarse();
    options.voxel = 0.2;
    expectSame(test::randomBalls(60, 16.0, openvdb::Vec3d(1.3, -2.1, 0.4), 3), options, 8);
}

// A probe of many voxels: distances come from leaves away.
TEST_F(Bricks, LargeProbesAreThoseOfTheWhole)
{
    SurfaceOptions options = coarse();
    options.voxel = 0.4;
    options.probe = 6.0;
    expectSame(test::randomBalls(150, 30.0, openvdb::Vec3d(1.3, -2.1, 0.4), 3), options, 8);
}

TEST_F(Bricks, HalfFloatsAreThoseOfTheWhole)
{
    SurfaceOptions options = coarse(SurfaceKind::Gaussian);
    options.halfFloats = true;
    expectSame(chain(), options, 4);
}

TEST_F(Bricks, GaussianSurfaceIsThatOfTheWhole)
{
    expectSame(chain(), coarse(SurfaceKind::Gaussian), 4);
}

TEST_F(Bricks, SolventExcludedSurfaceIsThatOfTheWhole)
{
    expectSame(chain(), coarse(SurfaceKind::SolventExcluded), 4);
}

// Fine enough for balls beyond the voxels around a brick to be felt in it.
TEST_F(Bricks, FineExcludedSurfacesAreThoseOfTheWhole)
{
    SurfaceOptions options = coarse(SurfaceKind::SolventExcluded);
    options.voxel = 0.2;
    expectSame(test::randomBalls(60, 16.0, openvdb::Vec3d(1.3, -2.1, 0.4), 3), options, 8);
}

TEST_F(Bricks, UnionsAreThoseOfTheWhole)
{
    // Of the whole, area, volume and pieces are those of the balls and not of the mesh.
    expectSame(chain(), coarse(SurfaceKind::VanDerWaals), 3, false);
    expectSame(chain(), coarse(SurfaceKind::SolventAccessible), 3, false);
}

/// Voxels of a grid that differ from those of another in value or activity.
template<typename GridT>
std::size_t differing(const openvdb::GridBase& a, const openvdb::GridBase& b)
{
    const auto &left = dynamic_cast<const GridT&>(a), &right = dynamic_cast<const GridT&>(b);
    const auto values = right.getConstAccessor();
    std::size_t wrong = left.activeVoxelCount() != right.activeVoxelCount();
    for (auto it = left.cbeginValueOn(); it; ++it)
        wrong += !values.isValueOn(it.getCoord()) || values.getValue(it.getCoord()) != *it;
    return wrong;
}

// A value beside a face of a brick is one of the surface, whose normal needs what lies behind it.
TEST_F(Bricks, FieldsAreThoseOfTheWhole)
{
    constexpr std::size_t count = 500;
    BallSet atoms;
    atoms.balls = chain();
    atoms.balls.resize(count);
    BallLabels& labels = atoms.labels.emplace();
    labels.chains = {"A"};
    labels.groups = {{"all", count, {}}};
    labels.chainOf.assign(count, 0);
    labels.groupOf = labels.chainOf;
    labels.elementOf.assign(count, 6);
    labels.residueClassOf.assign(count, ResidueClass::Other);
    BallValues& of = labels.values.emplace();
    of.name = "bfactor";
    of.unit = "Å²";
    for (std::size_t i = 0; i < count; ++i) of.valueOf.push_back(float(i % 7) / 6.0f);
    SurfaceOptions options = coarse();
    options.evolution.steps = 6;
    options.color = ColorBy::Value;
    for (const FieldRow& row : fieldTable())
        if (!(row.missingIn & InBricks) && row.name != "v") options.fields.push_back(row.name);
    Progress progress;
    const openvdb::GridPtrVec expected = saved(makeSurface(atoms, options, &progress));
    const BrickPlan plan = planBricks(atoms, options, {4, 0}, progress);
    OutputFile vdb(path("merged.vdb"), true);
    writeMergedVdb(bricksOf(atoms, options, plan), options.voxel, "test", {}, vdb, progress);
    vdb.commit();
    const openvdb::GridPtrVec merged = readVdb(path("merged.vdb")).grids;
    ASSERT_EQ(merged.size(), expected.size());
    ASSERT_EQ(merged.size(), options.fields.size() + 1);
    for (std::size_t g = 0; g < merged.size(); ++g) {
        const openvdb::GridBase &a = *expected[g], &b = *merged[g];
        ASSERT_EQ(a.getName(), b.getName());
        ASSERT_EQ(a.type(), b.type()) << a.getName();
        for (const char* word : {"attribute", "unit"})
            EXPECT_EQ(a[word] ? a[word]->str() : "", b[word] ? b[word]->str() : "") << a.getName();
        EXPECT_EQ(a.isType<openvdb::FloatGrid>()   ? differing<openvdb::FloatGrid>(a, b)
                  : a.isType<openvdb::Int32Grid>() ? differing<openvdb::Int32Grid>(a, b)
                                                   : differing<openvdb::Vec3SGrid>(a, b),
                  0u)
            << a.getName();
    }
}

TEST_F(Bricks, HoldTheWholeSpaceOnce)
{
    BallSet atoms;
    atoms.balls = chain();
    Progress progress;
    const BrickPlan plan = planBricks(atoms, coarse(), {7, 0}, progress);
    std::size_t balls = 0;
    for (std::size_t i = 0; i < plan.bricks.size(); ++i) {
        const openvdb::CoordBBox& box = plan.bricks[i].box;
        balls += plan.bricks[i].atoms;
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(box.min()[axis] % leafDim, 0);
            EXPECT_EQ((box.max()[axis] + 1) % leafDim, 0);
        }
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_FALSE(box.hasOverlap(plan.bricks[j].box)) << i << " " << j;
    }
    EXPECT_EQ(balls, atoms.balls.size());
}

TEST_F(Bricks, NeedTheMemoryOfTheirSurface)
{
    BallSet atoms;
    atoms.balls = test::randomBalls(3000, 40.0, openvdb::Vec3d(0.0), 2);
    Progress progress;
    const auto bytes = [&](SurfaceKind kind, std::vector<std::string> fields) {
        SurfaceOptions options = coarse();
        options.kind = kind;
        options.fields = std::move(fields);
        return planWhole(atoms, options, progress).bricks[0].bytes;
    };
    const std::size_t plain = bytes(SurfaceKind::Variational, {"surface"});
    EXPECT_GT(bytes(SurfaceKind::Gaussian, {"surface"}), plain);    // runs between the atoms
    EXPECT_GT(bytes(SurfaceKind::VanDerWaals, {"surface"}), plain); // has all atoms on its boundary
    const std::size_t one = bytes(SurfaceKind::Variational, {"surface", "mean_curvature"}) - plain;
    const std::size_t three = bytes(SurfaceKind::Variational, {"surface", "Cd"}) - plain;
    EXPECT_GT(one, 0u);
    EXPECT_NEAR(double(three), 3.0 * double(one), 2.0); // rounding
}

// Many leaves far from each other are counted by a sample, which takes little memory.
TEST_F(Bricks, AreEstimatedFromASampleOfFarAtoms)
{
    SurfaceOptions options = coarse();
    options.kind = SurfaceKind::VanDerWaals;
    options.voxel = 2.0;
    Progress progress;
    const auto planOf = [&](int count) {
        BallSet atoms;
        for (int i = 0; i < count; ++i) {
            const Vec3f place(float(i % 50), float(i / 50 % 50), float(i / 2500));
            atoms.balls.push_back({200.0f * place, 1.7f, i});
        }
        return planWhole(atoms, options, progress).bricks[0];
    };
    const PlannedBrick all = planOf(40000), sampled = planOf(120000);
    EXPECT_EQ(all.atoms, 40000u);
    const auto expectThrice = [](std::size_t most, std::size_t least) {
        EXPECT_NEAR(double(most) / double(least), 3.0, 0.03);
    };
    expectThrice(sampled.atoms, all.atoms);
    expectThrice(sampled.voxels, all.voxels);
    EXPECT_NEAR(sampled.seconds / all.seconds, 3.0, 0.03);
}

// Fronts that move far take several times the steps.
TEST_F(Bricks, ALargeLambdaIsEstimatedToTakeLonger)
{
    BallSet atoms;
    atoms.balls = chain();
    Progress progress;
    const auto secondsOf = [&](SurfaceKind kind, double lambda) {
        SurfaceOptions options;
        options.kind = kind;
        options.evolution.lambda = lambda;
        return planWhole(atoms, options, progress).bricks[0].seconds;
    };
    const double calm = secondsOf(SurfaceKind::Variational, 0.01);
    EXPECT_EQ(secondsOf(SurfaceKind::Variational, 0.03), calm);
    EXPECT_GT(secondsOf(SurfaceKind::Variational, 0.1), 1.8 * calm);
    EXPECT_EQ(secondsOf(SurfaceKind::Gaussian, 0.1), secondsOf(SurfaceKind::Gaussian, 0.01));
}

TEST_F(Bricks, FitTheMemoryOrSayWhatWould)
{
    BallSet atoms;
    atoms.balls = chain();
    Progress progress;
    const std::size_t whole = planWhole(atoms, coarse(), progress).bricks[0].bytes;
    const std::size_t less = whole - whole / 20;
    const BrickPlan plan = planBricks(atoms, coarse(), {0, less}, progress);
    EXPECT_GT(plan.bricks.size(), 1u);
    for (const PlannedBrick& brick : plan.bricks) EXPECT_LE(brick.bytes, less);
    EXPECT_FALSE(plan.keepsMemory);
    const BrickPlan kept = planBricks(atoms, coarse(), {0, less, true}, progress);
    EXPECT_GE(kept.bricks.size(), plan.bricks.size());
    for (const PlannedBrick& brick : kept.bricks) EXPECT_LE(brick.bytes, less);
    try {
        planBricks(atoms, coarse(), {0, 1000000}, progress);
        FAIL() << "a megabyte is not enough";
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Input);
        const std::string text = e.what(), mark = "[hint: `memory` ";
        const std::size_t at = text.find(mark);
        ASSERT_NE(at, std::string::npos) << text;
        const std::size_t megabytes = std::stoul(text.substr(at + mark.size()));
        EXPECT_NO_THROW(planBricks(atoms, coarse(), {0, megabytes << 20}, progress)) << text;
        EXPECT_THROW(planBricks(atoms, coarse(), {0, (megabytes << 20) / 10 * 8}, progress), Error);
    }
}

TEST_F(Bricks, RefuseWhatNeedsTheWhole)
{
    const auto refused = [](auto change) {
        SurfaceOptions options;
        change(options);
        EXPECT_THROW(checkWay(InBricks, options), Error);
    };
    EXPECT_NO_THROW(checkWay(InBricks, SurfaceOptions()));
    refused([](SurfaceOptions& o) { o.split = true; });
    refused([](SurfaceOptions& o) { o.interfaces = true; });
    refused([](SurfaceOptions& o) { o.fillCavities = true; });
    refused([](SurfaceOptions& o) { o.curvatureTotals = true; });
    refused([](SurfaceOptions& o) { o.splineLevel = 1; });
    refused([](SurfaceOptions& o) { o.evolution.flow = Flow::Paper; });
    refused([](SurfaceOptions& o) { o.color = ColorBy::MeanCurvature; });
    refused([](SurfaceOptions& o) { o.surfaceOf = {{"a", SurfaceKind::VanDerWaals}}; });
}

TEST_F(Bricks, DamagedPlansAreRefused)
{
    BallSet atoms;
    atoms.balls = {{Vec3f(0.0f), 2.0f, 0}, {Vec3f(3.0f, 0.0f, 0.0f), 2.0f, 1}};
    SurfaceOptions options;
    options.voxel = 1.0;
    const BrickPlan good = planBricks(atoms, options, {1, 0});
    checkPlan(good, options);
    const auto expectRefused = [&](const auto& damage) {
        BrickPlan plan = good;
        damage(plan);
        EXPECT_THROW(checkPlan(plan, options), Error);
    };
    expectRefused([](BrickPlan& plan) { plan.steps = 2'000'000'000; });
    expectRefused([](BrickPlan& plan) { plan.steps = -1; });
    expectRefused([](BrickPlan& plan) { plan.anchor.x() = 1 << 30; });
    expectRefused([](BrickPlan& plan) { plan.bricks[0].box.max().x() = 2147483647; });
    expectRefused([](BrickPlan& plan) { plan.bricks[0].box.min().y() -= 1; });
    expectRefused(
        [](BrickPlan& plan) { std::swap(plan.bricks[0].box.min(), plan.bricks[0].box.max()); });
    for (double BrickPlan::*length :
         {&BrickPlan::maxRadius, &BrickPlan::maxGrownRadius, &BrickPlan::maxTolerance}) {
        BrickPlan plan = good;
        plan.*length = 1e9;
        EXPECT_THROW(makeBrick(atoms, options, plan, 1, path("a.brick")), Error);
    }
}

TEST_F(Bricks, ACutFileIsRefused)
{
    BallSet atoms;
    atoms.balls = {{Vec3f(0.1f, 0.2f, 0.3f), 1.7f, 0}};
    SurfaceOptions options = coarse();
    options.evolution.steps = 2;
    Progress progress;
    const BrickPlan plan = planWhole(atoms, options, progress);
    bricksOf(atoms, options, plan);
    std::ifstream in(path("0.brick"), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    std::ofstream(path("cut.brick"), std::ios::binary) << bytes.substr(0, bytes.size() - 5);
    EXPECT_THROW(BrickFile(path("cut.brick")), Error);
    std::ofstream(path("other.brick"), std::ios::binary) << "something else, of some length";
    EXPECT_THROW(BrickFile(path("other.brick")), Error);
}

TEST_F(Bricks, FilesThatAreRefusedAreClosed)
{
    std::ofstream(path("short.brick")) << "MOLBRK05";
    std::ofstream(path("other.brick")) << "something else, of some length";
    const auto opened = [] {
        const std::filesystem::directory_iterator all("/proc/self/fd");
        return std::distance(begin(all), end(all));
    };
    const auto before = opened();
    for (int i = 0; i < 100; ++i)
        EXPECT_THROW(BrickFile(path(i % 2 ? "short.brick" : "other.brick")), Error);
    EXPECT_EQ(opened(), before);
}

/// Two bricks of a molecule, and what is done to them.
struct HostileBricks : Bricks {
    void SetUp() override
    {
        Bricks::SetUp();
        BallSet atoms;
        for (int i = 0; i < 12; ++i)
            atoms.balls.push_back({Vec3f(3.0f * float(i), 0.2f, 0.3f), 1.7f, i});
        options = coarse();
        options.evolution.steps = 2;
        plan = planBricks(atoms, options, {2, 0}, progress);
        ASSERT_EQ(plan.bricks.size(), 2u);
        for (std::size_t k = 0; k < 2; ++k) {
            const Scope scope = scopeOf(plan, k, options);
            bricks.push_back(runBrick(inSpatialOrder(ballsIn(atoms, spaceNear(options, scope))),
                                      options, scope, progress));
            write(k);
        }
    }

    std::string pathOf(std::size_t k) { return path(std::to_string(k) + ".brick"); }

    void write(std::size_t k)
    {
        OutputFile file(pathOf(k), true);
        writeBrick(bricks[k], "test", k + 1, true, file, progress);
        file.commit();
    }

    std::string bytesOf(std::size_t k)
    {
        std::ifstream in(pathOf(k), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    /// Writes a file again, with the checksum of what it has now.
    void putBack(std::size_t k, std::string bytes)
    {
        constexpr std::size_t body = 32;
        const std::uint64_t sum =
            crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()) + body, bytes.size() - body);
        std::memcpy(&bytes[24], &sum, sizeof sum);
        std::ofstream(pathOf(k), std::ios::binary) << bytes;
    }

    /// What merging says; nothing if it succeeds.
    std::string merged()
    {
        try {
            const MergedBricks all({pathOf(0), pathOf(1)}, "test", plan, options, true);
            OutputFile vdb(path("m.vdb"), true), ply(path("m.ply"), true);
            all.writeVdb({}, vdb, progress);
            all.writePly(ply, progress);
            vdb.commit();
            ply.commit();
        } catch (const Error& e) {
            return e.what();
        }
        return {};
    }

    void expectRefused(const char* why)
    {
        const std::string text = merged();
        EXPECT_NE(text.find(why), std::string::npos) << text;
    }

    SurfaceOptions options;
    BrickPlan plan;
    std::vector<Brick> bricks;
    Progress progress;
};

TEST_F(HostileBricks, AreMergedAsLongAsTheyAreGood)
{
    EXPECT_EQ(merged(), "");
}

TEST_F(HostileBricks, EveryFlippedBitIsSeen)
{
    const std::string good = bytesOf(0);
    std::mt19937 random(3);
    for (int i = 0; i < 100; ++i) {
        std::string bytes = good;
        const std::size_t at = random() % bytes.size();
        bytes[at] = char(bytes[at] ^ (1 << random() % 8));
        std::ofstream(pathOf(0), std::ios::binary) << bytes;
        EXPECT_NE(merged(), "") << at;
    }
}

TEST_F(HostileBricks, LengthsThatWrapAreRefusedBeforeMemoryIsTaken)
{
    std::string bytes = bytesOf(0);
    const std::uint64_t length = ~std::uint64_t(0) - 40, header = bytes.size() - length;
    std::memcpy(&bytes[8], &header, sizeof header);
    std::memcpy(&bytes[16], &length, sizeof length);
    putBack(0, bytes);
    expectRefused("cut short");
}

TEST_F(HostileBricks, OthersGroupsAreRefused)
{
    bricks[1].groups.resize(3);
    write(1);
    expectRefused("groups are others");
}

TEST_F(HostileBricks, OthersNumbersAreRefused)
{
    OutputFile file(pathOf(0), true);
    writeBrick(bricks[0], "test", 2, true, file, progress);
    file.commit();
    expectRefused("belongs to another plan");
}

TEST_F(HostileBricks, OthersPrecisionIsRefused)
{
    for (const auto& grid : bricks[1].grids) grid->setSaveFloatAsHalf(true);
    write(1);
    expectRefused("grids or groups are others");
    for (const auto& grid : bricks[0].grids) grid->setSaveFloatAsHalf(true);
    write(0);
    EXPECT_EQ(merged(), "");
}

// Areas are sums, brought to the area of the whole; the atoms of no group are the rest, and without
// any it is no group.
TEST_F(HostileBricks, GroupsAreSums)
{
    for (const std::size_t second : {4u, 7u}) {
        for (const std::size_t k : {0u, 1u}) {
            bricks[k].groups.resize(3);
            const double areas[2][3] = {{30.0, 10.0, 0.0}, {5.0, 50.0, second == 4 ? 5.0 : 0.0}};
            for (std::size_t g = 0; g < 3; ++g) bricks[k].groups[g].area = areas[k][g];
            bricks[k].groups[0].name = "one";
            bricks[k].groups[0].atoms = 5;
            bricks[k].groups[1].name = "two";
            bricks[k].groups[1].atoms = second;
            bricks[k].groups[1].color = k == 1 ? "#010203" : "";
            write(k);
        }
        const Report report =
            MergedBricks({pathOf(0), pathOf(1)}, "test", plan, options, true).report();
        ASSERT_EQ(report.groups.size(), second == 4 ? 3u : 2u);
        const double all = second == 4 ? 100.0 : 95.0, whole = report.surface.area;
        EXPECT_NEAR(report.groups[0].area, 35.0 / all * whole, 1e-9 * whole);
        EXPECT_NEAR(report.groups[1].area, 60.0 / all * whole, 1e-9 * whole);
        EXPECT_EQ(report.groups[0].atoms, 5u);
        EXPECT_EQ(report.groups[1].atoms, second);
        EXPECT_EQ(report.groups[1].color, "#010203");
        EXPECT_TRUE(std::isnan(report.groups[0].volume));
        if (second == 4) {
            EXPECT_EQ(report.groups[2].atoms, 3u);
        }
    }
}

// Energies, areas and volumes of a step are sums, its displacement the mean over the area, its
// speed the largest.
TEST_F(HostileBricks, StepsAreSums)
{
    for (const std::size_t k : {0u, 1u}) {
        EvolutionReport& part = *bricks[k].evolution;
        ASSERT_GE(part.area.size(), 2u);
        part.area[0] = k == 0 ? 30.0 : 10.0;
        part.meanDisplacement[0] = k == 0 ? 0.1 : 0.5;
        part.area[1] = 0.0;
        part.meanDisplacement[1] = 0.25;
        part.maxSpeed[0] = k == 0 ? 0.7 : 0.3;
        write(k);
    }
    const Report report =
        MergedBricks({pathOf(0), pathOf(1)}, "test", plan, options, true).report();
    ASSERT_TRUE(report.evolution);
    const EvolutionReport &all = *report.evolution, &one = *bricks[0].evolution,
                          &two = *bricks[1].evolution;
    EXPECT_EQ(all.steps, 2);
    EXPECT_NEAR(all.finalEnergy, one.finalEnergy + two.finalEnergy, 1e-9);
    ASSERT_EQ(all.energy.size(), one.energy.size());
    for (std::size_t i = 0; i < one.energy.size(); ++i)
        EXPECT_NEAR(all.energy[i], one.energy[i] + two.energy[i], 1e-9) << i;
    ASSERT_EQ(all.volume.size(), one.volume.size());
    for (std::size_t i = 0; i < one.volume.size(); ++i) {
        EXPECT_NEAR(all.volume[i], one.volume[i] + two.volume[i], 1e-9) << i;
        EXPECT_NEAR(all.area[i], one.area[i] + two.area[i], 1e-9) << i;
    }
    EXPECT_EQ(all.maxSpeed[0], 0.7);
    EXPECT_NEAR(all.meanDisplacement[0], (30.0 * 0.1 + 10.0 * 0.5) / 40.0, 1e-12);
    EXPECT_EQ(all.meanDisplacement[1], 0.0); // there is no area
}

TEST_F(HostileBricks, StepsWithoutSumsAreRefused)
{
    bricks[0].evolution->area.pop_back();
    write(0);
    expectRefused("steps are not as many");
}

TEST_F(HostileBricks, NoGridsAreRefused)
{
    bricks[0].grids.clear();
    write(0);
    expectRefused("grids do not begin with surface");
}

TEST_F(HostileBricks, LeavesThatAreNoneAreRefused)
{
    const BrickFile file(pathOf(0));
    const Section leaves = file.header().grids.front().leaves;
    ASSERT_GT(leaves.count, 1u);
    const std::string good = bytesOf(0);
    const auto with = [&](const auto& change) {
        std::string bytes = good;
        StoredLeaf leaf;
        std::memcpy(&leaf, &bytes[leaves.offset], sizeof leaf);
        change(leaf);
        std::memcpy(&bytes[leaves.offset], &leaf, sizeof leaf);
        putBack(0, bytes);
    };
    with([](StoredLeaf& leaf) { leaf.negative ^= 1; });
    expectRefused("not those of their leaf");
    with([](StoredLeaf& leaf) { leaf.negative = 4; });
    expectRefused("not those of their leaf");
    with([](StoredLeaf& leaf) { leaf.mask[0] ^= 1; });
    expectRefused("not those of their leaf");
    with([](StoredLeaf& leaf) { leaf.origin[1] += 3; });
    expectRefused("between leaves");
    with([](StoredLeaf& leaf) { leaf.origin[2] = 1 << 30; });
    expectRefused("far away");
    with([](StoredLeaf& leaf) { leaf.size = ~std::uint64_t(0) - 7; });
    expectRefused("values lie elsewhere");
    with([](StoredLeaf& leaf) { leaf.offset = std::uint64_t(1) << 50; });
    expectRefused("values lie elsewhere");
    with([&](StoredLeaf& leaf) { leaf.origin[0] += plan.bricks[0].box.dim().x(); });
    expectRefused("far away");
    with([&](StoredLeaf& leaf) {
        StoredLeaf next;
        std::memcpy(&next, &good[leaves.offset + sizeof next], sizeof next);
        leaf.origin = next.origin;
    });
    expectRefused("another brick has");
}

TEST_F(HostileBricks, VerticesThatAreNoneAreRefused)
{
    bricks[0].mesh.mesh.triangles.front()[1] = 1u << 30;
    write(0);
    expectRefused("a vertex that it does not have");
    bricks[0].mesh.mesh.triangles.front()[1] = 0;
    ASSERT_FALSE(bricks[0].mesh.border.empty());
    bricks[0].mesh.border.front().piece = 1u << 30;
    write(0);
    expectRefused("a piece that it does not have");
}

TEST_F(HostileBricks, MeshesThatAreNotWhatTheySayAreRefused)
{
    const BrickMesh good = bricks[0].mesh;
    const auto expectRefusedWith = [&](const auto& change, const char* why) {
        bricks[0].mesh = good;
        change(bricks[0].mesh);
        write(0);
        expectRefused(why);
    };
    expectRefusedWith([](BrickMesh& b) { b.mesh.triangles.resize(b.mesh.triangles.size() / 2); },
                      "brick");
    expectRefusedWith([](BrickMesh& b) { b.mesh.triangles.erase(b.mesh.triangles.begin() + 40); },
                      "holes");
    expectRefusedWith([](BrickMesh& b) { b.mesh.triangles[40][1] = b.mesh.triangles[40][0]; },
                      "two vertices");
    expectRefusedWith([](BrickMesh& b) { b.pieces.emplace_back(); }, "number of pieces");
    expectRefusedWith([](BrickMesh& b) { b.openEdges.pop_back(); }, "open edges");
    expectRefusedWith([](BrickMesh& b) { b.openEdges.front().surplus = -1; }, "open edges");
    expectRefusedWith([](BrickMesh& b) { b.mesh.positions[7][2] = NAN; }, "far away");
    expectRefusedWith([](BrickMesh& b) { b.pieces.front().area = INFINITY; }, "without a size");
    expectRefusedWith(
        [](BrickMesh& b) {
            for (auto& t : b.mesh.triangles)
                for (auto& v : t) v += v >= b.owned;
            for (auto& v : b.border) v.vertex += v.vertex >= b.owned;
            for (auto& e : b.openEdges) e.from += e.from >= b.owned, e.to += e.to >= b.owned;
            b.mesh.positions.insert(b.mesh.positions.begin() + long(b.owned), Vec3f(0.0f));
            b.mesh.normals.insert(b.mesh.normals.begin() + long(b.owned), Vec3f(0.0f));
            for (auto& a : b.mesh.scalars) a.values.insert(a.values.begin() + long(b.owned), 0.0f);
            for (auto& a : b.mesh.labels) a.values.insert(a.values.begin() + long(b.owned), 0);
            b.areas.push_back(1.0f);
            b.pieces.emplace_back();
            ++b.owned;
        },
        "no triangle");
}

TEST_F(HostileBricks, BricksWithoutAMeshAreRefusedWhereOneIsWanted)
{
    OutputFile file(pathOf(0), true);
    writeBrick(bricks[0], "test", 1, false, file, progress);
    file.commit();
    expectRefused("holds no mesh");
    EXPECT_NO_THROW(MergedBricks({pathOf(0), pathOf(1)}, "test", plan, options, false));
}

TEST_F(HostileBricks, GroupsOfMoreAtomsThanThereAreAreRefused)
{
    for (Brick& brick : bricks) {
        brick.groups.resize(2);
        brick.groups[0].atoms = 13;
    }
    write(0);
    write(1);
    expectRefused("more atoms than the plan");
}

TEST_F(HostileBricks, LeavesFarFromEachOtherAreRefusedBeforeMemoryIsTaken)
{
    using Leaf = openvdb::FloatTree::LeafNodeType;
    auto& grid = dynamic_cast<openvdb::FloatGrid&>(*bricks[0].grids.front());
    for (int i = 1; i < 40; ++i)
        for (int j = 1; j < 25; ++j)
            grid.tree().addLeaf(new Leaf(openvdb::Coord(i << 13, j << 13, 0), 1.0f));
    write(0);
    plan.bricks[0].box = anySpace();
    expectRefused("too far from each other");
}

TEST_F(HostileBricks, LeavesThatEncloseTooMuchAreRefused)
{
    using Leaf = openvdb::FloatTree::LeafNodeType;
    auto& grid = dynamic_cast<openvdb::FloatGrid&>(*bricks[0].grids.front());
    for (int j = 1; j < 4; ++j)
        for (const int z : {-(1 << 26), (1 << 26) - 8})
            grid.tree().addLeaf(new Leaf(openvdb::Coord(0, j << 13, z), -1.0f));
    write(0);
    plan.bricks[0].box = anySpace();
    expectRefused("enclose more");
}

/// Changes bytes, and numbers of the header, as somebody might who makes the checksum right again.
std::string mutated(std::string bytes, std::mt19937& random)
{
    std::uint64_t head[2];
    std::memcpy(head, &bytes[8], sizeof head);
    const auto below = [&](std::size_t end) { return std::size_t(random()) % end; };
    for (std::size_t times = 1 + below(3); times > 0; --times) {
        const std::size_t body = 32, at = body + below(std::size_t(head[0]) - body);
        const std::size_t size = std::min<std::size_t>(std::size_t(1) << below(5), head[0] - at);
        switch (below(4)) {
        case 0:
            bytes[at] = char(bytes[at] ^ (1 << below(8)));
            break;
        case 1:
            bytes.replace(at, size, bytes, body + below(std::size_t(head[0]) - body - size), size);
            break;
        case 2:
            bytes.replace(at, size, size, below(2) ? '\xff' : '\0');
            break;
        case 3: { // another number in the header
            const char* others[] = {
                "0",          "1",    "-1",   "2",   "1e300", "18446744073709551615",
                "4294967296", "true", "null", "\"\""};
            std::size_t from = std::size_t(head[0]) + below(bytes.size() - std::size_t(head[0]));
            from = bytes.find_first_of("0123456789", from);
            if (from == std::string::npos) break;
            const std::size_t end = bytes.find_first_not_of("0123456789.e-+", from);
            const std::string old = bytes.substr(from, end - from);
            const std::string fresh =
                below(2) ? others[below(std::size(others))]
                         : std::to_string(std::atoll(old.c_str()) + (below(2) ? 1 : -1));
            bytes.replace(from, old.size(), fresh);
            break;
        }
        }
    }
    head[1] = bytes.size() - head[0];
    std::memcpy(&bytes[8], head, sizeof head);
    return bytes;
}

// MOLSURF_MUTATIONS says how many, if not a few thousand.
TEST_F(HostileBricks, MutatedOnesGiveFilesThatCanBeReadOrOneLine)
{
    const char* asked = std::getenv("MOLSURF_MUTATIONS");
    const std::string good = bytesOf(0);
    std::mt19937 random(31);
    int whole = 0;
    const int count = asked ? std::atoi(asked) : 3000;
    for (int i = 0; i < count; ++i) {
        putBack(0, mutated(good, random));
        const std::string said = merged();
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
        if (!said.empty()) continue;
        ++whole;
        EXPECT_NO_THROW(readVdb(path("m.vdb"))) << i;
        const Topology topology = checkTopology(readMesh(path("m.ply")), progress);
        const MergedBricks all({pathOf(0), pathOf(1)}, "test", plan, options, true);
        EXPECT_TRUE(topology.closed || !all.report().surface.closed) << i;
        EXPECT_TRUE(topology.manifold || !all.report().surface.manifold) << i;
    }
    RecordProperty("merged", whole);
    EXPECT_GT(whole, count / 100);
    EXPECT_LT(whole, count);
}

// Beyond 4096 voxels a tree has another node under its root: what lies between two of them along z
// is inside, if both ends are.
TEST_F(Bricks, MergedTreesAreFilledBetweenTheNodesUnderTheirRoot)
{
    constexpr int node = openvdb::FloatTree::RootNodeType::ChildNodeType::DIM;
    const float outside = 3.0f;
    auto grid = openvdb::FloatGrid::create(outside);
    grid->setName("surface");
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    using Leaf = openvdb::FloatTree::LeafNodeType;
    const auto add = [&](int xy, int z, bool entering) {
        auto* leaf = new Leaf(openvdb::Coord(xy, xy, z), outside);
        for (openvdb::Index v = 0; v < Leaf::SIZE; ++v)
            leaf->setValueOn(v, (entering ? 3.5f - float(v & 7) : float(v & 7) - 3.5f) * 0.5f);
        grid->tree().addLeaf(leaf);
    };
    add(node - 8, node - 8, true); // the last leaf of its node
    add(0, 3 * node, false);       // the first one
    Brick brick;
    brick.grids = {grid->deepCopyGrid()};
    OutputFile file(path("1.brick"), true);
    Progress progress;
    writeBrick(brick, "test", 1, false, file, progress);
    file.commit();
    std::vector<BrickFile> bricks;
    bricks.emplace_back(path("1.brick"));
    OutputFile vdb(path("a.vdb"), true);
    writeMergedVdb(bricks, 0.5, "test", {}, vdb, progress);
    vdb.commit();
    openvdb::io::File in(path("a.vdb"));
    in.open();
    const auto merged = openvdb::gridPtrCast<openvdb::FloatGrid>(in.readGrid("surface"));
    const auto at = [&](int z) { return merged->getConstAccessor().getValue({0, 0, z}); };
    openvdb::tools::signedFloodFill(grid->tree());
    for (const int z : {node + 5, 2 * node + 5, 3 * node - 5}) {
        EXPECT_EQ(at(z), -outside) << z;
        EXPECT_EQ(at(z), grid->getConstAccessor().getValue({0, 0, z})) << z;
    }
    EXPECT_EQ(at(5 * node), outside);
}

/// Balls with all that a file of atoms keeps.
BallSet describedBalls()
{
    BallSet atoms;
    atoms.balls = chain();
    atoms.balls.resize(200);
    atoms.resolutions = {{{"A", 6.0}, 120, 0.5}, {{"B/10-20", 9.5}, 80, -0.25}};
    atoms.coloring.range = {{-1.5, 2.5}};
    atoms.coloring.palette = "magma";
    atoms.coloring.potentialOffset = 2.25;
    atoms.coloring.byResidue = true;
    BallLabels& labels = atoms.labels.emplace();
    labels.chains = {"A", "B-2"};
    labels.groups = {{"one", 150, {}}, {"two", 50, {{1, 2, 3}}}};
    labels.values.emplace();
    labels.values->name = "bfactor";
    labels.values->low = -3.25;
    labels.values->centre = openvdb::Vec3d(1.0, -2.0, 0.1);
    ScalarMap map;
    map.counts[0] = map.counts[1] = 2;
    map.counts[2] = 3;
    map.values.assign(12, 0.5f);
    labels.values->field = std::make_shared<ScalarMap>(map);
    for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
        const auto n = std::int32_t(i);
        atoms.resolutionOf.push_back(n % 3 - 1);
        atoms.decays.push_back({0.1f * float(n), -0.2f * float(n)});
        atoms.colors.push_back({std::uint8_t(n), std::uint8_t(2 * n), std::uint8_t(3 * n)});
        labels.chainOf.push_back(n % 2);
        labels.groupOf.push_back(n % 3 - 1);
        labels.elementOf.push_back(std::uint8_t(n % 90));
        labels.residueClassOf.push_back(ResidueClass(n % 12));
        labels.values->valueOf.push_back(0.5f * float(n));
    }
    return atoms;
}

/// What is known of each ball, by its atom.
std::map<std::int32_t, std::vector<double>> factsOf(const BallSet& atoms)
{
    std::map<std::int32_t, std::vector<double>> facts;
    const BallLabels& labels = *atoms.labels;
    for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
        const Ball& ball = atoms.balls[i];
        const auto& color = atoms.colors[i];
        facts[ball.atom] = {ball.center.x(),
                            ball.center.y(),
                            ball.center.z(),
                            ball.radius,
                            double(atoms.resolutionOf[i]),
                            double(atoms.decays[i].rate),
                            double(atoms.decays[i].level),
                            double(color[0]),
                            double(color[1]),
                            double(color[2]),
                            double(labels.chainOf[i]),
                            double(labels.groupOf[i]),
                            double(labels.elementOf[i]),
                            double(labels.residueClassOf[i]),
                            double(labels.values->valueOf[i])};
    }
    return facts;
}

TEST_F(Bricks, AtomsOnDiskAreThoseInMemory)
{
    const BallSet atoms = describedBalls();
    Progress progress;
    OutputFile out(path("a.atoms"), true);
    const std::string index = writeAtoms(atoms, {1.5, 2.5, 0.5}, out, progress);
    out.commit();
    const AtomsFile file(path("a.atoms"));
    EXPECT_EQ(file.index(), index);
    EXPECT_EQ(file.extent().maxGrownRadius, 2.5);
    const BallSet all = file.within(everywhere());
    EXPECT_EQ(factsOf(all), factsOf(atoms));
    EXPECT_EQ(all.resolutions[1].rule.select, "B/10-20");
    EXPECT_EQ(all.resolutions[1].balls, 80u);
    EXPECT_EQ(all.resolutions[1].level, -0.25);
    EXPECT_EQ(all.coloring.range, atoms.coloring.range);
    EXPECT_EQ(all.coloring.palette, "magma");
    EXPECT_EQ(all.coloring.potentialOffset, 2.25);
    EXPECT_TRUE(all.coloring.byResidue);
    EXPECT_FALSE(all.coloring.flat);
    EXPECT_EQ(all.labels->chains, atoms.labels->chains);
    EXPECT_EQ(all.labels->groups[1].name, "two");
    EXPECT_EQ(all.labels->groups[1].balls, 50u);
    EXPECT_EQ(all.labels->groups[1].color, atoms.labels->groups[1].color);
    EXPECT_EQ(all.labels->values->low, -3.25);
    EXPECT_EQ(all.labels->values->centre, atoms.labels->values->centre);
    EXPECT_EQ(all.labels->values->field->values, atoms.labels->values->field->values);
    EXPECT_EQ(all.labels->values->field->counts[2], 3u);

    const openvdb::BBoxd space(openvdb::Vec3d(-8.0), openvdb::Vec3d(3.0, 9.0, 21.0));
    const BallSet near = file.within(space);
    EXPECT_LT(near.balls.size(), atoms.balls.size());
    EXPECT_EQ(factsOf(near), factsOf(ballsIn(atoms, space)));
}

// Two chains, two groups and two rules have the indices 0 and 1; -1 stands for none.
TEST_F(Bricks, AtomsOfNoChainGroupOrRuleAreRefused)
{
    const auto reads = [&](const auto& change) {
        BallSet atoms = describedBalls();
        change(atoms);
        Progress progress;
        OutputFile out(path("i.atoms"), true);
        writeAtoms(atoms, {1.5, 2.5, 0.5}, out, progress);
        out.commit();
        return AtomsFile(path("i.atoms")).within(everywhere()).balls.size();
    };
    for (const std::int32_t good : {-1, 0, 1}) {
        EXPECT_EQ(reads([&](BallSet& a) { a.labels->chainOf[7] = good; }), 200u);
        EXPECT_EQ(reads([&](BallSet& a) { a.labels->groupOf[7] = good; }), 200u);
        EXPECT_EQ(reads([&](BallSet& a) { a.resolutionOf[7] = good; }), 200u);
    }
    for (const std::int32_t bad : {-2, 2, 3}) {
        EXPECT_THROW(reads([&](BallSet& a) { a.labels->chainOf[7] = bad; }), Error) << bad;
        EXPECT_THROW(reads([&](BallSet& a) { a.labels->groupOf[7] = bad; }), Error) << bad;
        EXPECT_THROW(reads([&](BallSet& a) { a.resolutionOf[7] = bad; }), Error) << bad;
    }
    EXPECT_THROW(reads([](BallSet& a) { a.labels->residueClassOf[7] = ResidueClass(12); }), Error);
}

TEST_F(Bricks, DamagedAtomsOnDiskAreRefused)
{
    Progress progress;
    OutputFile out(path("a.atoms"), true);
    const std::string index = writeAtoms(describedBalls(), {1.5, 2.5, 0.5}, out, progress);
    out.commit();
    std::string bytes = test::contentOf(path("a.atoms"));
    const auto readsWith = [&](std::size_t at, char change) {
        std::string damaged = bytes;
        damaged[at] = char(damaged[at] ^ change);
        std::ofstream(path("b.atoms"), std::ios::binary) << damaged;
        return AtomsFile(path("b.atoms")).within(everywhere()).balls.size();
    };
    EXPECT_EQ(readsWith(0, 0), 200u);
    const std::size_t indexAt = bytes.size() - index.size();
    for (const std::size_t at :
         {std::size_t(8), indexAt / 2, indexAt - 1, indexAt, indexAt + 16, indexAt + 20,
          bytes.size() - 1, bytes.size() - 9, bytes.size() - 20, bytes.size() - 30})
        EXPECT_THROW(readsWith(at, 64), Error) << at;
    bytes.resize(bytes.size() - 5);
    EXPECT_THROW(readsWith(0, 0), Error);
    bytes.clear();
    std::ofstream(path("b.atoms"), std::ios::binary) << "";
    EXPECT_THROW(AtomsFile(path("b.atoms")), Error);
    EXPECT_THROW(AtomsFile(path("none.atoms")), Error);
}

/// The text of a PDB file: 300 atoms of two chains, of which an assembly makes several copies.
/// @param[in] ofA  translations along x of chain A [Å]; those of chain B are 60 Å and 0 Å
std::string assemblyText(const std::vector<double>& ofA)
{
    std::string text;
    const auto add = [&](const char* form, auto... values) {
        char line[100];
        std::snprintf(line, sizeof line, form, values...);
        text += line;
    };
    const auto part = [&](char name, const std::vector<double>& along) {
        add("REMARK 350 APPLY THE FOLLOWING TO CHAINS: %c\n", name);
        for (std::size_t k = 0; k < along.size(); ++k) {
            const int n = int(k) + 1;
            // A turn about x for the second, third...
            const double c = std::cos(double(k)), s = std::sin(double(k));
            add("REMARK 350   BIOMT1 %3d  1.000000  0.000000  0.000000     %10.5f\n", n, along[k]);
            add("REMARK 350   BIOMT2 %3d  0.000000 %9.6f %9.6f        3.00000\n", n, c, -s);
            add("REMARK 350   BIOMT3 %3d  0.000000 %9.6f %9.6f       -2.00000\n", n, s, c);
        }
    };
    text += "REMARK 350 BIOMOLECULE: 1\n";
    part('A', ofA);
    part('B', {60.0, 0.0});
    const std::vector<Ball> balls = chain();
    for (int i = 0; i < 300; ++i) {
        const openvdb::Vec3d& x = balls[std::size_t(i)].center;
        add("ATOM  %5d  %s  ALA %c%4d    %8.3f%8.3f%8.3f  1.00  0.00           %c\n", i + 1,
            i % 3 ? "CA" : "O ", i < 200 ? 'A' : 'B', i + 1, x.x(), x.y(), x.z(),
            i % 3 ? 'C' : 'O');
    }
    return text + "END\n";
}

BallSet ballsOf(const std::string& text, bool folded)
{
    SelectOptions select;
    select.assembly.name = "1";
    select.assembly.folded = folded;
    LabelOptions labels;
    labels.labels = labels.names = false;
    return Molecule(FileContent{"a.pdb", text}).balls(select, labels);
}

/// Centres, radii and atoms, in an order of their own.
std::vector<std::array<double, 5>> sortedBalls(const std::vector<Ball>& balls)
{
    std::vector<std::array<double, 5>> out;
    for (const Ball& b : balls)
        out.push_back({b.center.x(), b.center.y(), b.center.z(), b.radius, double(b.atom)});
    std::sort(out.begin(), out.end());
    return out;
}

void expectEqual(const BrickPlan& a, const BrickPlan& b)
{
    EXPECT_EQ(a.atoms, b.atoms);
    EXPECT_EQ(a.anchor, b.anchor);
    EXPECT_EQ(a.steps, b.steps);
    EXPECT_EQ(a.maxGrownRadius, b.maxGrownRadius);
    ASSERT_EQ(a.bricks.size(), b.bricks.size());
    for (std::size_t k = 0; k < a.bricks.size(); ++k) {
        EXPECT_EQ(a.bricks[k].box, b.bricks[k].box) << k;
        EXPECT_EQ(a.bricks[k].atoms, b.bricks[k].atoms) << k;
        EXPECT_EQ(a.bricks[k].voxels, b.bricks[k].voxels) << k;
        EXPECT_EQ(a.bricks[k].bytes, b.bricks[k].bytes) << k;
        EXPECT_EQ(a.bricks[k].seconds, b.bricks[k].seconds) << k;
    }
}

TEST_F(Bricks, PlansOfFoldedAssembliesAreThoseOfAllBalls)
{
    const std::string text = assemblyText({0.0, 45.0, 90.5});
    const BallSet folded = ballsOf(text, true), whole = ballsOf(text, false);
    ASSERT_TRUE(folded.placement.folded);
    EXPECT_EQ(folded.balls.size(), 300u);
    ASSERT_EQ(whole.balls.size(), 800u);
    EXPECT_EQ(repeatedBalls(folded).size(), 800u);
    Progress progress;
    for (const SurfaceKind kind : {SurfaceKind::Variational, SurfaceKind::VanDerWaals}) {
        for (const double voxel : {0.05, 0.4, 1.0}) { // at the first balls have leaves inside
            SurfaceOptions options = coarse();
            options.kind = kind;
            options.voxel = voxel;
            expectEqual(planBricks(folded, options, {7, 0}, progress),
                        planBricks(whole, options, {7, 0}, progress));
        }
    }
}

TEST_F(Bricks, FoldedAtomsOnDiskAreThoseInMemory)
{
    const std::string text = assemblyText({0.0, 45.0, 90.5});
    const BallSet whole = ballsOf(text, false);
    Progress progress;
    OutputFile out(path("a.atoms"), true);
    writeAtoms(ballsOf(text, true), {1.7, 1.7, 0.0}, out, progress);
    out.commit();
    EXPECT_LT(std::filesystem::file_size(path("a.atoms")), 300 * 72 + 4000);
    const AtomsFile file(path("a.atoms"));
    EXPECT_EQ(sortedBalls(file.within(everywhere()).balls), sortedBalls(whole.balls));
    std::size_t some = 0;
    for (double x = -60.0; x < 120.0; x += 7.0) {
        const openvdb::BBoxd space(openvdb::Vec3d(x, -15.0, -20.0),
                                   openvdb::Vec3d(x + 11.0, 9.0, 8.0));
        const std::vector<Ball> near = file.within(space).balls;
        EXPECT_EQ(sortedBalls(near), sortedBalls(ballsIn(whole, space).balls)) << x;
        some += near.size() < whole.balls.size() ? near.size() : 0;
    }
    EXPECT_GT(some, 100u);
    for (const Ball& ball : whole.balls) { // some lie at corners of cells that are turned
        openvdb::BBoxd about(ball.center, ball.center);
        about.expand(0.01);
        EXPECT_EQ(file.within(about).balls.size(), 1u) << ball.center;
    }
}

// The last cell of a part and the first one of the next are the same place.
TEST_F(Bricks, PartsOnDiskHaveCellsOfTheirOwn)
{
    BallSet atoms;
    atoms.balls = {{{1.0, 2.0, 3.0}, 1.5, 0}, {{4.0, 5.0, 6.0}, 1.7, 1}};
    atoms.placement.folded = true;
    atoms.placement.copies = 2;
    atoms.placement.begin = {0, 1, 2};
    Motion along = Motion::identity(), up = Motion::identity();
    along.translation = {100.0, 0.0, 0.0};
    up.translation = {0.0, 50.0, 0.0};
    atoms.placement.instances = {{along, 0, "1"}, {Motion::identity(), 1, "2"}, {up, 1, "3"}};
    Progress progress;
    OutputFile out(path("a.atoms"), true);
    writeAtoms(atoms, {1.7, 1.7, 0.0}, out, progress);
    out.commit();
    const std::vector<Ball> whole = {
        {{101.0, 2.0, 3.0}, 1.5, 0}, {{4.0, 5.0, 6.0}, 1.7, 1}, {{4.0, 55.0, 6.0}, 1.7, 1}};
    EXPECT_EQ(sortedBalls(AtomsFile(path("a.atoms")).within(everywhere()).balls),
              sortedBalls(whole));
}

TEST_F(Bricks, AssembliesWithEqualAtomsAreUnfolded)
{
    const std::string text = assemblyText({0.0, 45.0}), twice = assemblyText({0.0});
    EXPECT_TRUE(ballsOf(text, true).placement.folded);
    // Chain A a second time where it is.
    std::string equal = twice;
    const std::string row = "REMARK 350   BIOMT1   1";
    const std::size_t begin = equal.find(row), end = equal.find("REMARK 350 APPLY", begin);
    std::string again = equal.substr(begin, end - begin);
    for (std::size_t at = 0; (at = again.find("   1  ", at)) != std::string::npos; ++at)
        again[at + 3] = '2';
    equal.insert(end, again);
    const BallSet atoms = ballsOf(equal, true);
    EXPECT_FALSE(atoms.placement.folded);
    EXPECT_EQ(atoms.balls.size(), ballsOf(equal, false).balls.size());
    EXPECT_EQ(atoms.record.warnings.size(), 1u);
}

TEST_F(Bricks, AssembliesAreUnfoldedWhereMoreIsAskedFor)
{
    const Molecule molecule(FileContent{"a.pdb", assemblyText({0.0, 45.0})});
    SelectOptions select;
    select.assembly.name = "1";
    select.assembly.folded = true;
    LabelOptions bare;
    bare.labels = bare.names = false;
    const auto folds = [&](const SelectOptions& chosen, const LabelOptions& labels) {
        const BallSet atoms = molecule.balls(chosen, labels);
        EXPECT_EQ(atoms.balls.size(), atoms.placement.folded ? 300u : 600u);
        return atoms.placement.folded;
    };
    EXPECT_TRUE(folds(select, bare));
    LabelOptions labelled = bare, named = bare, grouped = bare, valued = bare;
    labelled.labels = named.names = true;
    grouped.groupBy = GroupBy{GroupBy::Kind::Copy};
    valued.valueBy = ValueBy{};
    for (const LabelOptions& labels : {labelled, named, grouped, valued})
        EXPECT_FALSE(folds(select, labels));
    SelectOptions blurred = select, plain = select;
    blurred.resolutions = {{"", 6.0}};
    plain.assembly.folded = false;
    EXPECT_FALSE(folds(blurred, bare));
    EXPECT_FALSE(folds(plain, bare));
}

TEST_F(Bricks, HostileCopiesAreRefused)
{
    Progress progress;
    OutputFile out(path("a.atoms"), true);
    writeAtoms(ballsOf(assemblyText({0.0, 45.0}), true), {1.7, 1.7, 0.0}, out, progress);
    out.commit();
    const std::string bytes = test::contentOf(path("a.atoms"));
    const auto readsWith = [&](const std::string& copies) {
        std::uint64_t header = 0; // its length
        std::memcpy(&header, bytes.data() + bytes.size() - 16, sizeof header);
        std::string text = bytes.substr(bytes.size() - 32 - header, header);
        const std::size_t begin = text.find("[[0,"), end = text.find("]]", begin) + 2;
        text.replace(begin, end - begin, copies);
        std::string changed =
            bytes.substr(0, bytes.size() - 32 - header) + text + bytes.substr(bytes.size() - 32);
        header = text.size();
        std::memcpy(changed.data() + changed.size() - 16, &header, sizeof header);
        std::ofstream(path("b.atoms"), std::ios::binary) << changed;
        return AtomsFile(path("b.atoms")).within(everywhere()).balls.size();
    };
    const std::string good = "[0,1,0,0,0,0,1,0,0,0,0,1,0]", other = "[1,1,0,0,0,0,1,0,0,0,0,1,0]";
    EXPECT_EQ(readsWith("[" + good + "," + other + "]"), 300u);
    EXPECT_EQ(readsWith("[" + good + "," + good + "," + other + "]"), 500u);
    EXPECT_THROW(readsWith("[]"), Error);             // cells of a part that is none
    EXPECT_THROW(readsWith("[" + good + "]"), Error); // the same
    for (const char* bad : {"[7,1,0,0,0,0,1,0,0,0,0,1,0]", "[1,1,0,0,0,0,1,0,0,0,0,1]", "[1]", "7",
                            "[1,1,0,0,2e6,0,1,0,0,0,0,1,0]", "[-1,1,0,0,0,0,1,0,0,0,0,1,0]",
                            "[1,1,0,0,null,0,1,0,0,0,0,1,0]", "{}"})
        EXPECT_THROW(readsWith("[" + good + "," + bad + "]"), Error) << bad;
    std::string old = bytes;
    old.back() = '1';
    std::ofstream(path("b.atoms"), std::ios::binary) << old;
    try {
        AtomsFile(path("b.atoms"));
        ADD_FAILURE();
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("earlier version"), std::string::npos) << e.what();
    }
}

} // namespace
} // namespace molsurf
