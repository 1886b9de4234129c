// SPDX-License-Identifier: MPL-2.0
#include "molsurf/color/legend.h"

#include "molsurf/color/curvature_colors.h"
#include "molsurf/color/palette.h"
#include "molsurf/color/value_colors.h"
#include "molsurf/structure/element.h"

#include <algorithm>
#include <set>

namespace molsurf
{

namespace
{

const char* nameOf(ResidueClass residue)
{
    switch (residue) {
    case ResidueClass::Hydrophobic:
        return "hydrophobic";
    case ResidueClass::Aromatic:
        return "aromatic";
    case ResidueClass::Polar:
        return "polar";
    case ResidueClass::Positive:
        return "positive";
    case ResidueClass::Negative:
        return "negative";
    case ResidueClass::Special:
        return "Gly, Pro, Cys";
    case ResidueClass::Nucleic:
    case ResidueClass::Adenine:
    case ResidueClass::Cytosine:
    case ResidueClass::Guanine:
    case ResidueClass::Thymine:
        return "nucleic acid";
    default:
        return "other";
    }
}

const char* nameOfBase(ResidueClass residue)
{
    switch (residue) {
    case ResidueClass::Adenine:
        return "A";
    case ResidueClass::Cytosine:
        return "C";
    case ResidueClass::Guanine:
        return "G";
    case ResidueClass::Thymine:
        return "T, U";
    default:
        return "other";
    }
}

std::optional<Legend> curvatureLegend(ColorBy by, const Mesh& mesh)
{
    Legend legend;
    const bool mean = by == ColorBy::MeanCurvature;
    legend.title = mean ? "Mean curvature" : "Gaussian curvature";
    legend.unit = mean ? "1/Å" : "1/Å²";
    legend.attribute = curvatureNameOf(by);
    for (const auto& scalar : mesh.scalars)
        if (scalar.name == legend.attribute) legend.scale = curvatureScale(scalar.values);
    if (!legend.scale) return {};
    return legend;
}

/// Adds "other" if a vertex has none of the entries.
void addOther(const Mesh& mesh, Legend& legend)
{
    for (const auto& label : mesh.labels) {
        if (label.name != legend.attribute) continue;
        if (std::count(label.values.begin(), label.values.end(), -1) > 0)
            legend.entries.push_back({"other", neutralColor});
    }
}

/// If the groups are classes of chains, the title says how many chains they are: "180 chains in 3
/// classes".
void foldClasses(const BallSet& atoms, Legend& legend)
{
    const std::string word = "class ";
    for (const LegendEntry& entry : legend.entries)
        if (entry.name.rfind(word, 0) != 0) return;
    const std::size_t chains =
        atoms.labels->chains.size() * std::max<std::size_t>(atoms.instances.size(), 1);
    const std::size_t classes = legend.entries.size();
    if (chains <= classes) return;
    legend.title = std::to_string(chains) + " chains in " + std::to_string(classes) +
                   (classes == 1 ? " class" : " classes");
    for (LegendEntry& entry : legend.entries) entry.name.erase(0, word.size());
}

/// Entries of what occurs among the balls, by the name for a value of each.
template<typename Value, typename Name>
void addKinds(const std::vector<Value>& values, const std::vector<Color>& colors, const Name& name,
              Legend& legend)
{
    std::set<std::string> seen;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (seen.insert(name(values[i])).second)
            legend.entries.push_back({name(values[i]), colors[i]});
}

} // namespace

std::optional<Legend> legendOf(ColorBy by, const BallSet& atoms, const Mesh& mesh,
                               const Progress& progress)
{
    if (by == ColorBy::Nothing || by == ColorBy::Plain) return {};
    std::optional<Legend> found;
    Legend legend;
    if (curvatureNameOf(by)) {
        found = curvatureLegend(by, mesh);
    } else if (atoms.labels) {
        const BallLabels& labels = *atoms.labels;
        if (by == ColorBy::Chain) {
            legend.title = "Chain";
            legend.attribute = "chain_id";
            const std::vector<Color> colors = chainColors(atoms, progress);
            for (std::size_t i = 0; i < colors.size(); ++i)
                legend.entries.push_back({labels.chains[i], colors[i]});
        } else if (by == ColorBy::Group) {
            legend.title = "Group";
            legend.attribute = "group_id";
            const std::vector<Color> colors = groupColors(atoms, progress);
            for (std::size_t i = 0; i < colors.size(); ++i)
                legend.entries.push_back({labels.groups[i].name, colors[i]});
            foldClasses(atoms, legend);
        } else if (by == ColorBy::Value) {
            if (!labels.values) return {};
            legend.title = labels.values->title;
            legend.attribute = labels.values->name;
            legend.unit = labels.values->unit;
            legend.scale = scaleOf(*labels.values);
        } else if (by == ColorBy::Element) {
            legend.title = "Element";
            addKinds(labels.elementOf, ballColors(atoms, by, progress), elementSymbol, legend);
        } else {
            const bool bases = by == ColorBy::Nucleotide;
            legend.title = bases ? "Nucleotide" : "Residue";
            addKinds(
                labels.residueClassOf, ballColors(atoms, by, progress),
                [&](ResidueClass c) { return bases ? nameOfBase(c) : nameOf(c); }, legend);
            if (bases)
                std::sort(legend.entries.begin(), legend.entries.end(),
                          [](const auto& a, const auto& b) { return a.name < b.name; });
        }
        if (!legend.entries.empty()) addOther(mesh, legend);
        if (!legend.entries.empty() || legend.scale) found = legend;
    }
    if (found) found->id = molsurf::nameOf(by);
    return found;
}

} // namespace molsurf
