// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/draw_profile.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/show/color/pore_color.h"
#include "molsurf/show/picture/font.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace molsurf
{

namespace
{

constexpr Color chartInk = {30, 33, 38}, chartGrey = {150, 155, 160};

/// A line, or the area between it and the height `base`.
struct ChartLine {
    double x0, y0, x1, y1;
    Color color;
    double width; ///< 0: an area
    double base = 0.0;
};

struct ChartText {
    double x, y;   ///< of the baseline
    double anchor; ///< share of the width that lies left of x
    std::string text;
};

/// Sizes of a chart, in pixels of a picture of a given width.
struct Chart {
    int width, height, letters;
    std::vector<ChartLine> lines;
    std::vector<ChartText> texts;
};

/// The step between ticks: 1, 2 or 5 times a power of ten, for eight of them at most.
double tickStep(double range)
{
    constexpr double most = 8.0;
    const double ten = std::pow(10.0, std::floor(std::log10(std::max(range, 1e-9) / most)));
    for (const double step : {1.0, 2.0, 5.0})
        if (range <= most * step * ten) return step * ten;
    return 10.0 * ten;
}

/// From lengths to pixels.
struct ChartScale {
    double left, right, top, bottom, length, low, high;

    double x(double distance) const { return left + (right - left) * distance / length; }
    double y(double radius) const
    {
        return bottom + (top - bottom) * (radius - low) / (high - low);
    }
};

std::string tickText(double value)
{
    return shortest(std::abs(value) < 1e-9 ? 0.0 : std::round(value * 1e6) / 1e6);
}

void addAxes(const ChartScale& to, Chart& chart)
{
    const double letters = chart.letters, hair = chart.width / 1200.0;
    const double along = tickStep(to.length), up = tickStep(to.high - to.low);
    for (double at = 0.0; at <= to.length + 1e-9; at += along) {
        chart.lines.push_back(
            {to.x(at), to.bottom, to.x(at), to.bottom + 0.4 * letters, chartInk, hair});
        chart.texts.push_back({to.x(at), to.bottom + 1.7 * letters, 0.5, tickText(at)});
    }
    for (double at = std::ceil(to.low / up - 1e-9) * up; at <= to.high + 1e-9; at += up) {
        chart.lines.push_back(
            {to.left - 0.4 * letters, to.y(at), to.left, to.y(at), chartInk, hair});
        chart.texts.push_back(
            {to.left - 0.8 * letters, to.y(at) + 0.36 * letters, 1.0, tickText(at)});
    }
    chart.lines.push_back({to.left, to.y(0.0), to.right, to.y(0.0), chartInk, hair});
    chart.lines.push_back({to.left, to.top, to.left, to.bottom, chartInk, hair});
    for (const double step : poreSteps)
        if (step < to.high)
            chart.lines.push_back({to.left, to.y(step), to.right, to.y(step), chartGrey, hair});
    chart.texts.push_back({0.5 * (to.left + to.right), to.bottom + 3.4 * letters, 0.5,
                           "Distance along the pore [\xC3\x85]"});
    chart.texts.push_back({to.left, to.top - 0.8 * letters, 0.0, "Radius [\xC3\x85]"});
}

Chart chartOf(const Report::Pore& pore, int width)
{
    Chart chart{width, width / 2, letterHeight(width), {}, {}};
    const double letters = chart.letters;
    ChartScale to{4.0 * letters,
                  width - 2.0 * letters,
                  2.4 * letters,
                  chart.height - 4.2 * letters,
                  std::max(pore.length(), 1e-3),
                  0.0,
                  0.5};
    for (const Report::Pore::Station& s : pore.stations) {
        to.low = std::min(to.low, s.radius);
        to.high = std::max(to.high, s.radius);
    }
    for (std::size_t i = 1; i < pore.stations.size(); ++i) {
        const Report::Pore::Station &a = pore.stations[i - 1], &b = pore.stations[i];
        ChartLine line{to.x(a.distance),
                       to.y(a.radius),
                       to.x(b.distance),
                       to.y(b.radius),
                       poreColor(0.5 * (a.radius + b.radius)),
                       0.0,
                       to.y(0.0)};
        chart.lines.push_back(line);
    }
    addAxes(to, chart);
    const auto narrower = [](const auto& a, const auto& b) { return a.radius < b.radius; };
    for (std::size_t i = 1; i < pore.stations.size(); ++i) {
        const Report::Pore::Station &a = pore.stations[i - 1], &b = pore.stations[i];
        chart.lines.push_back({to.x(a.distance), to.y(a.radius), to.x(b.distance), to.y(b.radius),
                               chartInk, width / 500.0});
    }
    const auto& least = *std::min_element(pore.stations.begin(), pore.stations.end(), narrower);
    // The number is centred on the line, but near an end of the chart shifted inward.
    const double share = least.distance / to.length;
    chart.lines.push_back({to.x(least.distance), to.y(least.radius), to.x(least.distance), to.top,
                           chartGrey, width / 1200.0});
    chart.texts.push_back({to.x(least.distance), to.top - 0.8 * letters,
                           std::clamp(share, share < 0.3 ? 0.0 : 0.5, share > 0.8 ? 1.0 : 0.5),
                           formatted("%.2f", least.radius)});
    return chart;
}

/// Mixes a colour into a pixel.
void blend(int x, int y, const Color& color, double share, Picture& picture)
{
    if (x < 0 || y < 0 || x >= picture.width || y >= picture.height || !(share > 0.0)) return;
    const std::size_t at = 3 * (std::size_t(y) * std::size_t(picture.width) + std::size_t(x));
    for (std::size_t k = 0; k < 3; ++k) {
        const double old = picture.rgb[at + k];
        picture.rgb[at + k] =
            std::uint8_t(std::lround(old + std::min(share, 1.0) * (color[k] - old)));
    }
}

/// Fills columns of pixels; one that the area covers in part is mixed by that share.
void fillArea(const ChartLine& line, Picture& picture)
{
    for (int x = int(std::ceil(line.x0)); x < int(std::ceil(line.x1)); ++x) {
        const double t = (x - line.x0) / std::max(line.x1 - line.x0, 1e-9);
        const double y = line.y0 + t * (line.y1 - line.y0);
        const double low = std::min(y, line.base), high = std::max(y, line.base);
        for (int row = int(std::floor(low)); row < int(std::ceil(high)); ++row)
            blend(x, row, line.color, std::min(row + 1.0, high) - std::max(double(row), low),
                  picture);
    }
}

/// Draws a line with round ends: pixels by their distance from it, with a rim one pixel wide.
void strokeLine(const ChartLine& line, Picture& picture)
{
    const double half = 0.5 * std::max(line.width, 1.0), dx = line.x1 - line.x0,
                 dy = line.y1 - line.y0, length2 = std::max(dx * dx + dy * dy, 1e-12);
    for (int y = int(std::min(line.y0, line.y1) - half) - 1;
         y <= int(std::max(line.y0, line.y1) + half) + 1; ++y) {
        for (int x = int(std::min(line.x0, line.x1) - half) - 1;
             x <= int(std::max(line.x0, line.x1) + half) + 1; ++x) {
            const double px = x + 0.5 - line.x0, py = y + 0.5 - line.y0;
            const double t = std::clamp((px * dx + py * dy) / length2, 0.0, 1.0);
            blend(x, y, line.color, half + 0.5 - std::hypot(px - t * dx, py - t * dy), picture);
        }
    }
}

std::string svgColor(const Color& color)
{
    return formatted("#%02x%02x%02x", color[0], color[1], color[2]);
}

} // namespace

Picture drawProfile(const Report::Pore& pore, int width)
{
    const Chart chart = chartOf(pore, width);
    Picture picture{chart.width, chart.height, {}};
    picture.rgb.assign(3 * std::size_t(chart.width) * std::size_t(chart.height), 255);
    for (const ChartLine& line : chart.lines)
        line.width > 0.0 ? strokeLine(line, picture) : fillArea(line, picture);
    const Font font(chart.letters);
    for (const ChartText& text : chart.texts)
        font.draw(text.text, int(std::lround(text.x - text.anchor * font.width(text.text))),
                  int(std::lround(text.y)), chartInk, picture);
    return picture;
}

void writeProfileSvg(const Report::Pore& pore, OutputFile& file)
{
    constexpr int svgWidth = 1200;
    const Chart chart = chartOf(pore, svgWidth);
    std::string out = formatted(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" font-family=\"DejaVu "
        "Sans, sans-serif\" font-size=\"%d\">\n<rect width=\"%d\" height=\"%d\" fill=\"white\"/>\n",
        chart.width, chart.height, chart.letters, chart.width, chart.height);
    for (const ChartLine& l : chart.lines) {
        if (l.width > 0.0)
            out += formatted("<path d=\"M%.2f %.2fL%.2f %.2f\" stroke=\"%s\" stroke-width=\"%.2f\" "
                             "stroke-linecap=\"round\"/>\n",
                             l.x0, l.y0, l.x1, l.y1, svgColor(l.color).c_str(), l.width);
        else
            out += formatted("<path d=\"M%.2f %.2fV%.2fL%.2f %.2fV%.2fZ\" fill=\"%s\"/>\n", l.x0,
                             l.base, l.y0, l.x1, l.y1, l.base, svgColor(l.color).c_str());
    }
    for (const ChartText& t : chart.texts) {
        const char* anchor = t.anchor < 0.25 ? "start" : t.anchor < 0.75 ? "middle" : "end";
        out += formatted("<text x=\"%.2f\" y=\"%.2f\" text-anchor=\"%s\">%s</text>\n", t.x, t.y,
                         anchor, t.text.c_str());
    }
    file.write(out + "</svg>\n");
    file.finish();
}

} // namespace molsurf
