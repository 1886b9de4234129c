// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/color/color_table.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/element.h"
#include "molsurf/show/color/curvature_colors.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/show/color/value_colors.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace molsurf
{

namespace
{

struct ElementColor {
    int element;
    Color color;
};

constexpr ElementColor elementColors[] = {
    {1, {255, 255, 255}},  {6, {144, 144, 144}},  {7, {48, 80, 248}},    {8, {255, 13, 13}},
    {9, {144, 224, 80}},   {11, {171, 92, 242}},  {12, {138, 255, 0}},   {15, {255, 128, 0}},
    {16, {255, 255, 48}},  {17, {31, 240, 31}},   {19, {143, 64, 212}},  {20, {61, 255, 0}},
    {25, {156, 122, 199}}, {26, {224, 102, 51}},  {27, {240, 144, 160}}, {28, {80, 208, 80}},
    {29, {200, 128, 51}},  {30, {125, 128, 176}}, {34, {255, 161, 0}},   {35, {166, 41, 41}},
    {53, {148, 0, 148}}};
constexpr Color otherElement = {255, 20, 147};

/// Of Okabe and Ito's colours.
struct ClassColor {
    ResidueClass residue;
    const char* name;
    Color color;
};

constexpr ClassColor classColors[] = {{ResidueClass::Hydrophobic, "hydrophobic", {153, 153, 153}},
                                      {ResidueClass::Aromatic, "aromatic", {204, 121, 167}},
                                      {ResidueClass::Polar, "polar", {0, 158, 115}},
                                      {ResidueClass::Positive, "positive", {0, 114, 178}},
                                      {ResidueClass::Negative, "negative", {213, 94, 0}},
                                      {ResidueClass::Special, "Gly, Pro, Cys", {240, 228, 66}},
                                      {ResidueClass::Nucleic, "nucleic acid", {86, 180, 233}},
                                      {ResidueClass::Adenine, "nucleic acid", {86, 180, 233}},
                                      {ResidueClass::Cytosine, "nucleic acid", {86, 180, 233}},
                                      {ResidueClass::Guanine, "nucleic acid", {86, 180, 233}},
                                      {ResidueClass::Thymine, "nucleic acid", {86, 180, 233}},
                                      {ResidueClass::Other, "other", {230, 159, 0}}};

constexpr ClassColor baseColors[] = {{ResidueClass::Adenine, "A", {213, 94, 0}},
                                     {ResidueClass::Cytosine, "C", {240, 228, 66}},
                                     {ResidueClass::Guanine, "G", {0, 158, 115}},
                                     {ResidueClass::Thymine, "T, U", {0, 114, 178}},
                                     {ResidueClass::Other, "other", neutralColor}};

/// The row of a class, or the last one.
template<std::size_t Rows>
const ClassColor& rowOf(const ClassColor (&rows)[Rows], ResidueClass residue)
{
    const ClassColor* last = rows + Rows - 1;
    return *std::find_if(rows, last, [&](const ClassColor& row) { return row.residue == residue; });
}

Color elementColor(std::uint8_t element)
{
    const auto row = std::find_if(std::begin(elementColors), std::end(elementColors),
                                  [&](const ElementColor& e) { return e.element == element; });
    return row == std::end(elementColors) ? otherElement : row->color;
}

std::vector<Color> spread(const std::vector<Color>& colors, const std::vector<std::int32_t>& of)
{
    std::vector<Color> out(of.size(), neutralColor);
    for (std::size_t i = 0; i < of.size(); ++i)
        if (of[i] >= 0) out[i] = colors[std::size_t(of[i])];
    return out;
}

/// The colour of each of some values.
template<typename Value, typename ColorOf>
std::vector<Color> eachOf(const std::vector<Value>& values, const ColorOf& colorOf)
{
    std::vector<Color> out;
    out.reserve(values.size());
    for (const Value& value : values) out.push_back(colorOf(value));
    return out;
}

/// Entries of what occurs among the balls, by the name and the colour of a value.
template<typename Value, typename NameOf, typename ColorOf>
void addKinds(const std::vector<Value>& values, const NameOf& nameOf, const ColorOf& colorOf,
              Legend& legend)
{
    std::set<std::string> seen;
    for (const Value& value : values)
        if (seen.insert(nameOf(value)).second)
            legend.entries.push_back({nameOf(value), colorOf(value)});
}

bool hasLabels(const BallSet& atoms)
{
    return atoms.labels.has_value();
}

bool hasGroups(const BallSet& atoms)
{
    return atoms.labels && !atoms.labels->groups.empty();
}

bool hasFileGroups(const BallSet& atoms)
{
    return atoms.labels && !atoms.labels->colorGroups.empty();
}

bool hasValues(const BallSet& atoms)
{
    return atoms.labels && atoms.labels->values;
}

bool hasColors(const BallSet& atoms)
{
    return !atoms.colors.empty();
}

bool always(const BallSet&)
{
    return true;
}

/// If the groups are classes of chains, the title says how many chains they are: "180 chains in 3
/// classes".
void foldClasses(const BallSet& atoms, Legend& legend)
{
    const std::string word = "class ";
    for (const LegendEntry& entry : legend.entries)
        if (entry.name.rfind(word, 0) != 0) return;
    const std::size_t chains =
        atoms.labels->chains.size() * std::max<std::size_t>(atoms.placement.instances.size(), 1);
    const std::size_t classes = legend.entries.size();
    if (chains <= classes) return;
    legend.title = std::to_string(chains) + " chains in " + counted(classes, "class", "classes");
    for (LegendEntry& entry : legend.entries) entry.name.erase(0, word.size());
}

/// A row of colours by labels, with a colour for each name.
ColorKind byLabels(ColorBy by, const char* word, const char* title, const char* attribute = "")
{
    ColorKind kind{by, word, title, attribute};
    kind.needs = "labels, as of LabelOptions::labels";
    kind.has = hasLabels;
    kind.hasBorders = always;
    return kind;
}

/// A row of the kinds of residues, by the names and colours of a list.
/// @tparam sorted  whether the legend is sorted by name; else entries are in the order of the balls
template<const auto& rows, bool sorted>
ColorKind byClass(ColorBy by, const char* word, const char* title, const char* help = "")
{
    ColorKind kind = byLabels(by, word, title);
    kind.help = help;
    kind.ofBalls = [](const BallSet& atoms, const Progress&) {
        return eachOf(atoms.labels->residueClassOf,
                      [](ResidueClass c) { return rowOf(rows, c).color; });
    };
    kind.describe = [](const BallSet& atoms, const Mesh&, const Progress&, Legend& legend) {
        addKinds(
            atoms.labels->residueClassOf, [](ResidueClass c) { return rowOf(rows, c).name; },
            [](ResidueClass c) { return rowOf(rows, c).color; }, legend);
        if (sorted)
            std::sort(legend.entries.begin(), legend.entries.end(),
                      [](const auto& a, const auto& b) { return a.name < b.name; });
    };
    return kind;
}

ColorKind byChain()
{
    ColorKind kind = byLabels(ColorBy::Chain, "chain", "Chain", "chain_id");
    kind.offered = kind.ofChains = true;
    kind.ofBalls = [](const BallSet& atoms, const Progress& progress) {
        return spread(chainColors(atoms, progress), atoms.labels->chainOf);
    };
    kind.describe = [](const BallSet& atoms, const Mesh&, const Progress& progress,
                       Legend& legend) {
        const std::vector<Color> colors = chainColors(atoms, progress);
        for (std::size_t i = 0; i < colors.size(); ++i)
            legend.entries.push_back({atoms.labels->chains[i], colors[i]});
    };
    return kind;
}

ColorKind byGroup()
{
    ColorKind kind = byLabels(ColorBy::Group, "group", "Group", "group_id");
    kind.offered = true;
    kind.needs = "groups, as of LabelOptions::groupBy";
    kind.has = hasGroups;
    kind.ofBalls = [](const BallSet& atoms, const Progress& progress) {
        return spread(groupColors(atoms, progress), atoms.labels->groupOf);
    };
    kind.describe = [](const BallSet& atoms, const Mesh&, const Progress& progress,
                       Legend& legend) {
        const std::vector<Color> colors = groupColors(atoms, progress);
        for (std::size_t i = 0; i < colors.size(); ++i)
            legend.entries.push_back({atoms.labels->groups[i].name, colors[i]});
        foldClasses(atoms, legend);
    };
    return kind;
}

/// By groups of a file, which are there for colours alone.
ColorKind byFileGroup()
{
    ColorKind kind = byLabels(ColorBy::FileGroup, "groups", "Group");
    kind.complete = false;
    kind.needs = "groups, as of LabelOptions::colorGroups";
    kind.has = hasFileGroups;
    kind.ofBalls = [](const BallSet& atoms, const Progress& progress) {
        return spread(fileGroupColors(atoms, progress), atoms.labels->colorGroupOf);
    };
    kind.describe = [](const BallSet& atoms, const Mesh&, const Progress& progress,
                       Legend& legend) {
        const std::vector<Color> colors = fileGroupColors(atoms, progress);
        for (std::size_t i = 0; i < colors.size(); ++i)
            legend.entries.push_back({atoms.labels->colorGroups[i].name, colors[i]});
        const std::vector<std::int32_t>& of = atoms.labels->colorGroupOf;
        if (std::count(of.begin(), of.end(), -1) > 0)
            legend.entries.push_back({"other", neutralColor});
    };
    return kind;
}

/// By the CPK convention, with Jmol's values.
ColorKind byElement()
{
    ColorKind kind = byLabels(ColorBy::Element, "element", "Element");
    kind.ofBalls = [](const BallSet& atoms, const Progress&) {
        return eachOf(atoms.labels->elementOf, elementColor);
    };
    kind.describe = [](const BallSet& atoms, const Mesh&, const Progress&, Legend& legend) {
        addKinds(atoms.labels->elementOf, elementSymbol, elementColor, legend);
    };
    return kind;
}

/// Chains as illustrators paint them: carbon is lighter than the other elements of its chain.
ColorKind illustrative()
{
    ColorKind kind = byChain();
    kind.by = ColorBy::Illustrative;
    kind.word = "illustrative";
    kind.help = "chain, carbon lighter";
    kind.attribute = ""; // a chain has two colours
    kind.offered = false;
    kind.ofBalls = [](const BallSet& atoms, const Progress& progress) {
        std::vector<Color> out = spread(chainColors(atoms, progress), atoms.labels->chainOf);
        for (std::size_t i = 0; i < out.size(); ++i)
            if (atoms.labels->elementOf[i] == carbonElement)
                for (std::uint8_t& c : out[i]) c = std::uint8_t(c + (255 - c) / 2);
        return out;
    };
    return kind;
}

/// Carbon in the colour of its chain, and the other elements in their own, as ChimeraX does it.
ColorKind hetero()
{
    ColorKind kind = byChain();
    kind.by = ColorBy::Hetero;
    kind.word = "hetero";
    kind.help = "carbon by chain, others by element";
    kind.attribute = ""; // a chain has several colours
    kind.offered = false;
    kind.title = "Chain, element";
    kind.ofBalls = [](const BallSet& atoms, const Progress& progress) {
        std::vector<Color> out = spread(chainColors(atoms, progress), atoms.labels->chainOf);
        for (std::size_t i = 0; i < out.size(); ++i)
            if (const std::uint8_t element = atoms.labels->elementOf[i]; element != carbonElement)
                out[i] = elementColor(element);
        return out;
    };
    kind.describe = [](const BallSet& atoms, const Mesh& mesh, const Progress& progress,
                       Legend& legend) {
        byChain().describe(atoms, mesh, progress, legend);
        std::vector<std::uint8_t> others = atoms.labels->elementOf;
        others.erase(std::remove(others.begin(), others.end(), carbonElement), others.end());
        addKinds(others, elementSymbol, elementColor, legend);
    };
    return kind;
}

/// One colour, which needs no legend.
ColorKind plain()
{
    ColorKind kind{ColorBy::Plain, "plain"};
    kind.complete = false;
    kind.needs = "colours of the balls, as of LabelOptions::plainColor";
    kind.has = hasColors;
    kind.ofBalls = [](const BallSet& atoms, const Progress&) { return atoms.colors; };
    return kind;
}

ColorKind byCurvature(ColorBy by, const char* word, const char* title, const char* attribute,
                      const char* unit)
{
    ColorKind kind{by, word, title, attribute, unit};
    kind.ofCurvature = kind.offered = true;
    kind.describe = [](const BallSet& atoms, const Mesh& mesh, const Progress&, Legend& legend) {
        for (const auto& scalar : mesh.scalars)
            if (scalar.name == legend.attribute)
                legend.scale = curvatureScale(scalar.values, atoms.coloring);
    };
    return kind;
}

/// A row of colours whose names and places the mesh has as a label.
ColorKind byLabelOfMesh(ColorBy by, const char* word, const char* title)
{
    ColorKind kind{by, word, title, word};
    kind.describe = [](const BallSet&, const Mesh& mesh, const Progress&, Legend& legend) {
        for (const auto& label : mesh.labels) {
            if (label.name != legend.attribute || mesh.colors.empty()) continue;
            for (const std::string& name : label.names)
                legend.entries.push_back({name, neutralColor, false});
            for (std::size_t v = 0; v < label.values.size(); ++v) {
                LegendEntry& entry = legend.entries[std::size_t(label.values[v])];
                entry.color = mesh.colors[v];
                entry.seen = true;
            }
        }
    };
    return kind;
}

/// The values name themselves in the legend.
ColorKind byValue()
{
    ColorKind kind{ColorBy::Value, "value"};
    kind.complete = false;
    kind.needs = "values, as of LabelOptions::valueBy";
    kind.has = hasValues;
    kind.ofBalls = [](const BallSet& atoms, const Progress&) {
        return valueColors(*atoms.labels->values);
    };
    kind.describe = [](const BallSet& atoms, const Mesh& mesh, const Progress&, Legend& legend) {
        const BallValues& values = *atoms.labels->values;
        legend.title = values.title;
        legend.attribute = values.name;
        legend.unit = values.unit;
        if (values.low == values.high) {
            legend.entries = {{formatted("all %.6g", values.low), neutralColor}};
            return;
        }
        legend.scale = scaleOf(values);
        for (const auto& scalar : mesh.scalars)
            if (scalar.name == values.name &&
                std::any_of(scalar.values.begin(), scalar.values.end(),
                            [](float v) { return !std::isfinite(v); }))
                legend.entries = {{"no value", noValueColor}};
    };
    kind.hasBorders = [](const BallSet& atoms) {
        return hasValues(atoms) && !atoms.labels->values->byPoint() &&
               isFlat(*atoms.labels->values);
    };
    return kind;
}

} // namespace

const std::vector<ColorKind>& colorTable()
{
    static const std::vector<ColorKind> all = {
        {ColorBy::Nothing, "none"},
        byChain(),
        byGroup(),
        byFileGroup(),
        byElement(),
        byClass<classColors, false>(ColorBy::Residue, "residue", "Residue", "or residue-type"),
        byClass<baseColors, true>(ColorBy::Nucleotide, "nucleotide", "Nucleotide"),
        illustrative(),
        hetero(),
        byCurvature(ColorBy::MeanCurvature, "mean-curvature", "Mean curvature", "mean_curvature",
                    "1/Å"),
        byCurvature(ColorBy::GaussianCurvature, "gaussian-curvature", "Gaussian curvature",
                    "gaussian_curvature", "1/Å²"),
        byLabelOfMesh(ColorBy::Pocket, "pocket", "Pocket"), // by addPockets()
        byLabelOfMesh(ColorBy::Patch, "patch", "Patch"),    // by addPatches()
        plain(),
        byValue()};
    return all;
}

const ColorKind& kindOf(ColorBy by)
{
    const auto& all = colorTable();
    return *std::find_if(all.begin(), all.end(), [&](const ColorKind& k) { return k.by == by; });
}

const char* nameOf(ColorBy color)
{
    return kindOf(color).word;
}

} // namespace molsurf
