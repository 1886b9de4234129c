// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The archive of a .vdb file with an identifier of its content.

#include "molsurf/show/io/output_file.h"

#include <functional>
#include <ostream>

namespace molsurf
{

/// Writes an archive of OpenVDB, which gives each a random identifier (UUID); the one that the
/// archive gets is made of all of its other bytes. An archive that goes to a stream is made twice,
/// since its identifier comes first.
///
/// @param[in] write  writes it, header and all, to the stream that it is given
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeArchive(const std::function<void(std::ostream&)>& write, OutputFile& file);

} // namespace molsurf
