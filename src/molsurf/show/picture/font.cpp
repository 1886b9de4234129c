// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/font.h"

#include "molsurf/error.h"

#include <algorithm>
#include <ft2build.h>
#include FT_FREETYPE_H

#include <cstdint>

// The file of the font as it is.
asm(".section .rodata\n"
    ".balign 16\n"
    ".globl molsurf_font_begin, molsurf_font_end\n"
    ".hidden molsurf_font_begin, molsurf_font_end\n"
    "molsurf_font_begin:\n"
    ".incbin \"" MOLSURF_FONT "\"\n"
    "molsurf_font_end:\n"
    ".previous\n");

extern "C" {
extern const unsigned char molsurf_font_begin[] __attribute__((visibility("hidden")));
extern const unsigned char molsurf_font_end[] __attribute__((visibility("hidden")));
}

namespace molsurf
{

namespace
{

/// Calls f with the code of each letter of UTF-8; what is no UTF-8 becomes U+FFFD.
template<typename F>
void forEachLetter(const std::string& text, const F& f)
{
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = [&](std::size_t k) { return std::uint8_t(text[k]); };
        const std::uint8_t first = byte(i++);
        const int more = first < 0x80                    ? 0
                         : first >= 0xC2 && first < 0xE0 ? 1
                         : first >= 0xE0 && first < 0xF0 ? 2
                         : first >= 0xF0 && first < 0xF5 ? 3
                                                         : -1;
        // The first byte has 5, 4 or 3 bits of the code, each further one 6.
        std::uint32_t code = more < 0 ? 0xFFFD : more == 0 ? first : first & (0x3F >> more);
        for (int k = 0; k < more; ++k) {
            if (i == text.size() || (byte(i) & 0xC0) != 0x80) {
                code = 0xFFFD;
                break;
            }
            code = code << 6 | (byte(i++) & 0x3Fu);
        }
        f(code);
    }
}

} // namespace

struct Font::Face {
    FT_Library library = nullptr;
    FT_Face face = nullptr;

    ~Face()
    {
        if (face) FT_Done_Face(face);
        if (library) FT_Done_FreeType(library);
    }

    bool load(std::uint32_t code) const
    {
        return FT_Load_Char(face, code, FT_LOAD_RENDER | FT_LOAD_NO_HINTING) == 0;
    }
};

int letterHeight(int width)
{
    return std::clamp(width / 52, 11, 160);
}

Font::Font(int height) : face_(std::make_unique<Face>())
{
    const auto size = FT_Long(molsurf_font_end - molsurf_font_begin);
    if (FT_Init_FreeType(&face_->library) != 0 ||
        FT_New_Memory_Face(face_->library, molsurf_font_begin, size, 0, &face_->face) != 0 ||
        FT_Set_Pixel_Sizes(face_->face, 0, FT_UInt(height)) != 0)
        throw Error(ErrorKind::Output, "legend: FreeType cannot use the font");
}

Font::~Font() = default;

int Font::lineHeight() const
{
    return int(face_->face->size->metrics.height + 63) / 64;
}

int Font::width(const std::string& text) const
{
    FT_Pos width = 0; // in 1/64 pixel
    forEachLetter(text, [&](std::uint32_t code) {
        if (face_->load(code)) width += face_->face->glyph->advance.x;
    });
    return int(width + 63) / 64;
}

void Font::draw(const std::string& text, int x, int y, const Color& color, Picture& picture) const
{
    FT_Pos at = FT_Pos(x) * 64; // in 1/64 pixel
    forEachLetter(text, [&](std::uint32_t code) {
        if (!face_->load(code)) return;
        const FT_GlyphSlot glyph = face_->face->glyph;
        const int left = int((at + 32) / 64) + glyph->bitmap_left, top = y - glyph->bitmap_top;
        for (int row = 0; row < int(glyph->bitmap.rows); ++row) {
            for (int column = 0; column < int(glyph->bitmap.width); ++column) {
                const int px = left + column, py = top + row;
                if (px < 0 || py < 0 || px >= picture.width || py >= picture.height) continue;
                const int cover = glyph->bitmap.buffer[row * glyph->bitmap.pitch + column];
                const std::size_t pixel =
                    std::size_t(py) * std::size_t(picture.width) + std::size_t(px);
                std::uint8_t* to = &picture.rgb[3 * pixel];
                if (!picture.alpha.empty()) {
                    std::uint8_t& alpha = picture.alpha[pixel];
                    if (alpha == 0) std::copy(color.begin(), color.end(), to);
                    alpha = std::max(alpha, std::uint8_t(cover));
                }
                for (std::size_t c = 0; c < 3; ++c)
                    to[c] = std::uint8_t((color[c] * cover + to[c] * (255 - cover) + 127) / 255);
            }
        }
        at += glyph->advance.x;
    });
}

} // namespace molsurf
