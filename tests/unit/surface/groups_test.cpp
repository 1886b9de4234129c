// SPDX-License-Identifier: MPL-2.0
#include "molsurf/error.h"
#include "molsurf/show/color/palette.h"
#include "support/runs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace molsurf
{
namespace
{

using openvdb::Vec3f;

/// Two balls, each a group of its own.
BallSet pair(float distance)
{
    BallSet atoms;
    atoms.balls = {{Vec3f(0.1f, 0.2f, 0.3f), 1.7f, 0},
                   {Vec3f(0.1f + distance, 0.2f, 0.3f), 1.7f, 1}};
    atoms.placement.begin = {0, 2};
    BallLabels labels;
    labels.chains = {"A", "B"};
    labels.chainOf = labels.groupOf = {0, 1};
    labels.groups = {{"left", 1, {}}, {"right", 1, Color{1, 2, 3}}};
    labels.elementOf = {6, 8};
    labels.residueClassOf = {ResidueClass::Other, ResidueClass::Other};
    atoms.labels = labels;
    return atoms;
}

template<typename T>
const Attribute<T>* find(const std::vector<Attribute<T>>& all, const std::string& name)
{
    for (const auto& a : all) {
        if (a.name == name) return &a;
    }
    return nullptr;
}

TEST(Groups, ColoursWithoutWhatTheyShowAreRefused)
{
    BallSet bare;
    bare.balls = {{openvdb::Vec3d(0.0), 1.7, 0}};
    for (const ColorBy by : {ColorBy::Chain, ColorBy::Group, ColorBy::Element, ColorBy::Residue,
                             ColorBy::Nucleotide, ColorBy::Plain, ColorBy::Value}) {
        SurfaceOptions options;
        options.color = by;
        try {
            makeSurface(bare, options);
            ADD_FAILURE() << int(by) << " was taken";
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::Usage);
            EXPECT_NE(std::string(e.what()).find("LabelOptions::"), std::string::npos) << e.what();
        }
    }
}

TEST(Groups, ColoursOfAFileAreMadeOrRefused)
{
    const BallSet atoms = readAtoms(MOLSURF_TEST_DATA "/1crn.pdb");
    SurfaceOptions options;
    options.voxel = 1.0;
    for (const ColorBy by : {ColorBy::Chain, ColorBy::Element, ColorBy::Residue,
                             ColorBy::Nucleotide, ColorBy::Illustrative}) {
        options.color = by;
        const Mesh mesh = makeSurface(atoms, options).mesh;
        EXPECT_EQ(mesh.colors.size(), mesh.positions.size()) << nameOf(by);
        if (by == ColorBy::Element || by == ColorBy::Residue) {
            EXPECT_GT(std::set<Color>(mesh.colors.begin(), mesh.colors.end()).size(), 2u);
        }
    }
    for (const ColorBy by : {ColorBy::Group, ColorBy::Plain, ColorBy::Value}) {
        options.color = by;
        EXPECT_THROW(makeSurface(atoms, options), Error) << nameOf(by);
    }
}

TEST(Groups, ShareAreaAndVolumeOfTwoBalls)
{
    SurfaceOptions options;
    options.kind = SurfaceKind::VanDerWaals;
    options.voxel = 0.25;
    options.color = ColorBy::Group;
    options.fields = {"chain_id", "group_id", "Cd"};
    Progress progress;
    const MolecularSurface result = makeSurface(pair(2.0f), options, &progress);
    const auto& groups = result.report.groups;
    ASSERT_EQ(groups.size(), 2u);
    EXPECT_NEAR(groups[0].area + groups[1].area, result.report.surface.area, 1e-6);
    EXPECT_NEAR(groups[0].volume + groups[1].volume, result.report.surface.volume, 1e-6);
    EXPECT_NEAR(groups[0].area / groups[1].area, 1.0, 0.005);
    EXPECT_NEAR(groups[0].volume / groups[1].volume, 1.0, 0.005);
    EXPECT_EQ(groups[1].color, "#010203");

    const auto* group = find(result.mesh.labels, "group_id");
    ASSERT_TRUE(group && find(result.mesh.labels, "chain_id"));
    ASSERT_EQ(result.mesh.colors.size(), result.mesh.positions.size());
    for (std::size_t v = 0; v < group->values.size(); ++v) {
        const float x = result.mesh.positions[v].x();
        if (std::abs(x - 1.1f) < 0.01f) continue;
        EXPECT_EQ(group->values[v], x < 1.1f ? 0 : 1);
        if (x > 1.1f) {
            EXPECT_EQ(result.mesh.colors[v], (Color{1, 2, 3}));
        }
    }
    std::set<std::string> names;
    for (const auto& field : result.fields) names.insert(field->getName());
    EXPECT_EQ(names, (std::set<std::string>{"chain_id", "group_id", "Cd"}));
}

// Copies of one molecule, turned about an axis, have equal parts.
TEST(Groups, CopiesHaveEqualParts)
{
    SelectOptions select;
    select.assembly.name = "1";
    LabelOptions labels;
    labels.groupBy = GroupBy{GroupBy::Kind::Copy};
    const BallSet atoms =
        selectBalls(readStructure(std::string(MOLSURF_TEST_DATA) + "/1a8o.cif.gz"), select, labels);
    Progress progress;
    const MolecularSurface result = makeSurface(atoms, SurfaceOptions(), &progress);
    ASSERT_EQ(result.report.groups.size(), 2u);
    const double a = result.report.groups[0].area, b = result.report.groups[1].area;
    EXPECT_NEAR(a / b, 1.0, 0.005);
    EXPECT_NEAR(result.report.groups[0].volume / result.report.groups[1].volume, 1.0, 0.01);
}

// Two balls of radius R whose centres are d apart hide caps of height R - d/2.
TEST(Interfaces, OfTwoBallsAreTheirCaps)
{
    for (const auto& [kind, grown] : {std::pair(SurfaceKind::VanDerWaals, 0.0),
                                      std::pair(SurfaceKind::SolventAccessible, 1.4)}) {
        SurfaceOptions options;
        options.kind = kind;
        options.interfaces = true;
        Progress progress;
        const Report report = makeSurface(pair(2.5f), options, &progress).report;
        const double R = 1.7 + grown, cap = 2.0 * M_PI * R * (R - 1.25);
        ASSERT_EQ(report.interfaces.size(), 1u);
        EXPECT_EQ(report.interfaces[0].first, "left");
        EXPECT_EQ(report.interfaces[0].second, "right");
        EXPECT_NEAR(report.interfaces[0].area, cap, 1e-4 * cap);
        EXPECT_NEAR(*report.groups[0].aloneArea, 4.0 * M_PI * R * R, 1e-3);
        EXPECT_NEAR(report.groups[0].area, 4.0 * M_PI * R * R - cap, 0.01 * cap);
    }
}

TEST(Interfaces, FarGroupsHaveNone)
{
    SurfaceOptions options;
    options.kind = SurfaceKind::SolventExcluded;
    options.interfaces = true;
    Progress progress;
    EXPECT_TRUE(makeSurface(pair(6.5f), options, &progress).report.interfaces.empty());
    // Together they have more area, 73.08 Å^2, than the two alone: nothing is buried.
    EXPECT_TRUE(makeSurface(pair(4.0f), options, &progress).report.interfaces.empty());
}

// Soft Gaussians are felt far beyond the balls: where the two surfaces are first reported, the area
// of both, each alone, is that of two less than 0.005.
TEST(Interfaces, OfGaussiansAreFoundAsFarAsTheyReach)
{
    SurfaceOptions options;
    options.kind = SurfaceKind::Gaussian;
    options.blobbiness = 0.3;
    options.voxel = 0.25;
    Progress progress;
    const double alone = makeSurface(pair(100.0f), options, &progress).report.surface.area;
    for (const float apart : {1.0f, 2.0f, 5.3f, 5.5f, 7.0f, 9.0f, 10.0f, 12.0f}) {
        options.interfaces = true;
        const Report report = makeSurface(pair(apart), options, &progress).report;
        options.interfaces = false;
        const double buried = 0.5 * (alone - report.surface.area);
        ASSERT_EQ(report.interfaces.size(), buried > 0.005 ? 1u : 0u) << apart;
        for (const Report::Interface& found : report.interfaces)
            EXPECT_NEAR(found.area, buried, 0.01);
        EXPECT_TRUE(apart < 5.0f || apart > 6.0f || buried < -12.0) << buried;
    }
}

TEST(Parts, SplitGivesEveryGroupItsOwnClosedSurface)
{
    SurfaceOptions options;
    options.split = true;
    options.voxel = 0.25;
    options.kind = SurfaceKind::VanDerWaals;
    options.fields = {"group_id"};
    Progress progress;
    const MolecularSurface result = makeSurface(pair(2.0f), options, &progress);
    EXPECT_EQ(result.surface, nullptr);
    std::vector<std::string> names;
    for (const auto& field : result.fields) names.push_back(field->getName());
    EXPECT_EQ(names, (std::vector<std::string>{"surface_left", "group_id_left", "surface_right",
                                               "group_id_right"}));
    EXPECT_EQ(result.fields[0]->transform(), result.fields[2]->transform());
    const Report& report = result.report;
    ASSERT_EQ(report.parts.size(), 2u);
    const double area = 4.0 * M_PI * 1.7 * 1.7;
    for (const Report::Part& part : report.parts) {
        EXPECT_EQ(part.atoms, 1u);
        EXPECT_NEAR(part.surface.area, area, 1e-6 * area);
        EXPECT_TRUE(part.surface.closed && part.surface.manifold);
    }
    EXPECT_NEAR(report.surface.area, 2.0 * area, 1e-5 * area);
    EXPECT_EQ(report.surface.eulerCharacteristic, 4);
    EXPECT_EQ(report.surface.components, 2);
    ASSERT_EQ(report.groups.size(), 2u);
    EXPECT_NEAR(report.groups[1].area, area, 1e-5 * area);

    // The second part's triangles have the second part's vertices.
    ASSERT_EQ(result.mesh.parts.size(), 2u);
    const auto* group = find(result.mesh.labels, "group_id");
    ASSERT_EQ(group->values.size(), result.mesh.positions.size());
    for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
        for (const std::uint32_t v : result.mesh.triangles[t]) {
            ASSERT_EQ(group->values[v], t < result.mesh.parts[1].firstTriangle ? 0 : 1);
        }
    }
}

TEST(Parts, SurfaceOfAGroup)
{
    SurfaceOptions options;
    options.kind = SurfaceKind::VanDerWaals;
    options.surfaceOf = {{"right", SurfaceKind::SolventAccessible}};
    Progress progress;
    const Report report = makeSurface(pair(2.0f), options, &progress).report;
    ASSERT_EQ(report.parts.size(), 2u);
    EXPECT_EQ(report.parts[0].name, "right");
    EXPECT_EQ(report.parts[0].surface.kind, "sas");
    EXPECT_NEAR(report.parts[0].surface.area, 4.0 * M_PI * 3.1 * 3.1, 1e-3);
    EXPECT_EQ(report.parts[1].name, "other");
    EXPECT_NEAR(report.parts[1].surface.area, 4.0 * M_PI * 1.7 * 1.7, 1e-3);
    EXPECT_EQ(report.surface.kind, "mixed");

    options.surfaceOf = {{"middle", SurfaceKind::SolventAccessible}};
    EXPECT_THROW(makeSurface(pair(2.0f), options, &progress), Error);
    EXPECT_THROW(makeSurface(pair(2.0f).balls, options, &progress), Error); // no groups
}

// A part has the colours of the whole, though it has fewer neighbours.
TEST(Parts, KeepTheColorsOfTheWhole)
{
    SurfaceOptions options;
    options.kind = SurfaceKind::VanDerWaals;
    options.color = ColorBy::Chain;
    Progress progress;
    const auto whole = ballColors(pair(2.0f), ColorBy::Chain, progress);
    options.split = true;
    const MolecularSurface result = makeSurface(pair(2.0f), options, &progress);
    const std::set<Color> found(result.mesh.colors.begin(), result.mesh.colors.end());
    EXPECT_EQ(found, std::set<Color>(whole.begin(), whole.end()));
    EXPECT_EQ(found.size(), 2u);
}

TEST(Palette, NeighboursDiffer)
{
    // A ring of odd length, and one thing that touches all.
    std::vector<std::vector<std::int32_t>> neighbours(60);
    for (std::int32_t i = 0; i < 59; ++i) {
        neighbours[std::size_t(i)] = {(i + 1) % 59, (i + 58) % 59, 59};
        neighbours[59].push_back(i);
    }
    const std::vector<Color> colors = distinctColors(neighbours);
    for (std::size_t i = 0; i < 60; ++i) {
        for (const std::int32_t n : neighbours[i]) EXPECT_NE(colors[i], colors[std::size_t(n)]);
    }
    EXPECT_GE(std::set<Color>(colors.begin(), colors.end()).size(), 7u);
}

TEST(Palette, ElementsAndLabelsOfBalls)
{
    const BallSet atoms = pair(2.0f);
    const auto elements = ballColors(atoms, ColorBy::Element, Progress());
    EXPECT_EQ(elements[1], (Color{255, 13, 13})); // oxygen is red
    const auto chains = ballColors(atoms, ColorBy::Chain, Progress());
    EXPECT_NE(chains[0], chains[1]);
    BallSet plain;
    plain.balls = atoms.balls;
    EXPECT_EQ(ballColors(plain, ColorBy::Chain, Progress())[0], neutralColor);
}

} // namespace
} // namespace molsurf
