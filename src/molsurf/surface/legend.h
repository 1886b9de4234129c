// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What the colours of a surface mean.

#include "molsurf/surface/color_map.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// A colour with the name of what has it.
struct LegendEntry {
    std::string name;
    Color color;
};

/// A scale of values, or a list of names.
struct Legend {
    std::string title;               ///< "Chain", "Mean curvature"
    std::string id;                  ///< the command line's word: "chain", "mean-curvature"
    std::string attribute;           ///< vertex attribute that is shown; empty: none in the mesh
    std::string unit;                ///< of the scale: "1/Å"
    std::optional<ColorScale> scale; ///< of a legend of values
    /// Else of names: entry i is that of the attribute's value i; of value -1 the last one.
    std::vector<LegendEntry> entries;
};

} // namespace molsurf
