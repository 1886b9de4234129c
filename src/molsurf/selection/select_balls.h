// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// From a structure to the balls whose surface is wanted.

#include "molsurf/selection/ball.h"
#include "molsurf/structure/structure.h"

#include <string>
#include <vector>

namespace molsurf {

/// Which atoms are used, and how large they are.
struct SelectOptions {
    std::string select;              ///< gemmi selections joined by '|'; empty: all atoms
    int model = 0;                   ///< number in the file; 0: the first model
    std::string assembly = "none";   ///< name in the file, or "none": the coordinates as they stand
    std::string altloc;              ///< "": the highest occupancy; "A": that label; "all"
    bool hydrogens = true;           ///< keep the hydrogens of the file
    bool hetero = true;              ///< keep ligands and ions
    bool waters = false;             ///< keep waters
    std::string radii = "bondi";     ///< name of a set, or the path of a radii file
};

/// Atoms left out for one reason.
struct Drop {
    std::string reason; ///< "water", "hydrogen", "alternate location", "dummy", "zero radius", ...
    std::size_t count;
};

/// The balls, and what was done to get them.
struct BallSelection {
    std::vector<Ball> balls;
    std::vector<Drop> drops;           ///< counted before the assembly is expanded
    std::size_t copies = 1;            ///< assembly operators applied, 1 without an assembly
    std::vector<std::string> warnings; ///< one line each: unknown elements, missing altloc, ...
};

/// Chooses atoms, gives them radii, and applies the operators of the assembly.
///
/// The order of the balls is that of the file, copy by copy. Every ball's `atom` is the index of
/// its atom in Structure::atoms.
///
/// @throws Error(ErrorKind::Input) if nothing is selected, or if the model, the assembly or the
///         radii file does not exist
/// @throws Error(ErrorKind::Usage) if the selection cannot be parsed, or if radii are asked for a
///         file that has its own
BallSelection selectBalls(const Structure& structure, const SelectOptions& options);

/// The built-in radii sets, one paragraph each: name, source, and the radii by element [Å].
std::string describeRadii();

} // namespace molsurf
