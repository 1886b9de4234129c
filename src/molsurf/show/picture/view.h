// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The frame of a picture.

#include "molsurf/show/picture/draw_mesh.h"

namespace molsurf
{

/// The frame of a picture: unit vectors, right-handed.
struct View {
    openvdb::Vec3d center, right, up, toEye;
    double pixel = 0.0;        ///< edge [Å]
    double low = 0.0, far = 0; ///< of the mesh and atoms along toEye, from the center [Å]
    int width = 0, height = 0; ///< [pixel]

    /// A point of the plane through the center, from the upper left corner [pixel].
    openvdb::Vec3d at(double x, double y) const
    {
        return center + (x - 0.5 * width) * pixel * right + (0.5 * height - y) * pixel * up;
    }
};

/// The frame that shows all of a mesh, or of its copies, with atoms and the places of notes.
View chooseView(const Mesh& mesh, const DrawOptions& options);

/// Where the near part of a mesh is cut away so that DrawOptions::zoom is seen: through its middle.
/// @return as DrawOptions::clip [Å]; none: nothing hides it, or the options say what is cut
std::optional<double> clipBefore(const Mesh& mesh, const View& view, const DrawOptions& options);

/// Keeps one view for pictures of things that move: directions and size are in the options then.
/// @param[in] count   how many sets of points there are, > 0
/// @param[in] setOf   gives set i; the view is that of the first, and all are in the frame
/// @param[in] margin  about the points [Å]
void keepView(std::size_t count,
              const std::function<std::vector<openvdb::Vec3d>(std::size_t i)>& setOf, double margin,
              DrawOptions& options);

} // namespace molsurf
