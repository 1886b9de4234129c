// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Text in pictures: DejaVu Sans, which the build puts into the library, drawn by FreeType.

#include "molsurf/show/picture/draw_mesh.h"

#include <memory>
#include <string>

namespace molsurf
{

/// How high the letters of a picture are, with what is beside the mesh [pixel].
/// @param[in] width  of it [pixel]
int letterHeight(int width);

/// The font at one size. The same text has the same pixels on every machine.
class Font
{
public:
    /// @param[in] height  of the em square [pixel]
    /// @throws Error(ErrorKind::Output) if FreeType refuses
    explicit Font(int height);
    ~Font();
    Font(const Font&) = delete;
    Font& operator=(const Font&) = delete;

    /// From one line to the next [pixel].
    int lineHeight() const;

    /// Width of a text in UTF-8 [pixel]. TextCursor that the font lacks have an empty box.
    int width(const std::string& text) const;

    /// Writes a line of text; what lies outside the picture is left out.
    /// @param[in] x,y  left end of the line, and its baseline [pixel]
    void draw(const std::string& text, int x, int y, const Color& color, Picture& picture) const;

private:
    struct Face;
    std::unique_ptr<Face> face_;
};

} // namespace molsurf
