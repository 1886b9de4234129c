// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What the columns of ATOM and HETATM records mean, which programs use in several ways.

#include "molsurf/molecule/structure/atom_tree.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <cstddef>
#include <set>
#include <string>
#include <string_view>

namespace molsurf
{

/// The columns [first, first + size) of a line, counted from 0, without blanks around them.
std::string_view columns(std::string_view line, std::size_t first, std::size_t size);

/// How the atoms of a file use their columns.
struct PdbLayout {
    bool fourLetters = false;   ///< columns 18-21 are the name of a residue, column 22 is the chain
    bool placedNames = true;    ///< names begin in column 13 if their elements have two letters
    bool wideNames = false;     ///< names go on in column 17, and there are no alternate locations
    bool strayElements = false; ///< what stands in columns 75-76 begins elements
    bool autoDock = false;      ///< columns 71-76 have charges, and types begin in column 78
};

/// Finds the layout of a file by all of its atoms.
class PdbLayoutFinder
{
public:
    void add(std::string_view line);
    PdbLayout layout() const;
    std::size_t atoms() const { return atoms_; }

private:
    bool hasFourLetters() const;

    std::size_t atoms_ = 0;
    bool placedNames_ = true;
    bool wideNames_ = false, alternates_ = false;      ///< what column 17 holds
    bool strayElements_ = false, segments_ = false;    ///< what columns 73-76 hold
    std::set<std::string, std::less<>> residueFields_; ///< columns 18-22 with a letter in 21
};

/// Reads everything of a record but its coordinates, and the types of AutoDock.
AtomLine atomInColumns(std::string_view line, const PdbLayout& layout);

/// Reads columns 31-54.
/// @throws Error(ErrorKind::Input) with the line, if they hold anything but three numbers
openvdb::Vec3d placeInColumns(const std::string& path, const LineReader& lines);

} // namespace molsurf
