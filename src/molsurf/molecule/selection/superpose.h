// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A structure laid on another one by the atoms that both have.

#include "molsurf/kernel/core/superposition.h"
#include "molsurf/molecule/selection/match_atoms.h"

#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace molsurf
{

/// What makes an atom of one structure that of another one: chain, number, insertion code, name.
using AtomKey = std::tuple<std::string, int, char, std::string>;

/// The atoms by which a structure is laid on others [Å].
struct Anchors {
    std::string source; ///< the structure, for messages
    std::map<AtomKey, openvdb::Vec3d> atoms;
};

/// Which atoms are anchors.
struct AnchorRule {
    std::string anchors; ///< a selection; "auto": CA of amino acids and C4' of nucleotides
    std::string among;   ///< a selection that they are in, too; empty: all

    bool byResidue() const { return anchors == "auto"; }
};

/// Which atoms of all models are anchors.
std::vector<char> anchorAtoms(const Selections& selections, const AnchorRule& rule);

/// @param[in] model  its number; 0: the first one
/// @throws Error(ErrorKind::Input) if there are none
Anchors anchorsOf(const Structure& structure, const AnchorRule& rule, int model);

/// The same, by what anchorAtoms() has found.
Anchors anchorsOf(const Structure& structure, const AnchorRule& rule,
                  const std::vector<char>& taken, int model);

/// The motion that lays some anchors on others, by the atoms that both have. Names of chains do not
/// count where each of the two has one chain.
/// @throws Error(ErrorKind::Input) if fewer than three are common, or they lie on one line
Superposition superpositionOf(const Anchors& moving, const Anchors& fixed);

/// Moves the atoms of all models, and the operators of assemblies with them.
void moveBy(const Superposition& motion, Structure& structure);

/// Moves the atoms of one model alone.
void moveBy(const Superposition& motion, const Model& model, Structure& structure);

/// The operators of assemblies of a structure that was moved.
std::vector<Assembly> moved(const Superposition& motion, std::vector<Assembly> assemblies);

/// "superposed by 326 atoms, rmsd 1.234 Å".
std::string describe(const Superposition& motion);

} // namespace molsurf
