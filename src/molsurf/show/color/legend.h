// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The legend of a surface: the meaning of its colours.

#include "molsurf/mesh.h"
#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"
#include "molsurf/show/color/color_map.h"

#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// A colour with the name of what has it.
struct LegendEntry {
    std::string name;
    Color color;
    bool seen = true; ///< whether anything has it; if not it only keeps the place of its value
};

/// A scale of values, or a list of names.
struct Legend {
    std::string title;               ///< "Chain", "Mean curvature"
    std::string id;                  ///< the command line's word: "chain", "mean-curvature"
    std::string attribute;           ///< vertex attribute that is shown; empty: none in the mesh
    std::string unit;                ///< of the scale: "1/Å"
    std::optional<ColorScale> scale; ///< of a legend of values
    /// Beside a scale what has no value on it. Else of names: entry i is that of the attribute's
    /// value i; of value -1 the last one.
    std::vector<LegendEntry> entries;
};

/// Adds an entry, unless there is one with its name and colour.
void addEntry(const LegendEntry& entry, std::vector<LegendEntry>& entries);

/// The legend of one kind of colours, or nothing: the mesh cannot have them. Chains and groups have
/// an entry each, in their order, and if some vertices have none of them one more, "other";
/// elements and kinds of residues have one for each that occurs.
///
/// @param[in] mesh  of the run
std::optional<Legend> legendOf(ColorBy by, const BallSet& atoms, const Mesh& mesh,
                               const Progress& progress);

/// Legends of all colours that a mesh offers; the one that it was asked for comes first.
std::vector<Legend> offeredLegends(ColorBy asked, const BallSet& atoms, const Mesh& mesh,
                                   const Progress& progress);

} // namespace molsurf
