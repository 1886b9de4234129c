// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/whole_only.h"

#include "molsurf/color/color_table.h"
#include "molsurf/error.h"
#include "molsurf/surface/field_table.h"
#include "molsurf/surface/surface_kind.h"

namespace molsurf
{

namespace
{

struct Row {
    const char* what;
    unsigned ways; ///< that cannot give it
    bool (*asked)(const SurfaceOptions& options);
};

const Row rows[] = {
    {"`surface`", InClosedForm, [](auto& o) { return !isClosedForm(o); }},
    {"`split`", InBricks | BySymmetry | InClosedForm | ByAtom, [](auto& o) { return o.split; }},
    {"`surfaceOf`", InBricks | BySymmetry | InClosedForm | ByAtom,
     [](auto& o) { return !o.surfaceOf.empty(); }},
    {"`interfaces`", InBricks, [](auto& o) { return o.interfaces; }},
    {"`pockets`", InBricks | BySymmetry,
     [](auto& o) { return o.pockets || o.color == ColorBy::Pocket; }},
    {"`matchVolume`", InBricks | BySymmetry, [](auto& o) { return o.matchVolume; }},
    {"`fillCavities`", InBricks | BySymmetry | InClosedForm,
     [](auto& o) { return o.fillCavities; }},
    {"`minWall`", InBricks, [](auto& o) { return o.minWall > 0.0; }},
    {"a solvent-excluded surface without `grid`", BySymmetry,
     [](auto& o) { return !o.grid && !isBoundary(o); }},
    {"`curvatureTotals`", InBricks | BySymmetry | InClosedForm,
     [](auto& o) { return o.curvatureTotals; }},
    {"`remesh`", InBricks | BySymmetry | InClosedForm, [](auto& o) { return o.meshEdge > 0.0; }},
    {"`splineLevel`", InBricks, [](auto& o) { return o.splineLevel > 0; }},
    {"`flow` paper", InBricks,
     [](auto& o) { return hasFlow(o.kind) && o.evolution.flow == Flow::Paper; }},
    {"`color` by curvature", InBricks, [](auto& o) { return kindOf(o.color).ofCurvature; }}};

} // namespace

std::string missingIn(Way way, const SurfaceOptions& options)
{
    for (const Row& row : rows)
        if ((row.ways & way) && row.asked(options)) return row.what;
    for (const FieldRow& row : fieldTable())
        if ((row.missingIn & way) && hasField(options.fields, row.name))
            return "`fields` " + row.name;
    return "";
}

void checkWay(Way way, const SurfaceOptions& options)
{
    const std::string what = missingIn(way, options);
    if (what.empty()) return;
    if (way == ByAtom)
        throw Error(ErrorKind::Usage, "areas of atoms: expected one surface, and not " + what);
    throw Error(ErrorKind::Usage,
                what + (way == InBricks ? " needs the whole molecule at once: it is not for bricks "
                                          "[hint: a run in one piece, on a machine that has enough "
                                          "memory]"
                                        : " needs the whole assembly at once [hint: without "
                                          "`bySymmetry`]"));
}

} // namespace molsurf
