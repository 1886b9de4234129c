// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/color/color_table.h"

#include "molsurf/error.h"
#include "molsurf/show/color/palette.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace molsurf
{
namespace
{

/// A carbon and a nitrogen in each of two chains that touch.
BallSet twoChains()
{
    BallSet atoms;
    BallLabels labels;
    labels.chains = {"A", "B"};
    for (int i = 0; i < 4; ++i) {
        atoms.balls.push_back({openvdb::Vec3d(1.5 * i, 0, 0), 1.7, i});
        labels.chainOf.push_back(i / 2);
        labels.groupOf.push_back(-1);
        labels.elementOf.push_back(i % 2 ? 7 : 6);
        labels.residueClassOf.push_back(ResidueClass::Polar);
    }
    atoms.labels = labels;
    return atoms;
}

TEST(ColorTable, HasARowForEveryProperty)
{
    std::set<std::string> words;
    for (const ColorKind& kind : colorTable()) {
        EXPECT_TRUE(words.insert(kind.word).second) << kind.word;
        EXPECT_EQ(kindOf(kind.by).word, kind.word);
        EXPECT_EQ(nameOf(kind.by), std::string(kind.word));
        EXPECT_EQ(kind.has == nullptr, kind.needs == nullptr) << kind.word;
        EXPECT_EQ(kind.ofBalls != nullptr, kind.has != nullptr) << kind.word;
    }
}

TEST(ColorTable, BallsWithoutWhatARowNeedsAreRefusedAndNeutral)
{
    BallSet atoms = twoChains();
    atoms.labels.reset();
    int refused = 0;
    for (const ColorKind& kind : colorTable()) {
        if (!kind.has) {
            EXPECT_NO_THROW(checkColors(atoms, kind.by)) << kind.word;
            continue;
        }
        ++refused;
        EXPECT_THROW(checkColors(atoms, kind.by), Error) << kind.word;
        EXPECT_EQ(ballColors(atoms, kind.by, Progress()), std::vector<Color>(4, neutralColor));
        EXPECT_FALSE(legendOf(kind.by, atoms, Mesh(), Progress()));
    }
    EXPECT_GE(refused, 8);
}

TEST(ColorTable, IllustrationsHaveLighterCarbon)
{
    const BallSet atoms = twoChains();
    const std::vector<Color> chains = ballColors(atoms, ColorBy::Chain, Progress()),
                             found = ballColors(atoms, ColorBy::Illustrative, Progress());
    EXPECT_NE(chains[0], chains[2]);
    for (const std::size_t i : {1, 3}) EXPECT_EQ(found[i], chains[i]);
    for (const std::size_t i : {0, 2})
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(int(found[i][k]), (int(chains[i][k]) + 255) / 2) << i;
    const auto legend = legendOf(ColorBy::Illustrative, atoms, Mesh(), Progress());
    ASSERT_TRUE(legend);
    EXPECT_EQ(legend->id, "illustrative");
    ASSERT_EQ(legend->entries.size(), 2u);
    EXPECT_EQ(legend->entries[1].color, chains[3]);
}

TEST(ColorTable, HeteroColoursChainsAtCarbonAlone)
{
    const BallSet atoms = twoChains();
    const std::vector<Color> chains = ballColors(atoms, ColorBy::Chain, Progress()),
                             elements = ballColors(atoms, ColorBy::Element, Progress()),
                             found = ballColors(atoms, ColorBy::Hetero, Progress());
    for (const std::size_t i : {0, 2}) EXPECT_EQ(found[i], chains[i]);
    for (const std::size_t i : {1, 3}) EXPECT_EQ(found[i], elements[i]);
    const auto legend = legendOf(ColorBy::Hetero, atoms, Mesh(), Progress());
    ASSERT_TRUE(legend);
    const std::vector<LegendEntry>& entries = legend->entries;
    ASSERT_EQ(entries.size(), 3u);
    EXPECT_EQ(entries[1].color, chains[2]);
    EXPECT_EQ(entries[2].color, elements[1]);
}

// In a scene of copies each chain is there as often as its copies are.
TEST(ColorTable, ClassesCountTheChainsOfAllCopies)
{
    BallSet atoms = twoChains();
    atoms.labels->groups.resize(2);
    atoms.labels->groups[0].name = "class 1";
    atoms.labels->groups[1].name = "class 2";
    const auto titleOf = [&] { return legendOf(ColorBy::Group, atoms, Mesh(), Progress())->title; };
    EXPECT_EQ(titleOf(), "Group"); // as many chains as classes
    atoms.placement.instances.resize(3);
    EXPECT_EQ(titleOf(), "6 chains in 2 classes");
    EXPECT_EQ(legendOf(ColorBy::Group, atoms, Mesh(), Progress())->entries[1].name, "2");
    atoms.labels->groups[1].name = "ligand";
    EXPECT_EQ(titleOf(), "Group");
}

TEST(ColorTable, ValuesThatAreMissingAreInTheLegend)
{
    BallSet atoms = twoChains();
    BallValues values;
    values.name = "charge";
    values.low = -1.0;
    values.high = 1.0;
    atoms.labels->values = values;
    Mesh mesh;
    mesh.scalars = {{"charge", {0.0f, 1.0f}}, {"other", {std::nanf("")}}};
    EXPECT_TRUE(legendOf(ColorBy::Value, atoms, mesh, Progress())->entries.empty());
    mesh.scalars[0].values.push_back(std::nanf(""));
    const auto legend = legendOf(ColorBy::Value, atoms, mesh, Progress());
    ASSERT_EQ(legend->entries.size(), 1u);
    EXPECT_EQ(legend->entries[0].name, "no value");
    EXPECT_EQ(legend->entries[0].color, noValueColor);
}

} // namespace
} // namespace molsurf
