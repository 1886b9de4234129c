// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/draw_notes.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/show/picture/font.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

using openvdb::Vec2d;
using openvdb::Vec3d;

namespace
{

constexpr Color ink = {20, 22, 26}, rim = {255, 255, 255};

/// Draws over what is there.
class Pen
{
public:
    Pen(const View& view, int width, Picture& picture)
        : view_(view), letters_(letterHeight(width)), font_(letters_), picture_(picture)
    {
    }

    /// Where a point is seen [pixel].
    Vec2d placeOf(const Vec3d& x) const
    {
        const Vec3d d = (x - view_.center) / view_.pixel;
        return {0.5 * view_.width + d.dot(view_.right), 0.5 * view_.height - d.dot(view_.up)};
    }

    double thin() const { return std::max(1.0, letters_ / 12.0); }
    double thick() const { return thin() + std::max(1.0, letters_ / 14.0); }
    int letters() const { return letters_; }

    /// A line with round ends. @param[in] radius  [pixel]
    void line(const Vec2d& a, const Vec2d& b, double radius, const Color& color)
    {
        const auto low = [&](int k) { return int(std::floor(std::min(a[k], b[k]) - radius - 1)); };
        const auto high = [&](int k) { return int(std::ceil(std::max(a[k], b[k]) + radius + 1)); };
        const Vec2d along = b - a;
        for (int y = std::max(low(1), 0); y < std::min(high(1), picture_.height); ++y)
            for (int x = std::max(low(0), 0); x < std::min(high(0), picture_.width); ++x) {
                const Vec2d p = Vec2d(x + 0.5, y + 0.5) - a;
                const double length2 = along.lengthSqr();
                const double t = length2 > 0.0 ? std::clamp(p.dot(along) / length2, 0.0, 1.0) : 0.0;
                const double cover = radius + 0.5 - (p - t * along).length();
                if (cover > 0.0) blend(x, y, std::min(cover, 1.0), color);
            }
    }

    /// A line of text whose middle is at x, above a baseline.
    void text(const std::string& line, const Vec2d& middle)
    {
        const int x = int(std::lround(middle[0] - 0.5 * font_.width(line)));
        const int y = int(std::lround(middle[1]));
        const int away = std::max(1, letters_ / 10);
        for (int dy = -away; dy <= away; ++dy)
            for (int dx = -away; dx <= away; ++dx)
                if (dx * dx + dy * dy <= away * away + 1)
                    font_.draw(line, x + dx, y + dy, rim, picture_);
        font_.draw(line, x, y, ink, picture_);
    }

private:
    void blend(int x, int y, double cover, const Color& color)
    {
        const std::size_t pixel = std::size_t(y) * std::size_t(picture_.width) + std::size_t(x);
        for (std::size_t c = 0; c < 3; ++c) {
            std::uint8_t& value = picture_.rgb[3 * pixel + c];
            value = std::uint8_t(std::lround(cover * color[c] + (1.0 - cover) * value));
        }
        if (!picture_.alpha.empty())
            picture_.alpha[pixel] =
                std::max(picture_.alpha[pixel], std::uint8_t(std::lround(255.0 * cover)));
    }

    const View& view_;
    int letters_;
    Font font_;
    Picture& picture_;
};

} // namespace

void drawNotes(const std::vector<PictureNote>& notes, const View& view, int width, Picture& picture)
{
    if (notes.empty()) return;
    Pen pen(view, width, picture);
    for (const PictureNote& note : notes) { // lines first, so that no text is crossed
        const Vec2d a = pen.placeOf(note.from), b = pen.placeOf(note.to.value_or(note.from));
        pen.line(a, b, pen.thick(), rim);
        pen.line(a, b, pen.thin(), ink);
    }
    for (const PictureNote& note : notes) {
        const Vec3d to = note.to.value_or(note.from);
        const Vec2d middle = pen.placeOf(0.5 * (note.from + to));
        const std::string text =
            note.to ? formatted("%.1f Å", (to - note.from).length()) : note.text;
        pen.text(text, middle - Vec2d(0.0, 0.6 * pen.letters()));
    }
}

} // namespace molsurf
