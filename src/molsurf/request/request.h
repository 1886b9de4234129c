// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A request for the files of a surface: how it is made, how files show it, and which they are.

#include "molsurf/mesh.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/settings.h"
#include "molsurf/show/color/crisp_borders.h"
#include "molsurf/show/color/legend.h"
#include "molsurf/show/io/file_content.h"
#include "molsurf/show/io/frame_files.h"
#include "molsurf/show/io/output_file.h"
#include "molsurf/show/io/write_apbs.h"
#include "molsurf/show/picture/atom_model.h"
#include "molsurf/surface/file_settings.h"
#include "molsurf/surface/picture_settings.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

class Film;
struct Writing;

/// A format of files. The words of the command line, its help, what a verb writes, what a file
/// cannot show, and the writers come from it.
struct Format {
    const char* word;  ///< how a file's name ends, without the first dot: "ply", "atoms.csv"
    unsigned verbs;    ///< that write it, a set of Verb
    unsigned holds;    ///< of holds::Content
    const char* help;  ///< what a file is, for help texts; of two in turn with the same said once;
                       ///< "": an option that asks for it says it
    const char* table; ///< the table of areas that it has, one of areaTables(); "" if none
    void (*write)(const Writing& what, OutputFile& file); ///< null: a verb does so by itself
    const char* opens = ""; ///< of a Script: the format of the file that it opens
};

/// One file to write.
struct Output {
    std::string path; ///< "-" is standard output
    const Format* format;
    std::string beside{};         ///< of a Stage: the .vdb that it shows, or the .usda of a frame
    std::size_t pocket = 0;       ///< of a Numbered one: which, from 1
    double turn = 0.0;            ///< of a picture of a turntable, beside that of all [degree]
    std::shared_ptr<Film> film{}; ///< of all frames, which gets a picture of each; null: none

    /// Whether it holds one of these.
    bool holds(unsigned some) const { return (format->holds & some) != 0; }
};

/// A further picture beside the first one.
struct Panel {
    std::string file{};                ///< of another structure; empty: it is of the same
    openvdb::Vec3d toEye{0.0};         ///< from there
    std::optional<SurfaceKind> kind{}; ///< or of that kind

    bool hasSurface() const { return !file.empty() || kind; }
};

/// Borders, bodies and levels that files show of a surface besides its mesh.
struct ShownMeshes {
    std::shared_ptr<const ColorOwners> borders{}; ///< between its colours; null: they have none
    std::optional<Mesh> crisp{};                  ///< the mesh, with these borders cut
    std::shared_ptr<const Mesh> bodies{};         ///< of pockets; null: none
    std::shared_ptr<const Bodies> drawnBodies{};  ///< that pages show, with tunnels; null: none
    std::vector<Mesh> coarser{};                  ///< further levels of detail
    std::optional<Legend> legend{}; ///< of colours that no option names; none: by the options
    std::string about{};            ///< what a page shows; empty: kind and voxels of the surface
    /// The balls of the whole, where the mesh is of that and the atoms are a unit or prototypes of
    /// it; null: the mesh is of the atoms.
    std::shared_ptr<const WholeBalls> whole{};
};

/// A further structure or kind with its surface, beside the first one.
struct PanelSurface {
    std::string name;
    BallSet atoms;
    SurfaceOptions options; ///< that decided its surface and its colours
    Mesh mesh;
    ShownMeshes shown;
    DrawOptions picture{}; ///< with the atoms that it shows
    bool inPlace = false;  ///< whether it is of the first structure
    std::string unrest{};  ///< that it is not at rest; empty: it is
};

/// How a surface is made, how files show it, and which files.
struct Request : Settings, PictureSettings, FileSettings {
    bool knowsAtoms = true;      ///< whether the options of atoms and labels are known
    std::string input;           ///< the file of the atoms; empty: not known
    std::string firstName;       ///< of the surface among its panels
    std::vector<Output> outputs; ///< of a batch: extensions in the place of paths
    std::vector<Panel> panels;   ///< of pictures, beside the first one
    /// Of `panels` that have one, once they are made.
    std::shared_ptr<std::vector<PanelSurface>> panelSurfaces;
    std::optional<ApbsGrid> apbsGrid; ///< known when the atoms are
    std::string trajectory;           ///< the file with the frames; empty: models are
    int frame = 0;                    ///< the number of the one that is built; 0: none is
    std::string frameDigest; ///< of all that a frame depends on but its atoms, 16 hexadecimal
                             ///< digits that change with any option; empty: no frame is built
    /// Of the files in the folders of frames.
    std::shared_ptr<FrameOptions> frameOptions = std::make_shared<FrameOptions>();

    /// Whether one of the files holds one of these.
    bool writes(unsigned some) const
    {
        return std::any_of(outputs.begin(), outputs.end(),
                           [=](const Output& output) { return output.holds(some); });
    }

    /// Whether there are files, and each holds one of these.
    bool writesOnly(unsigned some) const
    {
        return !outputs.empty() &&
               std::all_of(outputs.begin(), outputs.end(),
                           [=](const Output& output) { return output.holds(some); });
    }

    /// The point of the atoms that is 0 in meshes [Å].
    openvdb::Vec3d origin() const { return center ? scene.center : openvdb::Vec3d(0.0); }
};

} // namespace molsurf
