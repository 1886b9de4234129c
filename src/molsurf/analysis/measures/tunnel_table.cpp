// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/station_columns.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

namespace molsurf
{

Lining liningOfTunnel(const BallSet& atoms, const Report::Tunnels::Tunnel& tunnel)
{
    std::map<std::size_t, double> lengths;
    for (std::size_t i = 0; i < tunnel.stations.size(); ++i) {
        const double from = tunnel.stations[i > 0 ? i - 1 : i].distance,
                     to = tunnel.stations[std::min(i + 1, tunnel.stations.size() - 1)].distance;
        for (const std::size_t ball : tunnel.stations[i].lining) lengths[ball] += 0.5 * (to - from);
    }
    return liningOf(atoms, {lengths.begin(), lengths.end()});
}

const Report::Pore::Station& Report::Tunnels::Tunnel::narrowest() const
{
    return *std::min_element(stations.begin(), stations.end(),
                             [](const auto& a, const auto& b) { return a.radius < b.radius; });
}

double Report::Tunnels::Tunnel::curvature() const
{
    const auto &from = stations.front().place, &to = stations.back().place;
    return length() / std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
}

Table Report::Tunnels::table(const BallSet& atoms) const
{
    StationColumns columns({"distance_A", "x_A", "y_A", "z_A", "radius_A", "bottleneck_A",
                            "length_A", "curvature", "hydrophobicity", "charge", "probe_A",
                            "probe_out_A"});
    for (const Tunnel& tunnel : list) {
        const Lining all = liningOfTunnel(atoms, tunnel);
        for (const Report::Pore::Station& s : tunnel.stations)
            columns.add(atoms, s, std::int64_t(tunnel.number),
                        {s.distance, s.place[0], s.place[1], s.place[2], s.radius,
                         tunnel.narrowest().radius, tunnel.length(), tunnel.curvature(),
                         all.hydrophobicity, all.charge, probe, probeOut});
    }
    Table table{"tunnels", {}};
    columns.moveWays("tunnel", table);
    columns.moveNumbers(0, 5, table);
    columns.moveLining(table);
    columns.moveNumbers(5, 12, table);
    return table;
}

} // namespace molsurf
