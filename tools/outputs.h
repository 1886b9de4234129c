// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Functions of the verbs that write files.

#include "cli/call.h"
#include "terminal.h"

#include "molsurf/molecule/structure/archive.h"
#include "molsurf/report.h"
#include "molsurf/show/io/output_file.h"

#include <tbb/global_control.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace molsurf::tool
{

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start);

/// The largest resident memory up to now [byte].
std::size_t peakMemory();

/// @throws Cancelled after a signal
void stopIfAsked();

/// Says which files have colours that slicers cannot paint.
void warnOfPaint(const CommandLine& call, const Mesh& mesh, Report& report);

/// Fills in what every report begins with: version, command, input and threads.
void beginReport(const CommandLine& call, Report& report);

/// Fills in what every report ends with, when its files are written: their time, the total and the
/// memory.
/// @param[in] start  when the program began
template<typename R>
void endReport(double writeSeconds, Clock::time_point start, R& report)
{
    report.seconds.emplace_back("write", writeSeconds);
    report.seconds.emplace_back("total", secondsSince(start));
    report.peakMemoryBytes = peakMemory();
}

/// Puts the warnings and times of reading before those of the surface, with options as the command
/// line calls them.
void addReading(const Report& read, Report& report);

/// One line on a flow that has not come to rest: where, how far, and what to do.
/// @param[in] voxel  edge of a voxel [Å]
/// @param[in] more   option that lets it make more steps
std::string unrestText(const EvolutionReport& evolution, double voxel, const std::string& more);

/// A line on a surface that is at rest only as far as its voxels hold it; empty for others.
std::string heldText(const EvolutionReport& evolution, const SurfaceSpec& spec);

/// Finds out whether an output can be written.
/// @throws Error(ErrorKind::Output) as checkWritable(), if the call reads that file, or if a
///         library is missing
void checkOutput(const CommandLine& call, const Output& output);

/// Finds out whether all outputs can be written, and has them cleaned up after a signal. To be
/// called before any work.
/// @throws Error(ErrorKind::Output) as checkOutput()
/// @param[in] more  further temporary files and folders to be removed then
void prepareOutputs(const CommandLine& call, const std::vector<std::string>& more = {});

/// Files that are being written.
using OutputFiles = std::vector<std::unique_ptr<OutputFile>>;

/// Puts complete files in their places as molsurf::commit() does, whatever signals come then.
/// @throws Cancelled after a signal that came before
void commitUndisturbed(const OutputFiles& files);

/// Ends what killed runs have begun in the folders that a call writes to. To be called first.
/// @throws Error(ErrorKind::Output) as molsurf::recover()
void recoverOutputs(const CommandLine& call);

/// Writes all files, and only when every one is complete puts them in their place. The report comes
/// last, because it has the times of the others; streams, which cannot be taken back, only
/// precede the reports. A film of several runs gets what it is to have of this one.
///
/// @param[in] writeOne  writes one of them
/// @param[in] timed     is called once with the seconds that writing took, before the report is
///                      written or else at the end
/// @param[in] sideBySide  files other than reports are written at the same time
/// @param[in] addMore   adds further files, complete, at the end; may be empty
void writeOutputs(const CommandLine& call, Terminal& terminal,
                  const std::function<void(const Output&, OutputFile&)>& writeOne,
                  const std::function<void(double)>& timed, bool sideBySide = true,
                  const std::function<void(OutputFiles&)>& addMore = {});

} // namespace molsurf::tool
