// SPDX-License-Identifier: MPL-2.0
#include "draw_result.h"

#include "bricks.h"
#include "exit_status.h"
#include "outputs.h"
#include "verbs.h"

#include "molsurf/color/color_table.h"
#include "molsurf/color/palette.h"
#include "molsurf/color/value_colors.h"
#include "molsurf/core/words.h"
#include "molsurf/error.h"
#include "molsurf/picture/atom_model.h"
#include "molsurf/picture/draw_legend.h"
#include "molsurf/picture/panels.h"
#include "molsurf/picture/view.h"
#include "molsurf/picture/view_file.h"
#include "molsurf/picture/write_html.h"
#include "molsurf/spline/curvature.h"
#include "molsurf/surface/run.h"
#include "molsurf/surface/surface_kind.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace molsurf::tool
{

openvdb::Vec3d originOf(const Call& call)
{
    return call.center ? call.scene.center : openvdb::Vec3d(0.0);
}

std::vector<Ball> placedBalls(const Call& call, const BallSet& atoms)
{
    std::vector<Ball> balls = atoms.balls;
    for (Ball& ball : balls) ball.center -= originOf(call);
    return balls;
}

std::shared_ptr<const ColorOwners> bordersOf(const Call& call, const BallSet& atoms,
                                             const Mesh& mesh, const Progress& progress)
{
    return molsurf::bordersOf(call.options.color, atoms,
                              asMeshed(placedBalls(call, atoms), call.options), mesh, progress);
}

std::vector<MeshInstance> instancesOf(const Call& call, const BallSet& atoms, const Mesh& mesh,
                                      bool colored, const Progress& progress)
{
    const Color plain = mesh.colors.empty() ? call.picture.plain : Color{255, 255, 255};
    const std::vector<Color> colors =
        colored ? instanceColors(atoms, progress) : std::vector<Color>();
    std::vector<MeshInstance> out;
    for (std::size_t i = 0; i < atoms.placement.instances.size(); ++i) {
        const Instance& copy = atoms.placement.instances[i];
        out.push_back({copy.part, "copy " + (copy.name.empty() ? std::to_string(i + 1) : copy.name),
                       copy.rotation, copy.translation, colors.empty() ? plain : colors[i]});
    }
    return out;
}

void showBodies(const Mesh& bodies, DrawOptions& picture)
{
    if (bodies.triangles.empty()) return;
    const auto model =
        picture.model ? std::make_shared<AtomModel>(*picture.model) : std::make_shared<AtomModel>();
    addBodies(bodies, *model);
    picture.model = model;
}

DrawOptions pictureOf(const Call& call, const BallSet& atoms, const Mesh& mesh, bool coloredCopies,
                      const Progress& progress)
{
    DrawOptions options = call.picture;
    options.instances = instancesOf(call, atoms, mesh, coloredCopies, progress);
    if (call.options.color == ColorBy::Pocket) options.glass = neutralColor;
    setUpright(atoms, options);
    if (atoms.placement.isWhole()) {
        for (const Ball& ball : atoms.balls) options.about.emplace_back(ball.center);
        return options;
    }
    constexpr std::size_t enough = 300; // balls of a prototype
    for (const MeshInstance& copy : options.instances) {
        const auto [begin, end] = atoms.prototype(copy.part);
        for (std::size_t i = begin; i < end; i += 1 + (end - begin) / enough)
            options.about.push_back(copy.placed(openvdb::Vec3d(atoms.balls[i].center)));
    }
    return options;
}

std::optional<std::array<double, 2>> rangeOf(const Call& call, const BallSet& atoms,
                                             const Mesh& mesh, const Progress& progress)
{
    const auto legend = legendOf(call.options.color, atoms, mesh, progress);
    if (!legend || !legend->scale) return std::nullopt;
    return std::array<double, 2>{legend->scale->low, legend->scale->high};
}

void takeRange(const std::optional<std::array<double, 2>>& range, BallSet& atoms)
{
    if (!range) return;
    atoms.coloring.range = range;
    if (!atoms.labels || !atoms.labels->values) return;
    atoms.labels->values->low = (*range)[0];
    atoms.labels->values->high = (*range)[1];
}

namespace
{

/// The call without what pictures do not show, and without atoms that the first structure has.
Call panelCall(Call call)
{
    SurfaceOptions& options = call.options;
    options.pockets = options.ballAreas = options.contacts = options.interfaces = false;
    options.curvatureTotals = options.energy = options.closedForm = false;
    options.areasOf.reset();
    auto& fields = options.fields; // those of vertices are of the mesh
    fields.erase(std::remove_if(fields.begin(), fields.end(),
                                [](const auto& field) { return !findCurvatureField(field); }),
                 fields.end());
    call.atoms.pore.clear();
    call.atoms.pocketAt.clear();
    call.atoms.model = 0;
    call.viewed.clear(); // the first structure says where the eye is
    return call;
}

/// What the panel shows, without its surface.
PanelSurface readPanel(const Call& call, const Panel& what, const BallSet& first,
                       Terminal& terminal)
{
    PanelSurface panel{what.kind ? nameOf(*what.kind) : inputStem(what.file),
                       first,
                       {},
                       {},
                       call.picture,
                       bool(what.kind),
                       ""};
    if (what.kind) return panel;
    panel.picture.model.reset();
    panel.picture.notes.clear();
    auto [balls, description] =
        readBalls(what.file, panelCall(call), terminal, &panel.picture, true);
    terminal.erase();
    if (!call.quiet) {
        say(description);
        for (const std::string& warning : balls.warnings)
            say("warning: " + what.file + ": " + warning);
    }
    panel.atoms = std::move(balls);
    return panel;
}

PanelSurface makePanel(const Call& call, const Panel& what, const BallSet& first,
                       const std::optional<std::array<double, 2>>& range, Terminal& terminal)
{
    PanelSurface panel = readPanel(call, what, first, terminal);
    Call other = panelCall(call);
    other.options = panelOptions(other.options, what);
    takeRange(range, panel.atoms);
    checkCost(panel.atoms, other.options, limitsOf(call), terminal);
    MolecularSurface result = makePrototypes(panel.atoms, other.options, &terminal);
    terminal.erase();
    const auto& flow = result.report.evolution;
    if (flow && !flow->converged)
        panel.unrest = panel.name + ": " + unrestText(*flow, other.options.voxel, moreSteps(call));
    if (!call.quiet)
        for (const std::string& warning : result.report.warnings)
            say("warning: " + panel.name + ": " + warning);
    panel.shown = shownMeshes(other, panel.atoms, result.mesh, terminal);
    panel.shown.about = aboutPage(result.report.surface.kind, other.options.voxel);
    panel.mesh = std::move(result.mesh);
    return panel;
}

} // namespace

SurfaceOptions panelOptions(SurfaceOptions options, const Panel& panel)
{
    if (!panel.kind) return options;
    options.kind = *panel.kind;
    if (isUnion(options.kind)) options.inset = 0.0; // --match is for the others
    return options;
}

std::string firstName(const Call& call)
{
    const auto any = [&](const auto& such) {
        return std::any_of(call.panels.begin(), call.panels.end(), such);
    };
    std::vector<std::string> words;
    if (any([](const Panel& panel) { return !panel.file.empty(); }))
        words.push_back(inputStem(call.input));
    if (any([](const Panel& panel) { return bool(panel.kind); }))
        words.push_back(nameOf(call.options.kind));
    return joinWords(words, ", ");
}

void makePanels(const Call& call, const BallSet& first, const Mesh& mesh, Terminal& terminal)
{
    const auto range = rangeOf(call, first, mesh, terminal);
    for (const Panel& panel : call.panels) {
        if (!panel.hasSurface()) continue;
        const std::string name = panel.kind ? nameOf(*panel.kind) : panel.file;
        try {
            call.panelSurfaces->push_back(makePanel(call, panel, first, range, terminal));
        } catch (const Error& error) {
            if (std::string(error.what()).find(name) != std::string::npos) throw;
            throw Error(error, name + ": " + error.what());
        }
    }
}

int endOf(const std::vector<PanelSurface>& panels)
{
    bool rest = true;
    for (const PanelSurface& panel : panels) {
        if (panel.unrest.empty()) continue;
        say(panel.unrest);
        rest = false;
    }
    return rest ? 0 : notConvergedStatus;
}

namespace
{

/// One panel, ready to be drawn.
struct Shot {
    std::string name;
    const Mesh* mesh;
    DrawOptions options;
    std::vector<Legend> legends;
};

Shot shotOf(const Drawn& d, double turn, bool quick)
{
    const Call& call = d.call;
    Shot shot{"", &d.mesh, pictureOf(call, d.atoms, d.mesh, call.colorsCopies(), d.progress), {}};
    DrawOptions& options = shot.options;
    options.turn += turn;
    options.quick = quick;
    options.borders = d.borders;
    if (options.clip)
        options.inside = insideColors(call.options, d.atoms, originOf(call), d.borders);
    const auto legend =
        d.legend ? d.legend : legendOf(call.options.color, d.atoms, d.mesh, d.progress);
    shot.legends = molsurf::legendsOf(legend, options.model.get());
    return shot;
}

/// All panels, the first one first.
std::vector<Shot> shotsOf(const Drawn& d, double turn, bool quick)
{
    std::vector<Shot> shots = {shotOf(d, turn, quick)};
    if (d.call.panels.empty() || !d.call.panelSurfaces) return shots;
    auto surface = d.call.panelSurfaces->begin();
    shots[0].name = firstName(d.call);
    for (const Panel& panel : d.call.panels) {
        if (!panel.hasSurface()) {
            shots.push_back(shots[0]);
            lookFrom(panel.toEye, shots.back().options);
            continue;
        }
        Call call = d.call;
        call.picture = surface->picture;
        shots.push_back(
            shotOf({call, surface->atoms, surface->mesh, surface->shown.borders, {}, d.progress},
                   turn, quick));
        shots.back().name = surface->name;
        ++surface;
    }
    return shots;
}

/// One direction for all panels but those that have their own, and one scale. Each panel shows the
/// middle of its structure, unless the call says what it shows.
void shareCamera(const Call& call, std::vector<Shot>& shots)
{
    DrawOptions level = shots[0].options;
    level.turn = 0.0;
    const auto axes = viewAxes(*shots[0].mesh, level);
    std::vector<PictureFrame> frames;
    PictureFrame largest{openvdb::Vec3d(0.0), 0.0, 0.0};
    for (std::size_t n = 0; n < shots.size(); ++n) {
        DrawOptions& options = shots[n].options;
        if (n == 0 || call.panels[n - 1].hasSurface()) {
            options.upright = openvdb::Vec3d(0.0);
            options.up = axes[1];
            options.toEye = axes[2];
        }
        options.turnable = options.turnable || options.turn != 0.0;
        const View view = chooseView(*shots[n].mesh, options);
        frames.push_back({view.center, view.width * view.pixel, view.height * view.pixel});
        largest.width = std::max(largest.width, frames.back().width);
        largest.height = std::max(largest.height, frames.back().height);
    }
    for (std::size_t n = 0; n < shots.size(); ++n)
        shots[n].options.frame = PictureFrame{frames[n].center, largest.width, largest.height};
}

std::vector<Legend> joined(const std::vector<Shot>& shots)
{
    std::vector<Legend> all;
    for (const Shot& shot : shots) {
        for (const Legend& legend : shot.legends) {
            const auto known = std::find_if(all.begin(), all.end(), [&](const Legend& other) {
                return other.title == legend.title;
            });
            if (known == all.end())
                all.push_back(legend);
            else
                for (const LegendEntry& entry : legend.entries) addEntry(entry, known->entries);
        }
    }
    return all;
}

} // namespace

std::vector<Legend> legendsOf(const Drawn& drawn)
{
    return joined(shotsOf(drawn, 0.0, true));
}

Picture drawResult(const Drawn& drawn, double turn, bool quick)
{
    const Call& call = drawn.call;
    std::vector<Shot> shots = shotsOf(drawn, turn, quick);
    const std::vector<Legend> legends = call.drawsLegend() ? joined(shots) : std::vector<Legend>();
    if (shots.size() == 1)
        return drawExplained(*shots[0].mesh, std::move(shots[0].options), legends, call.scaleBar,
                             drawn.progress);
    shareCamera(call, shots);
    const int whole = shots[0].options.width, width = widthBeside(legends, whole);
    std::vector<PanelPicture> panels;
    for (Shot& shot : shots) {
        shot.options.width = panelWidth(shots.size(), width);
        shot.options.whole = whole;
        panels.push_back({drawMesh(*shot.mesh, shot.options, drawn.progress),
                          call.drawsLegend() ? shot.name : ""});
    }
    return explained(joinPanels(panels, width, whole, call.picture.background), legends,
                     call.scaleBar, whole, call.picture.background);
}

} // namespace molsurf::tool
