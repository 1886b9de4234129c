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

/// Colours that values run through.
struct Palette {
    const char* word;         ///< of the command line: "viridis"
    std::vector<Color> stops; ///< evenly spaced, at least two; linear in sRGB between them
    bool steps = false;       ///< whether these are few colours with sharp edges
};

/// All of them. Lightness rises evenly along viridis and cividis (matplotlib; CC0) and batlow
/// (Crameri, doi:10.5281/zenodo.1243862), so equal steps look equal, also in grey. It falls along
/// OrRd; those that run through white to both sides darken alike away from it (Brewer,
/// colorbrewer2.org). The
/// colour-blind can read all but turbo (Mikhailov, 2019). plddt is that of the AlphaFold database.
const std::vector<Palette>& paletteTable();

/// The row of a word, in any case; null: there is none.
const Palette* findPalette(const std::string& word);

/// A range of values and the colours that it runs through.
struct ColorScale {
    std::string map;          ///< the word of its palette
    double low, high;         ///< values at the ends of the map; beyond them its end colours hold
    std::vector<Color> stops; ///< evenly spaced, at least two; linear in sRGB between them
    bool steps = false;       ///< whether each colour holds up to the next stop

    Color at(double value) const;

    /// The value that stop i stands at.
    double valueOf(std::size_t i) const
    {
        return low + (high - low) * double(i) / double(stops.size() - 1);
    }
};

/// The scale of a palette that there is.
ColorScale scaleOf(const std::string& palette, double low, double high);

} // namespace molsurf
