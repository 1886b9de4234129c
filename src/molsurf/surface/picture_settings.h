// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The options of pictures, a row each: the command line and Python's picture() take them.

#include "molsurf/atoms.h"
#include "molsurf/options.h"
#include "molsurf/show/color/crisp_borders.h"
#include "molsurf/show/picture/draw_mesh.h"
#include "molsurf/surface/option_row.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// When legends are drawn; Auto: in pictures that are 600 pixels wide or more.
enum class LegendChoice { Auto, On, Off };

/// Their words: auto, on, off.
const char* nameOf(LegendChoice choice);

/// How a picture is drawn.
struct PictureSettings {
    DrawOptions picture;
    LegendChoice legend = LegendChoice::Auto;
    bool scaleBar = false; ///< a bar of lengths below pictures

    bool drawsLegend() const;
};

/// An option of pictures. Labels and rulers add all of their values; of others the last one counts.
using PictureSetting = OptionRow<PictureSettings>;

/// All of them, in the order of help texts.
const std::vector<PictureSetting>& pictureSettings();

/// The row of a name.
/// @throws Error(ErrorKind::Usage) if there is none
const PictureSetting& pictureSetting(const std::string& name);

/// A direction X,Y,Z, or an axis as x or -z; none: the text is no such.
std::optional<openvdb::Vec3d> directionOf(const std::string& text);

/// A place X,Y,Z within 1e6 Å of the origin; none: the text is no such.
std::optional<openvdb::Vec3d> placeIn(const std::string& text);

/// The parts of "WHERE=TEXT", and of "WHERE..WHERE": one or two, each a place X,Y,Z or a selection,
/// and the text of a label.
struct NoteText {
    std::vector<std::string> places;
    std::string text; ///< "": none
};

/// @throws Error(ErrorKind::Usage) if the text is none, or if it labels a place with nothing
NoteText labelText(const std::string& text);
NoteText rulerText(const std::string& text);

/// Looks from where a word says: auto, a direction or a file.
/// @return whether it is one of these
/// @throws Error(ErrorKind::Usage) if it is a direction of no length
/// @throws Error(ErrorKind::Input) if the file is no view
bool takeView(const std::string& view, DrawOptions& picture);

/// Zooms to places X,Y,Z with semicolons between.
/// @return whether the text is such
bool takeZoom(const std::string& text, DrawOptions& picture);

/// Zooms to places, also where a .view has a frame of its own.
void zoomTo(std::vector<openvdb::Vec3d> places, DrawOptions& picture);

/// Puts the normal of a membrane upright, unless the options have a view.
void setUpright(const BallSet& atoms, DrawOptions& picture);

/// The colours of points inside a surface, where it is cut; null: it has none.
/// @param[in] origin   the point of the atoms that is 0 in the mesh [Å]
/// @param[in] borders  between the colours of the mesh; null: it has none
std::function<Color(const openvdb::Vec3d&)>
insideColors(const SurfaceOptions& options, const BallSet& atoms, const openvdb::Vec3d& origin,
             const std::shared_ptr<const ColorOwners>& borders);

} // namespace molsurf
