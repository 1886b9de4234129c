// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Includes every public header of the library.

#include "molsurf/atoms.h"
#include "molsurf/ball.h"
#include "molsurf/bricks.h"
#include "molsurf/error.h"
#include "molsurf/files.h"
#include "molsurf/mesh.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"
#include "molsurf/settings.h"
#include "molsurf/surface.h"
