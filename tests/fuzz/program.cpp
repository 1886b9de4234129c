// SPDX-License-Identifier: MPL-2.0
// What the program's main() defines.
#include "program.h"

namespace molsurf::tool
{

const char* const programName = "fuzz";
const char* const noMemoryText = "error: not enough memory";

} // namespace molsurf::tool
