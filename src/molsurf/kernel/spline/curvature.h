// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Curvature of the level set of a function through a point, from the function's first and second
/// derivatives there. Positive where the molecule is convex: 1/R on a ball of radius R, negative on
/// the wall of a cavity. Formulas: docs/math.md, section 5.

#include "molsurf/kernel/spline/spline.h"

#include <string>
#include <vector>

namespace molsurf
{

/// Below this |grad S| a point counts as critical: the level set has no normal there.
constexpr double leastSlope = 1e-3;

/// Mean curvature (k1 + k2)/2 [1/Å].
/// @pre |gradient| > 0
/// @see R. Goldman, Curvature formulas for implicit curves and surfaces, Computer Aided Geometric
///      Design 22(7):632-658, 2005; there with the opposite sign.
double meanCurvature(const Jet& jet);

/// Gaussian curvature k1 k2 [1/Å^2], source as above.
/// @pre |gradient| > 0
double gaussianCurvature(const Jet& jet);

/// The curvatures of a surface at a point; all finite.
struct Curvature {
    double k1 = 0.0; ///< larger principal curvature [1/Å]
    double k2 = 0.0; ///< smaller one [1/Å]; k1 >= k2
    /// Unit vectors along which the surface has these curvatures, perpendicular to each other and
    /// to the normal n, with direction1 x direction2 = n. They are lines: the sign of the pair is
    /// arbitrary. Where k1 = k2 (an umbilic) they are any such pair.
    openvdb::Vec3d direction1 = openvdb::Vec3d(1.0, 0.0, 0.0);
    openvdb::Vec3d direction2 = openvdb::Vec3d(0.0, 1.0, 0.0);

    double mean() const { return 0.5 * (k1 + k2); } ///< [1/Å]
    double gaussian() const { return k1 * k2; }     ///< [1/Å^2]

    /// (2/pi) arctan((k1 + k2)/(k1 - k2)), in [-1, 1]: 1 on a ball (cap), 0.5 on a convex cylinder
    /// (ridge), 0 on a symmetric saddle, -0.5 in a groove (rut), -1 in a spherical hollow (cup).
    /// 0 on a plane, where it is not defined.
    /// @see J. J. Koenderink, A. J. van Doorn, Surface shape and curvature scales, Image and Vision
    ///      Computing 10(8):557-564, 1992; their sign depends on the normal's.
    double shapeIndex() const;

    /// sqrt((k1^2 + k2^2)/2) [1/Å], 0 only on a plane; source as above.
    double curvedness() const;
};

/// The principal curvatures and directions, as eigenvalues and eigenvectors of the shape operator
/// in the tangent plane: a symmetric 2 x 2 problem that always has an answer.
///
/// At a critical point (|gradient| < leastSlope) both curvatures are 0 and the directions any
/// orthonormal pair.
Curvature curvature(const Jet& jet);

/// One number at each point, or a vector as three of them, under the name that files use.
struct CurvatureField {
    const char* name;
    int components; ///< 1, or 3 for a direction
    /// @param[out] out  as many as there are components
    void (*value)(const Curvature& curvature, float* out);
};

/// "mean_curvature", "gaussian_curvature", "principal_curvature_1" (k1), "principal_curvature_2",
/// "shape_index", "curvedness", "principal_direction_1", "principal_direction_2".
const std::vector<CurvatureField>& curvatureFields();

/// The field of a name, or null.
const CurvatureField* findCurvatureField(const std::string& name);

} // namespace molsurf
