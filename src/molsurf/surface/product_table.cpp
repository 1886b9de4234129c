// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/product_table.h"

#include "molsurf/analysis/measures/polarity.h"
#include "molsurf/error.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/core/quiet_progress.h"
#include "molsurf/kernel/grid/grid_like.h"
#include "molsurf/kernel/pipeline/closed_form.h"
#include "molsurf/kernel/pipeline/influence.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/show/color/color_table.h"
#include "molsurf/show/color/curvature_colors.h"
#include "molsurf/show/color/value_colors.h"
#include "molsurf/surface/field_table.h"
#include "molsurf/surface/interfaces.h"
#include "molsurf/surface/patches.h"
#include "molsurf/surface/pockets.h"
#include "molsurf/surface/pore.h"
#include "molsurf/surface/tunnels.h"
#include "molsurf/surface/whole_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace molsurf
{

namespace
{

using Options = SurfaceOptions;

/// Whether there are several prototypes, each of which has a surface of its own.
bool ofPrototypes(const BallSet& atoms)
{
    return atoms.placement.prototypes() > 1;
}

void needGroups(const BallSet& atoms, const Options&)
{
    if (!atoms.labels || atoms.labels->groups.empty())
        throw Error(ErrorKind::Input, "there are no groups to surface alone");
}

constexpr char ofPatches[] = "`patches`", ofSmoothing[] = "`smoothColors`";
constexpr char ofPore[] = "`pore`", ofTunnels[] = "`tunnelsFrom`", ofMeasures[] = "`measures`";

/// Checks that the balls and their mesh are the whole, which ways through the void and measures are
/// of.
template<const auto& option>
void needOnePlace(const BallSet& atoms, const Options&)
{
    if (!atoms.placement.isWhole())
        throw Error(ErrorKind::Usage, std::string(option) +
                                          ": expected one surface, and not `instances` or "
                                          "`bySymmetry`");
}

void needOnePrototype(const BallSet& atoms, const Options&)
{
    if (ofPrototypes(atoms))
        throw Error(ErrorKind::Usage, "`pockets`: expected one surface, and not `instances`");
}

/// Checks that the mesh is that of the whole by one surface.
template<const auto& option>
void needOneMesh(const BallSet& atoms, const Options& options)
{
    if (!atoms.placement.isWhole() || options.ofParts())
        throw Error(ErrorKind::Usage, std::string(option) +
                                          ": expected one surface, and not `split`, `surfaceOf`, "
                                          "`instances` or `bySymmetry`");
}

/// Colours of one ball each, and grids, show no means over the mesh.
void needBlended(const BallSet& atoms, const Options& options)
{
    needOneMesh<ofSmoothing>(atoms, options);
    const bool byValue = options.color == ColorBy::Value && atoms.labels && atoms.labels->values;
    if (byValue && isFlat(*atoms.labels->values))
        throw Error(ErrorKind::Usage, std::string(ofSmoothing) +
                                          ": expected values that blend, and not `flatValues` or "
                                          "colours in steps");
    if (byValue || kindOf(options.color).ofCurvature)
        for (const char* field : {"Cd", "value"})
            if (hasField(options.fields, field))
                throw Error(ErrorKind::Usage,
                            std::string(ofSmoothing) +
                                ": expected colours of a mesh, and not `fields` " + field);
}

void needPatches(const BallSet& atoms, const Options& options)
{
    if (!options.patches) throw Error(ErrorKind::Usage, "`color` patch: expected `patches` too");
    needOneMesh<ofPatches>(atoms, options);
    const bool ofBalls = options.patches->by == ColorBy::Value;
    if (ofBalls && !(atoms.labels && atoms.labels->patchValues))
        throw Error(ErrorKind::Input,
                    "`patches`: expected values of the atoms, as of LabelOptions::patchBy");
}

/// The surface that areas are of.
SurfaceSpec areasShown(const Options& options)
{
    return ofKind(options, options.areasOf.value_or(options.kind));
}

void needAreas(const BallSet& atoms, const Options& options)
{
    checkWay(ByAtom, options);
    if (ofPrototypes(atoms))
        throw Error(ErrorKind::Usage, "areas of atoms: expected one surface, and not `split`");
    if (atoms.placement.unit && !isBoundary(areasShown(options)))
        throw Error(ErrorKind::Usage, "areas of atoms by symmetry: expected a surface in "
                                      "closed form [hint: `surface` sas or vdw]");
}

/// Areas of atoms on a surface that is made only to measure them.
std::vector<double> areasApart(const BallSet& atoms, const SurfaceSpec& spec, Progress& progress)
{
    if (!isClosedForm(spec)) {
        QuietProgress quiet(progress);
        Products wanted = measuresOfWhole();
        wanted.ballAreas = true;
        return runWhole(atoms, {spec, wanted}, quiet).ballAreas;
    }
    std::vector<double> areas = measureClosedForm(atoms.balls, spec, progress).ballAreas;
    areas.resize(atoms.own());
    return areas;
}

void makeAreas(MadeRun& run)
{
    const bool same = run.areasOf.kind == run.options.kind && !run.ballAreas.empty();
    run.result.ballAreas =
        same ? std::move(run.ballAreas) : areasApart(run.atoms, run.areasOf, run.progress);
    if (!run.atoms.names) return;
    const auto [polar, apolar] = areasByPolarity(run.atoms, run.result.ballAreas);
    const double times = double(run.atoms.placement.order());
    run.result.report.polarArea = times * polar;
    run.result.report.apolarArea = times * apolar;
}

void nameAreas(MadeRun& run)
{
    run.result.report.areasOf = nameOf(run.areasOf.kind);
}

void makeInterfaces(MadeRun& run)
{
    measureInterfaces(run.atoms, run.areasOf, run.options.ballAreas, run.progress,
                      run.result.report);
}

void makePatches(MadeRun& run)
{
    addPatches(run.atoms, run.options, run.progress, run.result);
}

/// The grid of colours by curvature, and that of the curvature itself where it was asked for.
void makeCurvatureColors(MadeRun& run)
{
    const Options& options = run.options;
    openvdb::GridPtrVec grids = run.result.fields;
    grids.insert(grids.end(), run.result.shown.begin(), run.result.shown.end());
    if (hasField(options.fields, "Cd")) {
        const auto colors =
            curvatureColors(options.color, run.atoms.coloring, run.result.mesh, grids);
        run.result.fields.insert(run.result.fields.end(), colors.begin(), colors.end());
    }
    run.result.shown.clear();
}

/// Depths of the balls, and their grid where there is one.
void makeDepths(MadeRun& run)
{
    MolecularSurface& result = run.result;
    result.ballDepths = ballDepths(run.atoms, probeOf(run.areasOf), run.progress);
    if (run.options.ofParts())
        result.report.warnings.push_back("`fields` depth: surfaces of parts have no grid of it");
    if (!result.surface) return;
    const double reach = Influence(run.atoms, run.options).ofLabel();
    FieldSource from{run.atoms, run.options, result, nullptr, reach, run.progress};
    const Labels& owners = from.owners(false);
    result.fields.push_back(
        gridOf<openvdb::FloatGrid>(from.voxels(false), "depth", 0.0f, [&](std::size_t i) {
            return owners[i] < 0 ? 0.0f : float(result.ballDepths[std::size_t(owners[i])]);
        }));
}

void makeMeasures(MadeRun& run)
{
    for (const MeasureRow& row : measureTable())
        if (hasField(run.options.measures, row.name))
            run.result.report.measures.push_back({row.name, row.of(run.result, run.progress)});
}

/// The area of a ball of the outer volume by the outer area: at most 1, of a ball.
double sphericity(const MolecularSurface& surface, const Progress&)
{
    const SurfaceReport& s = surface.report.surface;
    return std::cbrt(36.0 * M_PI * s.outerVolume * s.outerVolume) / s.outerArea;
}

/// The root of the mean of |x - c|^2 over the volume that the mesh encloses, c its centre. The
/// integrals over a tetrahedron (0, a, b, c) of volume v are v (a + b + c)/4 for x, and
/// v (|a|^2 + |b|^2 + |c|^2 + |a + b + c|^2)/20 for |x|^2.
double gyrationRadius(const MolecularSurface& surface, const Progress& progress)
{
    struct Moments {
        double volume = 0.0;
        openvdb::Vec3d first{0.0};
        double second = 0.0;
        Moments& operator+=(const Moments& other)
        {
            volume += other.volume;
            first += other.first;
            second += other.second;
            return *this;
        }
    };
    const Mesh& mesh = surface.mesh;
    if (mesh.triangles.empty()) return std::nan("");
    const openvdb::Vec3d origin(mesh.positions.front());
    constexpr std::size_t chunk = 4096; // triangles
    const auto sumOf = [&](std::size_t c) {
        Moments sum;
        const std::size_t end = std::min(mesh.triangles.size(), (c + 1) * chunk);
        for (std::size_t t = c * chunk; t < end; ++t) {
            const auto corner = [&](std::size_t k) {
                return openvdb::Vec3d(mesh.positions[mesh.triangles[t][k]]) - origin;
            };
            const openvdb::Vec3d x = corner(0), y = corner(1), z = corner(2), all = x + y + z;
            const double v = x.dot(y.cross(z)) / 6.0; // of the tetrahedron with the origin
            sum += {v, v / 4.0 * all,
                    v / 20.0 * (x.lengthSqr() + y.lengthSqr() + z.lengthSqr() + all.lengthSqr())};
        }
        return sum;
    };
    const Moments sum =
        parallelSum<Moments>((mesh.triangles.size() + chunk - 1) / chunk, progress, sumOf);
    return std::sqrt(sum.second / sum.volume - (sum.first / sum.volume).lengthSqr());
}

constexpr unsigned always = 0;

} // namespace

const std::vector<MeasureRow>& measureTable()
{
    static const std::vector<MeasureRow> rows = {
        {"sphericity", "", "1 for a ball, else less", InBricks, sphericity},
        {"gyration_radius", "Å", "of the volume inside the mesh", InBricks | InClosedForm,
         gyrationRadius}};
    return rows;
}

const std::vector<ProductRow>& productTable()
{
    static const std::vector<ProductRow> rows = {
        {"`surface`", InClosedForm, [](auto&, auto& o) { return !isClosedForm(o); }},
        {"`split`", InBricks | InClosedForm | ByAtom | WithoutMesh,
         [](auto&, auto& o) { return o.split; }, needGroups},
        {"`surfaceOf`", InBricks | InClosedForm | ByAtom | WithoutMesh,
         [](auto&, auto& o) { return !o.surfaceOf.empty(); }, needGroups},
        {"`instances`", WithoutMesh, [](auto& atoms, auto&) { return ofPrototypes(atoms); },
         needGroups},
        {"colours by curvature", WithoutMesh,
         [](auto&, auto& o) { return kindOf(o.color).ofCurvature; }, nullptr, makeCurvatureColors},
        {"`color` by value or pocket", WithoutMesh,
         [](auto&, auto& o) { return o.color == ColorBy::Value || o.color == ColorBy::Pocket; }},
        {ofSmoothing, InBricks | BySymmetry | InClosedForm | WithoutMesh,
         [](auto&, auto& o) { return o.smoothColors > 0.0; }, needBlended, nullptr,
         costOfSmoothing},
        {ofPatches, InBricks | BySymmetry | InClosedForm | WithoutMesh,
         [](auto&, auto& o) { return o.patches || o.color == ColorBy::Patch; }, needPatches,
         makePatches, costOfPatches},
        {"areas", always, [](auto&, auto& o) { return o.ballAreas || o.contacts || o.interfaces; },
         nullptr, nameAreas},
        {"`interfaces`", InBricks | WithoutMesh, [](auto&, auto& o) { return o.interfaces; },
         needGroups, makeInterfaces, costOfInterfaces},
        {"`pockets`", InBricks | BySymmetry, [](auto&, auto& o) { return wantsPockets(o); },
         needOnePrototype,
         [](MadeRun& run) { addPockets(run.atoms, run.options, run.progress, run.result); },
         costOfPockets},
        {ofPore, always, [](auto&, auto& o) { return o.places.pore.has_value(); },
         needOnePlace<ofPore>,
         [](MadeRun& run) { addPore(run.atoms, run.options, run.progress, run.result.report); },
         costOfPore},
        {ofTunnels, always, [](auto&, auto& o) { return o.places.tunnelsFrom.has_value(); },
         needOnePlace<ofTunnels>,
         [](MadeRun& run) { addTunnels(run.atoms, run.options, run.progress, run.result.report); },
         costOfTunnels},
        {"areas of atoms", WithoutMesh, [](auto&, auto& o) { return o.ballAreas; }, needAreas,
         makeAreas, costOfAreas},
        {"contacts", always, [](auto&, auto& o) { return o.contacts; }, nullptr,
         [](MadeRun& run) {
             run.result.contacts =
                 contactAreas(run.atoms.balls, probeOf(run.areasOf), run.progress);
         },
         costOfContacts},
        {"`fields` depth", InBricks, [](auto&, auto& o) { return hasField(o.fields, "depth"); },
         nullptr, makeDepths, costOfDepths},
        {ofMeasures, WithoutMesh, [](auto&, auto& o) { return !o.measures.empty(); },
         needOnePlace<ofMeasures>, makeMeasures, costOfMeasures},
        {"`halfFloats`", always, [](auto&, auto& o) { return o.halfFloats; }, nullptr,
         [](MadeRun& run) { saveAsHalf(run.result.grids()); }},
        // The stages make the others.
        {"`matchVolume`", InBricks | BySymmetry, [](auto&, auto& o) { return o.matchVolume; },
         nullptr, nullptr, costOfMatch},
        {"`fillCavities`", InBricks | BySymmetry | InClosedForm | WithoutMesh,
         [](auto&, auto& o) { return o.fillCavities; }},
        {"`minThickness`", InBricks, [](auto&, auto& o) { return o.minThickness > 0.0; }, nullptr,
         nullptr, costOfWall},
        {"a solvent-excluded surface without `grid`", BySymmetry,
         [](auto&, auto& o) { return !o.grid && !isBoundary(o); }},
        {"`curvatureTotals`", InBricks | BySymmetry | InClosedForm | WithoutMesh,
         [](auto&, auto& o) { return o.curvatureTotals; }, nullptr, nullptr, costOfCurvature},
        {"`remesh`", InBricks | BySymmetry | InClosedForm | WithoutMesh,
         [](auto&, auto& o) { return o.meshEdge > 0.0; }, nullptr, nullptr, costOfRemesh},
        {"`splineLevel`", InBricks | WithoutMesh, [](auto&, auto& o) { return o.splineLevel > 0; }},
        {"`flow` paper", InBricks,
         [](auto&, auto& o) { return hasFlow(o.kind) && o.evolution.flow == Flow::Paper; }},
        {"`color` by curvature", InBricks,
         [](auto&, auto& o) { return kindOf(o.color).ofCurvature; }}};
    return rows;
}

std::string missingIn(Way way, const SurfaceOptions& options, const BallSet& atoms)
{
    for (const ProductRow& row : productTable())
        if ((row.missingIn & way) && row.asked(atoms, options)) return row.name;
    for (const FieldRow& row : fieldTable())
        if ((row.missingIn & way) && hasField(options.fields, row.name))
            return "`fields` " + row.name;
    for (const MeasureRow& row : measureTable())
        if ((row.missingIn & way) && hasField(options.measures, row.name))
            return std::string("`measures` ") + row.name;
    return "";
}

bool hasClosedForm(const SurfaceOptions& options)
{
    return missingIn(InClosedForm, options).empty();
}

Needs needsOf(const BallSet& atoms, const SurfaceOptions& options)
{
    Needs needs = options.needs;
    needs.mesh = needs.mesh || !missingIn(WithoutMesh, options, atoms).empty();
    // Groups have the volumes that interpolated distances enclose.
    const bool grouped = atoms.labels && !atoms.labels->groups.empty();
    needs.levelSet = needs.levelSet || grouped || !options.fields.empty();
    return needs;
}

void checkWay(Way way, const SurfaceOptions& options)
{
    const std::string what = missingIn(way, options);
    if (what.empty()) return;
    if (way == ByAtom)
        throw Error(ErrorKind::Usage, "areas of atoms: expected one surface, and not " + what);
    throw Error(ErrorKind::Usage,
                what + (way == InBricks ? " needs the whole molecule at once: it is not for bricks "
                                          "[hint: a run in one piece, on a machine that has enough "
                                          "memory]"
                                        : " needs the whole assembly at once [hint: without "
                                          "`bySymmetry`]"));
}

void checkProducts(const BallSet& atoms, const SurfaceOptions& options)
{
    for (const ProductRow& row : productTable())
        if (row.check && row.asked(atoms, options)) row.check(atoms, options);
}

void makeProducts(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                  MolecularSurface& result)
{
    MadeRun run{atoms, options, areasShown(options), std::move(result.ballAreas), progress, result};
    result.ballAreas.clear();
    for (const ProductRow& row : productTable())
        if (row.make && row.asked(atoms, options)) row.make(run);
}

} // namespace molsurf
