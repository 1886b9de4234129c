// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Numbers whose most significant byte comes first, as XDR and NetCDF have them.

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace molsurf
{

/// An unsigned number of up to 8 bytes.
inline std::uint64_t bigEndian(const char* bytes, std::size_t width)
{
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < width; ++k) value = value << 8 | std::uint8_t(bytes[k]);
    return value;
}

/// A number of IEEE 754.
/// @param[in] width  4 or 8 bytes
inline double bigEndianReal(const char* bytes, std::size_t width)
{
    const std::uint64_t bits = bigEndian(bytes, width);
    if (width == 8) {
        double value = 0.0;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }
    const auto half = std::uint32_t(bits);
    float value = 0.0f;
    std::memcpy(&value, &half, sizeof value);
    return double(value);
}

} // namespace molsurf
