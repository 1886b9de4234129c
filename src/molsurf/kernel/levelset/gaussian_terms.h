// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The terms of a sum of Gaussians in one leaf: which balls have one, between which bounds their
/// sum lies, and its logarithm psi at each voxel. Lengths are in voxels if not said otherwise.

#include "molsurf/kernel/grid/leaf_table.h"

#include <cstdint>
#include <vector>

namespace molsurf
{

/// The lowest psi that matters: at a distance of D outside, psi = -2 ln 2 D/eps - ...; the band of
/// a surface ends long before.
constexpr float lowestPsi = -60.0f;

/// A term that stays e^-12 = 6e-6 of the largest one moves psi = 0 by less than 1e-5 eps.
constexpr float negligible = 12.0f;

/// The Gaussians of balls, a list for each number, padded so that eight can be read at any place.
struct GaussianLists {
    std::vector<double> x, y, z; ///< centres [Å]
    std::vector<float> decay;    ///< C h^2
    std::vector<float> level;    ///< exponent at the centre
    std::vector<float> rim;      ///< a term counts this far from the centre and the reach farther,
    std::vector<float> felt2;    ///< or where the square of the distance is below this
    std::vector<float> felt;     ///< the root of that [Å]

    void resize(std::size_t balls);
};

/// A leaf, as seen from balls.
struct GaussianLeaf {
    /// @param[in] reach  how far outside the rims of balls their terms count
    GaussianLeaf(const openvdb::Coord& origin, double voxelSize, double reach);

    openvdb::Vec3d low; ///< the place of its first voxel [Å]
    double inverse;     ///< 1/h [1/Å]
    float reach;
};

/// The terms that count somewhere in a leaf. Voxels have the coordinates 0 to 7 in it.
struct GaussianTerms {
    std::size_t count = 0;
    std::vector<float> x, y, z, decay, level; ///< padded by terms of exponent `noExponent`

    static constexpr float noExponent = -1e30f;
};

/// Adds the terms of a run of balls.
void addTerms(const GaussianLists& balls, std::int32_t begin, std::int32_t end,
              const GaussianLeaf& leaf, GaussianTerms& terms);

/// Bounds of the terms in a leaf, and in its octants of 4^3 voxels: the octant of voxel (x, y, z)
/// is 4 (x / 4) + 2 (y / 4) + z / 4.
struct GaussianBounds {
    float top;                ///< the largest exponent in the leaf
    float floor[8];           ///< the smallest psi that one term alone gives in each octant
    std::vector<float> upper; ///< largest exponents, [terms / 8][octant][8 terms]

    /// psi is at least this and at most that in the whole leaf.
    float least() const;
    float most(std::size_t terms) const;
};
void boundTerms(GaussianTerms& terms, GaussianBounds& bounds);

/// Memory of sumTerms(), for leaf after leaf.
struct GaussianTables {
    std::vector<float> exponentials; ///< 8 along each axis, for each term that counts
    std::vector<std::int32_t> list;  ///< for each octant the terms that count there
    std::size_t counts[8];           ///< their numbers
};

/// psi = ln sum exp at all voxels of a leaf, no lower than the lowest that matters.
///
/// In each octant the terms are left out that are negligible throughout it.
/// @param[out] psi  512 values; always finite
void sumTerms(const GaussianTerms& terms, const GaussianBounds& bounds, GaussianTables& tables,
              float* psi);

/// psi at a point, and its gradient.
struct PsiSample {
    float psi;
    float x, y, z; ///< its gradient [1/voxel]
};

/// psi between voxels, of the terms alone and not of voxels: exact.
/// @param[in] x,y,z    of the point, from the leaf's first voxel
/// @param     scratch  memory, for point after point
PsiSample sampleTerms(const GaussianTerms& terms, float x, float y, float z,
                      std::vector<float>& scratch);

} // namespace molsurf
