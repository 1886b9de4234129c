// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Colours for values.

#include <openvdb/Types.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace molsurf
{

/// Red, green, blue; sRGB, 8 bits.
using Color = std::array<std::uint8_t, 3>;

/// Linear light of a colour (IEC 61966-2-1), which renderers compute in.
openvdb::Vec3f linearLight(const Color& color);

/// The part of a colour that has so much linear light, in [0, 1] or next to it.
std::uint8_t fromLinearLight(double light);

/// A colour as text, "#rrggbb".
std::string hexOf(const Color& color);

/// A range of values and the colours that it runs through.
struct ColorScale {
    std::string map;          ///< "viridis" or "RdBu"
    double low, high;         ///< values at the ends of the map; beyond them its end colours hold
    std::vector<Color> stops; ///< evenly spaced, at least two; linear in sRGB between them

    Color at(double value) const;

    /// The value that stop i stands at.
    double valueOf(std::size_t i) const
    {
        return low + (high - low) * double(i) / double(stops.size() - 1);
    }
};

/// From 0 to @a high by viridis: its lightness rises evenly, so equal steps look equal, also in
/// grey and to the colour-blind (van der Walt and Smith, matplotlib, 2015; CC0).
ColorScale magnitudeScale(double high);

/// From -high (blue) through white to high (red) by RdBu, turned round (Brewer, colorbrewer2.org):
/// both halves darken alike away from 0, and it is safe for the colour-blind.
ColorScale signedScale(double high);

} // namespace molsurf
