// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A semi-implicit step of the flow: a Newton step for the displacement of the whole interface.
/// docs/math.md, section 4.

#include "molsurf/core/simd.h"
#include "molsurf/flow/displacement.h"
#include "molsurf/flow/front.h"
#include "molsurf/flow/narrow_band.h"
#include "molsurf/grid/region.h"
#include "molsurf/progress.h"

#include <cmath>
#include <memory>
#include <vector>

namespace molsurf
{

/// Half width of the band that the displacement is solved in [voxel]: farther out the curvature of
/// phi is noise, which a Newton step would answer in full.
constexpr double newtonWidthVox = 1.5;

/// The displacements of the step before at the voxels of a leaf [Å].
struct StepHistory {
    alignas(64) float u[leafSize] = {};    ///< that it solved for
    alignas(64) float step[leafSize] = {}; ///< that it made
};

/// The longest step [voxel], and by how much steps are extended at most: where u is short, and
/// where it is long.
constexpr float longestStep = 0.8f, extension = 3.0f, longExtension = 5.0f;

/// The step that is made of a displacement u [Å]: u itself, but where it falls by the same factor
/// in two steps, the way that is left. If u falls by theta times the step, that is u/theta.
/// @param[in] lastU, lastStep  of the step before; 0: there was none
/// @param[in] h                edge of a voxel [Å]
/// @param[in] from             steps are extended above this, fully at twice that [voxel]
/// @param[in] longFrom         the same of the larger factor
MOLSURF_INLINE float extendedStep(float u, float lastU, float lastStep, float h, float from,
                                  float longFrom)
{
    const float length = std::abs(u) / h;
    const float far = clamped(length / longFrom - 1.0f, 0.0f, 1.0f);
    const float most = extension + (longExtension - extension) * far;
    const float theta =
        clamped(lastStep * (lastU - u) / (lastStep * lastStep + 1e-12f), 1.0f / most, 1.0f);
    const float trust = clamped(length / from - 1.0f, 0.0f, 1.0f);
    const float factor = lastStep * u > 0.0f ? 1.0f + trust * (1.0f / theta - 1.0f) : 1.0f;
    return clamped(factor * u, -longestStep * h, longestStep * h);
}

/// How Newton steps are made.
struct NewtonOptions {
    Weights weights;
    int sweeps = 1;      ///< for each step, >= 1
    bool eager = false;  ///< whether shorter steps are extended, too
    int splineLevel = 0; ///< curvatures come from a spline on voxels of edge 2^level h; 0: from
                         ///< differences
};

/// Semi-implicit steps, one after another. The displacement u along the inward normal solves
///
///     (P - w Laplace) u = F,
///
/// P the stiffness of the metric's valley, in the voxels next to the interface with no flux through
/// the rim, by a fixed number of Chebyshev-accelerated Jacobi sweeps. All of the band then moves by
/// u at its feet; where u falls by the same factor in two steps, by what that would add up to.
class NewtonSteps
{
public:
    explicit NewtonSteps(const NewtonOptions& options) : options_(options) {}

    /// Makes a step.
    /// @param[in]     region  whose own voxels are summed
    /// @param[out]    next    phi after the step, as many leaves as phi
    /// @param[in,out] moves   the displacements are added
    /// @return sums before the step
    InterfaceSums step(const NarrowBand& band, const Region& region, LeafField& next,
                       Displacements& moves, const Progress& progress);

    /// The sums of a band, without a step.
    InterfaceSums sums(const NarrowBand& band, const Region& region, const Progress& progress);

    /// The largest displacements of the interface in the leaves of table(), in the last step
    /// [voxel].
    const std::vector<float>& largest() const { return largest_; }
    const LeafTable& table() const { return known_; }

private:
    void fit(const LeafTable& table, const Progress& progress);
    void sweep(const LeafTable& table, LeafField& scratch, const Progress& progress);

    NewtonOptions options_;
    std::vector<float> largest_;
    LeafArray<std::uint32_t> system_;                   // its coefficients, two in a word
    LeafField u_;                                       // its solution
    std::vector<LeafMask> acting_;                      // the voxels that it is solved in
    bool made_ = false;                                 // whether there was a step before:
    LeafTable known_;                                   // its leaves,
    std::vector<LeafMask> down_;                        // where its u was below 0,
    std::vector<std::unique_ptr<StepHistory>> history_; // and more where u was long
};

} // namespace molsurf
