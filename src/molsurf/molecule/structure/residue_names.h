// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The names of residues, as the Protein Data Bank and the force fields of CHARMM, Amber, GROMACS
/// and OPLS write them.

#include <cstdint>
#include <string_view>

namespace molsurf
{

/// Class of a residue by its name alone.
enum class NameClass : std::uint8_t {
    Unknown,
    AminoAcid,         ///< one of the standard ones, by any name
    ModifiedAminoAcid, ///< "MSE", "SEP", and those of D form
    Nucleotide,        ///< one of the standard ones, by any name
    ModifiedNucleotide,
    Cap,        ///< the end of a chain: "ACE", "NME"
    Water,      ///< "HOH", "TIP3", "SOL"
    Ion,        ///< "CLA", "NA+", "ZN2"; see ionElement()
    Buffer,     ///< salts, buffers, solvents, cryoprotectants
    Solvent,    ///< "THF": a solvent's name of a force field, or another molecule
    Lipid,      ///< lipids and detergents
    LongLipid,  ///< "PSM": the name of a lipid of long tails, or another molecule
    CutLipid,   ///< "POP": a lipid's name without its last letters, or another molecule
    AmberLipid, ///< "PC", "OL": a head or a tail of Amber's lipids, or another molecule
    Sugar
};

/// Whether it is a link of a chain, standard or modified.
inline bool isLink(NameClass name)
{
    return name == NameClass::AminoAcid || name == NameClass::ModifiedAminoAcid ||
           name == NameClass::Nucleotide || name == NameClass::ModifiedNucleotide;
}

/// The class of a name. Names of ions may have charges.
NameClass nameClass(std::string_view residue);

/// The atomic number of the ion that a residue or an atom is named by; 0 if there is none. "SOD",
/// "NA", "NA+" and "Na+" are sodium, "CAL", "CA2+" calcium. A charge has one digit.
std::uint8_t ionElement(std::string_view name);

/// True for the amino acids and nucleotides that have no other form, by any of their names.
bool isStandardResidue(std::string_view residue);

} // namespace molsurf
