// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Colours of balls: by chain, group, element or kind of residue.

#include "molsurf/color/color_map.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"
#include "molsurf/selection/select_balls.h"

#include <vector>

namespace molsurf
{

/// The colour of what has no label.
constexpr Color neutralColor = {190, 190, 190};

/// Colours for things that touch each other: of those on a palette of eight that the colour-blind
/// can tell apart (Okabe and Ito, Color universal design, 2008) and their lighter and darker
/// shades, each takes the first that no neighbour of lower index has, the least used of them.
///
/// @param[in] neighbours  for each thing those that it touches
std::vector<Color> distinctColors(const std::vector<std::vector<std::int32_t>>& neighbours);

/// Checks that balls have what colours are chosen by.
/// @throws Error(ErrorKind::Usage) that names it
void checkColors(const BallSet& atoms, ColorBy by);

/// The colour of every ball: elements by the CPK convention (with Jmol's values), chains and groups
/// by distinctColors() where the file of groups gives none.
///
/// @param[in] by  Chain, Group, Element or Residue
/// @return one colour a ball; all neutral without labels
std::vector<Color> ballColors(const BallSet& atoms, ColorBy by, const Progress& progress);

/// The colours of the chains themselves, as ballColors() gives them.
std::vector<Color> chainColors(const BallSet& atoms, const Progress& progress);

/// The colours of the copies of an assembly, BallSet::instances, by distinctColors() of those whose
/// middles are near.
std::vector<Color> instanceColors(const BallSet& atoms, const Progress& progress);

/// The colours of the groups themselves, as ballColors() gives them.
std::vector<Color> groupColors(const BallSet& atoms, const Progress& progress);

} // namespace molsurf
