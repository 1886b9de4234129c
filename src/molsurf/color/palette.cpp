// SPDX-License-Identifier: MPL-2.0
#include "molsurf/color/palette.h"

#include "molsurf/color/value_colors.h"

#include "molsurf/balls/contacts.h"
#include "molsurf/error.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace molsurf
{

namespace
{

/// A gap between balls across which surfaces still look as if they touched [Å].
constexpr double visibleGap = 1.0;

constexpr Color base[] = {{86, 180, 233}, {230, 159, 0}, {0, 158, 115}, {204, 121, 167},
                          {240, 228, 66}, {0, 114, 178}, {213, 94, 0},  {153, 153, 153}};
constexpr std::size_t shades = 3;

/// Of the palette with its shades: the eight, then lighter, then darker ones.
Color paletteColor(std::size_t i)
{
    Color color = base[i % std::size(base)];
    const std::size_t shade = i / std::size(base) % shades;
    for (std::uint8_t& c : color) {
        if (shade == 1) c = std::uint8_t(c + (255 - c) / 2);
        if (shade == 2) c = std::uint8_t(c * 6 / 10);
    }
    return color;
}

Color elementColor(std::uint8_t element)
{
    switch (element) {
    case 1:
        return {255, 255, 255};
    case 6:
        return {144, 144, 144};
    case 7:
        return {48, 80, 248};
    case 8:
        return {255, 13, 13};
    case 9:
        return {144, 224, 80};
    case 11:
        return {171, 92, 242};
    case 12:
        return {138, 255, 0};
    case 15:
        return {255, 128, 0};
    case 16:
        return {255, 255, 48};
    case 17:
        return {31, 240, 31};
    case 19:
        return {143, 64, 212};
    case 20:
        return {61, 255, 0};
    case 25:
        return {156, 122, 199};
    case 26:
        return {224, 102, 51};
    case 27:
        return {240, 144, 160};
    case 28:
        return {80, 208, 80};
    case 29:
        return {200, 128, 51};
    case 30:
        return {125, 128, 176};
    case 34:
        return {255, 161, 0};
    case 35:
        return {166, 41, 41};
    case 53:
        return {148, 0, 148};
    default:
        return {255, 20, 147};
    }
}

Color classColor(ResidueClass residue)
{
    switch (residue) {
    case ResidueClass::Hydrophobic:
        return {153, 153, 153};
    case ResidueClass::Aromatic:
        return {204, 121, 167};
    case ResidueClass::Polar:
        return {0, 158, 115};
    case ResidueClass::Positive:
        return {0, 114, 178};
    case ResidueClass::Negative:
        return {213, 94, 0};
    case ResidueClass::Special:
        return {240, 228, 66};
    case ResidueClass::Nucleic:
    case ResidueClass::Adenine:
    case ResidueClass::Cytosine:
    case ResidueClass::Guanine:
    case ResidueClass::Thymine:
        return {86, 180, 233};
    default:
        return {230, 159, 0};
    }
}

/// Of Okabe and Ito's colours, like those of the classes.
Color baseColor(ResidueClass residue)
{
    switch (residue) {
    case ResidueClass::Adenine:
        return {213, 94, 0};
    case ResidueClass::Cytosine:
        return {240, 228, 66};
    case ResidueClass::Guanine:
        return {0, 158, 115};
    case ResidueClass::Thymine:
        return {0, 114, 178};
    default:
        return neutralColor;
    }
}

std::vector<Color> spread(const std::vector<Color>& colors, const std::vector<std::int32_t>& of)
{
    std::vector<Color> out(of.size(), neutralColor);
    for (std::size_t i = 0; i < of.size(); ++i) {
        if (of[i] >= 0) out[i] = colors[std::size_t(of[i])];
    }
    return out;
}

} // namespace

std::vector<Color> distinctColors(const std::vector<std::vector<std::int32_t>>& neighbours)
{
    constexpr std::size_t count = std::size(base) * shades;
    std::vector<std::size_t> chosen(neighbours.size()), uses(count, 0);
    std::vector<Color> out;
    for (std::size_t i = 0; i < neighbours.size(); ++i) {
        std::vector<std::size_t> taken(count, 0); // by neighbours
        for (const std::int32_t n : neighbours[i]) {
            if (std::size_t(n) < i) ++taken[chosen[std::size_t(n)]];
        }
        std::size_t best = 0;
        const auto cost = [&](std::size_t k) {
            // A neighbour of the same colour is worst, then a shade, then a colour used often.
            return std::make_tuple(taken[k], k / std::size(base), uses[k]);
        };
        for (std::size_t k = 1; k < count; ++k) {
            if (cost(k) < cost(best)) best = k;
        }
        chosen[i] = best;
        ++uses[best];
        out.push_back(paletteColor(best));
    }
    return out;
}

std::vector<Color> chainColors(const BallSet& atoms, const Progress& progress)
{
    if (!atoms.labels) return {};
    const BallLabels& labels = *atoms.labels;
    if (!labels.chainColors.empty()) return labels.chainColors;
    return distinctColors(
        contacts(atoms.balls, labels.chainOf, labels.chains.size(), visibleGap, progress));
}

std::vector<Color> groupColors(const BallSet& atoms, const Progress& progress)
{
    if (!atoms.labels || atoms.labels->groups.empty()) return {};
    const BallLabels& labels = *atoms.labels;
    std::vector<Color> colors = distinctColors(
        contacts(atoms.balls, labels.groupOf, labels.groups.size(), visibleGap, progress));
    for (std::size_t g = 0; g < labels.groups.size(); ++g) {
        if (labels.groups[g].color) colors[g] = *labels.groups[g].color;
    }
    return colors;
}

std::vector<Color> ballColors(const BallSet& atoms, ColorBy by, const Progress& progress)
{
    std::vector<Color> out(atoms.balls.size(), neutralColor);
    if (!atoms.labels) return out;
    const BallLabels& labels = *atoms.labels;
    switch (by) {
    case ColorBy::Chain:
        return spread(chainColors(atoms, progress), labels.chainOf);
    case ColorBy::Group:
        if (labels.groups.empty()) return out;
        return spread(groupColors(atoms, progress), labels.groupOf);
    case ColorBy::Value:
        if (!labels.values) return out;
        return valueColors(*labels.values);
    case ColorBy::Element:
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = elementColor(labels.elementOf[i]);
        return out;
    case ColorBy::Residue:
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = classColor(labels.residueClassOf[i]);
        return out;
    case ColorBy::Nucleotide:
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = baseColor(labels.residueClassOf[i]);
        return out;
    default:
        return out;
    }
}

void checkColors(const BallSet& atoms, ColorBy by)
{
    const auto expect = [](bool there, const char* what) {
        if (!there) throw Error(ErrorKind::Usage, std::string("`color`: expected ") + what);
    };
    const auto& labels = atoms.labels;
    switch (by) {
    case ColorBy::Nothing:
    case ColorBy::MeanCurvature:
    case ColorBy::GaussianCurvature:
        return;
    case ColorBy::Plain:
        return expect(!atoms.colors.empty(),
                      "colours of the balls, as of SelectOptions::plainColor");
    case ColorBy::Group:
        return expect(labels && !labels->groups.empty(), "groups, as of SelectOptions::groupBy");
    case ColorBy::Value:
        return expect(labels && labels->values, "values, as of SelectOptions::valueBy");
    default:
        return expect(labels.has_value(), "labels, as of SelectOptions::labels");
    }
}

std::vector<Color> instanceColors(const BallSet& atoms, const Progress& progress)
{
    if (atoms.instances.empty()) return {}; // a stored surface has no prototypes either
    struct Prototype {
        openvdb::Vec3d middle;
        double radius;
    };
    std::vector<Prototype> prototypes;
    for (std::size_t p = 0; p < atoms.copies; ++p) {
        openvdb::BBoxd box;
        for (std::size_t i = atoms.copyBegin[p]; i < atoms.copyBegin[p + 1]; ++i)
            box.expand(openvdb::Vec3d(atoms.balls[i].center));
        prototypes.push_back({box.getCenter(), 0.35 * box.extents().length()});
    }
    std::vector<Ball> middles; // of copies, as balls that touch where copies are near
    for (const Instance& copy : atoms.instances) {
        const auto& [middle, radius] = prototypes[copy.prototype];
        openvdb::Vec3d x = copy.translation;
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                x[row] += copy.rotation[std::size_t(row)][std::size_t(column)] * middle[column];
        middles.push_back({openvdb::Vec3f(x), float(radius), std::int32_t(middles.size())});
    }
    std::vector<std::int32_t> own(middles.size());
    std::iota(own.begin(), own.end(), 0);
    return distinctColors(contacts(middles, own, middles.size(), 0.0, progress));
}

} // namespace molsurf
