// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How each kind of surface is made: of which set it is the boundary, and how far inside of that.

#include "molsurf/kernel.h"
#include "molsurf/kernel/grid/distance_band.h"
#include "molsurf/kernel/levelset/gaussian_sum.h"
#include "molsurf/kernel/topology/gaps.h"

#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// A surface, and what the kernel makes of it.
struct KernelOptions : SurfaceSpec, KernelProducts {
};

/// The range of SurfaceSpec::voxel [Å].
constexpr double minVoxel = 0.05, maxVoxel = 10.0;

/// The largest SurfaceSpec::minThickness [Å]: by half of it the band about the surface is wider.
constexpr double maxThickness = 100.0;

/// Half width of the grid `surface` [voxel].
constexpr double surfaceWidthVox = 3.0;

/// How far from S = 0 the spline needs samples [voxel]: the corners of the 4^3 coefficients about a
/// point are up to 2 sqrt(3) = 3.46 away. (Three take 1.5 % less time; then a stored spline gives
/// vertices that differ by 1e-8, and curvatures at vertices move by 0.003 /Å.)
constexpr double splineWidthVox = 3.5;

/// A kind of surface.
struct KindRow {
    SurfaceKind kind;
    const char* word;  ///< of the command line
    const char* title; ///< what the word means; "" if it says it
    bool isUnion;      ///< whether it is that of a union of balls, or of a sum of Gaussians
    bool hasFlow;      ///< whether its level set moves to rest
    bool hasProbe;     ///< whether its balls are grown by the probe
    bool hasOffset;    ///< whether it lies inside of theirs by the probe radius
};

/// All of them, in the order of help texts.
const std::vector<KindRow>& kindTable();

/// The row of a kind.
const KindRow& rowOf(SurfaceKind kind);

/// Tells whether a surface is the level set of a sum of Gaussians as it is.
inline bool isGaussian(const KindRow& row)
{
    return !row.isUnion && !row.hasFlow;
}

/// Tells whether a surface is that of a union of balls.
inline bool isUnion(SurfaceKind kind)
{
    return rowOf(kind).isUnion;
}

/// Tells whether a surface is at rest after a flow.
inline bool hasFlow(SurfaceKind kind)
{
    return rowOf(kind).hasFlow;
}

/// Tells whether a surface is that of a union of balls of the atoms' own radii.
inline bool isBare(SurfaceKind kind)
{
    return rowOf(kind).isUnion && !rowOf(kind).hasProbe;
}

/// A hint on a word that names no kind: the nearest one, or what another program's word is here.
/// @return " [hint: did you mean ses?]", or empty
std::string kindMeant(const std::string& word);

/// Gives how far the surface lies inside the set whose distance is known [Å], >= 0.
double offsetOf(const SurfaceSpec& spec);

/// Tells whether area, volume and pieces of a surface are known in closed form.
bool isClosedForm(const SurfaceSpec& spec);

/// Tells whether a surface is the boundary of a union of balls itself, and not one inside of it.
bool isBoundary(const SurfaceSpec& spec);

/// Tells whether psi decides which thin walls of a surface are closed: where it decides gaps, and
/// voxels hold what it decides.
bool decidesWalls(const SurfaceSpec& spec);

/// How the gaps of a surface are decided; none: by its voxels and fronts.
std::optional<GapRule> gapRuleOf(const SurfaceSpec& spec);

/// The options of the flow of a surface, with what it takes from those of the surface.
EvolveOptions flowOptions(const SurfaceSpec& spec);

/// Tells whether a surface is at rest in closed form, without a step.
bool restsInClosedForm(const SurfaceSpec& spec);

/// Width of the band that psi is computed in, on each side of psi = 0 [voxel].
int psiBandVox(const SurfaceSpec& spec);

/// Gives the half width of the band of S that the spline is fitted on [Å].
double splineWidthOf(const SurfaceSpec& spec);

/// Gives how far from the surface of its set the distance is computed.
BandWidths widthsOf(const SurfaceSpec& spec);

/// Gives how much larger than the atoms' balls are those whose cells own the points of a surface
/// [Å]: the probe radius where it is the surface of their union or lies inside of it, or where it
/// is so far from the atoms; else 0.
double growthOf(const SurfaceSpec& spec);

/// Gives balls grown by growthOf().
std::vector<Ball> asMeshed(std::vector<Ball> balls, const SurfaceSpec& spec);

/// Says that the voxels show nothing of a surface, and what would.
/// @param[in] stage  that found it
[[noreturn]] void failNothingLeft(const char* stage, SurfaceKind kind);

/// Whether voxels are so large that a surface of balls may not come out whole on them.
bool maybeTooCoarse(const std::vector<Ball>& balls, const SurfaceSpec& spec);

/// Does nothing if the largest ball is as large as a voxel.
/// @param[in] what  is wrong with the surface
/// @throws Error(ErrorKind::Numeric) with that and a voxel that is small enough
void failIfTooCoarse(const std::string& what, const std::vector<Ball>& balls,
                     const SurfaceSpec& spec);

/// The surface of another kind, else the same.
SurfaceSpec ofKind(SurfaceSpec spec, SurfaceKind kind);

/// The surface on voxels of another edge [Å].
SurfaceSpec withVoxel(SurfaceSpec spec, double voxel);

/// Nothing but the level set, the mesh and their measures.
KernelProducts measuresAlone();

/// Gives the parameters of the sum of Gaussians.
GaussianOptions gaussianOptions(const SurfaceSpec& spec);

} // namespace molsurf
