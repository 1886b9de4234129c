// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Names by index, each stored once.

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace molsurf
{

/// Finds the index of a name in a list that it alone appends to.
class NameTable
{
public:
    /// Index of `name` in `names`; appends it if it is new.
    std::int32_t index(const std::string& name, std::vector<std::string>& names)
    {
        if (last_ >= 0 && names[std::size_t(last_)] == name) return last_;
        const auto found = indices_.emplace(name, static_cast<std::int32_t>(names.size()));
        if (found.second) names.push_back(name);
        return last_ = found.first->second;
    }

private:
    std::unordered_map<std::string, std::int32_t> indices_;
    std::int32_t last_ = -1; // neighbours mostly share a name
};

} // namespace molsurf
