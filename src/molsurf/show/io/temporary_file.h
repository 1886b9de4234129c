// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Files and folders in the place of an output until it is complete. Each is locked (flock) by the
/// process that made it, and its name identifies that process, so that others find out whether it
/// is still at work: by the lock, and on the same machine also where a file system has no locks.

#include "molsurf/kernel/core/file_descriptor.h"

#include <string>

namespace molsurf
{

/// The name under which the output @a path is written until it is complete: a hidden file in the
/// same folder, ".NAME.MAKER.part". A symbolic link is followed. Empty for standard output ("-").
std::string temporaryName(const std::string& path);

/// The same for a maker, in the place of this process, and a path that is no symbolic link.
std::string temporaryName(const std::string& path, const std::string& maker);

/// The name that a file of this path has while another one takes its place: ".NAME.MAKER.old".
std::string keptName(const std::string& path);

/// The maker in the names of this process: its number, 8 hexadecimal digits for the machine (host
/// and space of process numbers), and 8 for the boot of the machine and the start of the process.
const std::string& ownMaker();

/// The maker of a file of such a name; empty for other names.
std::string makerOf(const std::string& name);

/// Whether a text is a maker.
bool isMaker(const std::string& text);

/// Where an output lies: the path itself, or where a symbolic link leads.
std::string followed(const std::string& path);

/// The folder that an output is written to, at least ".".
std::string folderOf(const std::string& path);

/// Makes a file under a name of temporaryName(), locked until its descriptor is closed.
/// @return a descriptor to read and write, or -1 with errno
int makeLockedFile(const std::string& name);

/// The same for a folder, which only its owner may enter.
int makeLockedFolder(const std::string& name);

/// Opens a file or folder, and no symbolic link to one, if it is of this user.
FileDescriptor openOwn(const std::string& name);

/// Locks a file or folder of this user that a process has left which is gone.
/// @return none if it is gone, somebody else's, or of a process that may be at work
FileDescriptor lockAbandoned(const std::string& name, const std::string& maker);

/// Gives a file another name in its folder.
/// @return false if that fails, with errno: EEXIST if it may not @a replace another file
bool moveFile(const std::string& from, const std::string& to, bool replace);

/// Waits until the names in a folder are on the disk, where the file system supports that.
void syncFolder(const std::string& folder);

} // namespace molsurf
