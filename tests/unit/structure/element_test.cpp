// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/element.h"

#include "molsurf/structure/residue_kind.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

TEST(Element, SymbolsAndNumbersAgree)
{
    for (int z = 1; z <= maxElement; ++z) {
        const auto number = static_cast<std::uint8_t>(z);
        EXPECT_EQ(elementNumber(elementSymbol(number)), number);
    }
    EXPECT_EQ(elementNumber("MG"), 12);
    EXPECT_EQ(elementNumber("D"), 1);
    for (const char* none : {"", "X", "Zz", "C1", "ALA", "*"}) EXPECT_EQ(elementNumber(none), 0);
}

TEST(Element, IsGuessedFromTheAtomName)
{
    EXPECT_EQ(guessElement("CA", "ALA"), 6);
    EXPECT_EQ(guessElement("CA", "CA"), 20);
    EXPECT_EQ(guessElement("CL-", "CL-"), 17);
    EXPECT_EQ(guessElement("1HB", "ALA"), 1);
    EXPECT_EQ(guessElement("NA", "NAG"), 7);
    EXPECT_EQ(guessElement("", ""), 0);
}

TEST(ResidueKind, KnowsTheNamesOfWater)
{
    for (const char* name : {"HOH", "WAT", "DOD", "H2O", "TIP3", "TIP", "SOL"}) {
        EXPECT_TRUE(isWaterName(name)) << name;
    }
    for (const char* name : {"", "ALA", "OH", "HO4"}) EXPECT_FALSE(isWaterName(name)) << name;
}

} // namespace
} // namespace molsurf
