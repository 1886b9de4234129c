// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What follows from the settings that were given: groups and colours that others need, and
/// warnings. The command line and Python have the same.

#include "molsurf/settings.h"

#include <functional>
#include <string>
#include <vector>

namespace molsurf
{

/// Gives what needs groups or colours those that it has by default: interfaces are between chains,
/// colours by copy, entity or class are those of groups, and a grid of colours is by chain. Reads
/// the groups that are for colours; where no others are given parts and interfaces are of them. In
/// resolutions selections take the place of names of groups.
/// @param[in] coloredGrid  whether files have a grid of colours, named in `fields` or not
void resolveGroups(Settings& settings, bool coloredGrid = false);

/// Warnings of settings that change none of the surfaces, and of lengths that voxels do not
/// resolve. Names of settings are in backticks, as in an Error.
/// @param[in] isGiven  whether the setting of a name was given
/// @param[in] more     kinds of further surfaces
std::vector<std::string> settingWarnings(const Settings& settings,
                                         const std::function<bool(const char*)>& isGiven,
                                         const std::vector<SurfaceKind>& more = {});

} // namespace molsurf
