// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The columns that tables of pores and tunnels share, filled section by section.

#include "molsurf/analysis/measures/lining.h"
#include "molsurf/atoms.h"
#include "molsurf/report.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

/// A row for each section: its numbers by name, the way that it is of, whether it is a bottleneck,
/// and what lines it.
class StationColumns
{
public:
    /// @param[in] names  of the numbers of a row
    explicit StationColumns(std::vector<const char*> names)
        : names_(std::move(names)), numbers_(names_.size())
    {
    }

    /// @param[in] way      that the section is of, its number from 1
    /// @param[in] numbers  one a name
    void add(const BallSet& atoms, const Report::Pore::Station& station, std::int64_t way,
             const std::vector<double>& numbers)
    {
        for (std::size_t k = 0; k < numbers_.size(); ++k) numbers_[k].push_back(numbers[k]);
        ways_.push_back(way);
        necks_.push_back(station.isBottleneck);
        Lining lining = namesOf(atoms, station.lining);
        residues_.push_back(std::move(lining.residues));
        ids_.push_back(std::move(lining.atoms));
    }

    /// Moves the numbers [from, to) into a table.
    void moveNumbers(std::size_t from, std::size_t to, Table& table)
    {
        for (std::size_t k = from; k < to; ++k)
            table.columns.push_back({names_[k], std::move(numbers_[k])});
    }

    /// Moves the others there: the number of the way under a name, or what lines it.
    void moveWays(const char* name, Table& table)
    {
        table.columns.push_back({name, std::move(ways_)});
    }
    void moveLining(Table& table)
    {
        table.columns.push_back({"bottleneck", std::move(necks_)});
        table.columns.push_back({"residues", std::move(residues_)});
        table.columns.push_back({"atom_ids", std::move(ids_)});
    }

private:
    std::vector<const char*> names_;
    std::vector<std::vector<double>> numbers_;
    std::vector<std::int64_t> ways_, necks_;
    std::vector<std::string> residues_, ids_;
};

} // namespace molsurf
