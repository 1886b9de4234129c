// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A whole file, or standard input, as text.

#include <cstddef>
#include <string>

namespace molsurf
{

/// Whether a path names standard input, "-", a pipe or a device: these have no size, and what is
/// read of them is gone.
bool readsOnce(const std::string& path);

/// Reads a file, or standard input for "-", and unpacks it if it starts as those of gzip, bzip2 or
/// xz do. Members of a concatenated gzip file are joined; behind them there may be zeros. A leading
/// byte order mark is removed, and the UTF-16 behind it becomes UTF-8. Lines that end with CR alone
/// end with LF.
///
/// @param[in] maxBytes  that the text may have, unpacked [byte]; 0: 4 GiB, and where it is above
///                      16 MiB no more than 200 times what it was packed
/// @throws Error(ErrorKind::Input) if the file does not exist, is a folder, cannot be read, is
///         empty or larger than it may be, or if its packed data are damaged or cut short
std::string loadText(const std::string& path, std::size_t maxBytes = 0);

/// The same of a file whose limit no option raises.
/// @param[in] mostBytes  above 0
std::string loadSmallText(const std::string& path, std::size_t mostBytes);

/// The text of a file that is in memory; otherwise as above.
/// @param[in] path  stands for it in messages
std::string unpackedText(std::string bytes, const std::string& path, std::size_t maxBytes = 0);

/// A text without the byte order mark that it may begin with, in UTF-8.
std::string withoutMark(std::string text);

/// The same as it is unpacked, byte by byte.
std::string loadUnpacked(const std::string& path, std::size_t maxBytes = 0);

/// The first bytes of a file, unpacked; fewer if it has no more.
std::string unpackedBegin(const std::string& path, std::size_t count);

/// The same as it lies on the disk, which may be nothing. From a file or device without an end no
/// more is read than @a maxBytes and a block.
std::string loadBytes(const std::string& path, std::size_t maxBytes = 0);

} // namespace molsurf
