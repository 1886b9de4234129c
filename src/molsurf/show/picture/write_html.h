// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A page that shows a mesh: one file that needs nothing else.

#include "molsurf/atoms.h"
#include "molsurf/kernel/mesh/mesh_instance.h"
#include "molsurf/mesh.h"
#include "molsurf/show/color/legend.h"
#include "molsurf/show/io/output_file.h"
#include "molsurf/show/picture/atom_model.h"
#include "molsurf/show/picture/draw_mesh.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// The content of the page besides the mesh.
struct HtmlPage {
    std::string title;
    std::string name{};            ///< of the surface among the layers of a page
    std::string about{};           ///< what the surface is
    std::vector<Legend> legends{}; ///< the colours to choose from, the first one first
    Color plain = {140, 181, 222}; ///< of the mesh without them
    std::array<openvdb::Vec3d, 3> axes =
        { ///< directions to the right, up and toward the eye at first
            openvdb::Vec3d(1, 0, 0), openvdb::Vec3d(0, 1, 0), openvdb::Vec3d(0, 0, 1)};
    std::optional<PictureFrame> zoom{}; ///< shown at first; none: all
    /// The copies of parts that are shown in the place of the mesh, and their colours to choose;
    /// empty: the mesh.
    std::vector<MeshInstance> instances{};
    bool copiesFirst = false; ///< whether the colours of copies come before the legends
    /// With copies: the same parts at larger voxels, one mesh for each further level of detail.
    std::vector<const Mesh*> coarser{};
    /// The names of balls, and the ball of each vertex; null: the page names no atoms.
    const BallNames* names = nullptr;
    std::vector<std::int32_t> ballOf{};
    /// Balls whose colours are seen where the surface is cut, and these for each legend; empty: the
    /// cut is grey.
    std::vector<Ball> balls{};
    std::vector<std::vector<Color>> cutColors{};
    const Bodies* bodies = nullptr; ///< opaque parts inside; null: none
    double opacity = 1.0;           ///< of the surface at first
    /// Of a further layer: whether it is where the first one is. Else its middle comes to that
    /// one's.
    bool inPlace = false;
};

/// A surface of a page.
struct HtmlLayer {
    const Mesh& mesh;
    HtmlPage page;
};

/// The line on a page's surface: "Surface variational, voxels of 0.5 Å. Areas are of its mesh."
std::string aboutPage(const std::string& kind, double voxel);

/// Finds out before any work is done whether writeHtml() has its viewer.
/// @throws Error(ErrorKind::Output) if it was built without
void needViewer();

/// Lets a page name the atoms of a surface.
/// @param[in] names  of the balls, kept by reference
void nameAtoms(const BallNames& names, const std::vector<Ball>& balls, const Mesh& mesh,
               const Progress& progress, HtmlPage& page);

/// Gives a page the colours of what is cut, as its legends have them.
/// @param[in] balls  those of the atoms, where the mesh is
void colorCut(const BallSet& atoms, std::vector<Ball> balls, const Progress& progress,
              HtmlPage& page);

/// Writes a page of HTML with the mesh in it and a viewer (three.js, WebGL 2).
///
/// The mesh is packed: positions by steps of 1/65535 of its largest extent, values of curvature in
/// 256 steps of their scale, names of chains and groups as numbers; differences from vertex to
/// vertex, compressed by zlib, in base64. Copies have a matrix each; the page shows each by the
/// coarsest level whose triangles are small on the screen, and while it is turned by a coarser one
/// if it has to, which it makes itself. Each vertex knows its atom, so that the page can name what
/// the mouse is over and sum up areas. A legend without an attribute shows Mesh::colors.
///
/// @throws Error(ErrorKind::Output) if there is no viewer or the file cannot be written
void writeHtml(const Mesh& mesh, const HtmlPage& page, OutputFile& file);

/// The same with several surfaces, which the reader sees side by side or one at a time: with the
/// title and the axes of the first one, and its scales of values.
/// @param[in] layers  at least one
void writeHtml(std::vector<HtmlLayer> layers, OutputFile& file);

} // namespace molsurf
