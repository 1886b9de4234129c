// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The words of selections: those of PyMOL, VMD and MDAnalysis, and those of theirs that have no
/// meaning here. A word is a row of a table.

#include "molsurf/molecule/structure/structure.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace molsurf
{

/// Facts of a structure that several words need, found once.
class SelectionFacts
{
public:
    explicit SelectionFacts(const Structure& structure);

    const Structure& structure() const { return structure_; }

    /// The kind of a residue. A modified one is protein or nucleic, and a bead what its name says.
    ResidueKind kindOf(const Atom& atom) const { return kinds_[std::size_t(atom.residue)]; }

    /// Whether a residue has carbon.
    bool hasCarbon(const Atom& atom) const { return carbons_[std::size_t(atom.residue)] != 0; }

    const Model& modelOf(std::size_t atom) const;

    /// The place of an atom in its model, from 0.
    int indexOf(std::size_t atom) const { return int(atom - modelOf(atom).begin); }

private:
    const Structure& structure_;
    std::vector<ResidueKind> kinds_; ///< one a residue
    std::vector<char> carbons_;      ///< one a residue
};

/// A word that stands alone: "protein".
struct ClassWord {
    const char* words; ///< all its forms, with blanks between
    bool (*holds)(const SelectionFacts& facts, const Atom& atom);
};

/// A word that values follow: "chain A B", "resid 10 to 20", "b < 30". One of the last three
/// members reads it off an atom.
struct PropertyWord {
    const char* words;
    const char* what; ///< "the name of a chain"
    bool lists; ///< whether a list of values may follow; if not, a comparison with a number in
                ///< single precision has to
    std::string_view (*text)(const Structure& structure, const Atom& atom);
    double (*number)(const SelectionFacts& facts, std::size_t atom);
    bool element = false; ///< values are symbols of elements
    bool residue = false; ///< values are numbers of residues with insertion codes
    bool place = false;   ///< values change when atoms move
};

/// Effect of an operator on its selection.
enum class SelectionOperator : std::uint8_t { And, Or, Not, Value, SameAs, Within, Around, Beyond };

/// An operator: "and", "byres", "within".
struct OperatorWord {
    const char* words;
    SelectionOperator does;
    const char* property = nullptr; ///< of SameAs: the one that is shared; null: it is named behind
    bool itself = false; ///< of Around: whether the atoms that it is about are of it, as in expand
};

/// A word of any table; the members that are not of its table are null.
struct SelectionWord {
    const ClassWord* isClass = nullptr;
    const PropertyWord* isProperty = nullptr;
    const OperatorWord* isOperator = nullptr;
};

/// The word of a text in any case, if it is one.
std::optional<SelectionWord> selectionWord(std::string_view text);

/// What to write for a word of PyMOL, VMD, MDAnalysis, MDTraj or ProDy, in any case, that has no
/// meaning here; empty for all other texts.
std::string foreignWord(std::string_view text);

/// All words but abbreviations, for a message that names a near one.
const std::vector<std::string>& selectionWords();

} // namespace molsurf
