// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The command line of MSMS 2.6.

#include <string>
#include <vector>

namespace molsurf::msms
{

/// The user's request. The defaults are those of MSMS.
struct MsmsCall {
    std::string input;        ///< -if
    std::string surface;      ///< -of, without an ending; empty: no surface is written
    std::string areas;        ///< -af, without an ending; empty: no areas are written
    double probe = 1.5;       ///< [Å]
    double density = 1.0;     ///< vertices an Å^2
    double highDensity = 3.0; ///< as given: it is only printed
    bool header = true;       ///< whether surfaces begin with three lines with their size
    bool all = false;         ///< whether all components are computed, and not the outer one
    bool hydrogens = true;    ///< whether spheres of radius 1.2 Å are used
    bool totals = true;       ///< whether areas are printed
    bool help = false, manual = false, version = false;
    bool dryRun = false;               ///< only say what it takes
    std::vector<std::string> warnings; ///< one line each
};

/// The largest density that the finest voxels reach [1/Å^2].
constexpr double largestDensity = 400.0;

/// The least one: its triangles are as large as atoms [1/Å^2].
constexpr double leastDensity = 0.1;

/// The least radius of a probe but 0: smaller re-entrant faces are lost in the voxels [Å].
constexpr double leastProbe = 0.2;

/// Parses the command line. An option may be cut short as long as it can be no other one.
/// @throws Error(ErrorKind::Usage)
MsmsCall parseMsms(int argc, const char* const* argv);

/// The text of -h, and the manual page, which --man prints.
std::string msmsHelp();
std::string msmsManual();

} // namespace molsurf::msms
