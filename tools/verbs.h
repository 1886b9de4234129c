// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The verbs of the tool, one file each. They return the exit status.

#include "cli/call.h"
#include "exit_status.h"
#include "outputs.h"
#include "terminal.h"

#include "molsurf/molecule/selection/superpose.h"
#include "molsurf/report.h"
#include "molsurf/surface.h"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace molsurf::tool
{

/// Builds a surface and writes the outputs: build.cpp.
/// @param[in] start  when the program began, for the total time
int build(const CommandLine& call, std::chrono::steady_clock::time_point start);

/// Files of a verb's own that are one commit with the outputs of a surface.
struct ExtraOutputs {
    std::vector<std::string> temporaries; ///< to be removed after a signal
    /// Adds them, written, when the report of the surface is complete; may be empty.
    std::function<void(const Report&, OutputFiles&)> add;
};

/// The same without its last word on standard error, but for errors.
/// @return the report, complete
Report buildSurface(CommandLine call, std::chrono::steady_clock::time_point start);

/// The part of it behind the atoms.
/// @param[in] read  what readBalls() has put in the report
Report buildSurface(const CommandLine& call, const BallSet& balls, const Report& read,
                    Terminal& terminal, std::chrono::steady_clock::time_point start);

/// Makes the surface of balls that are read, checks and shows it, and writes the files.
/// prepareOutputs() has been called.
/// @param[in] call    with --center and a frame the centre of the scene is taken, else chosen
/// @param[in] extend  changes the result before it is written; may be empty
Report surfaceOf(CommandLine call, const BallSet& balls, const Report& read, Terminal& terminal,
                 std::chrono::steady_clock::time_point start,
                 const std::function<void(MolecularSurface&)>& extend = nullptr,
                 const ExtraOutputs& companions = {});

/// The balls of a structure file: read_balls.cpp.
struct DescribedBalls {
    BallSet balls;
    SearchPlaces places;
    std::string description;                      ///< one line
    std::shared_ptr<const Anchors> anchors{};     ///< of a call with `superpose`
    std::optional<Superposition> superposition{}; ///< how it lies on the anchors of the call
};

/// Where the call has anchors, the structure is laid on them.
/// @param[in,out] picture  gets the atoms that it shows and looks at; null: there is none
/// @param[in]     other    whether it is another structure than that of the call, which says where
///                         the eye is; what the structure lacks of these atoms is left out
DescribedBalls readBalls(const std::string& path, const CommandLine& call, Terminal& terminal,
                         DrawOptions* picture = nullptr, bool other = false);

/// The balls of a call, described on standard error.
/// @param[in,out] call    gets the places of its products, and the atoms of its picture
/// @param[in,out] report  gets the seconds that it took, and warnings
BallSet readBalls(CommandLine& call, Terminal& terminal, Report& report);

/// Colours each ball, if the options want colours, by what touches what in the whole molecule.
void colorBalls(const SurfaceOptions& options, Terminal& terminal, BallSet& balls);

/// Builds the surfaces of frames: frames.cpp.
int frames(const CommandLine& call, std::chrono::steady_clock::time_point start);

/// Builds the surfaces of a list of structures, one after the other; a summary after each:
/// batch.cpp.
int batch(CommandLine call);

/// Compares two surfaces and writes the outputs: compare.cpp.
/// @param[in] start  when the program began, for the total time
int compare(const CommandLine& call, std::chrono::steady_clock::time_point start);

/// Cuts the space about a molecule into bricks and writes a manifest: plan.cpp.
int plan(CommandLine call);

/// Computes one brick of a plan: brick.cpp.
int brick(const CommandLine& call);

/// Joins the bricks of a plan: merge.cpp.
/// @param[in] start  when the program began, for the total time
int merge(const CommandLine& call, std::chrono::steady_clock::time_point start);

/// Builds a surface within --memory, or only says what it takes (--dry-run): build_in_bricks.cpp.
int buildInBricks(CommandLine call, std::chrono::steady_clock::time_point start);

/// Meshes, colours and pictures of a stored surface: convert.cpp.
/// @param[in] start  when the program began, for the total time
int convert(const CommandLine& call, std::chrono::steady_clock::time_point start);

} // namespace molsurf::tool
