// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A surface as pictures and pages show it: with its copies, its colours and what explains them.

#include "molsurf/atoms.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/options.h"
#include "molsurf/show/color/crisp_borders.h"
#include "molsurf/show/color/legend.h"
#include "molsurf/show/picture/atom_model.h"
#include "molsurf/show/picture/draw_mesh.h"
#include "molsurf/show/picture/write_html.h"
#include "molsurf/surface/picture_settings.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// A surface and how it is looked at. Its references live longer.
struct DrawnSurface {
    const BallSet& atoms;
    const Mesh& mesh;
    const SurfaceOptions& options; ///< that decided its surface and its colours
    DrawOptions look;              ///< without what follows from the surface: see pictureOf()
    /// The balls of the whole, where the mesh is of that and the atoms are a unit or prototypes of
    /// it; null: the mesh is of the atoms.
    const WholeBalls* whole = nullptr;
    openvdb::Vec3d origin{0.0}; ///< the point of the atoms that is 0 in the mesh [Å]
    bool colorsCopies = false;  ///< whether the copies of an assembly have colours of their own
    /// Between the colours of the mesh; null: they have none.
    std::shared_ptr<const ColorOwners> borders{};
    std::optional<Legend> legend{}; ///< of colours that no option names; none: by the options
    std::string name{};             ///< below its panel
    bool ownEye = false;            ///< whether its panel does not look from where the first does
};

/// The balls with a point as their origin, as the mesh has it.
std::vector<Ball> movedBalls(const BallSet& atoms, const openvdb::Vec3d& origin);

/// The mesh with triangles cut where colours meet.
/// @param[in] owners   of the colours, where the mesh is
/// @param[in] options  that decided the surface and its colours
Mesh crispMesh(const Mesh& mesh, const ColorOwners& owners, const BallSet& atoms,
               const SurfaceOptions& options, const Progress& progress);

/// The copies of an assembly as nodes, each in a colour by which it can be told from its
/// neighbours, or in one for all.
/// @param[in] plain  that one, of a mesh without colours
std::vector<MeshInstance> instancesOf(const BallSet& atoms, const Mesh& mesh, bool colored,
                                      const Color& plain, const Progress& progress);

/// The options of its picture, whose automatic view comes from the atoms: it is the same for every
/// voxel.
DrawOptions pictureOf(const DrawnSurface& surface, const Progress& progress);

/// Gives atoms of copies that a surface leaves out its colours: those of atoms, or one for all.
/// @param[in] by  the surface's; of a curvature they are neutral
void colorLikeSurface(const BallSet& surface, ColorBy by, const Color& plain,
                      const Progress& progress, BallSet& others);

/// Looks at the side where the surface lies in the whole that it makes with other atoms, unless the
/// picture has a view.
void faceSurface(const BallSet& surface, const std::vector<BallSet>& others, DrawOptions& picture);

/// Puts atoms into the picture. Chains have the colours of the surface's.
/// @param[in] atoms    of each rule
/// @param[in] bonds    of their file; null: it gives none
/// @param[in] surface  the balls that the surface is of
/// @throws Error(ErrorKind::Input) if there is nothing to show, or more than the memory holds
void showAtoms(const std::vector<ShowRule>& rules, std::vector<BallSet> atoms,
               const std::shared_ptr<const FileBonds>& bonds, const BallSet& surface,
               const Progress& progress, DrawOptions& picture);

/// The legends of some surfaces in one picture, each name once; those of another scale have the
/// name of their surface, too.
std::vector<Legend> legendsOf(const std::vector<DrawnSurface>& surfaces, const Progress& progress);

/// Draws surfaces side by side, all in one scale, with their legends and a scale bar if the
/// settings have these. The view, the width and the background are those of the first.
Picture drawSurfaces(const std::vector<DrawnSurface>& surfaces, const PictureSettings& settings,
                     const Progress& progress);

/// Its page, without layers and coarser meshes; it refers to the names of the atoms.
/// @param[in] about  what the page shows, a line
HtmlPage pageOf(const DrawnSurface& surface, const std::string& title, const std::string& about,
                const Progress& progress);

} // namespace molsurf
