// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/lining.h"
#include "molsurf/report.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

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

/// The columns of a table of pores, filled row by row.
class PoreColumns
{
public:
    void add(const BallSet& atoms, const Report::Pore& pore)
    {
        ++pores_;
        const double nobody = std::numeric_limits<double>::quiet_NaN();
        const double conductance =
            pore.stations.empty() ? nobody : pore.conductance().value_or(nobody);
        for (const Report::Pore::Station& s : pore.stations) {
            double height = 0.0;
            for (std::size_t i = 0; i < 3; ++i) height += pore.axis[i] * s.place[i];
            const std::array<double, 9> row = {
                s.distance,    height,      s.place[0],
                s.place[1],    s.place[2],  s.radius,
                pore.length(), conductance, Report::Pore::bulkResistivity};
            for (std::size_t k = 0; k < row.size(); ++k) numbers_[k].push_back(row[k]);
            necks_.push_back(s.isBottleneck);
            number_.push_back(pores_);
            Lining lining = namesOf(atoms, s.lining);
            residues_.push_back(std::move(lining.residues));
            ids_.push_back(std::move(lining.atoms));
        }
    }

    void moveTo(Table& table)
    {
        constexpr std::array<const char*, 9> names = {
            "distance_A",     "height_A",         "x_A", "y_A", "z_A", "radius_A", "length_A",
            "conductance_pS", "resistivity_ohm_m"};
        const auto numbers = [&](std::size_t k) {
            table.columns.push_back({names[k], std::move(numbers_[k])});
        };
        for (std::size_t k = 0; k < 6; ++k) numbers(k);
        table.columns.push_back({"bottleneck", std::move(necks_)});
        table.columns.push_back({"residues", std::move(residues_)});
        table.columns.push_back({"atom_ids", std::move(ids_)});
        table.columns.push_back({"pore", std::move(number_)});
        for (std::size_t k = 6; k < 9; ++k) numbers(k);
    }

private:
    std::int64_t pores_ = 0;
    std::array<std::vector<double>, 9> numbers_;
    std::vector<std::int64_t> necks_, number_;
    std::vector<std::string> residues_, ids_;
};

} // namespace

Table Report::Pore::table(const BallSet& atoms) const
{
    PoreColumns columns;
    columns.add(atoms, *this);
    for (const Pore& pore : bundle) columns.add(atoms, pore);
    Table table{"pore", {}};
    columns.moveTo(table);
    return table;
}

} // namespace molsurf
