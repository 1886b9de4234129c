// SPDX-License-Identifier: MPL-2.0
#include "molsurf/core/words.h"
#include "molsurf/report.h"
#include "molsurf/selection/ball_names.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace molsurf
{

double Report::Pore::narrowest() const
{
    const auto narrower = [](const Station& a, const Station& b) { return a.radius < b.radius; };
    return std::min_element(stations.begin(), stations.end(), narrower)->radius;
}

double Report::Pore::conductance() const
{
    constexpr double pi = 3.14159265358979323846;
    if (narrowest() <= 0.0) return 0.0;
    double sum = 0.0; // integral of ds / (pi r^2) by the trapezoidal rule [1/Å]
    const auto inverse = [](const Station& s) { return 1.0 / (pi * s.radius * s.radius); };
    for (std::size_t i = 1; i < stations.size(); ++i)
        sum += 0.5 * (inverse(stations[i]) + inverse(stations[i - 1])) *
               (stations[i].distance - stations[i - 1].distance);
    constexpr double perMetre = 1e10, picosiemens = 1e12;
    return sum > 0.0 ? picosiemens / (bulkResistivity * sum * perMetre) : 0.0;
}

Table Report::Pore::table(const BallSet& atoms) const
{
    constexpr std::array<const char*, 6> names = {"distance_A", "height_A", "x_A",
                                                  "y_A",        "z_A",      "radius_A"};
    std::array<std::vector<double>, names.size()> numbers;
    std::vector<std::int64_t> necks;
    std::vector<std::string> residues, ids;
    for (const Station& s : stations) {
        double height = 0.0;
        for (std::size_t i = 0; i < 3; ++i) height += axis[i] * s.place[i];
        const std::array<double, names.size()> row = {s.distance, height,     s.place[0],
                                                      s.place[1], s.place[2], s.radius};
        for (std::size_t k = 0; k < row.size(); ++k) numbers[k].push_back(row[k]);
        necks.push_back(s.isBottleneck);
        std::set<std::int32_t> seen;
        std::string title, places;
        for (const std::size_t ball : s.lining) {
            places += (places.empty() ? "" : " ") + std::to_string(atoms.balls[ball].atom);
            if (!atoms.names || !seen.insert(atoms.names->residueOf[ball]).second) continue;
            const BallNames::Residue& residue =
                atoms.names->residues[std::size_t(atoms.names->residueOf[ball])];
            if (!residue.name.empty()) title += (title.empty() ? "" : " ") + titleOf(residue);
        }
        residues.push_back(std::move(title));
        ids.push_back(std::move(places));
    }
    Table table{"pore", {}};
    if (!stations.empty())
        table.note = formatted("pore: narrowest %.4f A, length %.2f A, conductance %.4g pS at "
                               "%g ohm m",
                               narrowest(), length(), conductance(), bulkResistivity);
    for (std::size_t k = 0; k < names.size(); ++k)
        table.columns.push_back({names[k], std::move(numbers[k])});
    table.columns.push_back({"bottleneck", std::move(necks)});
    table.columns.push_back({"residues", std::move(residues)});
    table.columns.push_back({"atom_ids", std::move(ids)});
    return table;
}

} // namespace molsurf
