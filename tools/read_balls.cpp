// SPDX-License-Identifier: MPL-2.0
#include "input_files.h"
#include "outputs.h"
#include "picture_atoms.h"
#include "verbs.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/memory.h"
#include "molsurf/molecule/selection/search_places.h"
#include "molsurf/molecule/selection/shown_atoms.h"
#include "molsurf/molecule/structure/read_structure.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/show/io/read_mesh.h"
#include "molsurf/show/io/read_vdb.h"
#include "molsurf/surface/drawn_surface.h"
#include "molsurf/surface/solver_files.h"

namespace molsurf::tool
{

namespace
{

/// Whether a structure has what f takes of it.
/// @param[in] partly  whether it may lack that
template<typename F>
bool isThere(bool partly, const F& f)
{
    try {
        f();
    } catch (const Error& error) {
        if (!partly || error.kind() != ErrorKind::Input) throw;
        return false;
    }
    return true;
}

/// The labels of copies that a surface leaves out. A group of certain copies is none of theirs, but
/// keeps its place, which decides the colours of the others.
LabelOptions labelsOfOthers(LabelOptions labels)
{
    for (auto* groups : {&labels.groups, &labels.colorGroups})
        for (GroupRule& group : *groups)
            if (!group.copies.all()) {
                group.copies = {};
                group.select = "none";
            }
    labels.labels = labels.names = true;
    return labels;
}

/// The atoms that a rule shows beside a surface.
/// @param[in] options  of the surface
BallSet shownBalls(const Structure& structure, const CommandLine& call,
                   const SelectOptions& options, const ShowRule& rule, const BallSet& surface,
                   const Progress& progress)
{
    if (!rule.others) {
        SelectOptions beside = besideSurface(options, rule.select);
        beside.assembly.instances = options.assembly.instances;
        return selectBalls(structure, beside, {}, 0.0, progress);
    }
    BallSet others = selectBalls(structure, ofOtherCopies(options, rule.select),
                                 labelsOfOthers(call.labels), probeOf(call.options), progress);
    const Color plain = rule.byCopy ? Color{255, 255, 255} : call.picture.plain;
    colorLikeSurface(surface, call.options.color, plain, progress, others);
    return others;
}

} // namespace

DescribedBalls readBalls(const std::string& path, const CommandLine& call, Terminal& terminal,
                         DrawOptions* picture, bool other)
{
    terminal.update("read", 0.0);
    failIfNoFile(path);
    if (isVdbFile(path))
        throw Error(ErrorKind::Input,
                    path + ": it is an OpenVDB file, expected atoms [hint: vdb_molsurf convert " +
                        path + " -o FILE]");
    if (isMeshName(path))
        throw Error(
            ErrorKind::Input,
            path + ": it is a mesh, expected atoms [hint: vdb_molsurf compare measures meshes]");
    Structure structure = readStructure(path, call.atoms.limits.maxInput, terminal, call.memory);
    stopIfAsked();
    SelectOptions options = call.atoms;
    options.limits.memory = call.memory;
    if (other) options.model = 0;
    std::shared_ptr<const Anchors> anchors;
    std::optional<Superposition> motion;
    if (!call.superpose.empty()) {
        anchors = std::make_shared<Anchors>(
            anchorsOf(structure, {call.superpose, options.select}, options.model));
        if (call.anchors) motion = superpositionOf(*anchors, *call.anchors);
        if (motion) moveBy(*motion, structure);
    }
    BallSet balls = selectBalls(structure, options, call.labels, probeOf(call.options), terminal);
    const SearchPlaces places = other ? SearchPlaces() : findPlaces(structure, call.places, balls);
    std::string description = describeSelection(structure, balls);
    if (motion) description += "; " + describe(*motion);
    if (!picture) return {std::move(balls), places, std::move(description), anchors, motion};
    const auto chosen = [&](const std::string& select) {
        return selectBalls(structure, besideSurface(options, select), {}, 0.0, terminal);
    };
    std::vector<ShowRule> rules;
    std::vector<BallSet> shown, others;
    for (ShowRule rule : call.shows) {
        rule.byCopy = rule.others && !rule.color && call.colorsCopies();
        const bool there = isThere(other, [&] {
            shown.push_back(shownBalls(structure, call, options, rule, balls, terminal));
        });
        if (!there) continue;
        rules.push_back(rule);
        if (rule.others) others.push_back(shown.back());
    }
    if (!others.empty() && call.viewed.empty()) faceSurface(balls, others, *picture);
    showAtoms(rules, std::move(shown), structure.bonds, balls, terminal, *picture);
    for (const NoteText& note : call.notes)
        if (!other || !isOfPlaces(note))
            isThere(other, [&] { addNotes({note}, chosen, *picture); });
    if (!call.zoomed.empty()) isThere(other, [&] { zoomTo(chosen(call.zoomed), *picture); });
    if (!call.viewed.empty() && !other) lookAt(call, chosen(call.viewed), balls, *picture);
    return {std::move(balls), places, std::move(description), anchors, motion};
}

BallSet readBalls(CommandLine& call, Terminal& terminal, Report& report)
{
    const Clock::time_point start = Clock::now();
    auto [balls, places, description, anchors, motion] =
        readBalls(call.input, call, terminal, &call.picture);
    call.options.places = places;
    call.anchors = anchors;
    trimHeap(); // what the parser has left is in pieces too small for the fields
    report.warnings = call.warnings;
    report.warnings.insert(report.warnings.end(), balls.record.warnings.begin(),
                           balls.record.warnings.end());
    report.seconds.emplace_back("read", secondsSince(start));
    terminal.erase();
    if (!call.quiet) {
        printLine(description);
        for (const std::string& warning : report.warnings) printLine("warning: " + warning);
    }
    stopIfAsked();
    if (balls.charges && call.writes(Solver)) call.apbsGrid = solverGrid(call.apbsInput, balls);
    return std::move(balls);
}

void colorBalls(const SurfaceOptions& options, Terminal& terminal, BallSet& balls)
{
    if (options.color != ColorBy::Nothing)
        balls.colors = ballColors(balls, options.color, terminal);
}

} // namespace molsurf::tool
