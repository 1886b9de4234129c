// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The distinct copies of an assembly, once each, and where they are.

#include "molsurf/atoms.h"
#include "molsurf/structure/structure.h"

#include <cstddef>
#include <string>
#include <vector>

namespace molsurf
{

/// The balls of each prototype and the copies of all.
struct InstancedBalls {
    std::vector<Ball> balls;         ///< in the coordinates of the file
    std::vector<std::size_t> begin;  ///< prototype p is balls [begin[p], begin[p + 1])
    std::vector<Instance> instances; ///< in the order of the operators
    std::size_t unused = 0;          ///< balls that no part of the assembly lists
};

/// Finds the prototypes of an assembly: the sets of chains that some operators move together. Most
/// assemblies have one.
///
/// @param[in] copies  which copies
/// @param[in] balls   in the coordinates of the file
/// @throws Error as expandAssembly()
InstancedBalls instanceAssembly(const Structure& structure, const std::string& name,
                                const CopyChoice& copies, const std::vector<Ball>& balls);

} // namespace molsurf
