// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Pictures of meshes.

#include "molsurf/kernel/mesh/mesh_instance.h"
#include "molsurf/mesh.h"
#include "molsurf/progress.h"
#include "molsurf/show/color/color_map.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace molsurf
{

struct AtomModel;
struct ColorOwners;
struct PictureStyle;

/// Pixels in rows from top to bottom, three bytes (red, green, blue; sRGB) each.
struct Picture {
    int width = 0, height = 0; ///< [pixel]
    std::vector<std::uint8_t> rgb;
    std::vector<std::uint8_t> alpha = {}; ///< one a pixel, 255: opaque; empty: all are
    double pixel = 0.0;                   ///< edge of a pixel [Å]; 0: the picture is not to scale
    double dpi = 0.0;                     ///< pixels an inch of paper; 0: not said
};

/// The part of space that a picture shows.
struct PictureFrame {
    openvdb::Vec3d center; ///< [Å]
    double width, height;  ///< [Å]
};

/// A label of a place, or a ruler between two.
struct PictureNote {
    openvdb::Vec3d from;              ///< [Å]
    std::optional<openvdb::Vec3d> to; ///< the other end of a ruler [Å]
    std::string text;                 ///< of a label
};

/// From where, and how large.
struct DrawOptions {
    int width = 1200; ///< of the picture [pixel], > 0; the height follows the shape
    /// Toward the eye, and what is up; zero: the shortest principal axis toward the eye, the
    /// longest one across the picture.
    openvdb::Vec3d toEye{0.0}, up{0.0};
    openvdb::Vec3d upright{0.0};         ///< what is up whatever the view is; zero: as it says
    std::optional<PictureFrame> frame{}; ///< none: `zoom`, or all of the mesh
    /// Places whose box has 0.8 of the sides of a square frame; what hides them is cut away. Empty:
    /// all of the mesh is shown.
    std::vector<openvdb::Vec3d> zoom{};
    double turn = 0.0;     ///< about `up` [degree]
    bool turnable = false; ///< the scale is the same for every turn, also for 0
    bool quick = false;    ///< as few rays as in wide pictures, for those of a film
    /// Points whose principal axes make the automatic view, so that it is the same for any mesh of
    /// them; empty: the vertices.
    std::vector<openvdb::Vec3d> about{};
    /// The same of each part that `instances` place.
    std::vector<std::vector<openvdb::Vec3d>> aboutParts{};
    Color background = {255, 255, 255};
    bool depthCue = false;               ///< whether distant parts fade to the background
    bool transparent = false;            ///< there is nothing behind the surface
    double dpi = 0.0;                    ///< Picture::dpi
    Color plain = {140, 181, 222};       ///< of a mesh without colours
    const PictureStyle* style = nullptr; ///< null: the first of styleTable()
    std::optional<Color> glass{}; ///< if there is one: with `opacity` only what has this colour is
                                  ///< seen through
    double opacity = 1.0; ///< of a surface seen from the front, in (0, 1]; what is seen aslant is
                          ///< more opaque
    bool showBehind = false;    ///< whether walls behind the nearest one are seen through it, too
    std::optional<double> clip; ///< what is nearer to the eye than the middle by more than this is
                                ///< cut away [Å], and the inside is seen there
    /// Who has which point, for colours that meet along exact lines; else those of vertices.
    std::shared_ptr<const ColorOwners> borders{};
    /// The colour of a point inside, where it is cut; null: `plain`.
    std::function<Color(const openvdb::Vec3d& x)> inside{};
    /// The copies of parts that are shown in the place of the mesh; empty: the mesh.
    std::vector<MeshInstance> instances{};
    /// Atoms that are seen beside the surface, opaque and whole; null: none.
    std::shared_ptr<const AtomModel> model{};
    std::vector<PictureNote> notes{}; ///< on top of all
    int whole = 0;                    ///< width of the picture with what is beside the mesh, which
                                      ///< decides the size of letters [pixel]; 0: `width`
};

/// The directions to the right, up and toward the eye of a picture, as right-handed unit vectors.
/// @param[in] mesh  with at least one vertex; those of copies are left to a few hundred outermost
std::array<openvdb::Vec3d, 3> viewAxes(const Mesh& mesh, const DrawOptions& options);

/// Draws a mesh: orthographic, lit by the sky and a lamp over the eye's left shoulder as far as the
/// surface sees them, with lines where one part stands before another. Rays by Embree.
/// The picture does not depend on the number of threads.
///
/// @param[in] mesh  with normals; one without triangles gives a blank picture
Picture drawMesh(const Mesh& mesh, const DrawOptions& options, const Progress& progress);

} // namespace molsurf
