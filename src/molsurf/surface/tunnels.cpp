// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/tunnels.h"

#include "molsurf/analysis/pockets/find_tunnels.h"
#include "molsurf/kernel/pipeline/surface_run.h"
#include "molsurf/surface/pore.h"

#include <string>

namespace molsurf
{

void addTunnels(const BallSet& atoms, const SurfaceOptions& options, Progress& progress,
                Report& report)
{
    Stopwatch watch(report);
    progress.update("tunnels", 0.0);
    report.tunnels = findTunnels(atoms.balls, *atoms.tunnelsFrom,
                                 {options.tunnelProbe, options.pocket.probeOut}, progress);
    watch.stop("tunnels");
}

Mesh tunnelTubes(const Report::Tunnels& tunnels)
{
    Mesh mesh;
    mesh.scalars.push_back({"radius", {}});
    for (const Report::Tunnels::Tunnel& tunnel : tunnels.list) {
        mesh.parts.push_back(
            {"tunnel " + std::to_string(mesh.parts.size() + 1), mesh.triangles.size()});
        addTube(tunnel.stations, mesh);
    }
    return mesh;
}

BallSet tunnelBalls(const Report::Tunnels& tunnels)
{
    BallSet out;
    out.names.emplace();
    for (const Report::Tunnels::Tunnel& tunnel : tunnels.list) {
        const auto number = std::int32_t(out.names->residues.size());
        out.names->residues.push_back({"T", "T", "TUN", number + 1, ' ', true});
        for (const Report::Pore::Station& s : tunnel.stations) {
            out.balls.push_back({openvdb::Vec3d(s.place[0], s.place[1], s.place[2]), s.radius,
                                 std::int32_t(out.balls.size() + 1)});
            out.names->residueOf.push_back(number);
            out.names->atoms.push_back({"X", '\0', 0, 1.0f});
        }
    }
    return out;
}

} // namespace molsurf
