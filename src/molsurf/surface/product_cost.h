// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What products take, estimated before they are made. bench/estimates.py compares the estimates
/// with runs.

#include "molsurf/atoms.h"
#include "molsurf/options.h"

namespace molsurf
{

/// Time and memory on top of those of a surface.
struct Cost {
    double seconds = 0.0; ///< on one core
    double bytes = 0.0;   ///< beside a level set and its mesh
};

/// How large a surface is that products are made of.
struct SurfaceSize {
    double balls = 0.0;
    double area = 0.0;   ///< [Å^2]
    double voxels = 0.0; ///< active ones of the grid `surface`; 0: there is none
};

/// The size of a surface, from a sample of points on its balls.
SurfaceSize sizeOf(const BallSet& atoms, const SurfaceOptions& options);

/// No surface of these balls is larger. It takes no time to speak of.
/// @param[in] voxels  that its grid has at most
SurfaceSize mostOf(const BallSet& atoms, const SurfaceOptions& options, double voxels);

/// Memory of the process [byte].
extern const double processBytes;

/// Memory that a level set and its mesh keep while products are made [byte].
double keptBytes(const SurfaceSize& size);

// Of products, each by its own lengths.
Cost costOfPockets(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size);
Cost costOfPatches(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size);
Cost costOfSmoothing(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size);
Cost costOfPore(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size);
Cost costOfTunnels(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size);
Cost costOfInterfaces(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size);
Cost costOfAreas(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size);
Cost costOfContacts(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size);
Cost costOfDepths(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size);
Cost costOfMeasures(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size);
Cost costOfWall(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size);
Cost costOfCurvature(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size);
Cost costOfMatch(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size);
Cost costOfRemesh(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size);

/// The sum of the times of all that is asked for, rows of fieldTable() among it, and the largest
/// of their memories.
Cost costOfProducts(const BallSet& atoms, const SurfaceOptions& options, const SurfaceSize& size);

} // namespace molsurf
