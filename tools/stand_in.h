// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Functions of the programs that replace others.

#include "molsurf/show/io/output_file.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace molsurf::tool
{

/// The programs have no option for it: some ten million spheres [byte].
inline constexpr std::size_t mostSphereBytes = std::size_t{512} << 20;

/// Finds out whether files can be written, which may replace others, and has them cleaned up after
/// a signal. To be called before any work, and again where other files follow.
/// @param[in] input  which none of them may be
/// @param[in] hint   how else they could be called
/// @throws Error(ErrorKind::Output) if one cannot be written, or is the input
void prepareFiles(const std::vector<std::string>& paths, const std::string& input,
                  const std::string& hint);

/// Ends what killed runs have begun in the folders of files.
/// @throws Error(ErrorKind::Output) as molsurf::recover()
void recoverFolders(const std::vector<std::string>& paths);

/// Writes files, and puts them in their places when all are complete.
/// @param[in] write     writes file i
/// @param[in] complete  is called when all are complete
/// @throws Cancelled after a signal
void writeFiles(const std::vector<std::string>& paths,
                const std::function<void(std::size_t, OutputFile&)>& write,
                const std::function<void()>& complete);

/// runProgram() without hints that name options of the library.
/// @return the exit status
int runStandIn(const std::function<void()>& perform);

} // namespace molsurf::tool
