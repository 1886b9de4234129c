// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Numbers in the bytes of files.

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace molsurf
{

/// Which byte of a number comes first.
enum class ByteOrder {
    Little, ///< the least significant
    Big     ///< the most significant, as in XDR and NetCDF
};

/// An unsigned number of up to 8 bytes.
inline std::uint64_t unsignedAt(const char* bytes, std::size_t width, ByteOrder order)
{
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < width; ++k)
        value = value << 8 | std::uint8_t(bytes[order == ByteOrder::Big ? k : width - 1 - k]);
    return value;
}

/// A number of IEEE 754.
/// @param[in] width  4 or 8 bytes
inline double realAt(const char* bytes, std::size_t width, ByteOrder order)
{
    const std::uint64_t bits = unsignedAt(bytes, width, order);
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
