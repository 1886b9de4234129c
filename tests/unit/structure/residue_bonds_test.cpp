// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/residue_bonds.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

TEST(ResidueBonds, AreThoseOfTheDictionary)
{
    const ResidueBonds* heme = ResidueBonds::find("HEM");
    ASSERT_TRUE(heme);
    EXPECT_TRUE(heme->bonded("CBA", "CGA")); // of a propionate
    EXPECT_TRUE(heme->bonded("NA", "FE"));
    EXPECT_FALSE(heme->bonded("NA", "NB"));
    EXPECT_FALSE(heme->has("CA"));
    EXPECT_FALSE(heme->bonded("CA", "CB"));
    EXPECT_FALSE(ResidueBonds::find("XXX"));
}

TEST(ResidueBonds, KnowOldNames)
{
    const ResidueBonds* adenosine = ResidueBonds::find("A");
    ASSERT_TRUE(adenosine);
    EXPECT_TRUE(adenosine->bonded("O5*", "C5*"));
    EXPECT_TRUE(adenosine->bonded("P", "O1P"));
    EXPECT_TRUE(adenosine->bonded("C5'", "O5*"));
    EXPECT_TRUE(adenosine->has("O2*"));
    EXPECT_FALSE(adenosine->bonded("O2*", "O3*"));
    // O1P is a name of today in others.
    EXPECT_TRUE(ResidueBonds::find("PLP")->bonded("O1P", "P"));
}

} // namespace
} // namespace molsurf
