// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/lining.h"
#include "molsurf/report.h"
#include "molsurf/surface/tunnels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace molsurf
{

namespace
{

using Tunnel = Report::Tunnels::Tunnel;

/// The columns of a table of tunnels, filled row by row.
class TunnelColumns
{
public:
    void add(const BallSet& atoms, const Report::Tunnels& tunnels, const Tunnel& tunnel)
    {
        ++count_;
        const Lining all = liningOfTunnel(atoms, tunnel);
        for (const Report::Pore::Station& s : tunnel.stations) {
            const std::array<double, 12> row = {
                s.distance,      s.place[0],         s.place[1],
                s.place[2],      s.radius,           tunnel.narrowest().radius,
                tunnel.length(), tunnel.curvature(), all.hydrophobicity,
                all.charge,      tunnels.probe,      tunnels.probeOut};
            for (std::size_t k = 0; k < row.size(); ++k) numbers_[k].push_back(row[k]);
            number_.push_back(count_);
            necks_.push_back(s.isBottleneck);
            Lining lining = namesOf(atoms, s.lining);
            residues_.push_back(std::move(lining.residues));
            ids_.push_back(std::move(lining.atoms));
        }
    }

    void moveTo(Table& table)
    {
        constexpr std::array<const char*, 12> names = {"distance_A", "x_A",       "y_A",
                                                       "z_A",        "radius_A",  "bottleneck_A",
                                                       "length_A",   "curvature", "hydrophobicity",
                                                       "charge",     "probe_A",   "probe_out_A"};
        const auto numbers = [&](std::size_t from, std::size_t to) {
            for (std::size_t k = from; k < to; ++k)
                table.columns.push_back({names[k], std::move(numbers_[k])});
        };
        table.columns.push_back({"tunnel", std::move(number_)});
        numbers(0, 5);
        table.columns.push_back({"bottleneck", std::move(necks_)});
        table.columns.push_back({"residues", std::move(residues_)});
        table.columns.push_back({"atom_ids", std::move(ids_)});
        numbers(5, names.size());
    }

private:
    std::int64_t count_ = 0;
    std::array<std::vector<double>, 12> numbers_;
    std::vector<std::int64_t> number_, necks_;
    std::vector<std::string> residues_, ids_;
};

} // namespace

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
    TunnelColumns columns;
    for (const Tunnel& tunnel : list) columns.add(atoms, *this, tunnel);
    Table table{"tunnels", {}};
    columns.moveTo(table);
    return table;
}

} // namespace molsurf
