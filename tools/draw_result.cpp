// SPDX-License-Identifier: MPL-2.0
#include "draw_result.h"

#include "bricks.h"
#include "outputs.h"
#include "verbs.h"

#include "molsurf/color/color_table.h"
#include "molsurf/color/palette.h"
#include "molsurf/color/value_colors.h"
#include "molsurf/error.h"
#include "molsurf/picture/draw_legend.h"
#include "molsurf/picture/panels.h"
#include "molsurf/picture/view.h"
#include "molsurf/picture/view_file.h"
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

namespace
{

/// The colours of points inside.
std::function<Color(const openvdb::Vec3d&)>
insideOf(const Call& call, const BallSet& atoms, const std::shared_ptr<const ColorOwners>& borders)
{
    constexpr double farthest = 30.0; // from a ball [Å]
    if (borders)
        return [borders](const openvdb::Vec3d& x) {
            std::vector<OwnersPower> near;
            borders->owners.at(x, 0.0, near);
            return near.empty() ? neutralColor : borders->colors[std::size_t(near[0].owner)];
        };
    if (call.options.color == ColorBy::Nothing) return nullptr;
    if (call.options.color != ColorBy::Value || atoms.balls.empty())
        return [](const openvdb::Vec3d&) { return neutralColor; };
    const auto values =
        std::make_shared<PointValues>(atoms, outwardOf(atoms.coloring, call.options));
    return [values, origin = originOf(call)](const openvdb::Vec3d& x) {
        return values->colorOf(values->at(x + origin, openvdb::Vec3d(0.0), farthest));
    };
}

} // namespace

void setUpright(const BallSet& atoms, DrawOptions& picture)
{
    const bool chosen = picture.upright.lengthSqr() > 0.0 || picture.toEye.lengthSqr() > 0.0;
    if (atoms.membrane && !chosen) picture.upright = *atoms.membrane;
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

PanelSurface makePanel(const Call& call, const std::string& file,
                       const std::optional<std::array<double, 2>>& range, Terminal& terminal)
{
    PanelSurface panel;
    panel.name = inputStem(file);
    const Call other = panelCall(call);
    panel.picture = call.picture;
    panel.picture.model.reset();
    panel.picture.notes.clear();
    auto [balls, description] = readBalls(file, other, terminal, &panel.picture, true);
    terminal.erase();
    if (!call.quiet) say(description);
    takeRange(range, balls);
    checkCost(balls, other.options, limitsOf(call), terminal);
    MolecularSurface result = makePrototypes(balls, other.options, &terminal);
    terminal.erase();
    const auto& flow = result.report.evolution;
    if (flow && !flow->converged) result.report.warnings.push_back("not converged");
    if (!call.quiet) {
        for (const std::string& warning : balls.warnings) say("warning: " + file + ": " + warning);
        for (const std::string& warning : result.report.warnings)
            say("warning: " + file + ": " + warning);
    }
    panel.borders = bordersOf(call, balls, result.mesh, terminal);
    panel.mesh = std::move(result.mesh);
    panel.atoms = std::move(balls);
    return panel;
}

} // namespace

std::shared_ptr<const std::vector<PanelSurface>> makePanels(const Call& call, const BallSet& first,
                                                            const Mesh& mesh, Terminal& terminal)
{
    const auto range = rangeOf(call, first, mesh, terminal);
    auto all = std::make_shared<std::vector<PanelSurface>>();
    for (const Panel& panel : call.panels) {
        if (panel.file.empty()) continue;
        try {
            all->push_back(makePanel(call, panel.file, range, terminal));
        } catch (const Error& error) {
            if (std::string(error.what()).find(panel.file) != std::string::npos) throw;
            throw Error(error, panel.file + ": " + error.what());
        }
    }
    return all;
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
    if (options.clip) options.inside = insideOf(call, d.atoms, d.borders);
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
    if (surface != d.call.panelSurfaces->end()) shots[0].name = inputStem(d.call.input);
    for (const Panel& panel : d.call.panels) {
        if (panel.file.empty()) {
            shots.push_back(shots[0]);
            lookFrom(panel.toEye, shots.back().options);
            continue;
        }
        Call call = d.call;
        call.picture = surface->picture;
        shots.push_back(shotOf(
            {call, surface->atoms, surface->mesh, surface->borders, {}, d.progress}, turn, quick));
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
        if (n == 0 || !call.panels[n - 1].file.empty()) {
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
