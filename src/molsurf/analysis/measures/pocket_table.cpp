// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/lining.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/report.h"

#include <array>
#include <cstdlib>
#include <limits>
#include <utility>

namespace molsurf
{

namespace
{

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A number without the digits that voxels do not resolve.
double resolvedDigits(double number)
{
    return std::strtod(formatted("%.7g", number).c_str(), nullptr);
}

/// What lines a pocket.
Lining liningOfPocket(const BallSet& atoms, const Report::Pockets::Pocket& pocket)
{
    std::vector<std::pair<std::size_t, double>> parts;
    for (const Report::Pockets::Pocket::Lining& part : pocket.lining)
        parts.emplace_back(part.ball, part.area);
    return liningOf(atoms, parts);
}

/// The columns of a table of pockets, filled row by row.
class PocketColumns
{
public:
    void add(const BallSet& atoms, const Report::Pockets::Pocket& pocket)
    {
        double mouthArea = 0.0, mouthRadius = unknown;
        std::array<double, 3> mouthPlace = {unknown, unknown, unknown};
        for (const Report::Pockets::Pocket::Mouth& mouth : pocket.mouths) {
            mouthArea += mouth.area;
            if (mouth.radius <= mouthRadius) continue;
            mouthRadius = mouth.radius;
            mouthPlace = mouth.place;
        }
        const Lining lining = liningOfPocket(atoms, pocket);
        const std::array<double, 14> row = {
            pocket.volume,         pocket.area,      pocket.depth,     pocket.radius,
            pocket.centre[0],      pocket.centre[1], pocket.centre[2], mouthArea,
            mouthRadius,           mouthPlace[0],    mouthPlace[1],    mouthPlace[2],
            lining.hydrophobicity, lining.charge};
        for (std::size_t k = 0; k < row.size(); ++k) numbers_[k].push_back(resolvedDigits(row[k]));
        number_.push_back(std::int64_t(number_.size()) + 1);
        rank_.push_back(std::int64_t(pocket.rank));
        open_.push_back(pocket.open);
        mouths_.push_back(std::int64_t(pocket.mouths.size()));
        atoms_.push_back(std::int64_t(pocket.lining.size()));
        std::string near;
        for (const std::size_t other : pocket.neighbours)
            near += (near.empty() ? "" : " ") + std::to_string(other);
        neighbours_.push_back(near);
        residues_.push_back(lining.residues);
        ids_.push_back(lining.atoms);
    }

    void moveTo(Table& table)
    {
        const auto numbers = [&](const char* name, std::size_t k) {
            table.columns.push_back({name, std::move(numbers_[k])});
        };
        table.columns.push_back({"pocket", std::move(number_)});
        constexpr std::array<const char*, 7> first = {"volume", "area", "depth_A", "radius_A",
                                                      "x_A",    "y_A",  "z_A"};
        for (std::size_t k = 0; k < first.size(); ++k) numbers(first[k], k);
        table.columns.push_back({"open", std::move(open_)});
        table.columns.push_back({"mouths", std::move(mouths_)});
        numbers("mouth_area", 7);
        numbers("mouth_radius_A", 8);
        numbers("mouth_x_A", 9);
        numbers("mouth_y_A", 10);
        numbers("mouth_z_A", 11);
        table.columns.push_back({"rank", std::move(rank_)});
        table.columns.push_back({"neighbours", std::move(neighbours_)});
        numbers("hydrophobicity", 12);
        numbers("charge", 13);
        table.columns.push_back({"atoms", std::move(atoms_)});
        table.columns.push_back({"residues", std::move(residues_)});
        table.columns.push_back({"atom_ids", std::move(ids_)});
    }

private:
    std::vector<std::int64_t> number_, rank_, open_, mouths_, atoms_;
    std::array<std::vector<double>, 14> numbers_;
    std::vector<std::string> neighbours_, residues_, ids_;
};

} // namespace

Table Report::Pockets::table(const BallSet& atoms) const
{
    PocketColumns columns;
    for (const Pocket& pocket : list) columns.add(atoms, pocket);
    if (isChosen && list.empty()) columns.add(atoms, {}); // it is closed
    Table table{"pockets", {}};
    columns.moveTo(table);
    const std::size_t rows = std::get<std::vector<std::int64_t>>(table.columns[0].values).size();
    const std::pair<const char*, double> asked[] = {{"probe_in_A", probeIn},
                                                    {"probe_out_A", probeOut},
                                                    {"cut_A", cut},
                                                    {"neck", neck},
                                                    {"voxel_A", voxel}};
    for (const auto& [name, value] : asked)
        table.columns.push_back({name, std::vector<double>(rows, value)});
    return table;
}

} // namespace molsurf
