// SPDX-License-Identifier: MPL-2.0
#include "draw_result.h"

#include "bricks.h"
#include "exit_status.h"
#include "outputs.h"
#include "verbs.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/kernel/spline/curvature.h"
#include "molsurf/show/color/legend.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/show/io/part_ranges.h"
#include "molsurf/show/picture/atom_model.h"
#include "molsurf/show/picture/view_file.h"
#include "molsurf/show/picture/write_html.h"
#include "molsurf/surface/pockets.h"
#include "molsurf/surface/run.h"
#include "molsurf/surface/tunnels.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

namespace molsurf::tool
{

namespace
{

void addTubes(const Report::Tunnels& tunnels, Bodies& bodies)
{
    const Mesh tubes = tunnelTubes(tunnels);
    for (const PartRange& part : partRanges(tubes, "")) appendPart(tubes, part, bodies.mesh);
    bodies.tunnels = tubeLegend(tubes);
}

} // namespace

Bodies drawnBodies(const CommandLine& call, const BallSet& atoms, const Mesh& pockets,
                   const MolecularSurface& surface, Terminal& terminal)
{
    const std::vector<PartRange> parts = partRanges(pockets, "");
    const std::size_t count =
        std::min(call.shownPockets, pockets.triangles.empty() ? 0 : parts.size());
    if (count < parts.size() && count > 0 && !call.quiet && call.writes(Pixels | ColorChoices)) {
        terminal.erase();
        printLine(formatted("pictures show the %d largest of %d pockets [hint: --show pockets=all]",
                            int(count), int(parts.size())));
    }
    std::vector<Color> used; // by the surface and the atoms beside it
    const ColorBy by = call.options.color;
    if (const auto legend = count > 0 ? legendOf(by, atoms, surface.mesh, terminal) : std::nullopt;
        legend && by != ColorBy::Pocket)
        for (const LegendEntry& entry : legend->entries) used.push_back(entry.color);
    if (call.picture.model)
        for (const auto* entries : {&call.picture.model->chains, &call.picture.model->elements})
            for (const LegendEntry& entry : *entries) used.push_back(entry.color);
    Bodies drawn;
    for (std::size_t p = 0, number = 1; p < count; ++p, ++number) {
        Color color = pocketColor(number);
        for (std::size_t tried = 0; tried < mostDistinct; ++tried) {
            if (std::count(used.begin(), used.end(), color) == 0) break;
            color = pocketColor(++number);
        }
        appendPart(pockets, parts[p], drawn.mesh);
        std::vector<Color>& colors = drawn.mesh.colors;
        std::fill(colors.end() - std::ptrdiff_t(parts[p].vertexEnd - parts[p].firstVertex),
                  colors.end(), color);
        drawn.pockets.push_back({parts[p].name, color});
    }
    if (surface.report.tunnels) addTubes(*surface.report.tunnels, drawn);
    return drawn;
}

void showBodies(const Bodies& bodies, DrawOptions& picture)
{
    if (bodies.mesh.triangles.empty()) return;
    const auto model =
        picture.model ? std::make_shared<AtomModel>(*picture.model) : std::make_shared<AtomModel>();
    addBodies(bodies, *model);
    picture.model = model;
}

std::optional<std::array<double, 2>> rangeOf(const CommandLine& call, const BallSet& atoms,
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

/// The options of what pictures show.
SurfaceOptions shownOptions(const SurfaceOptions& asked)
{
    Products shown;
    shown.energy = shown.closedForm = false;
    shown.needs.levelSet = shown.needs.statistics = shown.needs.passages = false;
    shown.meshLabels = asked.meshLabels;
    shown.meshEdge = asked.meshEdge;
    shown.meshError = asked.meshError;
    shown.color = asked.color;
    shown.pocket = asked.pocket; // colours by pocket
    shown.split = asked.split;
    shown.surfaceOf = asked.surfaceOf;
    std::copy_if(asked.fields.begin(), asked.fields.end(), std::back_inserter(shown.fields),
                 [](const auto& field) { return findCurvatureField(field); }); // of vertices
    return {asked, shown};
}

/// The atoms of a panel, read or `first`, and its view; its surface is made later.
PanelSurface readPanel(const CommandLine& call, const Panel& what, const BallSet& first,
                       Terminal& terminal)
{
    PanelSurface panel{what.kind ? nameOf(*what.kind) : inputStem(what.file),
                       first,
                       call.options,
                       {},
                       {},
                       call.picture,
                       bool(what.kind)};
    if (what.kind) return panel;
    panel.picture.model.reset();
    panel.picture.notes.clear();
    if (call.superpose.empty()) panel.picture.zoom.clear(); // its atoms are elsewhere
    auto [balls, places, description, anchors, motion] =
        readBalls(what.file, call, terminal, &panel.picture, true);
    terminal.erase();
    if (!call.quiet) {
        printLine(description);
        for (const std::string& warning : balls.record.warnings)
            printLine("warning: " + what.file + ": " + warning);
    }
    panel.atoms = std::move(balls);
    return panel;
}

PanelSurface makePanel(const CommandLine& call, const Panel& what, const BallSet& first,
                       const std::optional<std::array<double, 2>>& range, Terminal& terminal)
{
    PanelSurface panel = readPanel(call, what, first, terminal);
    CommandLine other = call;
    other.options = panelOptions(shownOptions(call.options), what);
    takeRange(range, panel.atoms);
    checkCost(panel.atoms, other.options, limitsOf(call), terminal);
    MolecularSurface result = makeUnitSurface(panel.atoms, other.options, &terminal);
    terminal.erase();
    const auto& flow = result.report.evolution;
    if (flow && !flow->converged)
        panel.unrest = panel.name + ": " + unrestText(*flow, other.options.voxel, moreSteps(call));
    if (!call.quiet)
        for (const std::string& warning : result.report.warnings)
            printLine("warning: " + panel.name + ": " + warning);
    panel.shown = shownMeshes(other, other.options, panel.atoms, result.mesh, {}, terminal);
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

std::string firstName(const CommandLine& call)
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

void makePanels(const CommandLine& call, const BallSet& first, const Mesh& mesh, Terminal& terminal)
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
        printLine(panel.unrest);
        rest = false;
    }
    return rest ? 0 : notConvergedStatus;
}

} // namespace molsurf::tool
