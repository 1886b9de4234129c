// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Members of .tar archives, which stand for files by the name "archive.tar::member".

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// Whether a name ends as those of archives do: .tar, .tar.gz or .tgz.
bool isArchiveName(const std::string& path);

struct ArchiveMember {
    std::string archive, name;
};

/// The member that a path names, if its archive is a file; whether it has that member is not asked.
std::optional<ArchiveMember> memberOf(const std::string& path);

/// The paths of an archive's files, "archive.tar::member", in its order, each once.
/// @throws Error(ErrorKind::Input) if it cannot be read, is damaged or cut short
std::vector<std::string> membersIn(const std::string& archive);

/// The bytes of a member. The archive is read once for the places of all; members that are asked
/// for in their order cost no more than one pass through what is packed.
/// @param[in] maxBytes  that it may have
/// @throws Error(ErrorKind::Input) as above, if there is none of that name, or it is larger
std::string readMember(const ArchiveMember& member, std::size_t maxBytes);

/// The name of an input without folder, .gz, .bz2 or .xz, and extension.
std::string inputStem(const std::string& input);

} // namespace molsurf
