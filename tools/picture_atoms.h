// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Atoms that pictures show or look at, beside those that the surface is of.

#include "cli/call.h"

#include "molsurf/atoms.h"
#include "molsurf/progress.h"
#include "molsurf/surface/picture_settings.h"

#include <functional>
#include <string>
#include <vector>

namespace molsurf::tool
{

/// Whether a note names no atoms: then it belongs to the first structure of a picture.
bool isOfPlaces(const NoteText& note);

/// Adds labels and rulers of selections and places.
/// @param[in] atomsOf  gives the atoms of a selection; it is asked in the order of the notes
/// @throws Error(ErrorKind::Input) if a ruler has no length
void addNotes(const std::vector<NoteText>& notes,
              const std::function<BallSet(const std::string& select)>& atomsOf,
              DrawOptions& picture);

/// Zooms to atoms.
void zoomTo(const BallSet& atoms, DrawOptions& picture);

/// Looks at the side of the surface where the atoms of --view lie.
/// @throws Error(ErrorKind::Input) if they lie on no side
void lookAt(const CommandLine& call, const BallSet& atoms, const BallSet& surface,
            DrawOptions& picture);

} // namespace molsurf::tool
