// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/element.h"

#include "molsurf/molecule/structure/guess_element.h"
#include "molsurf/molecule/structure/residue_names.h"

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

/// The symbol that is guessed.
std::string guess(const char* atom, const char* residue, double mass = -1.0, bool first = false)
{
    return elementSymbol(guessElement({atom, residue, mass, first}));
}

TEST(GuessElement, OfIonsByAllNames)
{
    const struct {
        const char *atom, *residue, *symbol;
    } ions[] = {
        {"SOD", "SOD", "Na"}, {"NA", "SOD", "Na"},  {"CLA", "CLA", "Cl"}, {"CL", "CL", "Cl"},
        {"Cl-", "Cl-", "Cl"}, {"CL-", "ION", "Cl"}, {"NA+", "NA+", "Na"}, {"Na+", "Na+", "Na"},
        {"K", "K", "K"},      {"K+", "K+", "K"},    {"POT", "POT", "K"},  {"CAL", "CAL", "Ca"},
        {"CA", "CA", "Ca"},   {"CA", "CA2", "Ca"},  {"CES", "CES", "Cs"}, {"ZN", "ZN2", "Zn"},
        {"MG", "MG2+", "Mg"}, {"FE", "FE2", "Fe"},  {"CU", "CU1", "Cu"},  {"I", "IOD", "I"},
        {"CD", "CD", "Cd"},   {"HG", "HG", "Hg"},   {"NI", "3NI", "Ni"},  {"LIT", "LIT", "Li"},
        {"BAR", "BAR", "Ba"}, {"CO", "CO", "Co"},   {"MN", "MN2P", "Mn"}};
    for (const auto& ion : ions) EXPECT_EQ(guess(ion.atom, ion.residue), ion.symbol) << ion.residue;
}

TEST(GuessElement, OfNamesThatAreNoIons)
{
    for (const char* name : {"1C9", "35B", "CA20", "B12", "2ZN1", "+NA"})
        EXPECT_EQ(ionElement(name), 0) << name;
    EXPECT_EQ(guess("CL", "1C9"), "Cl");
    EXPECT_EQ(guess("BR1", "35B"), "Br");
}

TEST(GuessElement, OfAminoAcidsByAllNames)
{
    for (const char* residue :
         {"ALA", "HSD", "HSE", "HSP", "HID", "HIE", "HIP", "CYX", "CYM", "ASH", "GLH", "LYN",
          "HISE", "LYSH", "NALA", "CHIE", "HIS1", "DC5", "TIP3"}) {
        EXPECT_EQ(guess("CA", residue), "C") << residue;
        EXPECT_EQ(guess("CD1", residue), "C") << residue;
        EXPECT_EQ(guess("CE1", residue), "C") << residue;
        EXPECT_EQ(guess("ND1", residue), "N") << residue;
        EXPECT_EQ(guess("NE2", residue), "N") << residue;
        EXPECT_EQ(guess("HE2", residue), "H") << residue;
        EXPECT_EQ(guess("1HB", residue), "H") << residue;
        EXPECT_EQ(guess("HG11", residue), "H") << residue;
        EXPECT_EQ(guess("OH2", residue), "O") << residue;
        EXPECT_EQ(guess("SG", residue), "S") << residue;
    }
    EXPECT_EQ(guess("SE", "MSE"), "Se");
}

TEST(GuessElement, OfLigandsByTwoLettersThenOne)
{
    for (const char* name : {"CL", "CL1", "Cl12", "cl2"})
        EXPECT_EQ(guess(name, "LIG"), "Cl") << name;
    for (const char* name : {"BR", "BR7", "Br1"}) EXPECT_EQ(guess(name, "UNL"), "Br") << name;
    EXPECT_EQ(guess("IR1", "LIG"), "Ir");
    EXPECT_EQ(guess("FE", "HEM"), "Fe");
    EXPECT_EQ(guess("FE1", "SF4"), "Fe");
    for (const char* name : {"NA", "NB", "NC", "ND"}) EXPECT_EQ(guess(name, "HEME"), "N") << name;
    for (const char* name : {"CA", "CB", "CD", "CE1", "CO", "C12"})
        EXPECT_EQ(guess(name, "LIG"), "C");
    for (const char* name : {"HG", "HO1", "HE", "HF2"}) EXPECT_EQ(guess(name, "LIG"), "H") << name;
    EXPECT_EQ(guess("OS1", "LIG"), "O");
    EXPECT_EQ(guess("PB", "ATP"), "P");
    EXPECT_EQ(guess("NA", "NAG"), "N");
    EXPECT_EQ(guess("CA", "LIG", -1.0, true), "Ca"); // in the columns of calcium
    EXPECT_EQ(guess("CO", "COB"), "Co");
    EXPECT_EQ(guess("Ca4", "PA"), "C"); // a carbon with a letter
    EXPECT_EQ(guess("ZND", "ZNM"), "Zn");
    for (const char* none : {"", "X1", "Q", "*", "1"}) EXPECT_EQ(guess(none, "LIG"), "X") << none;
}

TEST(GuessElement, ByMassWhereNamesSayNothing)
{
    EXPECT_EQ(guess("X1", "LIG", 35.45), "Cl");
    EXPECT_EQ(guess("CL1", "LIG", 12.011), "C");
    EXPECT_EQ(guess("CH2", "LIG", 14.027), "C"); // no nitrogen
    EXPECT_EQ(guess("D1", "LIG", 2.014), "H");
    EXPECT_EQ(guess("HB1", "ALA", 3.024), "H"); // repartitioned
    EXPECT_EQ(guess("SOD", "SOD", 22.9898), "Na");
    EXPECT_EQ(guess("POT", "IONS", 39.0983), "K");
    EXPECT_EQ(guess("FE", "LIG", 55.845), "Fe");
    EXPECT_EQ(guess("H1", "LIG", 4.0026), "H"); // repartitioned, and the carbon that lost it
    EXPECT_EQ(guess("C1", "LIG", 9.012), "C");
}

TEST(GuessElement, KnowsParticles)
{
    for (const char* name : {"EP", "EP1", "EPW", "LP1", "LPA", "LPOA"})
        EXPECT_TRUE(isParticleName(name)) << name;
    for (const char* name : {"", "1EP", "CA", "LI", "E1", "LP3H"})
        EXPECT_EQ(isParticleName(name), std::string(name) == "LP3H") << name;
}

TEST(ResidueKind, KnowsTheNamesOfWater)
{
    for (const char* name :
         {"HOH", "WAT", "DOD", "H2O", "TIP3", "TIP", "SOL", "TP3M", "SWM4", "OPC"}) {
        EXPECT_EQ(nameClass(name), NameClass::Water) << name;
    }
    for (const char* name : {"", "ALA", "OH", "HO4"})
        EXPECT_NE(nameClass(name), NameClass::Water) << name;
}

} // namespace
} // namespace molsurf
