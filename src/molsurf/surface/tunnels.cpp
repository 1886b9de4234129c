// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/tunnels.h"

#include "molsurf/analysis/pockets/find_pore.h"
#include "molsurf/analysis/pockets/find_tunnels.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/pipeline/surface_run.h"
#include "molsurf/show/color/pore_color.h"
#include "molsurf/surface/pore.h"

#include <algorithm>
#include <string>
#include <utility>

namespace molsurf
{

void addTunnels(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                Report& report)
{
    Stopwatch watch(report);
    progress.update("tunnels", 0.0);
    report.tunnels = findTunnels(atoms.balls, *options.places.tunnelsFrom,
                                 {options.tunnelProbe, options.pocket.probeOut}, progress);
    watch.stop("tunnels");
}

Mesh tunnelTubes(const Report::Tunnels& tunnels)
{
    Mesh mesh;
    mesh.scalars.push_back({"radius", {}});
    for (const Report::Tunnels::Tunnel& tunnel : tunnels.list) {
        mesh.parts.push_back({"tunnel " + std::to_string(tunnel.number), mesh.triangles.size()});
        addTube(tunnel.stations, mesh);
    }
    return mesh;
}

std::vector<LegendEntry> tubeLegend(const Mesh& tubes)
{
    const auto [low, high] = poreSteps;
    std::vector<LegendEntry> out;
    const auto add = [&](double radius, std::string name) {
        const Color color = poreColor(radius);
        if (std::count(tubes.colors.begin(), tubes.colors.end(), color) > 0)
            out.push_back({std::move(name), color});
    };
    add(0.0, formatted("below %g Å", low));
    add(low, formatted("%g to %g Å", low, high));
    add(high, formatted("from %g Å", high));
    return out;
}

BallSet tunnelBalls(const Report::Tunnels& tunnels)
{
    BallSet out;
    out.names.emplace();
    for (const Report::Tunnels::Tunnel& tunnel : tunnels.list) {
        const auto place = std::int32_t(out.names->residues.size());
        out.names->residues.push_back({"T", "T", "TUN", int(tunnel.number), ' ', true});
        for (const Report::Pore::Station& s : tunnel.stations) {
            out.balls.push_back({placeOf(s), s.radius, std::int32_t(out.balls.size() + 1)});
            out.names->residueOf.push_back(place);
            out.names->atoms.push_back({"X", '\0', 0, 1.0f});
        }
    }
    return out;
}

} // namespace molsurf
