// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Every option of a request, a row each.

#include "molsurf/request/request.h"

#include <vector>

namespace molsurf
{

/// The rows of settingTable(), fileSettings() and pictureSettings().
const std::vector<OptionRow<Request>>& requestTable();

} // namespace molsurf
