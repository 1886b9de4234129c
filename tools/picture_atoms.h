// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Atoms that pictures show or look at, beside those that the surface is of.

#include "cli/call.h"

#include "molsurf/atoms.h"
#include "molsurf/progress.h"

#include <functional>
#include <string>
#include <vector>

namespace molsurf::tool
{

/// How they are chosen: ligands and ions are among them; model, copies and alternate locations are
/// the surface's.
SelectOptions picturedAtoms(const Call& call, const std::string& select);

/// Puts atoms into the picture. Chains have the colours of the surface's.
/// @param[in] atoms    of each rule
/// @param[in] bonds    of their file; null: it gives none
/// @param[in] surface  the balls that the surface is of
/// @throws Error(ErrorKind::Input) if there is nothing to show, or more than the memory holds
void showAtoms(const std::vector<ShowRule>& rules, std::vector<BallSet> atoms,
               const std::shared_ptr<const FileBonds>& bonds, const BallSet& surface,
               const Progress& progress, DrawOptions& picture);

/// Adds labels and rulers.
/// @param[in] atomsOf  gives the atoms of a selection; it is asked in the order of the rules
/// @throws Error(ErrorKind::Input) if a ruler has no length
void addNotes(const std::vector<NoteRule>& rules,
              const std::function<BallSet(const std::string& select)>& atomsOf,
              DrawOptions& picture);

/// Looks at the side of the surface where the atoms of --view lie.
/// @throws Error(ErrorKind::Input) if they lie on no side
void lookAt(const Call& call, const BallSet& atoms, const BallSet& surface, DrawOptions& picture);

} // namespace molsurf::tool
