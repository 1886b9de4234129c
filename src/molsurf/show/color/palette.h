// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Colours of balls: by chain, group, element or kind of residue.

#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"
#include "molsurf/show/color/color_map.h"

#include <string>
#include <vector>

namespace molsurf
{

/// The colour of what has no label.
constexpr Color neutralColor = {190, 190, 190};

/// The colour of what has no value on a scale.
// measured: CIEDE2000 to any colour of any palette under shading by 0.15 to 1 in linear light: 14.9
constexpr Color noValueColor = {172, 204, 180};

/// As many things as this can have colours of their own.
constexpr std::size_t mostDistinct = 40;

/// Colours for things that touch each other. Up to mostDistinct of them have colours of their own,
/// any two of which differ by 10 or more (CIEDE2000), also from the neutral one and that of no
/// value; the first eight are those that the colour-blind can tell apart (Okabe and Ito, Color
/// universal design, 2008). More things share these eight: each takes the first that no neighbour
/// of lower index has, the least used of them, and one of the others if neighbours have all.
///
/// @param[in] neighbours  for each thing those that it touches
std::vector<Color> distinctColors(const std::vector<std::vector<std::int32_t>>& neighbours);

/// Checks that balls have what colours are chosen by.
/// @throws Error(ErrorKind::Usage) that names it
void checkColors(const BallSet& atoms, ColorBy by);

/// The colour of every ball: elements by the CPK convention (with Jmol's values), chains and groups
/// by their places in the file, where each has a colour of its own, else by distinctColors().
/// The file of groups may give others.
///
/// @param[in] by  Chain, Group, Element or Residue
/// @return one colour a ball; all neutral without labels
std::vector<Color> ballColors(const BallSet& atoms, ColorBy by, const Progress& progress);

/// Warnings about the colours of names, as that chains share some: a line each.
std::vector<std::string> colorWarnings(const BallSet& atoms, ColorBy by);

/// The colours of the chains themselves, as ballColors() gives them.
std::vector<Color> chainColors(const BallSet& atoms, const Progress& progress);

/// The colours of the copies of an assembly, Placement::instances, by distinctColors() of those
/// whose middles are near.
std::vector<Color> instanceColors(const BallSet& atoms, const Progress& progress);

/// The colours of the groups themselves, as ballColors() gives them.
std::vector<Color> groupColors(const BallSet& atoms, const Progress& progress);

/// The same of BallLabels::colorGroups.
std::vector<Color> fileGroupColors(const BallSet& atoms, const Progress& progress);

} // namespace molsurf
