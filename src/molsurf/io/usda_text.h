// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Words of USD's text that the writers of .usda files share.

#include <cctype>
#include <string>

namespace molsurf
{

constexpr const char* usdaFirstLine = "#usda 1.0";
constexpr double usdaMetersPerAngstrom = 1e-10;

/// A name of a prim: letters that USD does not take become _.
inline std::string usdaIdentifier(const std::string& name)
{
    std::string word;
    for (const char letter : name)
        word += std::isalnum(static_cast<unsigned char>(letter)) ? letter : '_';
    if (word.empty() || std::isdigit(static_cast<unsigned char>(word[0]))) word = "_" + word;
    return word;
}

} // namespace molsurf
