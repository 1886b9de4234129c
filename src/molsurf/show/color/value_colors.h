// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Colours by the values of balls.

#include "molsurf/atoms.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/mesh.h"
#include "molsurf/options.h"
#include "molsurf/show/color/color_map.h"
#include "molsurf/show/color/label.h"

#include <limits>
#include <vector>

namespace molsurf
{

/// The colours of values.
ColorScale scaleOf(const BallValues& values);

/// Whether a point has the value of one ball: it was asked for, or the colours have steps.
bool isFlat(const BallValues& values);

/// Whether colours show values of points that nearby balls may share.
bool isBlended(const BallSet& atoms, ColorBy by);

/// The colour of every ball: noValueColor without a value, neutral if the scale has no range.
std::vector<Color> valueColors(const BallValues& values);

/// The value of a point, and how much of it there is.
struct PointValue {
    float value = 0.0f; ///< the mean of what there is; not a number, if share is 0
    float share = 0.0f; ///< of the weights that balls with a value have, in [0, 1]

    /// The value, where at least half of the weights have one; else not a number.
    float known() const { return share < 0.5f ? std::numeric_limits<float>::quiet_NaN() : value; }
};

/// The values of points of a surface: its distance from the centre, that of the map, or a mean over
/// the balls near it, with the weights exp(-e/s). Here e is how far the power distance
/// |x - c|^2 - r^2 of a ball is above the least one, and s is 3 Å^2: between balls that are a bond
/// apart the value goes from one to the other within some 2 Å, smoothly.
///
/// Safe to use from all threads. Balls and values must live as long.
class PointValues
{
public:
    /// @param[in] values   of the balls
    /// @param[in] outward  how far outside of the surface a potential is taken [Å]
    PointValues(const std::vector<Ball>& balls, const BallValues& values, double outward);

    /// Those that colours show.
    PointValues(const BallSet& atoms, double outward)
        : PointValues(atoms.balls, *atoms.labels->values, outward)
    {
    }

    /// @param[in] normal  of the surface there, outward
    /// @param[in] reach   no point that has a value is farther than this from its ball [Å]
    PointValue at(const openvdb::Vec3d& x, const openvdb::Vec3d& normal, double reach) const;

    /// The values of some voxels of a level set's band or inside, in the order of their tree.
    std::vector<PointValue> on(const openvdb::BoolGrid& voxels, const openvdb::FloatGrid& surface,
                               double reach, const Progress& progress) const;

    /// The colour of such a value, mixed with noValueColor by the weights that have none.
    Color colorOf(const PointValue& value) const;

private:
    PointValue blended(const openvdb::Vec3d& x, double reach) const;

    const BallValues& values_;
    BallIndex index_;
    ColorScale scale_;
    double smallest_; ///< radius of a ball [Å]
    double outward_;  ///< [Å]
};

/// The values of the vertices of a mesh: of the ball of each, where they are flat.
/// @param[in] points   made of the same values
/// @param[in] nearest  ball of each vertex
/// @param[in] reach    as above
std::vector<PointValue> vertexValues(const PointValues& points, const BallValues& values,
                                     const Labels& nearest, double reach, const Progress& progress,
                                     const Mesh& mesh);

/// Adds the values of vertices to their mesh as a scalar, which is not a number where less than
/// half of the weights have one, and colours them by it unless they are flat.
/// @param[in] points  made of the same values
void addValues(const BallValues& values, const PointValues& points,
               const std::vector<PointValue>& ofVertices, Mesh& mesh);

/// Gives how far outside of the surface a potential is taken [Å]: where the coloring does not say
/// it, a probe radius, if the surface is not that far from the atoms itself.
double outwardOf(const Coloring& coloring, const SurfaceSpec& spec);

} // namespace molsurf
