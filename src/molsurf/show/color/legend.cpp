// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/color/legend.h"

#include "molsurf/show/color/color_table.h"
#include "molsurf/show/color/palette.h"

#include <algorithm>

namespace molsurf
{

void addEntry(const LegendEntry& entry, std::vector<LegendEntry>& entries)
{
    for (const LegendEntry& known : entries)
        if (known.name == entry.name && known.color == entry.color) return;
    entries.push_back(entry);
}

std::optional<Legend> legendOf(ColorBy by, const BallSet& atoms, const Mesh& mesh,
                               const Progress& progress)
{
    const ColorKind& kind = kindOf(by);
    if (!kind.describe || (kind.has && !kind.has(atoms))) return {};
    Legend legend;
    legend.title = kind.title;
    legend.id = kind.word;
    legend.attribute = kind.attribute;
    legend.unit = kind.unit;
    kind.describe(atoms, mesh, progress, legend);
    if (legend.scale) return legend;
    if (legend.entries.empty()) return {};
    for (const auto& label : mesh.labels) {
        if (label.name == legend.attribute &&
            std::count(label.values.begin(), label.values.end(), -1) > 0)
            legend.entries.push_back({"other", neutralColor});
    }
    return legend;
}

std::vector<Legend> offeredLegends(ColorBy asked, const BallSet& atoms, const Mesh& mesh,
                                   const Progress& progress)
{
    std::vector<ColorBy> kinds = {asked};
    for (const ColorKind& kind : colorTable())
        if (kind.offered && kind.by != asked) kinds.push_back(kind.by);
    std::vector<Legend> legends;
    for (const ColorBy kind : kinds)
        if (auto legend = legendOf(kind, atoms, mesh, progress))
            legends.push_back(std::move(*legend));
    return legends;
}

} // namespace molsurf
