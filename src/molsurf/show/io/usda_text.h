// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Words of USD's text that the writers of .usda files share.

#include "molsurf/show/io/output_buffer.h"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace molsurf
{

constexpr const char* usdaFirstLine = "#usda 1.0";
constexpr double usdaMetersPerAngstrom = 1e-10;

// Of the layer of a frame: its `frames.options`, and its number in the input.
constexpr const char *usdaFrameOptions = "framesOptions", *usdaFrame = "frame";

/// A name of a prim: letters that USD does not take become _.
std::string usdaIdentifier(const std::string& name);

/// A string of USD.
std::string usdaString(const std::string& text);

/// A path of USD to a file in the same folder; one with an @ takes three of them on each side.
std::string usdaAsset(const std::string& file);

/// A line of a layer's customLayerData.
std::string usdaDataLine(const std::string& name, const std::string& value);

/// A string of a file's customLayerData, whose lines usdaDataLine() has made; empty if there is
/// none.
std::string usdaData(const std::string& path, const std::string& name);

/// A UsdPreviewSurface, the Material `name` under the path `above`.
/// @param[in] byVertex  the colour is that of the vertices, displayColor
void putUsdaMaterial(TextOutput& out, const std::string& above, const std::string& name,
                     const std::array<std::uint8_t, 3>& color, bool byVertex,
                     const std::string& indent);

/// (a, b, ...), with so many digits behind the point.
template<typename Numbers>
void putTuple(TextOutput& out, const Numbers& numbers, int size, int digits)
{
    for (int i = 0; i < size; ++i)
        (out << (i == 0 ? "(" : ", ")).fixed(double(numbers[std::size_t(i)]), digits);
    out << ")";
}

/// [...], with one call of `put` for each element.
template<typename Put>
void putList(TextOutput& out, std::size_t count, const Put& put)
{
    out << "[";
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0) out << ", ";
        put(i);
    }
    out << "]";
}

/// name = [...]
template<typename Put>
void putArray(TextOutput& out, std::string_view name, std::size_t count, const Put& put)
{
    out << name << " = ";
    putList(out, count, put);
}

constexpr int usdaLengthDigits = 4;    // behind the point [Å]
constexpr int usdaDirectionDigits = 4; // of normals and colours

} // namespace molsurf
