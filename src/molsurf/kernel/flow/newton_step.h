// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A semi-implicit step of the flow: a Newton step for the displacement of the whole interface.
/// docs/math.md, section 4.

#include "molsurf/kernel/core/simd.h"
#include "molsurf/kernel/flow/front.h"
#include "molsurf/kernel/flow/narrow_band.h"
#include "molsurf/kernel/grid/region.h"
#include "molsurf/progress.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace molsurf
{

/// Half width of the band that the displacement is solved in [voxel]: farther out the curvature of
/// phi is noise, which a Newton step would answer in full.
constexpr double newtonWidthVox = 1.5;

/// Of the step before, at the voxels of a leaf: its sign, and the share of it that was made in
/// 1/127; 0: there was none.
struct StepHistory {
    static constexpr float whole = 127.0f;
    alignas(64) std::int8_t share[leafSize] = {};
};

/// The step before of fronts, at the voxels of a leaf [Å]; 0: there was none.
struct FrontHistory {
    alignas(64) float u[leafSize] = {};    ///< the displacement that was solved for
    alignas(64) float step[leafSize] = {}; ///< the step that was made of it
};

/// The longest step [voxel], and by how much steps of fronts are extended at most: where u is
/// short, and where it is long.
constexpr float longestStep = 0.8f, extension = 3.0f, longExtension = 5.0f;

/// How much shorter a step becomes where displacements alternate, how fast it becomes whole again
/// where they do not, and the least share that is made.
constexpr float shorter = 0.5f, longer = 1.2f, leastShare = 0.1f;

/// The share of a step that is made. Where u has another sign than the step before, which went too
/// far, it is halved, and it grows from step to step where it has the same: so what goes to and fro
/// in a gap comes to rest.
/// @param[in] last  share of the step before, with that step's sign; 0: there was none
MOLSURF_INLINE float shareOfStep(float u, float last)
{
    const float size = std::abs(last);
    const float next =
        last * u < 0.0f ? larger(shorter * size, leastShare) : smaller(longer * size, 1.0f);
    return last == 0.0f ? 1.0f : next;
}

/// The step of a front with the displacement u [Å]: u itself, but where it falls by the same factor
/// in two steps, the way that is left. If u falls by theta times the step, that is u/theta.
/// @param[in] lastU, lastStep  of the step before; 0: there was none
/// @param[in] h                edge of a voxel [Å]
MOLSURF_INLINE float extendedStep(float u, float lastU, float lastStep, float h)
{
    constexpr float from = 0.01f, longFrom = 0.03f; // fully at twice that [voxel]
    const float length = std::abs(u) / h;
    const float far = clamped(length / longFrom - 1.0f, 0.0f, 1.0f);
    const float most = extension + (longExtension - extension) * far;
    const float theta =
        clamped(lastStep * (lastU - u) / (lastStep * lastStep + 1e-12f), 1.0f / most, 1.0f);
    const float trust = clamped(length / from - 1.0f, 0.0f, 1.0f);
    return lastStep * u > 0.0f ? u * (1.0f + trust * (1.0f / theta - 1.0f)) : u;
}

/// How Newton steps are made.
struct NewtonOptions {
    Weights weights;
    int sweeps = 1;        ///< for each step, >= 1
    bool extended = false; ///< whether steps are extended, since fronts move far
    int splineLevel = 0;   ///< curvatures come from a spline on voxels of edge 2^level h; 0: from
                           ///< differences

    /// Iterations of reinitialize() after each step: extended ones spoil the distance more.
    int repairs() const { return extended ? 2 : 1; }
};

/// Semi-implicit steps, one after another. The displacement u along the inward normal solves
///
///     (P - w Laplace) u = F,
///
/// P the stiffness of the metric's valley, in the voxels next to the interface with no flux through
/// the rim, by a fixed number of Chebyshev-accelerated Jacobi sweeps. All of the band then moves by
/// u at its feet; by less where u alternates, and by more in fronts.
class NewtonSteps
{
public:
    explicit NewtonSteps(const NewtonOptions& options) : options_(options) {}

    /// Makes a step.
    /// @param[in]  region  whose own voxels are summed
    /// @param[out] before  phi before the step
    /// @return sums before the step
    InterfaceSums step(NarrowBand& band, const Region& region, LeafField& before,
                       const Progress& progress);

    /// The sums of a band, without a step.
    InterfaceSums sums(const NarrowBand& band, const Region& region, const Progress& progress);

    /// The leaves of the last step.
    const LeafTable& table() const { return known_; }

private:
    /// The displacement u, to a relative 0.002 (bfloat16); `outside` where it is not solved for.
    using Displacement = LeafArray<std::uint16_t>;

    /// The equations of a step. They live while it is solved.
    struct System {
        LeafArray<std::uint32_t> coefficients; ///< b and c in a word
        Displacement u;                        ///< a first solution; then that of the sweeps
        std::vector<LeafMask> acting;          ///< the voxels that it is solved in

        explicit System(std::size_t leaves) : coefficients(leaves), u(leaves), acting(leaves) {}
    };

    void fit(const LeafTable& table, const Progress& progress);
    InterfaceSums assemble(const NarrowBand& band, const Region& region, System& system,
                           const Progress& progress) const;
    void sweep(const LeafTable& table, System& system, const Progress& progress) const;
    void choose(std::size_t n, float h, const float* u, float* step);

    NewtonOptions options_;
    LeafTable known_;                                   // the leaves of the step before,
    std::vector<std::unique_ptr<StepHistory>> history_; // and its steps where one is long
    std::vector<std::unique_ptr<FrontHistory>> fronts_; // of extended ones alone
};

} // namespace molsurf
