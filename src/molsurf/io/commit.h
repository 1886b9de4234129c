// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Several files that appear together or not at all, whenever the process is killed.
///
/// A record of all names, ".vdb_molsurf.MAKER.commit" in the folder of the first file, says that
/// all of them are complete. While it is there they are put in their places. Whoever comes after a
/// killed process does what its records say, and removes what no record names. The folders of the
/// other files have records that name the first folder. A record can rename the temporary files of
/// its maker alone, in their folders, so that a folder from elsewhere does no harm.

#include "molsurf/io/output_file.h"

#include <string>
#include <vector>

namespace molsurf
{

/// Finishes all files, then puts them in their places. Standard output is only flushed.
/// @throws Error(ErrorKind::Output) if that fails, or if a file that may not be replaced has been
///         made meanwhile. Then none is there, but for those that have replaced another one before
///         the system refused the next.
void commit(const std::vector<OutputFile*>& files);

/// Ends what killed processes of this user have begun in a folder: files that were complete get
/// their names, and others are removed. Files of processes that are at work stay as they are.
/// @throws Error(ErrorKind::Output) if a complete file cannot get its name
void recover(const std::string& folder);

} // namespace molsurf
