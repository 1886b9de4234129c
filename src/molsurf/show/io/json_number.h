// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Numbers of a JSON text that others have written.

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace molsurf
{

/// A number, checked before it is converted: nlohmann's own conversion makes anything of 1e300.
/// @throws std::range_error if it is none, if it is beyond T, or no whole number where T is one
template<typename T, typename Json>
T jsonNumber(const Json& json)
{
    using Limits = std::numeric_limits<T>;
    bool fits;
    if constexpr (std::is_floating_point_v<T>)
        fits = json.is_number() && std::abs(json.template get<double>()) <= double(Limits::max());
    else if (json.is_number_unsigned())
        fits = json.template get<std::uint64_t>() <= std::uint64_t(Limits::max());
    else
        fits = json.is_number_integer() && std::is_signed_v<T> &&
               json.template get<std::int64_t>() >= std::int64_t(Limits::min());
    if (!fits) throw std::range_error("numbers are none, or too large");
    return json.template get<T>();
}

template<typename T, typename Json>
std::vector<T> jsonNumbers(const Json& json)
{
    std::vector<T> out;
    for (const Json& number : json) out.push_back(jsonNumber<T>(number));
    return out;
}

} // namespace molsurf
