// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Area, volume and topology of a solvent-excluded surface in closed form.

#include "molsurf/kernel/balls/boundary_measure.h"

#include <vector>

namespace molsurf
{

/// Areas of a solvent-excluded surface by what makes it [Å^2].
struct ExcludedAreas {
    double contact = 0.0; ///< parts of the balls themselves
    double toric = 0.0;   ///< parts that a probe makes which touches two balls
    double concave = 0.0; ///< parts that a probe makes which touches three balls

    double sum() const { return contact + toric + concave; }
};

/// The concave face under a probe that rests on three balls, for excludedGradients().
struct ConcavePull {
    std::int32_t balls[3];   ///< places in BallBoundary::balls
    openvdb::Vec3d position; ///< of the probe [Å]
    openvdb::Vec3d normal;   ///< integrated over its faces, outward [Å^2]
    openvdb::Vec3d edge;     ///< tan(phi/2) n integrated along their creases, phi being the angle
                             ///< between the two normals there [Å]
};

/// The measures of a solvent-excluded surface. It bounds what no probe reaches whose centre is
/// outside of the union of grown balls. Where it pinches off in a cusp two pieces end.
struct ExcludedMeasure {
    /// The closed pieces, in the order of their first patch, as those of a union: outer ones, and
    /// the walls of cavities. (`component` is not used: one part of the union may have several.)
    std::vector<BoundaryPiece> pieces;
    /// Areas under the probes whose centres lie on each of BoundaryMeasure::pieces. (Several of
    /// these may make one of `pieces`, and one of these several.)
    std::vector<ExcludedAreas> areasByCentre;
    double creaseLength = 0.0; ///< of the edges where concave faces meet [Å]
    std::vector<double> areas; ///< the share of each of BallBoundary::balls [Å^2], if asked for
    std::vector<ConcavePull> pulls; ///< of each corner
    /// Whether all faces, edges and vertices fit together. They may not where four and more probes
    /// touch each other in one point to within rounding, as in molecules with many symmetries. Area
    /// and volume are right all the same, but the Euler number of a piece may be wrong by 2.
    bool topologyKnown = true;

    ExcludedAreas totalAreas() const;
};

/// Measures the solvent-excluded surface of balls from the boundary of the balls grown by a probe.
///
/// Contact faces are the patches, drawn in by the probe radius p. An arc of radius rho gives a part
/// of a torus, from one ball to the other. If rho < p, and the plane of the arc lies between the
/// balls, it ends at two points of its axis, and what would be between them is not there. A corner
/// gives the part of the probe there that lies in the cone of its three balls, and nearer to it
/// than to any other corner: a triangle of great circles less caps (Connolly, J. Appl. Cryst.
/// 16:548-558, 1983; Sanner, Olson and Spehner, Biopolymers 38:305-320, 1996; Quan and Stamm,
/// J. Comput. Phys. 322:760-782, 2016).
///
/// A point of a toric or concave face belongs to that of the balls which the probe touches there
/// (to 0.01 Å) for which |x - x_i|^2 - r_i^2 is least. (It hardly differs from the one whose
/// surface is nearest, and is the same for equal radii.)
///
/// @param[in] boundary  of the balls of radius r_i + probe
/// @param[in] measure   of this boundary. Faces and arcs that it leaves out, with -1 for their
///                      piece, are so here
/// @param[in] probe     [Å]
/// @param[in] shares    whether to find the areas of balls, which takes half as long again
/// @return exact but for rounding and the moves of placedBalls()
/// @throws Error(ErrorKind::Check) if the parts do not fit together
ExcludedMeasure measureExcluded(const BallBoundary& boundary, const BoundaryMeasure& measure,
                                double probe, bool shares, const Progress& progress);

/// The area of every ball [Å^2], in the order of the caller's balls.
/// @param[in] count  of those balls
std::vector<double> areasOfBalls(const BallBoundary& boundary, const ExcludedMeasure& measure,
                                 std::size_t count);

} // namespace molsurf
