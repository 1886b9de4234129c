// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A C2 function on a sparse band: the uniform tensor-product cubic B-spline that interpolates a
/// field at its voxels. Lengths in Å, symbols in docs/math.md, section 5.

#include "molsurf/kernel/grid/leaf_block.h"
#include "molsurf/kernel/grid/sparse_field.h"
#include "molsurf/progress.h"

#include <openvdb/openvdb.h>

namespace molsurf
{

/// Coefficients of a spline: S(x) = sum_k c_k B(x/h - k), B the product of three cubic B-splines.
struct Spline {
    SparseField coefficients; ///< c [Å]; active voxels: where c interpolates

    const LeafTable& table() const { return coefficients.table; }
    double voxelSize() const { return coefficients.voxelSize; } ///< spacing h [Å]
};

/// Solves for the coefficients that interpolate a field on its active voxels.
///
/// Along each axis in turn (1/6, 4/6, 1/6) c = s is solved on every run of active voxels, with c =
/// s at both ends of a run (the natural end condition of Unser, Splines: a perfect fit for signal
/// and image processing, IEEE Signal Processing Magazine 16(6):22-38, 1999). The influence of a
/// value decays by a factor of 2 + sqrt(3) a voxel, so each leaf solves alone, with the 8 voxels on
/// either side: the cut costs 3e-5 of the difference c - s. Interpolation is exact where no end of
/// a run is near; fourth order.
///
/// @param[in] field  s [Å]
/// @return c, with the leaves and active voxels of the field
SparseField prefilter(const SparseField& field, const Progress& progress);

/// Value, gradient and Hessian at one point.
struct Jet {
    double value;            ///< S [Å]
    openvdb::Vec3d gradient; ///< no unit
    openvdb::Mat3d hessian;  ///< [1/Å], symmetric
};

/// Evaluates a spline. Cheap to make; keeps the coefficients of the last leaf at hand, so make one
/// a thread and ask leaf by leaf. The spline must outlive it.
class SplineSampler
{
public:
    explicit SplineSampler(const Spline& spline) : spline_(spline) {}

    /// @param[in] x  [Å, world]
    /// @pre the 4^3 coefficients about x are active; else the result is finite but means nothing
    Jet at(const openvdb::Vec3d& x);

private:
    /// Makes the leaf of a point current.
    /// @param[out] local  the cell of the point, relative to the leaf
    /// @param[out] t      place in the cell, in [0, 1)
    void locate(const openvdb::Vec3d& x, openvdb::Coord& local, openvdb::Vec3d& t);

    const Spline& spline_;
    openvdb::Coord origin_ = openvdb::Coord::max();
    LeafBlock<float, 2> block_;
};

/// Value, gradient and Hessian, in units of voxels, of the spline with the 4^3 coefficients about a
/// cell.
///
/// @param[in] c         coefficient at the cell's lowest corner
/// @param[in] strideX,strideY  of the array that holds it; z is contiguous
/// @param[in] t         place in the cell, in [0, 1]^3
Jet evaluateSpline(const float* c, int strideX, int strideY, const openvdb::Vec3d& t);

/// Moves a point along the gradient onto S = 0 by Newton's method.
///
/// For a distance that is its closest point of the surface; else one near it.
///
/// @param[in]     voxelSize  the unit of tolerance and reach [Å]
/// @param[in]     reach      how far from its start the point may get [voxel]
/// @param[in,out] x          [Å, world]; afterwards the last iterate
/// @param[out]    jet        of S at the last iterate, or the one before
/// @return whether |S| <= 1e-5 voxel at x, and jet is of x; false where the gradient fails (below
///         0.05) or the surface is out of reach
bool moveToSurface(SplineSampler& sampler, double voxelSize, double reach, openvdb::Vec3d& x,
                   Jet& jet);

} // namespace molsurf
