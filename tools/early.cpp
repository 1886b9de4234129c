// SPDX-License-Identifier: MPL-2.0
#include "stop.h"

namespace
{
// Of a program, and not of a library: the linker takes it nowhere else.
__attribute__((section(".preinit_array"), used)) void (*const early)() = molsurf::tool::handleEarly;
} // namespace
