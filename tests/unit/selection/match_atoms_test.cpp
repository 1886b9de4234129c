// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/match_atoms.h"

#include "molsurf/molecule/structure/read_structure.h"
#include "unit/structure/temp_file.h"

#include <algorithm>

namespace molsurf::test
{
namespace
{

/// Counts what an expression selects.
class MatchAtoms : public testing::Test
{
protected:
    std::size_t count(const std::string& expression) const
    {
        const AtomMatch match = matchAtoms(structure_, expression);
        EXPECT_EQ(match.atoms.size(), structure_.atoms.size());
        return static_cast<std::size_t>(std::count(match.atoms.begin(), match.atoms.end(), 1));
    }

    const Structure structure_ = readStructure(dataFile("4at1.ent.gz"));
};

TEST_F(MatchAtoms, ByChainResidueAtomAndElement)
{
    std::size_t chains = 0;
    for (const char* chain : {"A", "B", "C", "D"}) chains += count(chain);
    EXPECT_EQ(chains, 7170u);
    EXPECT_EQ(count("A,B,C,D"), 7170u);
    EXPECT_EQ(count("*"), 7170u);
    EXPECT_EQ(count("A/10-19/CA"), 10u);
    EXPECT_EQ(count("/1/A/10-19/CA[C]"), 10u);
    EXPECT_EQ(count("A/10/CA"), 1u); // not all that follow
    EXPECT_EQ(count("A/301-/CA"), 10u);
    EXPECT_EQ(count("A/301-*/CA"), 10u);
    EXPECT_EQ(count("A/301-.*/CA"), 10u);
    EXPECT_EQ(count("[ZN]"), 2u);
    EXPECT_EQ(count("(ATP)"), 62u);
    EXPECT_EQ(count("*;polymer") + count("*;!polymer"), 7170u);
    EXPECT_EQ(count("*;!polymer"), 64u);
}

TEST_F(MatchAtoms, ByTemperatureFactor)
{
    const std::size_t low = count("A;b<20.005"), high = count("A;b>20.005"); // two decimals in file
    EXPECT_EQ(low + high, count("A"));
    EXPECT_GT(low, 0u);
    EXPECT_GT(high, 0u);
}

TEST_F(MatchAtoms, JoinsAlternatives)
{
    EXPECT_EQ(count("A | B"), count("A") + count("B"));
    EXPECT_EQ(count("A|A/10-19"), count("A"));
    const AtomMatch match = matchAtoms(structure_, "A|Q");
    ASSERT_EQ(match.warnings.size(), 1u);
    EXPECT_HAS(match.warnings[0], "selection \"Q\" matches no atom");
}

TEST_F(MatchAtoms, RefusesWhatMatchesNothingAndShowsTheSyntax)
{
    const std::string message = errorOf(ErrorKind::Input, [&] { matchAtoms(structure_, "Q"); });
    EXPECT_HAS(message, "4at1.ent.gz: selection \"Q\" matches no atom");
    EXPECT_HAS(message, "the chains are A, B, C, D");
    EXPECT_HAS(message, "A/53-132");
}

TEST_F(MatchAtoms, RefusesWhatDoesNotParse)
{
    for (const char* text :
         {"//(ALA,GLY)", "A:1-20", "//*/CA:A,B/", "A;b<x", "[Zz]", "A;ligands", "", "A|", "A/-",
          "A/+1", "A/1,3", "\"A", "A:1-20", "A//N*", "///CA", "/x/A"}) {
        EXPECT_HAS(errorOf(ErrorKind::Usage, [&] { matchAtoms(structure_, text); }), "selection ");
    }
}

TEST(MatchAtomsModels, SelectsInTheNamedModel)
{
    const Structure s = readStructure(dataFile("1d3z.pdb.gz"));
    const AtomMatch match = matchAtoms(s, "/3/A/1-76");
    EXPECT_EQ(match.models, (std::vector<int>{3}));
    for (const Model& model : s.models) {
        const auto begin = match.atoms.begin() + static_cast<std::ptrdiff_t>(model.begin);
        const auto end = match.atoms.begin() + static_cast<std::ptrdiff_t>(model.end);
        EXPECT_EQ(std::count(begin, end, 1), model.number == 3 ? 1231 : 0);
    }
}

// Those that ask for places keep the atoms that they had, by their order in each model, without the
// warnings that were given when they were found; others follow their models.
TEST(MatchAtomsModels, KeepsWhatHasPlaces)
{
    const Structure s = readStructure(dataFile("1d3z.pdb.gz"));
    const std::string near = "within 4 of resid 40 | chain Q", plain = "resid 40 | chain Q";
    Selections selections(s);
    const Model& second = s.models[1];
    selections.keep({near, plain, "", "chain Q"}, second);
    const AtomMatch fresh = matchAtoms(s, near), kept = selections.match(near);
    ASSERT_FALSE(fresh.warnings.empty());
    EXPECT_TRUE(kept.warnings.empty());
    EXPECT_EQ(kept.models, std::vector<int>{0});
    EXPECT_FALSE(selections.match(plain).warnings.empty());
    std::size_t others = 0;
    for (const Model& model : s.models)
        for (std::size_t i = 0; i < model.end - model.begin; ++i) {
            EXPECT_EQ(kept.atoms[model.begin + i], fresh.atoms[second.begin + i]);
            others += kept.atoms[model.begin + i] != fresh.atoms[model.begin + i];
        }
    EXPECT_GT(others, 0u); // in other models other atoms are near
    selections.forgetPlaces();
    EXPECT_EQ(selections.match(near).atoms, fresh.atoms);
}

} // namespace
} // namespace molsurf::test
