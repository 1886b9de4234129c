// SPDX-License-Identifier: MPL-2.0
#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/selection/groups.h"
#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/molecule/structure/read_structure.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace molsurf
{
namespace
{

class GroupsFile : public ::testing::Test
{
protected:
    void TearDown() override { std::filesystem::remove(path_); }

    std::vector<GroupRule> read(const std::string& text)
    {
        std::ofstream(path_) << text;
        return readGroups(path_);
    }
    void refuse(const std::string& text, const std::string& says)
    {
        try {
            read(text);
            ADD_FAILURE() << text << " is taken";
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::Input);
            EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
        }
    }
    std::string path_ = testing::TempDir() + "/groups_" +
                        testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(GroupsFile, JsonAndTable)
{
    const auto json = read(R"( {"groups": [{"name": "red", "select": "A/1-5", "color": "#d55E00"},
                                           {"name": "b c", "select": "B"}]})");
    ASSERT_EQ(json.size(), 2u);
    EXPECT_EQ(json[0].color, (std::array<std::uint8_t, 3>{0xd5, 0x5e, 0x00}));
    EXPECT_EQ(json[1].name, "b c");
    EXPECT_FALSE(json[1].color);
    const auto table = read("# domains\nred A/1-5|A/9 #d55e00\n\n b\tB\r\n");
    ASSERT_EQ(table.size(), 2u);
    EXPECT_EQ(table[0].select, "A/1-5|A/9");
    EXPECT_EQ(table[0].color, json[0].color);
    EXPECT_EQ(table[1].select, "B");
    const auto words = read("a chain A and resid 1 to 5 #d55e00\nb  within 5 of (HEM)\tcopies=2\n");
    ASSERT_EQ(words.size(), 2u);
    EXPECT_EQ(words[0].select, "chain A and resid 1 to 5");
    EXPECT_EQ(words[0].color, json[0].color);
    EXPECT_EQ(words[1].select, "within 5 of (HEM)");
    EXPECT_FALSE(words[1].copies.all());
}

TEST_F(GroupsFile, BadOnesAreRefused)
{
    refuse("", "no group");
    refuse("# nothing\n", "no group");
    refuse("{\"groups\": []}", "no group");
    refuse("{\"groups\": [", "JSON");
    refuse("{\"group\": 3}", "groups");
    refuse("{\"groups\": [{\"name\": \"a\"}]}", "select");
    refuse("{\"groups\": [{\"name\": \"a\", \"select\": 7}]}", "select");
    refuse("{\"groups\": [{\"name\": \"a\", \"select\": \"A\", \"colour\": \"x\"}]}", "colour");
    refuse("a A redd", "redd");
    refuse("a A #12345", "#12345");
    refuse("a A #12345g", "#12345g");
    refuse("a\n", "line 1");
    refuse("a A\na B\n", "named 'a'");
    EXPECT_THROW(readGroups("/no/such/file"), Error);
    EXPECT_THROW(readGroups(testing::TempDir()), Error);
}

BallLabels labelled(const LabelOptions& labels, const std::string& file = "/4at1.ent.gz",
                    const SelectOptions& options = {})
{
    const BallSet out =
        selectBalls(readStructure(std::string(MOLSURF_TEST_DATA) + file), options, labels);
    EXPECT_EQ(out.labels->chainOf.size(), out.balls.size());
    return *out.labels;
}

TEST(Labels, GroupsByChainEntityCopyAndResidues)
{
    LabelOptions options;
    options.groupBy = parseGroupBy("chain");
    const BallLabels chains = labelled(options);
    ASSERT_EQ(chains.groups.size(), 4u); // two catalytic, two regulatory
    EXPECT_EQ(chains.groups[0].name, "A");
    std::size_t all = 0;
    for (const Group& group : chains.groups) all += group.balls;
    EXPECT_EQ(all, chains.chainOf.size());

    options.groupBy = parseGroupBy("entity");
    const BallLabels entities = labelled(options);
    ASSERT_EQ(entities.groups.size(), 2u);
    EXPECT_EQ(entities.groups[0].balls, chains.groups[0].balls + chains.groups[2].balls);

    // Names and places are of the file, whatever is selected.
    EXPECT_EQ(entities.groups[1].place, 1);
    SelectOptions select;
    select.select = "chain B+D";
    const BallLabels some = labelled(options, "/4at1.ent.gz", select);
    EXPECT_EQ(some.chainPlaces, (std::vector<std::int32_t>{1, 3}));
    ASSERT_EQ(some.groups.size(), 1u);
    EXPECT_EQ(some.groups[0].name, "entity 2");
    EXPECT_EQ(some.groups[0].place, 1);
    select.select.clear();

    options.groupBy = parseGroupBy("copy");
    select.assembly.name = "1";
    const BallLabels copies = labelled(options, "/1a8o.cif.gz", select);
    ASSERT_EQ(copies.groups.size(), 2u);
    EXPECT_EQ(copies.groups[0].balls, copies.groups[1].balls);
    EXPECT_EQ(copies.groups[1].name, "copy 2");
    EXPECT_EQ(copies.chains.size(), 2u);
    EXPECT_EQ(copies.chains[1], "A-2");
    EXPECT_EQ(copies.chainPlaces, (std::vector<std::int32_t>{0, 1}));
    EXPECT_EQ(copies.groups[1].place, 1);

    options.groupBy = parseGroupBy("residues:20");
    const BallLabels blocks = labelled(options, "/1crn.pdb");
    ASSERT_EQ(blocks.groups.size(), 3u); // 46 residues
    EXPECT_EQ(blocks.groups[0].name, "A/1-20");

    for (const char* bad : {"colour", "residues:", "residues:0", "residues:-3", "residues:2x"}) {
        EXPECT_THROW(parseGroupBy(bad), Error) << bad;
    }
}

// Blocks go on below 1 as above.
TEST(Labels, BlocksOfResiduesBelowOne)
{
    std::string text;
    const std::array<int, 6> numbers = {-10, -9, 0, 1, 10, 11};
    for (std::size_t i = 0; i < numbers.size(); ++i)
        text +=
            formatted("ATOM  %5zu  CA  GLY A%4d    %8.3f   0.000   0.000  1.00  0.00           C\n",
                      i + 1, numbers[i], 4.0 * double(i));
    LabelOptions options;
    options.groupBy = parseGroupBy("residues:10");
    const BallSet atoms = selectBalls(parseStructure(text + "END\n", "a.pdb"), {}, options);
    std::vector<std::string> names;
    for (const Group& group : atoms.labels->groups) names.push_back(group.name);
    EXPECT_EQ(names, (std::vector<std::string>{"A/-19--10", "A/-9-0", "A/1-10", "A/11-20"}));
}

TEST(Labels, LaterRulesWinAndSaySo)
{
    LabelOptions options;
    options.groups = {{"all", "A", {}}, {"helix", "A/7-19", {}}};
    const BallLabels labels = labelled(options, "/1crn.pdb");
    EXPECT_GT(labels.groups[0].balls, 150u);
    EXPECT_GT(labels.groups[1].balls, 60u);
    EXPECT_EQ(labels.groups[0].balls + labels.groups[1].balls, 327u);
    ASSERT_EQ(labels.warnings.size(), 1u);
    EXPECT_NE(labels.warnings[0].find("helix"), std::string::npos);
    EXPECT_EQ(labels.elementOf[0], 7); // N of THR 1
    EXPECT_EQ(labels.residueClassOf[0], ResidueClass::Polar);

    options.groups = {{"none", "Q", {}}};
    EXPECT_THROW(labelled(options, "/1crn.pdb"), Error);
}

} // namespace
} // namespace molsurf
