// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_comparison.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/show/io/write_mesh.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>

namespace molsurf
{

namespace
{

using Json = nlohmann::ordered_json;

template<typename T>
Json orNull(const std::optional<T>& value)
{
    return value ? Json(*value) : Json();
}

std::optional<double> ratio(std::optional<double> a, std::optional<double> b)
{
    if (!a || !b || *b == 0.0) return std::nullopt;
    return *a / *b;
}

Json operandJson(const ComparedFile& operand)
{
    return {{"input", operand.input},
            {"kind", operand.kind},
            {"atoms", operand.atoms ? Json(operand.atoms) : Json()},
            {"voxel", operand.voxel > 0.0 ? Json(operand.voxel) : Json()},
            {"area", operand.area},
            {"volume", orNull(operand.volume)},
            {"vertices", operand.vertices},
            {"triangles", operand.triangles},
            {"closed", operand.closed}};
}

Json oneWayJson(const Comparison::OneWay& way)
{
    return {{"mean", way.mean},
            {"rms", way.rms},
            {"max", way.max},
            {"max_at", {way.maxAt[0], way.maxAt[1], way.maxAt[2]}},
            {"mean_signed", orNull(way.meanSigned)},
            {"inside", orNull(way.inside)},
            {"samples", way.samples}};
}

/// The motion of B: its matrix acts on columns (x, y, z, 1) [Å].
Json motionJson(const std::optional<Superposition>& motion)
{
    if (!motion) return {};
    Json matrix = Json::array();
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& row = motion->rotation[i];
        matrix.push_back({row[0], row[1], row[2], motion->translation[int(i)]});
    }
    matrix.push_back({0.0, 0.0, 0.0, 1.0});
    return {{"atoms", motion->pairs}, {"rmsd", motion->rmsd}, {"matrix", std::move(matrix)}};
}

Json colorJson(const ComparisonReport& report)
{
    const ColorScale& color = report.color;
    Json bar = Json::array();
    for (std::size_t i = 0; i < color.stops.size(); ++i)
        bar.push_back(Json{{"value", color.valueOf(i)}, {"color", color.stops[i]}});
    return {{"attribute", report.shown},
            {"map", color.map},
            {"low", color.low},
            {"high", color.high},
            {"bar", std::move(bar)}};
}

std::string cell(std::optional<double> value, const char* form)
{
    if (!value) return "-";
    return formatted(form, *value);
}

void row(std::string& table, const std::string& name, const std::vector<std::string>& cells)
{
    std::string line = name;
    std::size_t column = 24;
    for (const std::string& text : cells) {
        // Right-aligned; Å is two bytes of a name only.
        column += 14;
        const std::size_t extra = name.find("Å") == std::string::npos ? 0 : 1;
        const std::size_t width = column + extra;
        line.resize(std::max(line.size() + 1, width - std::min(width, text.size())), ' ');
        line += text;
    }
    table += line + "\n";
}

} // namespace

std::string comparisonText(const ComparisonReport& report)
{
    Json seconds = Json::object();
    for (const auto& [stage, time] : report.seconds) seconds[stage] = time;
    const Json json = {
        {"program", report.program},
        {"version", report.version},
        {"command", report.command},
        {"a", operandJson(report.a)},
        {"b", operandJson(report.b)},
        {"a_to_b", oneWayJson(report.distances.aToB)},
        {"b_to_a", oneWayJson(report.distances.bToA)},
        {"hausdorff", report.distances.hausdorff},
        {"superposition", motionJson(report.superposition)},
        {"area_ratio", orNull(ratio(report.a.area, report.b.area))},
        {"volume_ratio", orNull(ratio(report.a.volume, report.b.volume))},
        {"color", colorJson(report)},
        {"seconds", std::move(seconds)},
        {"peak_memory_bytes", report.peakMemoryBytes},
        {"threads", report.threads},
        {"warnings", report.warnings},
    };
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void writeComparison(const ComparisonReport& report, OutputFile& file)
{
    file.write(comparisonText(report));
    file.finish();
}

std::string comparisonTable(const ComparisonReport& report)
{
    const Comparison::OneWay &there = report.distances.aToB, &back = report.distances.bToA;
    std::string table;
    row(table, "distance [Å]", {"A to B", "B to A"});
    const auto distances = [&](const char* name, std::optional<double> a, std::optional<double> b) {
        row(table, name, {cell(a, "%.5f"), cell(b, "%.5f")});
    };
    distances("  mean", there.mean, back.mean);
    distances("  mean, signed", there.meanSigned, back.meanSigned);
    distances("  RMS", there.rms, back.rms);
    distances("  max", there.max, back.max);
    row(table, "  Hausdorff", {cell(report.distances.hausdorff, "%.5f")});
    row(table, "", {"A", "B", "A/B"});
    row(table, "area [Å^2]",
        {cell(report.a.area, "%.2f"), cell(report.b.area, "%.2f"),
         cell(ratio(report.a.area, report.b.area), "%.5f")});
    row(table, "volume [Å^3]",
        {cell(report.a.volume, "%.2f"), cell(report.b.volume, "%.2f"),
         cell(ratio(report.a.volume, report.b.volume), "%.5f")});
    return table;
}

namespace
{

/// The distance that 99 % of the vertices do not exceed; at least a thousandth of an Å, below which
/// differences are rounding.
double usualRange(const std::vector<float>& distances)
{
    constexpr double share = 0.99, least = 1e-3;
    std::vector<float> sorted = distances;
    const auto place = sorted.begin() + std::ptrdiff_t(share * double(sorted.size() - 1));
    std::nth_element(sorted.begin(), place, sorted.end());
    return std::max(double(*place), least);
}

std::string shortestFloat(double value)
{
    char digits[32];
    return std::string(digits, std::to_chars(digits, digits + sizeof digits, float(value)).ptr);
}

/// Comments of the mesh file on its colours.
std::vector<std::string> colorComments(const ComparisonReport& report)
{
    const ColorScale& color = report.color;
    std::vector<std::string> lines = {"colors: " + report.shown + " in Angstrom, map " + color.map +
                                      " from " + shortestFloat(color.low) + " to " +
                                      shortestFloat(color.high)};
    for (std::size_t i = 0; i < color.stops.size(); ++i) {
        std::string line = "color " + shortestFloat(color.valueOf(i));
        for (const std::uint8_t part : color.stops[i]) line += " " + std::to_string(int(part));
        lines.push_back(line);
    }
    return lines;
}

} // namespace

void chooseColors(bool bySign, double range, const std::string& palette, ComparisonReport& report)
{
    const double end = range > 0.0 ? range : usualRange(report.distances.aToB.distance);
    report.shown = bySign ? "signed_distance" : "distance";
    const std::string preset = bySign ? "RdBu" : "OrRd";
    report.color = scaleOf(palette.empty() ? preset : palette, bySign ? -end : 0.0, end);
}

Mesh comparisonMesh(const Mesh& a, const ComparisonReport& report)
{
    const Comparison::OneWay& there = report.distances.aToB;
    const bool bySign = report.shown == "signed_distance";
    Mesh mesh = a;
    for (const float value : bySign ? there.signedDistance : there.distance)
        mesh.colors.push_back(report.color.at(value));
    mesh.scalars.insert(mesh.scalars.begin(), {"distance", there.distance});
    if (!there.signedDistance.empty())
        mesh.scalars.insert(mesh.scalars.begin() + 1, {"signed_distance", there.signedDistance});
    return mesh;
}

Legend comparisonLegend(const ComparisonReport& report)
{
    const bool bySign = report.shown == "signed_distance";
    return {bySign ? "Signed distance" : "Distance",
            bySign ? "signed-distance" : "distance",
            report.shown,
            "\xC3\x85",
            report.color,
            {}};
}

void writeComparisonMesh(const Mesh& a, const ComparisonReport& report, OutputFile& file)
{
    writePly(comparisonMesh(a, report), file, colorComments(report));
}

} // namespace molsurf
