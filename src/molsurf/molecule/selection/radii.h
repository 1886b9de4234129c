// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Van der Waals radii: named sets and files.

#include "molsurf/molecule/structure/element.h"

#include <array>
#include <map>
#include <string>
#include <utility>

namespace molsurf
{

/// Radii by element [Å], by atomic number; 0 where the set has none.
using ElementRadii = std::array<double, maxElement + 1>;

/// Radius of an atom whose element no set knows [Å]: that of carbon.
constexpr double unknownRadius = 1.7;

/// A set of rules that give atoms their radii.
struct RadiiSet {
    std::string name; ///< of the set, or the path of the file
    ElementRadii elements{};
    std::map<std::pair<std::string, std::string>, double> atoms; ///< by residue ("*": any) and atom
    double otherwise = 0; ///< for every other atom; 0: none is given

    /// Radius [Å], or a negative number if the set has none for this atom.
    double find(const std::string& residue, const std::string& atom, std::uint8_t element) const;
};

/// A built-in set, or the content of a file.
///
/// Sets: "bondi", "alvarez", "gemmi"; of heavy atoms with their hydrogens "protor" and "naccess";
/// for beads "martini2" and "martini3"; see describeRadii(). A file has one rule a line, in Å:
///
///     C        1.70      # an element
///     *        1.80      # any atom that no other rule covers
///     ALA  CB  1.90      # an atom of a residue
///     *    CA  1.88      # an atom of any residue
///
/// An atom of a named residue comes first, then that of the residue it is a form of (HIS for HID),
/// then `* ATOM`, then the element, then `*`. A later line
/// replaces an equal earlier one. 0 leaves the atom out.
///
/// @param[in] maxBytes  that a file may have; see loadText()
/// @throws Error(ErrorKind::Input) if `name` is neither a set nor a file that can be read, or, with
///         file and line, if a line is not a rule
RadiiSet readRadii(const std::string& name, std::size_t maxBytes = 0);

/// Whether readRadii() takes a name for that of a set, whatever files there are.
bool isRadiiSet(const std::string& name);

} // namespace molsurf
