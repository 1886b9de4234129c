// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/panels.h"

#include "molsurf/show/picture/draw_legend.h"
#include "molsurf/show/picture/font.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

constexpr std::size_t mostInARow = 4;

/// Copies a picture into another one.
void put(const Picture& picture, int left, int top, Picture& out)
{
    const int width = std::min(picture.width, out.width - left);
    for (int y = 0; y < std::min(picture.height, out.height - top); ++y) {
        const std::ptrdiff_t from = std::ptrdiff_t(y) * picture.width,
                             to = std::ptrdiff_t(y + top) * out.width + left;
        std::copy_n(picture.rgb.begin() + 3 * from, 3 * width, out.rgb.begin() + 3 * to);
        if (!picture.alpha.empty())
            std::copy_n(picture.alpha.begin() + from, width, out.alpha.begin() + to);
    }
}

} // namespace

int panelColumns(std::size_t count)
{
    return int(count <= mostInARow ? count : std::size_t(std::ceil(std::sqrt(double(count)))));
}

int panelWidth(std::size_t count, int width)
{
    return std::max(1, width / panelColumns(count));
}

Picture joinPanels(const std::vector<PanelPicture>& panels, int width, int whole,
                   const Color& background)
{
    const Font font(letterHeight(whole));
    const Picture& first = panels.front().picture;
    const bool named = std::any_of(panels.begin(), panels.end(),
                                   [](const PanelPicture& panel) { return !panel.name.empty(); });
    const int columns = panelColumns(panels.size());
    const int rows = (int(panels.size()) + columns - 1) / columns;
    const int line = named ? 2 * font.lineHeight() : 0, height = first.height + line;
    Picture out;
    out.width = width;
    out.height = rows * height;
    out.pixel = first.pixel;
    out.dpi = first.dpi;
    const std::size_t pixels = std::size_t(out.width) * std::size_t(out.height);
    out.rgb.reserve(3 * pixels);
    for (std::size_t n = 0; n < pixels; ++n)
        out.rgb.insert(out.rgb.end(), background.begin(), background.end());
    if (!first.alpha.empty()) out.alpha.resize(pixels, 0);
    for (std::size_t n = 0; n < panels.size(); ++n) {
        const int left = int(n) % columns * panelWidth(panels.size(), width);
        const int top = int(n) / columns * height;
        put(panels[n].picture, left, top, out);
        const int space = first.width - font.width(panels[n].name);
        font.draw(panels[n].name, left + std::max(space / 2, 0),
                  top + first.height + font.lineHeight(), inkOn(background), out);
    }
    return out;
}

} // namespace molsurf
