// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/write_html.h"

#include "molsurf/error.h"
#include "molsurf/kernel/balls/nearest_ball.h"
#include "molsurf/kernel/core/markup.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/selection/ball_names.h"
#include "molsurf/show/color/color_table.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/show/io/part_ranges.h"
#include "molsurf/show/picture/viewer_text.h"

#include <nlohmann/json.hpp>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

namespace molsurf
{

namespace
{

using Json = nlohmann::ordered_json;

/// Arrays of whole numbers, packed: component by component, byte by byte of all elements, each the
/// difference from the element before.
class Arrays
{
public:
    /// @param[in] width  bytes of a number: 1, 2 or 4
    template<typename Value>
    void add(const std::string& name, std::size_t count, int components, int width,
             const Value& value)
    {
        table_.push_back(Json{{"name", name},
                              {"layer", layer},
                              {"offset", bytes_.size()},
                              {"count", count},
                              {"components", components},
                              {"width", width}});
        for (int c = 0; c < components; ++c) {
            const std::size_t begin = bytes_.size();
            bytes_.resize(begin + count * std::size_t(width));
            std::uint32_t last = 0;
            for (std::size_t i = 0; i < count; ++i) {
                const std::uint32_t now = value(i, c), step = now - last;
                for (int w = 0; w < width; ++w)
                    bytes_[begin + std::size_t(w) * count + i] = std::uint8_t(step >> 8 * w);
                last = now;
            }
        }
    }

    std::size_t layer = 0; ///< of the page, that has what is added

    const Json& table() const { return table_; }

    /// All bytes, as base64 of a zlib stream.
    std::string packed() const
    {
        uLongf size = compressBound(uLong(bytes_.size()));
        std::vector<std::uint8_t> out(size);
        if (compress2(out.data(), &size, bytes_.data(), uLong(bytes_.size()), 6) != Z_OK)
            throw Error(ErrorKind::Output, "html: zlib failed");
        out.resize(size);
        return base64(out);
    }

private:
    static std::string base64(const std::vector<std::uint8_t>& bytes)
    {
        static constexpr char letters[] =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string out;
        out.reserve((bytes.size() + 2) / 3 * 4);
        for (std::size_t i = 0; i < bytes.size(); i += 3) {
            const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
            std::uint32_t bits = std::uint32_t(bytes[i]) << 16;
            if (left > 1) bits |= std::uint32_t(bytes[i + 1]) << 8;
            if (left > 2) bits |= bytes[i + 2];
            for (std::size_t k = 0; k < 4; ++k)
                out += k <= left ? letters[bits >> (18 - 6 * k) & 63] : '=';
        }
        return out;
    }

    Json table_ = Json::array();
    std::vector<std::uint8_t> bytes_;
};

Json colorJson(const Color& color)
{
    return Json::array({color[0], color[1], color[2]});
}

/// Packs what a legend shows; the mode of the viewer, or nothing if the mesh has no such thing.
/// @param[in] level  behind the names of its arrays
Json modeOf(const Legend& legend, const Mesh& mesh, const std::string& level, Arrays& arrays)
{
    Json mode = {{"title", legend.title}, {"id", legend.id}};
    if (legend.scale) {
        const auto scalar = std::find_if(mesh.scalars.begin(), mesh.scalars.end(),
                                         [&](const auto& s) { return s.name == legend.attribute; });
        if (scalar == mesh.scalars.end()) return {};
        const double low = legend.scale->low, range = legend.scale->high - low;
        const bool missing = std::any_of(scalar->values.begin(), scalar->values.end(),
                                         [](float value) { return !std::isfinite(value); });
        const double last = missing ? 254.0 : 255.0; // 255 is no value then
        arrays.add(legend.attribute + level, scalar->values.size(), 1, 1, [&](std::size_t i, int) {
            const double value = double(scalar->values[i]);
            if (!std::isfinite(value)) return std::uint32_t(255);
            const double place = (value - low) / range;
            return std::uint32_t(std::lround(last * std::clamp(place, 0.0, 1.0)));
        });
        if (missing) mode["missing"] = colorJson(noValueColor);
        mode["kind"] = "scale";
        mode["array"] = legend.attribute;
        mode["unit"] = legend.unit;
        mode["low"] = low;
        mode["high"] = legend.scale->high;
        for (const Color& stop : legend.scale->stops) mode["stops"].push_back(colorJson(stop));
        return mode;
    }
    const auto label = std::find_if(mesh.labels.begin(), mesh.labels.end(),
                                    [&](const auto& l) { return l.name == legend.attribute; });
    if (label != mesh.labels.end()) {
        const std::size_t last = legend.entries.size() - 1; // also that of what has no label
        arrays.add(legend.attribute + level, label->values.size(), 1, last < 256 ? 1 : 4,
                   [&](std::size_t i, int) {
                       const std::int32_t v = label->values[i];
                       return std::uint32_t(v < 0 ? last : std::min(std::size_t(v), last));
                   });
        mode["kind"] = "names";
        mode["array"] = legend.attribute;
    } else if (!mesh.colors.empty()) {
        arrays.add("color" + level, mesh.colors.size(), 3, 1, [&](std::size_t i, int c) {
            return std::uint32_t(mesh.colors[i][std::size_t(c)]);
        });
        mode["kind"] = "colors";
        mode["array"] = "color";
    } else {
        return {};
    }
    for (const LegendEntry& entry : legend.entries)
        mode["entries"].push_back(
            Json{{"name", entry.name}, {"color", colorJson(entry.color)}, {"seen", entry.seen}});
    return mode;
}

openvdb::BBoxd boxOf(const Mesh& mesh)
{
    openvdb::BBoxd box;
    for (const openvdb::Vec3f& p : mesh.positions) box.expand(openvdb::Vec3d(p));
    if (mesh.positions.empty()) box = openvdb::BBoxd(openvdb::Vec3d(0.0), openvdb::Vec3d(0.0));
    return box;
}

/// Packs vertices and triangles.
/// @param[in] origin  of the page [Å]
Json levelOf(const Mesh& mesh, const openvdb::Vec3d& origin, const std::string& level,
             Arrays& arrays)
{
    constexpr double full = std::numeric_limits<std::uint16_t>::max();
    const openvdb::BBoxd box = boxOf(mesh);
    const openvdb::Vec3d extent = box.extents(), center = box.getCenter();
    const double step = std::max({extent[0], extent[1], extent[2], 1e-6}) / full; // [Å]
    arrays.add("position" + level, mesh.positions.size(), 3, 2, [&](std::size_t i, int c) {
        const double place = (double(mesh.positions[i][c]) - center[c]) / step + 0.5 * full;
        return std::uint32_t(std::lround(std::clamp(place, 0.0, full)));
    });
    arrays.add("index" + level, 3 * mesh.triangles.size(), 1, 4,
               [&](std::size_t i, int) { return mesh.triangles[i / 3][i % 3]; });
    Json parts = Json::array();
    for (const PartRange& part : partRanges(mesh, ""))
        parts.push_back(
            Json::array({part.firstVertex, part.vertexEnd, part.firstTriangle, part.triangleEnd}));
    const openvdb::Vec3d middle = center - origin;
    return {{"level", level},
            {"step", step},
            {"middle", {middle[0], middle[1], middle[2]}},
            {"parts", parts}};
}

double rounded(double x, double unit)
{
    return std::round(x / unit) * unit + 0.0; // no -0
}

/// The copies: part, rows of the matrix about the origin of the page, and colour of each.
Json copiesOf(const std::vector<MeshInstance>& instances, const openvdb::Vec3d& origin)
{
    Json copies = Json::array();
    for (const MeshInstance& copy : instances) {
        const openvdb::Vec3d place = copy.placed(origin);
        Json rows = Json::array();
        for (std::size_t row = 0; row < 3; ++row) {
            for (const double number : copy.rotation[row]) rows.push_back(rounded(number, 1e-6));
            rows.push_back(rounded(place[int(row)], 1e-3));
        }
        copies.push_back(Json::array({copy.part, rows, colorJson(copy.color)}));
    }
    return copies;
}

/// Residues as chain, name and number; atoms as the index of their residue and their name. Only of
/// balls that a vertex belongs to.
Json namesOf(const HtmlPage& page, Arrays& arrays)
{
    const BallNames& names = *page.names;
    // 0 marks what is used, until its index on the page takes the place of that.
    std::vector<std::int32_t> placeOf(names.atoms.size(), -1);
    for (const std::int32_t ball : page.ballOf)
        if (ball >= 0) placeOf.at(std::size_t(ball)) = 0;
    std::vector<std::int32_t> residueAt(names.residues.size(), -1);
    for (std::size_t i = 0; i < placeOf.size(); ++i)
        if (placeOf[i] == 0) residueAt[std::size_t(names.residueOf[i])] = 0;
    Json residues = Json::array(), atoms = Json::array();
    for (std::size_t r = 0; r < residueAt.size(); ++r) {
        if (residueAt[r] < 0) continue;
        residueAt[r] = std::int32_t(residues.size());
        const BallNames::Residue& residue = names.residues[r];
        residues.push_back(Json::array({residue.chain, residue.name, numberText(residue)}));
    }
    for (std::size_t i = 0; i < placeOf.size(); ++i) {
        if (placeOf[i] < 0) continue;
        placeOf[i] = std::int32_t(atoms.size());
        atoms.push_back(
            Json::array({residueAt[std::size_t(names.residueOf[i])], names.atoms[i].name}));
    }
    arrays.add("ball", page.ballOf.size(), 1, atoms.size() < 65536 ? 2 : 4,
               [&](std::size_t i, int) {
                   const std::int32_t ball = page.ballOf[i];
                   return std::uint32_t(ball < 0 ? 0 : placeOf[std::size_t(ball)]);
               });
    return {{"residues", residues}, {"atoms", atoms}};
}

/// Packs the balls: places by steps of a part of the largest extent, radii by 0.02 Å.
Json cutOf(const HtmlPage& page, const openvdb::Vec3d& origin, Arrays& arrays)
{
    constexpr double full = std::numeric_limits<std::uint16_t>::max(), radiusStep = 0.02; // [Å]
    openvdb::BBoxd box;
    for (const Ball& ball : page.balls) box.expand(openvdb::Vec3d(ball.center));
    const openvdb::Vec3d extent = box.extents();
    const double step = std::max({extent[0], extent[1], extent[2], 1e-6}) / full; // [Å]
    arrays.add("ball_position", page.balls.size(), 3, 2, [&](std::size_t i, int c) {
        const double place = (double(page.balls[i].center[c]) - box.min()[c]) / step;
        return std::uint32_t(std::lround(std::clamp(place, 0.0, full)));
    });
    arrays.add("ball_radius", page.balls.size(), 1, 1, [&](std::size_t i, int) {
        return std::uint32_t(
            std::lround(std::clamp(double(page.balls[i].radius) / radiusStep, 0.0, 255.0)));
    });
    const openvdb::Vec3d low = box.min() - origin;
    return {{"step", step}, {"radius_step", radiusStep}, {"low", {low[0], low[1], low[2]}}};
}

/// Packs the bodies inside, with their legends.
Json bodiesOf(const Bodies& bodies, const openvdb::Vec3d& origin, Arrays& arrays)
{
    const std::vector<Color>& colors = bodies.mesh.colors;
    Json out = levelOf(bodies.mesh, origin, "_bodies", arrays);
    arrays.add("color_bodies", colors.size(), 3, 1,
               [&](std::size_t i, int c) { return std::uint32_t(colors[i][std::size_t(c)]); });
    const auto add = [&](const char* title, const std::vector<LegendEntry>& entries) {
        for (const LegendEntry& entry : entries)
            out["entries"].push_back(
                Json{{"title", title}, {"name", entry.name}, {"color", colorJson(entry.color)}});
    };
    add("Pockets", bodies.pockets);
    add("Tunnels", bodies.tunnels);
    return out;
}

/// @param[in] origin  of the page [Å]
Json headerOf(const Mesh& mesh, const HtmlPage& page, const openvdb::Vec3d& origin, Arrays& arrays)
{
    Json levels = Json::array({levelOf(mesh, origin, "", arrays)});
    for (std::size_t n = 0; n < page.coarser.size(); ++n)
        levels.push_back(levelOf(*page.coarser[n], origin, "_lod" + std::to_string(n + 1), arrays));
    Json modes = Json::array();
    for (std::size_t k = 0; k < page.legends.size(); ++k) {
        const Legend& legend = page.legends[k];
        Json mode = modeOf(legend, mesh, "", arrays);
        if (mode.is_null()) continue;
        if (k < page.cutColors.size() && !page.cutColors[k].empty()) {
            const std::vector<Color>& colors = page.cutColors[k];
            mode["cut"] = "cut_" + legend.id;
            arrays.add("cut_" + legend.id, colors.size(), 3, 1, [&](std::size_t i, int c) {
                return std::uint32_t(colors[i][std::size_t(c)]);
            });
        }
        modes.push_back(std::move(mode));
        for (std::size_t n = 0; n < page.coarser.size(); ++n)
            modeOf(legend, *page.coarser[n], levels[n + 1]["level"].get<std::string>(), arrays);
    }
    if (!page.instances.empty())
        modes.insert(page.copiesFirst ? modes.begin() : modes.end(),
                     Json{{"title", "Copy"}, {"id", "copy"}, {"kind", "copies"}});
    modes.push_back(Json{
        {"title", "Plain"}, {"id", "none"}, {"kind", "plain"}, {"color", colorJson(page.plain)}});
    Json axes = Json::array();
    for (const openvdb::Vec3d& axis : page.axes)
        axes.push_back(Json::array({axis[0], axis[1], axis[2]}));
    Json zoom;
    if (page.zoom) {
        const openvdb::Vec3d center = page.zoom->center - origin;
        zoom = {{"center", {center[0], center[1], center[2]}}, {"side", page.zoom->width}};
    }
    Json names = page.names && !page.ballOf.empty() ? namesOf(page, arrays) : Json();
    const bool colored = !page.balls.empty() && page.instances.empty();
    Json cut = colored ? cutOf(page, origin, arrays) : Json();
    const bool has = page.bodies && !page.bodies->mesh.triangles.empty();
    Json bodies = has ? bodiesOf(*page.bodies, origin, arrays) : Json();
    return {{"title", page.title},
            {"name", page.name},
            {"about", page.about},
            {"levels", levels},
            {"copies", copiesOf(page.instances, origin)},
            {"axes", axes},
            {"zoom", zoom},
            {"modes", modes},
            {"names", names},
            {"cut", cut},
            {"bodies", bodies},
            {"opacity", page.opacity}};
}

/// Gives layers the scales of values that the first one has.
void shareScales(std::vector<HtmlLayer>& layers)
{
    for (std::size_t n = 1; n < layers.size(); ++n)
        for (Legend& legend : layers[n].page.legends)
            for (const Legend& first : layers[0].page.legends)
                if (legend.scale && first.scale && first.id == legend.id)
                    legend.scale = first.scale;
}

/// The header of the first layer, with those of the others.
Json headerOf(const std::vector<HtmlLayer>& layers, Arrays& arrays)
{
    const openvdb::Vec3d place = boxOf(layers[0].mesh).getCenter();
    Json header = headerOf(layers[0].mesh, layers[0].page, place, arrays), others = Json::array();
    for (std::size_t n = 1; n < layers.size(); ++n) {
        const auto& [mesh, page] = layers[n];
        arrays.layer = n;
        others.push_back(
            headerOf(mesh, page, page.inPlace ? place : boxOf(mesh).getCenter(), arrays));
    }
    header["others"] = std::move(others);
    header["arrays"] = arrays.table();
    return header;
}

} // namespace

std::string aboutPage(const std::string& kind, double voxel)
{
    return "Surface " + kind + formatted(", voxels of %g Å. Areas are of its mesh.", voxel);
}

void needViewer()
{
    if (viewerScript == nullptr)
        throw Error(ErrorKind::Output,
                    "HTML: expected the viewer, got a program built without it (MOLSURF_VIEWER)");
}

void nameAtoms(const BallNames& names, const std::vector<Ball>& balls, const Mesh& mesh,
               const Progress& progress, HtmlPage& page)
{
    constexpr double farthest = 30.0; // from a ball [Å]
    page.names = &names;
    page.ballOf = nearestBalls(balls, mesh.positions, farthest, progress);
}

void colorCut(const BallSet& atoms, std::vector<Ball> balls, const Progress& progress,
              HtmlPage& page)
{
    if (!atoms.placement.isWhole() || !atoms.labels) return;
    page.balls = std::move(balls);
    const auto& values = atoms.labels->values;
    for (const Legend& legend : page.legends) {
        ColorBy by = ColorBy::Nothing;
        for (const ColorKind& kind : colorTable())
            if (legend.id == kind.word && kind.ofBalls) by = kind.by;
        if (values && legend.attribute == values->name && !values->byPoint()) by = ColorBy::Value;
        page.cutColors.push_back(by == ColorBy::Nothing ? std::vector<Color>()
                                                        : ballColors(atoms, by, progress));
    }
}

void writeHtml(const Mesh& mesh, const HtmlPage& page, OutputFile& file)
{
    writeHtml({{mesh, page}}, file);
}

void writeHtml(std::vector<HtmlLayer> layers, OutputFile& file)
{
    needViewer();
    shareScales(layers);
    Arrays arrays;
    const Json header = headerOf(layers, arrays);
    const std::string headerText = header.dump(-1, ' ', false, Json::error_handler_t::replace);

    // The page with its four places filled in, in their order.
    std::string_view left = viewerPage;
    const auto fill = [&](std::string_view place, std::string_view text) {
        const std::size_t at = left.find(place);
        file.write(left.substr(0, at));
        file.write(text);
        left.remove_prefix(at + place.size());
    };
    fill("%TITLE%", markupText(layers[0].page.title));
    fill("%HEADER%", scriptText(headerText));
    fill("%DATA%", arrays.packed());
    fill("%VIEWER%", viewerScript);
    file.write(left);
    file.finish();
}

} // namespace molsurf
