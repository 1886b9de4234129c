// SPDX-License-Identifier: MPL-2.0
/// @file
/// What the library of the programs leaves to each of them, for the wheel's module, which shares
/// that library.
#include "program.h"

namespace molsurf
{

const char* const tool::programName = "vdb_molsurf";
const char* const tool::noMemoryText = "error: not enough memory";

} // namespace molsurf
