// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/legend_svg.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/markup.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/show/picture/draw_legend.h"
#include "molsurf/show/picture/font.h"

#include <algorithm>

namespace molsurf
{

namespace
{

// In units of the drawing.
constexpr int letters = 16, line = 20, gap = 8, barHeight = 9 * line;
constexpr double wider = 1.15; // than DejaVu Sans a viewer's font may be

/// Draws downward.
class Drawing
{
public:
    explicit Drawing(const Color& ink) : ink_(hexOf(ink)) {}

    void text(const std::string& words, int left = 0)
    {
        label(words, left, y_ + letters);
        y_ += line;
    }

    void skip(int units) { y_ += units; }

    void entry(const LegendEntry& entry)
    {
        box(0, y_ + 2, letters, letters, hexOf(entry.color));
        text(entry.name, letters + gap);
    }

    /// @param[in] id  of the colours in the file
    void bar(const ColorScale& scale, const std::string& id)
    {
        std::string stops;
        const auto stop = [&](double share, const Color& color) {
            stops +=
                formatted("<stop offset=\"%.4g\" stop-color=\"%s\"/>", share, hexOf(color).c_str());
        };
        const auto last = double(scale.stops.size() - 1);
        for (std::size_t i = 0; i < scale.stops.size(); ++i) {
            if (scale.steps && i > 0) stop(double(i) / last, scale.stops[i - 1]);
            stop(double(i) / last, scale.stops[i]);
        }
        body_ += "<defs><linearGradient id=\"" + id + "\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">" +
                 stops + "</linearGradient></defs>\n";
        box(0, y_, letters, barHeight, "url(#" + id + ")");
        const std::vector<std::string> ticks = tickTexts(scale);
        for (std::size_t i = 0; i < ticks.size(); ++i) {
            const int y = y_ + int(i) * barHeight / int(ticks.size() - 1);
            body_ += formatted("<path d=\"M%d %dh%d\" stroke=\"%s\"/>\n", letters, y, gap / 2,
                               ink_.c_str());
            label(ticks[i], letters + gap, y + letters * 3 / 8);
        }
        y_ += barHeight;
    }

    std::string whole() const
    {
        const int width = int(wider * widest_) + 2 * gap, height = y_ + 2 * gap;
        return formatted("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" "
                         "viewBox=\"%d %d %d %d\" font-family=\"DejaVu Sans, Arial, sans-serif\" "
                         "font-size=\"%d\" fill=\"%s\">\n",
                         width, height, -gap, -gap, width, height, letters, ink_.c_str()) +
               body_ + "</svg>\n";
    }

private:
    void label(const std::string& words, int left, int baseline)
    {
        widest_ = std::max(widest_, left + font_.width(words));
        body_ +=
            formatted("<text x=\"%d\" y=\"%d\">", left, baseline) + markupText(words) + "</text>\n";
    }

    void box(int left, int top, int width, int height, const std::string& fill)
    {
        body_ += formatted("<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" fill=\"%s\" "
                           "stroke=\"%s\"/>\n",
                           left, top, width, height, fill.c_str(), ink_.c_str());
    }

    Font font_{letters};
    std::string ink_, body_;
    int y_ = 0, widest_ = 0;
};

} // namespace

std::string legendSvg(const std::vector<Legend>& legends, const Color& background)
{
    Drawing drawing(inkOn(background));
    for (std::size_t n = 0; n < legends.size(); ++n) {
        const Legend& legend = legends[n];
        if (n > 0) drawing.skip(line);
        drawing.text(legend.title);
        if (legend.scale) {
            if (!legend.unit.empty()) drawing.text(unitText(legend));
            drawing.skip(line / 2);
            drawing.bar(*legend.scale, "scale" + std::to_string(n));
            drawing.skip(line);
        }
        for (const LegendEntry& entry : legend.entries) drawing.entry(entry);
    }
    return drawing.whole();
}

void writeLegendSvg(const std::vector<Legend>& legends, const Color& background, OutputFile& file)
{
    if (legends.empty())
        throw Error(ErrorKind::Input, file.path() + ": expected colours for a legend, got none "
                                                    "[hint: `color` chain]");
    file.write(legendSvg(legends, background));
    file.finish();
}

} // namespace molsurf
