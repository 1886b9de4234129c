// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How pictures are lit and outlined, a row each.

#include <string>
#include <vector>

namespace molsurf
{

/// A style of pictures. Light is linear; what is white and takes all of it has the sum of the
/// parts.
struct PictureStyle {
    const char* word; ///< of the command line
    const char* help; ///< what a help text adds to it
    float sky;        ///< light from all about, as far as the surface is open to it
    float key, fill;  ///< from the lamp over the eye's left shoulder, and from the right
    float shadow;     ///< share of the lamp's light that is missing in its shadow
    float lampSize;   ///< radius of the lamp [rad]
    float highlight;  ///< light of the lamp that the surface mirrors
    float gloss;      ///< sharpness of that, the exponent of Blinn and Phong
    float outline;    ///< width of lines at jumps in depth [pixel at 1000 pixels of width]
    float crease;     ///< of lines at creases and borders of colours [the same]
    float ink;        ///< darkness of lines, in [0, 1]
};

/// All of them; the first one is the default.
const std::vector<PictureStyle>& styleTable();

/// The row of a word, in any case; null: there is none.
const PictureStyle* findStyle(const std::string& word);

} // namespace molsurf
