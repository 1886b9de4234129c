// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Several files that appear together or not at all, whenever the process is killed.
///
/// A record, ".vdb_molsurf.MAKER.commit" in the folder of the first file, says that all files are
/// complete. While it is there they are put in their places. Whoever comes after a killed process
/// does what its records say, and removes what no record names. Each folder has a record of its own
/// files; that of the first one names the other folders, and theirs name the first one. So a record
/// can rename only the temporary files of its maker, within its folder, and a folder from
/// elsewhere does no harm.

#include "molsurf/show/io/output_file.h"

#include <string>
#include <vector>

namespace molsurf
{

/// Finishes all files, then puts them in their places. Standard output is only flushed.
/// @throws Error(ErrorKind::Output) if that fails, or if a file that may not be replaced has been
///         made meanwhile. Then none is there, and those that were there before are there again; if
///         the system refuses even that, the next recover() puts all in their places.
void commit(const std::vector<OutputFile*>& files);

/// Ends what killed processes of this user have begun in a folder: files that were complete get
/// their names, and others are removed. Files of processes that are at work stay as they are.
/// @throws Error(ErrorKind::Output) if a complete file cannot get its name; names the record
void recover(const std::string& folder);

} // namespace molsurf
