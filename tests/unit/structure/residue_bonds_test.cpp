// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/residue_bonds.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

TEST(ResidueBonds, AreThoseOfTheDictionary)
{
    const ResidueBonds* heme = ResidueBonds::find("HEM");
    ASSERT_TRUE(heme);
    EXPECT_EQ(heme->between("CBA", "CGA"), BondOrder::Single); // of a propionate
    EXPECT_EQ(heme->between("NA", "FE"), BondOrder::Single);
    EXPECT_EQ(heme->between("NA", "NB"), BondOrder::None);
    EXPECT_FALSE(heme->has("CA"));
    EXPECT_EQ(heme->between("CA", "CB"), BondOrder::None);
    EXPECT_EQ(heme->between("CGA", "O1A"), BondOrder::Double);
    EXPECT_EQ(ResidueBonds::find("PHE")->between("CD1", "CE1"), BondOrder::Aromatic);
    EXPECT_EQ(ResidueBonds::find("CMO"), nullptr);
    EXPECT_FALSE(ResidueBonds::find("XXX"));
}

TEST(ResidueBonds, KnowOldNames)
{
    const ResidueBonds* adenosine = ResidueBonds::find("A");
    ASSERT_TRUE(adenosine);
    EXPECT_EQ(adenosine->between("O5*", "C5*"), BondOrder::Single);
    EXPECT_EQ(adenosine->between("P", "O1P"), BondOrder::Double);
    EXPECT_EQ(adenosine->between("C5'", "O5*"), BondOrder::Single);
    EXPECT_TRUE(adenosine->has("O2*"));
    EXPECT_EQ(adenosine->between("O2*", "O3*"), BondOrder::None);
    // O1P is a name of today in others.
    EXPECT_NE(ResidueBonds::find("PLP")->between("O1P", "P"), BondOrder::None);
}

} // namespace
} // namespace molsurf
