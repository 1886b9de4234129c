// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What the tests of reports share.

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace molsurf
{

using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

/// The keys of an object, in their order.
inline Names keys(const Json& json)
{
    Names names;
    for (const auto& item : json.items()) names.push_back(item.key());
    return names;
}

} // namespace molsurf
