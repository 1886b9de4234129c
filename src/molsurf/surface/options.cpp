// SPDX-License-Identifier: MPL-2.0
#include "molsurf/options.h"

#include "molsurf/error.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/surface/field_table.h"
#include "molsurf/surface/product_table.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace molsurf
{

namespace
{

void check(bool good, const std::string& option, const std::string& expected, double got)
{
    if (good) return;
    std::ostringstream message;
    message << option << ": expected " << expected << ", got " << got;
    throw Error(ErrorKind::Usage, message.str());
}

void checkPockets(const Products& wanted)
{
    const Products::PocketRule& pocket = wanted.pocket;
    check(pocket.probeIn >= 0.5 && pocket.probeIn <= 10.0, "`probeIn`", "0.5 to 10 Å",
          pocket.probeIn);
    check(pocket.probeOut > pocket.probeIn && pocket.probeOut <= 50.0, "`probeOut`",
          "more than `probeIn`, and at most 50 Å", pocket.probeOut);
    const double tunnel = wanted.tunnelProbe;
    check(tunnel >= 0.3 && tunnel <= 10.0 && tunnel < pocket.probeOut, "`tunnelProbe`",
          "0.3 to 10 Å, and less than `probeOut`", tunnel);
    check(pocket.cut >= 0.0 && pocket.cut <= 50.0, "`pocketCut`", "0 to 50 Å", pocket.cut);
    check(pocket.neck >= 0.0 && pocket.neck <= 1.0, "`pocketNeck`", "0 to 1", pocket.neck);
}

} // namespace

void checkOptions(const SurfaceOptions& options)
{
    const auto finite = [](double x) { return std::isfinite(x); };
    check(options.voxel >= minVoxel && options.voxel <= maxVoxel, "`voxel`", "0.05 to 10 Å",
          options.voxel);
    check(finite(options.probe) && options.probe >= 0.0 && options.probe <= 100.0, "`probe`",
          "0 to 100 Å", options.probe);
    check(options.epsilon >= 0.01 && options.epsilon <= 10.0, "`epsilon`", "0.01 to 10 Å",
          options.epsilon);
    check(options.blobbiness >= 0.1 && options.blobbiness <= 100.0, "`blobbiness`", "0.1 to 100",
          options.blobbiness);
    check(options.evolution.lambda >= 0.0 && options.evolution.lambda <= 1e6, "`lambda`",
          "0 to 1e6", options.evolution.lambda);
    check(finite(options.inset) && options.inset >= 0.0 && options.inset <= 1.0, "`inset`",
          "0 to 1 Å", options.inset);
    check(options.minThickness >= 0.0 && options.minThickness <= maxThickness, "`minThickness`",
          "0 to 100 Å", options.minThickness);
    check(options.inset == 0.0 || options.voxel <= 0.5, "`match` ses: `voxel`", "at most 0.5 Å",
          options.voxel);
    check(options.evolution.tolerance > 0.0 && finite(options.evolution.tolerance), "`tolerance`",
          "a positive number", options.evolution.tolerance);
    check(options.meshEdge == 0.0 || (options.meshEdge >= 0.05 && options.meshEdge <= 10.0),
          "`remesh`", "0.05 to 10 Å", options.meshEdge);
    check(options.meshError == 0.0 || (options.meshError >= 0.001 && options.meshError <= 1.0),
          "`adapt`", "0.001 to 1 Å", options.meshError);
    if (options.meshError > 0.0 && options.meshEdge == 0.0)
        throw Error(ErrorKind::Usage, "`adapt`: expected `remesh` too, the longest edge");
    const double smooth = options.smoothColors;
    check(smooth == 0.0 || (smooth >= 0.5 && smooth <= 20.0), "`smoothColors`", "0.5 to 20 Å",
          smooth);
    checkPockets(options);
    for (const std::string& field : options.fields) {
        const FieldRow* row = findField(field);
        if (!row) throw Error(ErrorKind::Usage, "`fields`: there is no field '" + field + "'");
        if (row->needs && !row->given(options))
            throw Error(ErrorKind::Usage, "`fields` " + field + ": expected " + row->needs);
    }
    for (const std::string& name : options.measures) {
        const auto& rows = measureTable();
        if (std::none_of(rows.begin(), rows.end(), [&](auto& row) { return row.name == name; }))
            throw Error(ErrorKind::Usage, "`measures`: there is no measure '" + name + "'");
    }
    if (!options.grid && !hasClosedForm(options))
        throw Error(ErrorKind::Usage,
                    "`grid`: there is no closed form for what is asked for [hint: `kind` ses, sas "
                    "or vdw]");
    check(options.splineLevel >= 0 && options.splineLevel <= 2, "`splineLevel`", "0, 1 or 2",
          options.splineLevel);
}

} // namespace molsurf
