// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The surfaces of a request as pictures and pages show them.

#include "molsurf/request/request.h"
#include "molsurf/surface/drawn_surface.h"

#include <string>
#include <vector>

namespace molsurf
{

/// Whether a file shows borders between colours that are cut: pictures find them by themselves.
bool isCrisp(const Request& request, const Output& output);

/// The meshes that the files of a request show, but for `coarser`: borders are found once for all
/// of them.
/// @param[in] options  that decided the surface and its colours
/// @param[in] mesh     of the surface, where the atoms are, or of the whole
/// @param[in] whole    as ShownMeshes::whole
ShownMeshes shownMeshes(const Request& request, const SurfaceOptions& options, const BallSet& atoms,
                        const Mesh& mesh, const std::shared_ptr<const WholeBalls>& whole,
                        const Progress& progress);

/// The surface of a request as pictures show it.
/// @param[in] turn   beside that of the request [degree]
/// @param[in] quick  as DrawOptions::quick
DrawnSurface drawnSurface(const Request& request, const BallSet& atoms, const Mesh& mesh,
                          const ShownMeshes& shown, double turn = 0.0, bool quick = false);

/// A panel with a surface of its own.
/// @param[in] mesh  its own or that with borders
DrawnSurface drawnPanel(const Request& request, const PanelSurface& panel, const Mesh& mesh);

/// The surface of a request with its panels behind it.
std::vector<DrawnSurface> drawnPanels(const Request& request, const DrawnSurface& first);

/// A line on a picture that shows nothing of the surface, since `clip` cuts all of it away; empty:
/// it shows some.
std::string clipWarning(const DrawnSurface& surface, const Progress& progress);

} // namespace molsurf
