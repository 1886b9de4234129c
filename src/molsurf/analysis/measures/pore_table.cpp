// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/station_columns.h"
#include "molsurf/report.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace molsurf
{

double Report::Pore::narrowest() const
{
    const auto narrower = [](const Station& a, const Station& b) { return a.radius < b.radius; };
    return std::min_element(stations.begin(), stations.end(), narrower)->radius;
}

std::optional<double> Report::Pore::conductance() const
{
    constexpr double pi = 3.14159265358979323846;
    if (narrowest() < leastWater) return {};
    double sum = 0.0; // integral of ds / (pi r^2) by the trapezoidal rule [1/Å]
    const auto inverse = [](const Station& s) { return 1.0 / (pi * s.radius * s.radius); };
    for (std::size_t i = 1; i < stations.size(); ++i)
        sum += 0.5 * (inverse(stations[i]) + inverse(stations[i - 1])) *
               (stations[i].distance - stations[i - 1].distance);
    constexpr double perMetre = 1e10, picosiemens = 1e12;
    if (!(sum > 0.0)) return {};
    return picosiemens / (bulkResistivity * sum * perMetre);
}

namespace
{

/// Adds the sections of a pore.
void addPore(const BallSet& atoms, const Report::Pore& pore, std::int64_t number,
             StationColumns& columns)
{
    const double nobody = std::numeric_limits<double>::quiet_NaN();
    const double conductance = pore.stations.empty() ? nobody : pore.conductance().value_or(nobody);
    for (const Report::Pore::Station& s : pore.stations) {
        double height = 0.0;
        for (std::size_t i = 0; i < 3; ++i) height += pore.axis[i] * s.place[i];
        columns.add(atoms, s, number,
                    {s.distance, height, s.place[0], s.place[1], s.place[2], s.radius,
                     pore.length(), conductance, Report::Pore::bulkResistivity});
    }
}

} // namespace

Table Report::Pore::table(const BallSet& atoms) const
{
    StationColumns columns({"distance_A", "height_A", "x_A", "y_A", "z_A", "radius_A", "length_A",
                            "conductance_pS", "resistivity_ohm_m"});
    std::int64_t number = 1;
    addPore(atoms, *this, number, columns);
    for (const Pore& other : bundle) addPore(atoms, other, ++number, columns);
    Table table{"pore", {}};
    columns.moveNumbers(0, 6, table);
    columns.moveLining(table);
    columns.moveWays("pore", table);
    columns.moveNumbers(6, 9, table);
    return table;
}

} // namespace molsurf
