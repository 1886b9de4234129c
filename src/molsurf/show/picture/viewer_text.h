// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The files of viewer/, as text; made by the build. Only for write_html.cpp.

namespace molsurf
{

extern const char* const viewerPage;   ///< page.html
extern const char* const viewerScript; ///< viewer.min.js; null if built without it

} // namespace molsurf
