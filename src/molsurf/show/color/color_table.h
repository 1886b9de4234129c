// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The properties that colours show, a row each: words, messages, legends, borders and pages come
/// from it.

#include "molsurf/mesh.h"
#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"
#include "molsurf/show/color/color_map.h"
#include "molsurf/show/color/legend.h"

#include <vector>

namespace molsurf
{

/// One property that colours show. A function that is null has nothing to give.
struct ColorKind {
    ColorBy by;
    const char* word;                            ///< of the command line
    const char* title = "";                      ///< of the legend
    const char* attribute = "";                  ///< of the mesh, that the legend is of
    const char* unit = "";                       ///< of the legend's scale
    const char* help = "";                       ///< what a help text adds to the word
    bool ofCurvature = false;                    ///< whether vertices have it, and not balls
    bool ofChains = false;                       ///< whether each chain has a colour of its own
    bool complete = true;                        ///< whether its word is enough to ask for it
    bool offered = false;                        ///< whether pages offer it without being asked
    const char* needs = nullptr;                 ///< what balls need for it, in words
    bool (*has)(const BallSet& atoms) = nullptr; ///< whether they have that
    /// The colour of every ball, for balls that have what it needs.
    std::vector<Color> (*ofBalls)(const BallSet& atoms, const Progress& progress) = nullptr;
    /// Fills in the scale or the entries of a legend, for such balls.
    void (*describe)(const BallSet& atoms, const Mesh& mesh, const Progress& progress,
                     Legend& legend) = nullptr;
    /// Whether its colours meet along exact lines.
    bool (*hasBorders)(const BallSet& atoms) = nullptr;
};

/// The whole table, in the order of the help text.
const std::vector<ColorKind>& colorTable();

/// The row of a property.
const ColorKind& kindOf(ColorBy by);

} // namespace molsurf
