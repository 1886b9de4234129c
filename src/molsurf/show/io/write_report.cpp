// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_report.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace molsurf
{

namespace
{

using Json = nlohmann::ordered_json;

Json statisticsJson(const Statistics& statistics)
{
    Json percentiles = Json::object();
    for (std::size_t i = 0; i < percents.size(); ++i)
        percentiles[std::to_string(percents[i])] = statistics.percentiles[i];
    return {{"mean", statistics.mean},
            {"standard_deviation", statistics.standardDeviation},
            {"min", statistics.min},
            {"max", statistics.max},
            {"percentiles", std::move(percentiles)}};
}

Json shapeJson(const SurfaceReport::Shape& shape, std::size_t triangles)
{
    const double all = std::max(1.0, double(triangles));
    return {{"least_angle", shape.leastAngle},
            {"share_below_20", double(shape.below20) / all},
            {"share_below_28", double(shape.below28) / all},
            {"shortest_edge", shape.shortestEdge},
            {"longest_edge", shape.longestEdge},
            {"kept_pieces", shape.keptPieces},
            {"euler_characteristics", shape.eulerNumbers}};
}

Json surfaceJson(const SurfaceReport& surface)
{
    Json cavities = Json::array();
    for (const SurfaceReport::Cavity& cavity : surface.cavities)
        cavities.push_back(Json{{"area", cavity.area}, {"volume", cavity.volume}});
    const auto& integrals = surface.integrals;
    const auto known = [&](const Json& value) { return surface.piecesKnown ? value : Json(); };
    const auto total = [&](double SurfaceIntegrals::*value) {
        return integrals ? Json((*integrals).*value) : Json();
    };
    return {{"kind", surface.kind},
            {"area", surface.area},
            {"volume", surface.volume},
            {"euler_characteristic",
             surface.eulerCharacteristic ? Json(*surface.eulerCharacteristic) : Json()},
            {"mesh_euler_characteristic", surface.meshEulerCharacteristic},
            {"components", known(surface.components)},
            {"cavities", known(surface.cavities.size())},
            {"outer_area", known(surface.outerArea)},
            {"outer_volume", known(surface.outerVolume)},
            {"cavity_list", known(std::move(cavities))},
            {"vertices", surface.vertices},
            {"triangles", surface.triangles},
            {"closed", surface.closed},
            {"manifold", surface.manifold},
            {"degenerate_triangles", surface.degenerateTriangles},
            {"max_residual", surface.maxResidual},
            {"gradient_share", surface.gradientShare},
            {"kink_share", surface.kinkShare},
            {"mesh_area", surface.meshArea ? Json(*surface.meshArea) : Json()},
            {"triangle_area", surface.triangleArea ? Json(*surface.triangleArea) : Json()},
            {"mesh_components", surface.meshComponents},
            {"mesh_volume", surface.meshVolume ? Json(*surface.meshVolume) : Json()},
            {"mesh_shape", surface.shape ? shapeJson(*surface.shape, surface.triangles) : Json()},
            {"cusp_length", surface.cuspLength ? Json(*surface.cuspLength) : Json()},
            {"mean_curvature", statisticsJson(surface.meanCurvature)},
            {"gaussian_curvature", statisticsJson(surface.gaussianCurvature)},
            {"total_mean_curvature", total(&SurfaceIntegrals::meanCurvature)},
            {"total_gaussian_curvature", total(&SurfaceIntegrals::gaussianCurvature)},
            {"willmore_energy", total(&SurfaceIntegrals::squaredMeanCurvature)},
            {"integrated_area", total(&SurfaceIntegrals::area)},
            {"integrated_volume", total(&SurfaceIntegrals::volume)},
            {"unresolved_area", total(&SurfaceIntegrals::unresolvedArea)}};
}

Json gapsJson(const std::optional<EvolutionReport::Gaps>& gaps)
{
    if (!gaps) return {};
    Json out = {{"found", gaps->found}, {"closed", gaps->closed}, {"nearest", gaps->nearest}};
    if (gaps->closedByField) {
        out["closed_by_field"] = *gaps->closedByField;
        out["widest_closed"] = gaps->widestClosed;
        out["opens_below"] = gaps->opensBelow;
    }
    return out;
}

Json evolutionJson(const EvolutionReport& evolution)
{
    return {
        {"steps", evolution.steps},
        {"converged", evolution.converged},
        {"energy", evolution.energy},
        {"mean_displacement", evolution.meanDisplacement},
        {"max_speed", evolution.maxSpeed},
        {"final_energy", evolution.finalEnergy},
        {"displacement_rms", evolution.displacementRms},
        {"displacement_tail", evolution.displacementTail},
        {"area_error", evolution.areaError},
        {"unsettled_share", evolution.unsettledShare},
        {"crevice_voxels", evolution.energy.empty() ? Json() : Json(evolution.unresolvedGapVoxels)},
        {"front_steps", evolution.frontSteps},
        {"restless_fronts", evolution.restlessFronts},
        {"gaps", gapsJson(evolution.gaps)},
        {"walls", gapsJson(evolution.walls)},
        {"area", evolution.area},
        {"volume", evolution.volume}};
}

Json groupsJson(const std::vector<Report::Group>& groups)
{
    Json out = Json::array();
    for (const Report::Group& g : groups) {
        Json entry = {{"name", g.name}, {"atoms", g.atoms}, {"area", g.area}, {"volume", g.volume}};
        if (!g.color.empty()) entry["color"] = g.color;
        if (g.aloneArea) entry["alone_area"] = *g.aloneArea;
        out.push_back(std::move(entry));
    }
    return out;
}

Json interfacesJson(const std::vector<Report::Interface>& interfaces)
{
    Json out = Json::array();
    for (const Report::Interface& i : interfaces) {
        out.push_back(Json{{"groups", {i.first, i.second}},
                           {"buried_area", i.area},
                           {"count", i.count},
                           {"shape_complementarity", i.fit.shape},
                           {"median_distance", i.fit.distance},
                           {"gap_volume", i.fit.gapVolume},
                           {"gap_index", i.fit.gapIndex},
                           {"contact_areas", i.fit.contact}});
    }
    return out;
}

Json pocketJson(const Report::Pockets::Pocket& pocket)
{
    Json mouths = Json::array();
    for (const Report::Pockets::Pocket::Mouth& mouth : pocket.mouths)
        mouths.push_back(
            Json{{"area", mouth.area}, {"radius", mouth.radius}, {"center", mouth.place}});
    return {
        {"volume", pocket.volume},     {"area", pocket.area},     {"depth", pocket.depth},
        {"radius", pocket.radius},     {"center", pocket.centre}, {"open", pocket.open},
        {"mouths", std::move(mouths)}, {"rank", pocket.rank},     {"neighbors", pocket.neighbours}};
}

Json pocketsJson(const Report::Pockets& pockets)
{
    Json list = Json::array();
    for (const Report::Pockets::Pocket& pocket : pockets.list) list.push_back(pocketJson(pocket));
    return {{"probe_in", pockets.probeIn}, {"probe_out", pockets.probeOut},
            {"cut", pockets.cut},          {"neck", pockets.neck},
            {"voxel", pockets.voxel},      {"list", std::move(list)}};
}

/// What is known of the stations of a way.
Json stationsJson(const std::vector<Report::Pore::Station>& stations)
{
    Json necks = Json::array(), distances = necks, radii = necks, centers = necks;
    for (const Report::Pore::Station& s : stations) {
        distances.push_back(s.distance);
        radii.push_back(s.radius);
        centers.push_back(s.place);
        if (s.isBottleneck)
            necks.push_back(
                Json{{"center", s.place}, {"distance", s.distance}, {"radius", s.radius}});
    }
    return {{"bottlenecks", std::move(necks)},
            {"profile",
             {{"distance", std::move(distances)},
              {"radius", std::move(radii)},
              {"center", std::move(centers)}}}};
}

/// A pore without the others of its bundle.
Json onePoreJson(const Report::Pore& pore)
{
    const std::optional<double> conductance = pore.conductance();
    Json out = {{"axis", pore.axis},
                {"crossed", pore.crossed},
                {"length", pore.length()},
                {"radius", pore.narrowest()},
                {"conductance", conductance ? Json(*conductance) : Json()},
                {"resistivity", Report::Pore::bulkResistivity}};
    out.update(stationsJson(pore.stations));
    return out;
}

Json poreJson(const Report::Pore& pore)
{
    Json out = onePoreJson(pore), bundle = Json::array(), others = bundle;
    for (const Report::Pore& other : pore.bundle) bundle.push_back(onePoreJson(other));
    for (const Report::Pore::Way& way : pore.others)
        others.push_back(Json{{"radius", way.radius}, {"center", way.place}});
    out["bundle"] = std::move(bundle);
    out["others"] = std::move(others);
    return out;
}

Json tunnelsJson(const Report::Tunnels& tunnels)
{
    Json list = Json::array();
    for (const Report::Tunnels::Tunnel& tunnel : tunnels.list) {
        Json one = {{"number", tunnel.number},
                    {"radius", tunnel.narrowest().radius},
                    {"center", tunnel.narrowest().place},
                    {"length", tunnel.length()},
                    {"curvature", tunnel.curvature()}};
        one.update(stationsJson(tunnel.stations));
        list.push_back(std::move(one));
    }
    return {{"start", {{"center", tunnels.start}, {"radius", tunnels.startRadius}}},
            {"probe", tunnels.probe},
            {"probe_out", tunnels.probeOut},
            {"list", std::move(list)}};
}

Json partsJson(const std::vector<Report::Part>& parts)
{
    Json out = Json::array();
    for (const Report::Part& part : parts) {
        out.push_back(Json{
            {"name", part.name}, {"atoms", part.atoms}, {"surface", surfaceJson(part.surface)}});
    }
    return out;
}

Json resolutionJson(const std::vector<Report::Resolution>& resolutions)
{
    Json out = Json::array();
    for (const Report::Resolution& r : resolutions) {
        out.push_back(Json{{"selection", r.select.empty() ? "all" : r.select},
                           {"resolution", r.resolution},
                           {"atoms", r.atoms},
                           {"level", r.level}});
    }
    return out;
}

Json instancesJson(const std::vector<Report::Copy>& instances)
{
    Json out = Json::array();
    for (const Report::Copy& i : instances)
        out.push_back(Json{{"part", i.part}, {"operator", i.name}, {"matrix", i.matrix}});
    return out;
}

Json symmetryJson(const Report::Symmetry& s)
{
    return {{"point_group", s.pointGroup}, {"order", s.order}, {"copies_in_unit", s.copies},
            {"deviation", s.deviation},    {"gap", s.gap},     {"open_vertices", s.openVertices}};
}

Json tableJson(const Table& table)
{
    Json out = Json::array();
    for (const Table::Column& column : table.columns) {
        std::visit(
            [&](const auto& values) {
                for (std::size_t row = 0; row < values.size(); ++row) {
                    if (row == out.size()) out.push_back(Json::object());
                    out[row][column.name] = values[row];
                }
            },
            column.values);
    }
    return out;
}

Json tablesJson(const std::vector<Table>& tables)
{
    Json out = Json::object();
    for (const Table& table : tables) out[table.name] = tableJson(table);
    return out;
}

/// Sets the keys that only a mesh has to null.
void dropMesh(Json& surface)
{
    for (const char* name :
         {"mesh_euler_characteristic", "mesh_components", "triangle_area", "closed", "manifold",
          "degenerate_triangles", "max_residual", "gradient_share", "kink_share", "mesh_shape",
          "mean_curvature", "gaussian_curvature"})
        surface[name] = nullptr;
}

Json orNull(const std::string& text)
{
    return text.empty() ? Json() : Json(text);
}

Json coarseJson(const Report::Coarse& coarse)
{
    return {{"beads", coarse.beads}, {"atoms", coarse.atoms}};
}

} // namespace

std::string reportText(const Report& report)
{
    Json seconds = Json::object();
    for (const auto& [stage, time] : report.seconds) seconds[stage] = time;

    Json json = {
        {"schema", reportSchema},
        {"program", report.program},
        {"version", report.version},
        {"commit", orNull(report.commit)},
        {"options_sha256", orNull(report.options)},
        {"command", report.command},
        {"input", report.input},
        {"input_sha256", orNull(report.inputSha256)},
        {"atoms", report.atoms},
        {"voxel", report.voxel},
        {"center", report.center ? Json(*report.center) : Json()},
        {"surface", surfaceJson(report.surface)},
        {"coarse", report.coarse ? coarseJson(*report.coarse) : Json()},
        {"resolution", resolutionJson(report.resolutions)},
        {"evolution", report.evolution ? evolutionJson(*report.evolution) : Json()},
        {"grid", {{"active_voxels", report.activeVoxels}, {"bytes", report.gridBytes}}},
        {"seconds", std::move(seconds)},
        {"peak_memory_bytes", report.peakMemoryBytes},
        {"threads", report.threads},
        {"groups", groupsJson(report.groups)},
        {"areas_of", orNull(report.areasOf)},
        {"polar_area", report.polarArea ? Json(*report.polarArea) : Json()},
        {"apolar_area", report.apolarArea ? Json(*report.apolarArea) : Json()},
        {"interfaces", interfacesJson(report.interfaces)},
        {"pockets", report.pockets ? pocketsJson(*report.pockets) : Json()},
        {"pore", report.pore ? poreJson(*report.pore) : Json()},
        {"tunnels", report.tunnels ? tunnelsJson(*report.tunnels) : Json()},
        {"parts", partsJson(report.parts)},
        {"instances", instancesJson(report.instances)},
        {"symmetry", report.symmetry ? symmetryJson(*report.symmetry) : Json()},
        {"warnings", report.warnings},
    };
    if (report.voxel == 0.0) json["voxel"] = nullptr;
    if (report.surface.triangles == 0) dropMesh(json["surface"]);
    for (const auto& [name, value] : report.measures) json["measures"][name] = value;
    if (!report.tables.empty()) json["areas"] = tablesJson(report.tables);
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void writeReport(const Report& report, OutputFile& file)
{
    file.write(reportText(report));
    file.finish();
}

} // namespace molsurf
