// SPDX-License-Identifier: MPL-2.0
#include "molsurf/request/drawn_request.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/show/picture/view.h"
#include "molsurf/show/picture/view_file.h"

#include <utility>

namespace molsurf
{

using namespace holds;

bool isCrisp(const Request& request, const Output& output)
{
    return output.holds(ColorChoices) || (request.sharpColors && !output.holds(Pixels));
}

namespace
{

/// Balls as motions repeat them, in the colours of those that they are made of.
BallSet repeated(const BallSet& atoms, ColorBy color, const WholeBalls& whole)
{
    BallSet colored = atoms;
    if (color != ColorBy::Nothing && colored.colors.empty())
        colored.colors = ballColors(atoms, color, Progress());
    return subset(colored, whole.sources);
}

} // namespace

ShownMeshes shownMeshes(const Request& request, const SurfaceOptions& options, const BallSet& atoms,
                        const Mesh& mesh, const std::shared_ptr<const WholeBalls>& whole,
                        const Progress& progress)
{
    ShownMeshes shown;
    shown.whole = whole;
    const auto shows = [&](auto&& what) {
        return std::any_of(request.outputs.begin(), request.outputs.end(), what);
    };
    const bool cut = shows([&](const Output& output) { return isCrisp(request, output); });
    if (!cut && !shows([](const Output& output) { return output.holds(Pixels); })) return shown;
    const BallSet colored = whole ? repeated(atoms, options.color, *whole) : BallSet();
    const BallSet& all = whole ? colored : atoms;
    const std::vector<Ball> balls = whole ? whole->balls : movedBalls(atoms, request.origin());
    shown.borders = bordersOf(options.color, all, asMeshed(balls, options), mesh, progress);
    if (cut && shown.borders) shown.crisp = crispMesh(mesh, *shown.borders, all, options, progress);
    return shown;
}

DrawnSurface drawnSurface(const Request& request, const BallSet& atoms, const Mesh& mesh,
                          const ShownMeshes& shown, double turn, bool quick)
{
    DrawnSurface drawn{atoms, mesh, request.options, request.picture, shown.whole.get()};
    drawn.origin = request.origin();
    drawn.colorsCopies = request.colorsCopies();
    drawn.borders = shown.borders;
    drawn.legend = shown.legend;
    drawn.look.turn += turn;
    drawn.look.quick = quick;
    return drawn;
}

DrawnSurface drawnPanel(const Request& request, const PanelSurface& panel, const Mesh& mesh)
{
    DrawnSurface drawn{panel.atoms, mesh, panel.options, panel.picture, panel.shown.whole.get()};
    drawn.origin = request.origin();
    drawn.colorsCopies = request.colorsCopies();
    drawn.borders = panel.shown.borders;
    drawn.legend = panel.shown.legend;
    drawn.name = panel.name;
    return drawn;
}

std::vector<DrawnSurface> drawnPanels(const Request& request, const DrawnSurface& first)
{
    std::vector<DrawnSurface> all = {first};
    if (request.panels.empty() || !request.panelSurfaces) return all;
    all[0].name = request.firstName;
    auto made = request.panelSurfaces->begin();
    for (const Panel& panel : request.panels) {
        if (!panel.hasSurface()) {
            all.push_back(all[0]);
            all.back().ownEye = true;
            lookFrom(panel.toEye, all.back().look);
            continue;
        }
        all.push_back(drawnPanel(request, *made, made->mesh));
        all.back().look.turn = first.look.turn;
        all.back().look.quick = first.look.quick;
        ++made;
    }
    return all;
}

std::string clipWarning(const DrawnSurface& surface, const Progress& progress)
{
    if (!surface.look.clip) return "";
    const DrawOptions options = pictureOf(surface, progress);
    const double low = chooseView(surface.mesh, options).low;
    if (*options.clip > low) return "";
    return formatted("`clip` %g: it cuts all of the surface away, expected more than %.1f",
                     *options.clip, low);
}

} // namespace molsurf
