// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A molecule that is kept: read once, then asked for balls and for selections of atoms.

#include "molsurf/atoms.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace molsurf
{

struct Structure;

/// What a file holds: atoms, residues, chains, models, assemblies, bonds and charges. Copies share
/// it; it does not change.
class Molecule
{
public:
    /// Reads a file; parameters and errors as of readAtoms().
    /// @param[in] maxInput,memory  as SelectOptions::maxInput and SelectOptions::memory
    explicit Molecule(const std::string& path, const Progress& progress = Progress(),
                      std::size_t maxInput = 0, std::size_t memory = 0);

    /// Reads a file in memory; otherwise as above.
    explicit Molecule(FileContent file, const Progress& progress = Progress(),
                      std::size_t maxInput = 0, std::size_t memory = 0);

    /// Makes balls of atoms, as readAtoms() does.
    BallSet balls(const SelectOptions& options = {}, double probe = 0.0,
                  const Progress& progress = Progress()) const;

    /// Finds the atoms that a selection takes, used or not.
    /// @param[in] selection  as SelectOptions::select; empty: all
    /// @return their places in the file, counted from 0 over all models, as Ball::atom; ascending
    /// @throws Error(ErrorKind::Usage) if it cannot be parsed
    /// @throws Error(ErrorKind::Input) if it matches no atom
    std::vector<std::size_t> select(const std::string& selection) const;

    /// Returns the molecule with atoms at other places.
    /// @param[in] atoms   their places in the file
    /// @param[in] places  one an atom [Å]
    Molecule moved(const std::vector<std::int32_t>& atoms,
                   const std::vector<openvdb::Vec3d>& places) const;

private:
    explicit Molecule(std::shared_ptr<const Structure> structure);
    std::shared_ptr<const Structure> structure_;
};

} // namespace molsurf
