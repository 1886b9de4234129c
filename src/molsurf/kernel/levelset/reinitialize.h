// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Keeps a level set a signed distance while its interface moves: Hamilton-Jacobi iterations by
/// leaf block.

#include "molsurf/kernel/grid/sparse_field.h"
#include "molsurf/progress.h"

#include <cstddef>
#include <functional>

namespace molsurf
{

/// Deviations that reinitialize() repairs beside the interface.
enum class Repair {
    All,   ///< every deviation from a distance
    Errors ///< deviations beyond the error of the stencils: a field at rest then stays as it is
};

/// Sees a leaf that the interface crosses, once its voxels next to the interface have their last
/// values. It is called from several threads.
/// @param[in] leaf       its number
/// @param[in] before     what scratch had in it
/// @param[in] after      the level set now
/// @param[in] interface  the voxels with a face neighbour of the other sign
using InterfaceWatch = std::function<void(std::size_t leaf, const float* before, const float* after,
                                          const LeafMask& interface)>;

/// How reinitialize() goes about it.
struct Reinitialization {
    double width = 0.0; ///< half width of the band [Å]
    int iterations = 1; ///< number of Euler steps
    Repair repair = Repair::All;
    InterfaceWatch watch{}; ///< none, or sees each leaf with interface
};

/// Iterates phi_t + sign(phi) (|grad phi| - 1) = 0 on the active voxels, by explicit Euler steps of
/// half a voxel with second-order ENO differences and Godunov's flux (Sussman, Smereka and Osher, A
/// level set approach for computing solutions to incompressible two-phase flow, J. Comput. Phys.
/// 114:146-159, 1994; Osher and Fedkiw, Level Set Methods and Dynamic Implicit Surfaces, chapters 6
/// and 7).
///
/// Voxels with a face neighbour of the other sign are not iterated but set, from the field as it
/// was given, to the distance of the zero of its second-order Taylor polynomial along the gradient.
/// That scales both ends of an edge alike, so the interface stays in place (a moved interface is
/// what plagues the plain iteration: Russo and Smereka, A remark on computing distance functions,
/// J. Comput. Phys. 163:51-67, 2000). One iteration carries the distance half a voxel outward.
///
/// @param[in,out] phi      level set [Å], iterated at its active voxels; afterwards within
///                         [-width, width]
/// @param         scratch  storage, to be kept from call to call; made to fit if it does not
void reinitialize(SparseField& phi, const Reinitialization& options, const Progress& progress,
                  LeafField& scratch);

/// As above, of every deviation, with storage of its own.
void reinitialize(SparseField& phi, double width, int iterations, const Progress& progress);

} // namespace molsurf
