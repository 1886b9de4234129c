// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/color/palette.h"

#include "molsurf/show/color/color_table.h"

#include "molsurf/error.h"
#include "molsurf/kernel/balls/contacts.h"

#include <numeric>
#include <string>
#include <tuple>

namespace molsurf
{

namespace
{

/// A gap between balls across which surfaces still look as if they touched [Å].
constexpr double visibleGap = 1.0;

/// Okabe and Ito's eight, then those of a lattice of colours of chroma 18 to 78 and lightness 38 to
/// 90 (CIELAB) that lie farthest from all before them, from black, white, the neutral one and that
/// of no value.
constexpr Color paletteColors[mostDistinct] = {
    {86, 180, 233},  {230, 159, 0},   {0, 158, 115},   {204, 121, 167}, {240, 228, 66},
    {0, 114, 178},   {213, 94, 0},    {153, 153, 153}, {104, 96, 0},    {120, 56, 184},
    {184, 0, 56},    {0, 104, 104},   {248, 160, 144}, {128, 160, 16},  {144, 128, 248},
    {0, 248, 248},   {120, 88, 72},   {8, 104, 40},    {248, 208, 248}, {120, 112, 144},
    {144, 248, 112}, {200, 0, 136},   {248, 72, 96},   {160, 128, 80},  {32, 152, 160},
    {248, 208, 168}, {112, 128, 88},  {176, 192, 248}, {168, 48, 0},    {0, 232, 176},
    {176, 120, 112}, {192, 176, 104}, {144, 88, 0},    {136, 80, 96},   {224, 152, 248},
    {184, 88, 208},  {32, 192, 80},   {0, 144, 16},    {168, 224, 240}, {176, 160, 192}};
constexpr std::size_t shared = 8; // of them, which things share if there are more than colours

/// The colours of the places of all, or none if one has no colour of its own.
std::vector<Color> colorsOfPlaces(const std::vector<std::int32_t>& places)
{
    std::vector<Color> out;
    for (const std::int32_t place : places) {
        if (place < 0 || std::size_t(place) >= mostDistinct) return {};
        out.push_back(paletteColors[place]);
    }
    return out;
}

} // namespace

/// Greedy graph colouring, in the order of the things.
std::vector<Color> distinctColors(const std::vector<std::vector<std::int32_t>>& neighbours)
{
    if (neighbours.size() <= mostDistinct)
        return {paletteColors, paletteColors + neighbours.size()};
    std::vector<std::size_t> chosen(neighbours.size()), uses(mostDistinct, 0);
    std::vector<Color> out;
    for (std::size_t i = 0; i < neighbours.size(); ++i) {
        std::vector<std::size_t> taken(mostDistinct, 0); // by neighbours
        for (const std::int32_t n : neighbours[i]) {
            if (std::size_t(n) < i) ++taken[chosen[std::size_t(n)]];
        }
        std::size_t best = 0;
        const auto cost = [&](std::size_t k) {
            // Fewest neighbours that have it, then the earliest eight, then the least used.
            return std::make_tuple(taken[k], k / shared, uses[k]);
        };
        for (std::size_t k = 1; k < mostDistinct; ++k) {
            if (cost(k) < cost(best)) best = k;
        }
        chosen[i] = best;
        ++uses[best];
        out.push_back(paletteColors[best]);
    }
    return out;
}

std::vector<std::string> colorWarnings(const BallSet& atoms, ColorBy by)
{
    if (!atoms.labels || !atoms.colors.empty()) return {};
    const ColorKind& kind = kindOf(by);
    const BallLabels& labels = *atoms.labels;
    const bool ofGroups = kind.attribute == std::string("group_id");
    const std::size_t count = ofGroups        ? labels.groups.size()
                              : kind.ofChains ? labels.chains.size()
                                              : 0;
    if (count <= mostDistinct) return {};
    return {"`color` " + std::string(kind.word) + ": " + std::to_string(count) +
            (ofGroups ? " groups" : " chains") + " share the colours of " +
            std::to_string(mostDistinct) + " [hint: `color` entity, for example]"};
}

std::vector<Color> chainColors(const BallSet& atoms, const Progress& progress)
{
    if (!atoms.labels) return {};
    const BallLabels& labels = *atoms.labels;
    if (!labels.chainColors.empty()) return labels.chainColors;
    if (std::vector<Color> own = colorsOfPlaces(labels.chainPlaces); !own.empty()) return own;
    return distinctColors(
        contacts(atoms.balls, labels.chainOf, labels.chains.size(), visibleGap, progress));
}

namespace
{

/// The colours of groups, of which those without one of their own that touch have different ones.
std::vector<Color> colorsOfGroups(const BallSet& atoms, const std::vector<Group>& groups,
                                  const std::vector<std::int32_t>& groupOf,
                                  const Progress& progress)
{
    std::vector<std::int32_t> places;
    for (const Group& group : groups) places.push_back(group.place);
    std::vector<Color> colors = colorsOfPlaces(places);
    if (colors.empty())
        colors =
            distinctColors(contacts(atoms.balls, groupOf, groups.size(), visibleGap, progress));
    for (std::size_t g = 0; g < groups.size(); ++g)
        if (groups[g].color) colors[g] = *groups[g].color;
    return colors;
}

} // namespace

std::vector<Color> groupColors(const BallSet& atoms, const Progress& progress)
{
    if (!atoms.labels || atoms.labels->groups.empty()) return {};
    return colorsOfGroups(atoms, atoms.labels->groups, atoms.labels->groupOf, progress);
}

std::vector<Color> fileGroupColors(const BallSet& atoms, const Progress& progress)
{
    if (!atoms.labels || atoms.labels->colorGroups.empty()) return {};
    return colorsOfGroups(atoms, atoms.labels->colorGroups, atoms.labels->colorGroupOf, progress);
}

std::vector<Color> ballColors(const BallSet& atoms, ColorBy by, const Progress& progress)
{
    const ColorKind& kind = kindOf(by);
    if (!kind.ofBalls || !kind.has(atoms))
        return std::vector<Color>(atoms.balls.size(), neutralColor);
    return kind.ofBalls(atoms, progress);
}

void checkColors(const BallSet& atoms, ColorBy by)
{
    const ColorKind& kind = kindOf(by);
    if (kind.has && !kind.has(atoms))
        throw Error(ErrorKind::Usage, std::string("`color`: expected ") + kind.needs);
}

std::vector<Color> instanceColors(const BallSet& atoms, const Progress& progress)
{
    struct Prototype {
        openvdb::Vec3d middle;
        double radius;
    };
    std::vector<Prototype> prototypes;
    for (std::size_t p = 0; p < atoms.placement.prototypes(); ++p) {
        openvdb::BBoxd box;
        const auto [begin, end] = atoms.prototype(p);
        for (std::size_t i = begin; i < end; ++i) box.expand(openvdb::Vec3d(atoms.balls[i].center));
        // Of a cube 0.29 of the diagonal is half an edge, so this ball goes a little beyond it.
        prototypes.push_back({box.getCenter(), 0.35 * box.extents().length()});
    }
    std::vector<Ball> middles; // of copies, as balls that touch where copies are near
    for (const Instance& copy : atoms.placement.instances) {
        const auto& [middle, radius] = prototypes[copy.part];
        middles.push_back(
            {openvdb::Vec3f(copy.placed(middle)), float(radius), std::int32_t(middles.size())});
    }
    std::vector<std::int32_t> own(middles.size());
    std::iota(own.begin(), own.end(), 0);
    return distinctColors(contacts(middles, own, middles.size(), 0.0, progress));
}

} // namespace molsurf
