// SPDX-License-Identifier: MPL-2.0
#include "msms/surface.h"

#include "molsurf/kernel/balls/ball_boundary.h"
#include "molsurf/kernel/balls/boundary_measure.h"
#include "molsurf/kernel/balls/boundary_point.h"
#include "molsurf/kernel/balls/excluded_measure.h"
#include "molsurf/kernel/balls/nearest_ball.h"
#include "molsurf/kernel/core/disjoint_sets.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/kernel/mesh/simplify.h"
#include "molsurf/kernel/mesh/topology.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/surface.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace molsurf::msms
{

using openvdb::Vec3d;
using openvdb::Vec3f;

namespace
{

constexpr std::uint32_t none = ~std::uint32_t(0);

/// The edge of voxels that give more vertices than are wanted [Å].
double voxelFor(const std::vector<Ball>& balls, double probe, double density)
{
    // The mesher makes 3/2 vertices a square voxel, on the average of all directions.
    const double byDensity = 0.9 * std::sqrt(1.5 / density);
    // A probe of 2.5 voxels shows the crevices between atoms.
    const double byProbe = std::clamp(0.4 * probe, 0.2, 0.6);
    const double largest =
        double(std::max_element(balls.begin(), balls.end(), [](auto& a, auto& b) {
                   return a.radius < b.radius;
               })->radius);
    return std::max(minVoxel, std::min({byDensity, byProbe, 0.4 * largest}));
}

/// The analytical surface.
struct Exact {
    const BallBoundary boundary; ///< of the solvent-accessible surface
    const BoundaryMeasure measure;
    const BoundaryPoints points;
    const double probe;

    Exact(const std::vector<Ball>& balls, double probeRadius, const Progress& progress)
        : boundary(ballBoundary(balls, probeRadius, progress)),
          measure(measureBoundary(boundary, progress)), points(boundary), probe(probeRadius)
    {
    }

    BoundaryPoint nearest(const Vec3d& x) const { return points.nearest(x, probe + 0.25); }

    Face faceOf(const BoundaryPoint& point) const
    {
        std::size_t number = point.index + 1;
        if (point.part != BoundaryPart::Patch) number += boundary.patches.size();
        if (point.part == BoundaryPart::Corner) number += boundary.arcs.size();
        // Without a probe there are no re-entrant faces.
        const FaceKind kind = point.part == BoundaryPart::Patch || probe == 0.0 ? FaceKind::Contact
                              : point.part == BoundaryPart::Arc                 ? FaceKind::Toric
                                                                : FaceKind::Spherical;
        return {kind, std::uint32_t(number)};
    }

    /// Moves a vertex x onto the surface, to the distance of the probe radius from the nearest
    /// point y of the boundary: y + probe (x - y)/|x - y|, again while that has another nearest
    /// point. Without a probe it is not moved.
    /// @return what it then is nearest to
    BoundaryPoint place(Vec3f& position, Vec3f& normal) const
    {
        constexpr int most = 4;        // moves; more than one only where faces intersect
        constexpr double close = 1e-9; // [Å]
        Vec3d x(position);
        BoundaryPoint point = nearest(x);
        if (probe == 0.0) return point; // the surface has sharp creases, and the mesh rounds them
        for (int n = 0; n < most; ++n) {
            const Vec3d inward = x - point.position;
            const double length = inward.length();
            if (length == 0.0 || std::abs(length - probe) < close) break;
            x = point.position + probe / length * inward;
            point = nearest(x);
        }
        position = Vec3f(x);
        Vec3d outward = point.position - x;
        if (outward.normalize()) normal = Vec3f(outward);
        return point;
    }
};

/// Moves all vertices onto the surface, but those whose triangles would turn: where faces meet in a
/// crease that the voxels do not resolve.
std::vector<BoundaryPoint> placeVertices(const Exact& exact, Mesh& mesh, const Progress& progress)
{
    const std::vector<Vec3f> before = mesh.positions;
    std::vector<BoundaryPoint> points(mesh.positions.size());
    parallelFor(points.size(), progress, [&](std::size_t v) {
        points[v] = exact.place(mesh.positions[v], mesh.normals[v]);
    });
    const auto normalOf = [](const std::vector<Vec3f>& x, const std::array<std::uint32_t, 3>& t) {
        const Vec3d first(x[t[0]]);
        return (Vec3d(x[t[1]]) - first).cross(Vec3d(x[t[2]]) - first);
    };
    // A vertex that goes back may turn triangles of its neighbours.
    for (bool again = true; again;) {
        std::vector<std::uint32_t> back;
        for (const auto& t : mesh.triangles) {
            const Vec3d old = normalOf(before, t), now = normalOf(mesh.positions, t);
            constexpr double steepest = 0.3; // cosine of the largest turn
            if (old.dot(now) > steepest * old.length() * now.length()) continue;
            for (const std::uint32_t v : t)
                if (mesh.positions[v] != before[v]) back.push_back(v);
        }
        again = !back.empty();
        for (const std::uint32_t v : back) mesh.positions[v] = before[v];
    }
    return points;
}

/// How the vertices of the mesh and the pieces of the solvent-accessible surface are shared out
/// among components. Two pieces whose probes overlap have one component: they wash one void.
struct Shares {
    std::size_t count = 0;
    std::vector<std::uint32_t> ofVertex, ofPiece; ///< none: in no component
};

/// Finds the components by union-find over pieces of the mesh and of the boundary: a vertex joins
/// its piece to that of the boundary's part that it is nearest to.
/// @param[in] points  nearest to the vertices
Shares sharesOf(const Mesh& mesh, const std::vector<BoundaryPoint>& points, const Exact& exact,
                const Progress& progress)
{
    // A patch determines a piece if all of its faces lie on that one.
    const BoundaryMeasure& measure = exact.measure;
    constexpr std::int32_t unknown = -1, several = -2;
    std::vector<std::int32_t> ofPatch(exact.boundary.patches.size(), unknown);
    for (const BoundaryFace& face : measure.faces) {
        std::int32_t& piece = ofPatch[face.patch];
        piece = piece == unknown || piece == face.piece ? face.piece : several;
    }
    std::size_t meshPieces = 0;
    const std::vector<std::uint32_t> meshPiece = connectedPieces(mesh, meshPieces, progress);
    const std::vector<std::int32_t> ofCorner = cornerPieces(exact.boundary, exact.measure);
    const std::size_t size = meshPieces + measure.pieces.size();
    DisjointSets sets(size);
    std::vector<char> known(size, 0);
    for (std::size_t v = 0; v < points.size(); ++v) {
        const std::uint32_t i = points[v].index;
        const std::int32_t piece = points[v].part == BoundaryPart::Patch ? ofPatch[i]
                                   : points[v].part == BoundaryPart::Arc ? measure.arcPieces[i]
                                                                         : ofCorner[i];
        if (piece < 0) continue;
        const auto other = std::uint32_t(meshPieces) + std::uint32_t(piece);
        sets.join(meshPiece[v], other);
        known[meshPiece[v]] = known[other] = 1;
    }
    // Numbers for the known ones only.
    Shares out;
    std::vector<std::uint32_t> numbers(size, none);
    const auto shareOf = [&](std::uint32_t i) {
        if (!known[i]) return none;
        std::uint32_t& number = numbers[sets.find(i)];
        if (number == none) number = std::uint32_t(out.count++);
        return number;
    };
    for (std::size_t v = 0; v < points.size(); ++v) out.ofVertex.push_back(shareOf(meshPiece[v]));
    for (std::size_t p = 0; p < measure.pieces.size(); ++p)
        out.ofPiece.push_back(shareOf(std::uint32_t(meshPieces + p)));
    return out;
}

/// The vertices and triangles of each component.
/// @param[in] balls      that vertices are nearest to
/// @param[out] pointsOf  of the vertices of each component
std::vector<Component> componentsOf(const Mesh& mesh, const std::vector<BoundaryPoint>& points,
                                    const std::vector<std::int32_t>& balls, const Shares& shares,
                                    std::vector<std::vector<BoundaryPoint>>& pointsOf)
{
    std::vector<Component> components(shares.count);
    std::vector<std::uint32_t> number(points.size(), none);
    for (std::size_t v = 0; v < points.size(); ++v) {
        const std::uint32_t share = shares.ofVertex[v];
        if (share == none) continue;
        Component& component = components[share];
        number[v] = std::uint32_t(component.mesh.positions.size());
        component.mesh.positions.push_back(mesh.positions[v]);
        component.mesh.normals.push_back(mesh.normals[v]);
        component.balls.push_back(balls[v]);
        pointsOf[share].push_back(points[v]);
    }
    for (const auto& t : mesh.triangles) {
        if (number[t[0]] == none) continue;
        components[shares.ofVertex[t[0]]].mesh.triangles.push_back(
            {number[t[0]], number[t[1]], number[t[2]]});
    }
    return components;
}

/// Area and volume of a mesh with curved triangles.
void measureMesh(Component& component, const Progress& progress)
{
    const Mesh& mesh = component.mesh;
    const std::vector<std::uint32_t> onePiece(mesh.positions.size(), 0);
    TriangleSums ignored;
    const PieceMeasure sum =
        measurePieces(mesh, onePiece, 1, Vec3d(mesh.positions[0]), ignored, progress)[0];
    component.meshArea = sum.area;
    component.volume = sum.volume;
}

/// Adds the areas, in closed form, of what probes touch whose centres lie on some pieces of the
/// solvent-accessible surface, and what each ball has of them.
/// @param[in,out] areasOf  one a piece; null: it is left out, and probes there cut nothing off
void addAreas(const Exact& exact, const std::vector<Areas*>& areasOf, MsmsSurface& out,
              const Progress& progress)
{
    BoundaryMeasure measure = exact.measure;
    const auto leaveOut = [&](std::int32_t& piece) {
        if (piece >= 0 && !areasOf[std::size_t(piece)]) piece = -1;
    };
    for (BoundaryFace& face : measure.faces) leaveOut(face.piece);
    for (std::int32_t& piece : measure.arcPieces) leaveOut(piece);

    for (const BoundaryFace& face : measure.faces) {
        if (face.piece < 0) continue;
        Areas& areas = *areasOf[std::size_t(face.piece)];
        const std::int32_t ball = exact.boundary.patches[face.patch].ball;
        const auto index = std::size_t(exact.boundary.balls[std::size_t(ball)].index);
        areas.accessible += face.area;
        out.accessibleOf[index] += face.area;
        if (exact.probe > 0.0) continue;
        areas.contact += face.area;
        out.excludedOf[index] += face.area;
    }
    if (exact.probe == 0.0) return;
    const ExcludedMeasure excluded =
        measureExcluded(exact.boundary, measure, exact.probe, true, progress);
    for (std::size_t p = 0; p < areasOf.size(); ++p) {
        if (!areasOf[p]) continue;
        areasOf[p]->contact += excluded.areasByCentre[p].contact;
        areasOf[p]->toric += excluded.areasByCentre[p].toric;
        areasOf[p]->spherical += excluded.areasByCentre[p].concave;
    }
    const std::vector<double> ofBalls =
        areasOfBalls(exact.boundary, excluded, out.excludedOf.size());
    for (std::size_t n = 0; n < ofBalls.size(); ++n) out.excludedOf[n] += ofBalls[n];
}

/// Keeps some of the vertices of a component, and finds the faces of what is left.
void thinComponent(const Exact& exact, const std::vector<BoundaryPoint>& points, double density,
                   Component& component, const Progress& progress)
{
    const auto wanted = std::size_t(std::lround(density * component.meshArea));
    ThinnedMesh thin = thinned(component.mesh, wanted, progress);
    Mesh mesh;
    std::vector<std::int32_t> balls;
    for (const std::uint32_t v : thin.vertices) {
        mesh.positions.push_back(component.mesh.positions[v]);
        mesh.normals.push_back(component.mesh.normals[v]);
        component.vertexFaces.push_back(exact.faceOf(points[v]));
        balls.push_back(component.balls[v]);
    }
    mesh.triangles = std::move(thin.triangles);
    component.triangleFaces.resize(mesh.triangles.size());
    parallelFor(mesh.triangles.size(), progress, [&](std::size_t t) {
        Vec3d centre(0.0);
        for (const std::uint32_t v : mesh.triangles[t]) centre += Vec3d(mesh.positions[v]) / 3.0;
        component.triangleFaces[t] = exact.faceOf(exact.nearest(centre));
    });
    component.mesh = std::move(mesh);
    component.balls = std::move(balls);
}

} // namespace

SurfaceOptions meshOptions(const std::vector<Ball>& balls, double probe, double density)
{
    SurfaceOptions options;
    options.kind = SurfaceKind::SolventExcluded;
    options.probe = probe;
    options.voxel = voxelFor(balls, probe, density);
    options.meshLabels = false;
    return options;
}

MsmsSurface msmsSurface(const std::vector<Ball>& balls, double probe, double density, bool all,
                        Progress& progress)
{
    Mesh mesh = std::move(makeSurface(balls, meshOptions(balls, probe, density), &progress).mesh);

    const Exact exact(balls, probe, progress);
    const std::vector<BoundaryPoint> points = placeVertices(exact, mesh, progress);
    const Shares shares = sharesOf(mesh, points, exact, progress);
    const std::vector<std::int32_t> nearest =
        nearestBalls(balls, mesh.positions, probe + 1.0, progress);

    std::vector<std::vector<BoundaryPoint>> pointsOf(shares.count);
    std::vector<Component> components = componentsOf(mesh, points, nearest, shares, pointsOf);
    mesh = Mesh();

    std::vector<char> outer(components.size(), 0);
    for (std::size_t p = 0; p < exact.measure.pieces.size(); ++p)
        if (shares.ofPiece[p] != none && exact.measure.pieces[p].outer)
            outer[shares.ofPiece[p]] = 1;
    std::size_t first = components.size();
    for (std::size_t n = 0; n < components.size(); ++n) {
        measureMesh(components[n], progress);
        if (outer[n] &&
            (first == components.size() || components[n].meshArea > components[first].meshArea))
            first = n;
    }
    if (first == components.size()) return {};

    MsmsSurface out;
    out.excludedOf.resize(balls.size());
    out.accessibleOf.resize(balls.size());
    const std::vector<BoundaryPiece>& pieces = exact.measure.pieces;
    std::vector<Areas*> areasOf(pieces.size(), nullptr), othersOf = areasOf;
    out.joined.reserve(pieces.size()); // its members stay where they are
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const std::uint32_t share = shares.ofPiece[p];
        if (share == none) continue;
        const bool isJoined = outer[share] && !pieces[p].outer;
        if (share == first && !isJoined)
            areasOf[p] = &components[first].areas;
        else if (all)
            othersOf[p] = isJoined ? &out.joined.emplace_back() : &components[share].areas;
    }
    addAreas(exact, areasOf, out, progress);
    if (all) addAreas(exact, othersOf, out, progress);
    std::vector<std::size_t> order{first};
    for (std::size_t n = 0; all && n < components.size(); ++n)
        if (n != first) order.push_back(n);
    std::stable_sort(order.begin() + 1, order.end(), [&](std::size_t a, std::size_t b) {
        return components[a].areas.excluded() > components[b].areas.excluded();
    });
    for (const std::size_t n : order) {
        thinComponent(exact, pointsOf[n], density, components[n], progress);
        out.components.push_back(std::move(components[n]));
    }
    return out;
}

} // namespace molsurf::msms
