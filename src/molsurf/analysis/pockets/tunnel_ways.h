// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Ways out of a place between balls.

#include "molsurf/analysis/pockets/pore_ways.h"
#include "molsurf/analysis/pockets/void_field.h"
#include "molsurf/analysis/pockets/void_graph.h"

#include <openvdb/Types.h>

#include <cstdint>
#include <vector>

namespace molsurf
{

/// The ways out of a node, one for each mouth, the widest first: each the widest way there is, and
/// of these the one with the least integral of ds / d^2.
///
/// A way ends where the large probe gets from outside. It only widens from its last neck on: a way
/// into the room of the outside has come out, and goes straight on. Of two ways with one mouth the
/// wider one counts: the large probes at their ends hold each other's centres, or the balls there
/// overlap, or one way goes through the ball at the other's end.
/// @param[in] start  a node that is not outside
/// @param[in] probe  the large one [Å]
std::vector<VoidWay> waysOut(const VoidGraph& graph, const Rooms& rooms, std::int32_t start,
                             double probe, const DepthAt& depth);

} // namespace molsurf
