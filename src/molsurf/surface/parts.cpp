// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/parts.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/quiet_progress.h"
#include "molsurf/kernel/mesh/mesh_shape.h"
#include "molsurf/kernel/mesh/statistics.h"
#include "molsurf/kernel/pipeline/check_balls.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/show/color/curvature_colors.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/surface/unit_run.h"
#include "molsurf/surface/whole_run.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <string>

namespace molsurf
{

namespace
{

constexpr const char* otherName = "other";

struct Part {
    std::string name;
    SurfaceKind kind;
    std::vector<std::size_t> balls;
};

std::size_t findGroup(const std::vector<Group>& groups, const std::string& name)
{
    const auto found = std::find_if(groups.begin(), groups.end(),
                                    [&](const Group& group) { return group.name == name; });
    if (found != groups.end()) return std::size_t(found - groups.begin());
    std::string names;
    for (std::size_t g = 0; g < std::min<std::size_t>(groups.size(), 8); ++g) {
        names += (g ? ", " : "") + groups[g].name;
    }
    throw Error(ErrorKind::Input, "`surfaceOf`: there is no group '" + name +
                                      "' [hint: the groups are " + names +
                                      (groups.size() > 8 ? ", ..." : "") + "]");
}

/// Groups that get a surface of their own, and all other balls as one part; without empty ones.
std::vector<Part> partsOf(const BallSet& atoms, const SurfaceOptions& options)
{
    const std::vector<Group>& groups = atoms.labels->groups;
    std::vector<Part> parts;
    for (const Group& group : groups) parts.push_back({group.name, options.kind, {}});
    parts.push_back({otherName, options.kind, {}});
    std::vector<bool> alone(groups.size(), options.split || atoms.placement.prototypes() > 1);
    for (const auto& [name, kind] : options.surfaceOf) {
        const std::size_t g = findGroup(groups, name);
        parts[g].kind = kind;
        alone[g] = true;
    }
    for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
        const std::int32_t g = atoms.labels->groupOf[i];
        const bool own = g >= 0 && alone[std::size_t(g)];
        parts[own ? std::size_t(g) : groups.size()].balls.push_back(i);
    }
    const auto hasNone = [&](const Part& part) { // the first balls are those of the surface
        return part.balls.empty() || part.balls[0] >= atoms.own();
    };
    parts.erase(std::remove_if(parts.begin(), parts.end(), hasNone), parts.end());
    return parts;
}

/// The name in the letters that any program takes, unlike those before it.
std::string gridName(const std::string& name, std::set<std::string>& taken)
{
    std::string word;
    for (const char letter : name) {
        word += std::isalnum(static_cast<unsigned char>(letter)) || letter == '-' ? letter : '_';
    }
    const std::string first = word;
    for (int n = 2; !taken.insert(word).second; ++n) word = first + "_" + std::to_string(n);
    return word;
}

template<typename T>
void append(std::vector<T>& to, const std::vector<T>& more)
{
    to.insert(to.end(), more.begin(), more.end());
}

template<typename T>
void append(std::vector<Attribute<T>>& to, const std::vector<Attribute<T>>& more)
{
    if (to.empty()) {
        to = more;
        return;
    }
    for (std::size_t a = 0; a < to.size(); ++a) append(to[a].values, more[a].values);
}

void append(Mesh& mesh, const Mesh& part, const std::string& name)
{
    const auto before = std::uint32_t(mesh.positions.size());
    mesh.parts.push_back({name, mesh.triangles.size()});
    append(mesh.positions, part.positions);
    append(mesh.normals, part.normals);
    append(mesh.scalars, part.scalars);
    append(mesh.labels, part.labels);
    append(mesh.colors, part.colors);
    for (const auto& t : part.triangles) {
        mesh.triangles.push_back({t[0] + before, t[1] + before, t[2] + before});
    }
}

/// Adds what may not be known.
template<typename T>
void add(std::optional<T>& sum, const std::optional<T>& part)
{
    if (sum && part)
        *sum += *part;
    else
        sum.reset();
}

/// Adds all but the statistics of curvature. Shares are means over vertices. At the first part,
/// when the sum has no vertices, kind and flags are set, and numbers that may be unknown begin
/// at 0.
SurfaceReport& operator+=(SurfaceReport& sum, const SurfaceReport& part)
{
    const auto smooth = [](const SurfaceReport& s) {
        return double(s.vertices) * (1.0 - s.kinkShare);
    };
    const double before = smooth(sum), more = smooth(part);
    if (more > 0.0) {
        sum.gradientShare = ((before > 0.0 ? before * sum.gradientShare : 0.0) + //
                             more * part.gradientShare) /
                            (before + more);
    }
    sum.kinkShare =
        (double(sum.vertices) * sum.kinkShare + double(part.vertices) * part.kinkShare) /
        std::max(1.0, double(sum.vertices + part.vertices));
    if (sum.vertices == 0) {
        sum.kind = part.kind;
        sum.meshArea = sum.meshVolume = sum.triangleArea = 0.0;
        sum.closed = sum.manifold = true;
    } else if (sum.kind != part.kind) {
        sum.kind = "mixed";
    }
    sum.area += part.area;
    sum.volume += part.volume;
    add(sum.eulerCharacteristic, part.eulerCharacteristic);
    sum.meshEulerCharacteristic += part.meshEulerCharacteristic;
    add(sum.meshArea, part.meshArea);
    add(sum.meshVolume, part.meshVolume);
    add(sum.triangleArea, part.triangleArea);
    sum.meshComponents += part.meshComponents;
    sum.components += part.components;
    append(sum.cavities, part.cavities);
    sum.outerArea += part.outerArea;
    sum.outerVolume += part.outerVolume;
    sum.vertices += part.vertices;
    sum.triangles += part.triangles;
    sum.closed = sum.closed && part.closed;
    sum.manifold = sum.manifold && part.manifold;
    sum.degenerateTriangles += part.degenerateTriangles;
    sum.maxResidual = std::max(sum.maxResidual, part.maxResidual);
    if (part.shape && sum.shape) {
        add(*part.shape, *sum.shape);
    } else if (part.shape) {
        sum.shape = part.shape;
    }
    if (part.integrals && sum.integrals) {
        *sum.integrals += *part.integrals;
    } else if (part.integrals) {
        sum.integrals = part.integrals;
    }
    return sum;
}

/// Whether an evolution says more of the whole than another.
bool tellsMore(const EvolutionReport& a, const EvolutionReport& b)
{
    return a.converged != b.converged ? !a.converged : a.steps > b.steps;
}

/// Adds the report of further parts.
Report& operator+=(Report& sum, const Report& part)
{
    sum.surface += part.surface;
    append(sum.parts, part.parts);
    for (const Report::Group& group : part.groups) {
        const auto found =
            std::find_if(sum.groups.begin(), sum.groups.end(),
                         [&](const Report::Group& g) { return g.name == group.name; });
        if (found == sum.groups.end()) {
            sum.groups.push_back(group);
            continue;
        }
        found->atoms += group.atoms;
        found->area += group.area;
        found->volume += group.volume;
    }
    if (part.evolution && (!sum.evolution || tellsMore(*part.evolution, *sum.evolution))) {
        sum.evolution = part.evolution;
    }
    sum.activeVoxels += part.activeVoxels;
    sum.gridBytes += part.gridBytes;
    for (const auto& [stage, seconds] : part.seconds) sum.addSeconds(stage, seconds);
    append(sum.warnings, part.warnings);
    return sum;
}

/// The report of one part, with its name.
Report named(const std::string& name, Report report)
{
    report.parts = {{name, report.atoms, report.surface}};
    for (std::string& warning : report.warnings) warning = name + ": " + warning;
    return report;
}

/// The same colours for a part as for the whole.
BallSet colored(const BallSet& atoms, ColorBy by, const Progress& progress)
{
    BallSet out = atoms;
    out.colors = ballColors(atoms, by, progress);
    if (by != ColorBy::Group) return out;
    const std::vector<Color> colors = groupColors(atoms, progress);
    for (std::size_t g = 0; g < colors.size(); ++g) out.labels->groups[g].color = colors[g];
    return out;
}

/// The balls of a part; those of a unit with the part's balls around it.
BallSet ballsOf(const Part& part, const BallSet& all)
{
    BallSet own = subset(all, part.balls);
    if (!all.placement.unit) return own;
    Placement& placement = own.placement = all.placement;
    const auto first = [&](std::size_t ball) { // of the part, from a ball of all
        return std::size_t(std::lower_bound(part.balls.begin(), part.balls.end(), ball) -
                           part.balls.begin());
    };
    placement.around = part.balls.size() - first(all.own());
    for (std::size_t& begin : placement.begin) begin = first(begin);
    for (std::size_t i = 0; i < part.balls.size(); ++i)
        placement.motionOf[i] = all.placement.motionOf[part.balls[i]];
    placement.motionOf.resize(part.balls.size());
    countBalls(own, own.resolutionOf, own.resolutions);
    countBalls(own, own.labels->groupOf, own.labels->groups);
    return own;
}

/// The surface of a part.
MolecularSurface runPart(const BallSet& own, const SurfaceOptions& options, Progress& progress)
{
    if (own.placement.unit) return runUnit(inSpatialOrder(own), options, progress);
    return runWhole(own, options, progress);
}

/// Takes the grids of a part, which get its name.
void addGrids(MolecularSurface& part, const std::string& suffix, MolecularSurface& whole)
{
    if (part.surface) {
        part.surface->setName("surface" + suffix);
        whole.fields.push_back(part.surface);
    }
    for (const auto& field : part.fields) {
        field->setName(field->getName() + suffix);
        whole.fields.push_back(field);
    }
    for (const auto& field : part.shown) {
        field->setName(field->getName() + suffix);
        whole.shown.push_back(field);
    }
}

/// Adds what the borders of a unit's part have. Its vertices come behind those before.
void addBorders(const MolecularSurface& part, MolecularSurface& whole)
{
    const auto before = std::uint32_t(whole.mesh.positions.size());
    for (MolecularSurface::SharedVertex shared : part.shared) {
        shared.vertex += before;
        shared.other += before;
        whole.shared.push_back(shared);
    }
    const auto& found = part.report.symmetry;
    auto& sum = whole.report.symmetry;
    if (!found) return;
    if (!sum) {
        sum = found;
        return;
    }
    sum->gap = std::max(sum->gap, found->gap);
    sum->openVertices += found->openVertices;
}

} // namespace

MolecularSurface runParts(const BallSet& atoms, const SurfaceOptions& options, Progress& progress)
{
    const std::vector<Part> parts = partsOf(atoms, options);
    const BallSet all = colored(atoms, options.color, progress);
    MolecularSurface whole;
    std::set<std::string> names;
    std::size_t done = 0; // balls
    for (const Part& part : parts) {
        progress.update("parts", double(done) / double(atoms.balls.size()));
        done += part.balls.size();
        QuietProgress quiet(progress);
        MolecularSurface result;
        try {
            const BallSet own = ballsOf(part, all);
            checkBalls(own.balls, options, Pieces::One, availableMemory());
            SurfaceOptions ofPart{ofKind(options, part.kind), options};
            ofPart.needs.levelSet = true; // a field of the whole
            result = runPart(own, ofPart, quiet);
            result.report.atoms = own.whole();
        } catch (const Error& e) {
            throw Error(e, part.name + ": " + e.what());
        }
        const std::string suffix = "_" + gridName(part.name, names);
        addGrids(result, suffix, whole);
        addBorders(result, whole);
        append(whole.mesh, result.mesh, part.name);
        whole.report += named(part.name, std::move(result.report));
    }
    colorByCurvature(options.color, atoms.coloring, whole.mesh);
    std::vector<SurfaceReport::Cavity>& cavities = whole.report.surface.cavities;
    std::stable_sort(cavities.begin(), cavities.end(),
                     [](const SurfaceReport::Cavity& a, const SurfaceReport::Cavity& b) {
                         return a.volume > b.volume;
                     });
    if (!options.needs.statistics) return whole;
    const std::vector<float> areas = vertexAreas(whole.mesh, progress);
    SurfaceReport& surface = whole.report.surface; // the first scalars are H and K
    surface.meanCurvature = statistics(whole.mesh.scalars[0].values, areas);
    surface.gaussianCurvature = statistics(whole.mesh.scalars[1].values, areas);
    return whole;
}

} // namespace molsurf
