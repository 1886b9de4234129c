// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/draw_legend.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/show/picture/atom_model.h"
#include "molsurf/show/picture/font.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

constexpr double widestName = 0.3; // of the picture
constexpr const char* chainsAndElements = "Chain, element";

/// Sizes in the column, all of them in proportion to the letters [pixel].
struct Sizes {
    int letters, gap, patch, bar;
    explicit Sizes(int width)
        : letters(letterHeight(width)), gap(letters / 2), patch(letters), bar(letters)
    {
    }
};

/// A number of the scale with two digits that matter.
std::string numberText(double value)
{
    if (value == 0.0) return "0";
    const int places = std::clamp(1 - int(std::floor(std::log10(std::abs(value)))), 0, 6);
    return (value < 0.0 ? "\xE2\x88\x92" : "") +
           formatted("%.*f", places, std::abs(value)); // a minus sign
}

/// A name that is not too wide, with an ellipsis where it was cut.
std::string shortened(const std::string& name, const Font& font, int width)
{
    const int widest = int(widestName * width);
    if (name.size() < 8 || font.width(name) <= widest) return name;
    constexpr std::size_t enough = 200; // letters; more are never shown
    for (std::size_t end = std::min(name.size(), enough); end-- > 1;) {
        if ((std::uint8_t(name[end]) & 0xC0) == 0x80) continue; // within a letter
        const std::string cut = name.substr(0, end) + "\xE2\x80\xA6";
        if (font.width(cut) <= widest) return cut;
    }
    return "";
}

/// The line for entries without room: as short as that, since it must not be cut off.
std::string restText(std::size_t count)
{
    return "+" + std::to_string(count);
}

/// The entries that have room, and a line for the rest.
std::vector<LegendEntry> shownEntries(const std::vector<LegendEntry>& entries, std::size_t room)
{
    room = std::max<std::size_t>(room, 2);
    if (entries.size() <= room) return entries;
    std::vector<LegendEntry> shown(entries.begin(), entries.begin() + std::ptrdiff_t(room - 1));
    shown.push_back({restText(entries.size() - shown.size()), Color()});
    return shown;
}

void fillBox(int x, int y, int width, int height, const Color& color, Picture& picture)
{
    for (int py = std::max(y, 0); py < std::min(y + height, picture.height); ++py) {
        for (int px = std::max(x, 0); px < std::min(x + width, picture.width); ++px) {
            const std::ptrdiff_t pixel = std::ptrdiff_t(py) * picture.width + px;
            std::copy(color.begin(), color.end(), picture.rgb.begin() + 3 * pixel);
            if (!picture.alpha.empty()) picture.alpha[std::size_t(pixel)] = 255;
        }
    }
}

/// A larger picture, with this one in it at the left.
Picture enlarged(const Picture& picture, int width, int height, int above, const Color& background)
{
    Picture out;
    out.width = width;
    out.height = height;
    out.pixel = picture.pixel;
    out.dpi = picture.dpi;
    out.rgb.resize(3 * std::size_t(out.width) * std::size_t(out.height));
    fillBox(0, 0, out.width, out.height, background, out);
    if (!picture.alpha.empty()) out.alpha.resize(out.rgb.size() / 3, 0);
    for (int y = 0; y < picture.height; ++y) {
        const std::ptrdiff_t from = std::ptrdiff_t(y) * picture.width,
                             to = std::ptrdiff_t(y + above) * out.width;
        std::copy_n(picture.rgb.begin() + 3 * from, 3 * picture.width, out.rgb.begin() + 3 * to);
        if (!picture.alpha.empty())
            std::copy_n(picture.alpha.begin() + from, picture.width, out.alpha.begin() + to);
    }
    return out;
}

/// The length of a bar [Å].
double barLength(double longest)
{
    const double ten = std::pow(10.0, std::floor(std::log10(longest)));
    return longest >= 5.0 * ten ? 5.0 * ten : longest >= 2.0 * ten ? 2.0 * ten : ten;
}

/// Draws downward from `top`.
class Column
{
public:
    Column(const Sizes& sizes, const Font& font, int left, int top, const Color& ink,
           Picture& picture)
        : sizes_(sizes), font_(font), left_(left), y_(top), ink_(ink), picture_(picture)
    {
    }

    void text(const std::string& line, int indent = 0)
    {
        font_.draw(line, left_ + indent, y_ + sizes_.letters, ink_, picture_);
        y_ += font_.lineHeight();
    }

    void skip(int pixels) { y_ += pixels; }

    /// @param[in] entries  of it, and a last one for those that are left out
    void legend(const Legend& legend, const std::vector<LegendEntry>& entries, int barHeight)
    {
        const int line = font_.lineHeight();
        text(legend.title);
        if (legend.scale) {
            if (!legend.unit.empty()) text(unitText(legend));
            skip(sizes_.gap + line / 2);
            bar(*legend.scale, barHeight);
            skip(line / 2);
        } else {
            skip(sizes_.gap);
        }
        for (std::size_t i = 0; i < entries.size(); ++i)
            entry(entries[i], entries.size() == legend.entries.size() || i + 1 < entries.size());
    }

    void entry(const LegendEntry& entry, bool patch)
    {
        const int indent = sizes_.patch + sizes_.gap, top = y_ + sizes_.letters - sizes_.patch + 2;
        if (patch) framed(left_, top, sizes_.patch, sizes_.patch, entry.color);
        text(shortened(entry.name, font_, picture_.width), patch ? indent : 0);
    }

    void bar(const ColorScale& scale, int height)
    {
        const auto ticks = tickTexts(scale);
        framed(left_, y_, sizes_.bar, height, Color());
        for (int row = 0; row < height; ++row) {
            const double share = (row + 0.5) / height;
            fillBox(left_, y_ + row, sizes_.bar, 1,
                    scale.at(scale.high + share * (scale.low - scale.high)), picture_);
        }
        for (std::size_t i = 0; i < ticks.size(); ++i) {
            const int y = y_ + int(i) * (height - 1) / 2;
            fillBox(left_ + sizes_.bar, y, sizes_.gap / 2, 1, ink_, picture_);
            font_.draw(ticks[i], left_ + sizes_.bar + sizes_.gap, y + sizes_.letters * 3 / 8, ink_,
                       picture_);
        }
        y_ += height;
    }

private:
    void framed(int x, int y, int width, int height, const Color& color)
    {
        fillBox(x - 1, y - 1, width + 2, height + 2, ink_, picture_);
        fillBox(x, y, width, height, color, picture_);
    }

    const Sizes& sizes_;
    const Font& font_;
    int left_, y_;
    Color ink_;
    Picture& picture_;
};

} // namespace

std::vector<Legend> legendsOf(const std::optional<Legend>& surface, const AtomModel* model)
{
    std::vector<Legend> legends;
    if (surface) {
        legends.push_back(*surface);
        auto& entries = legends[0].entries;
        const auto unseen = [](const LegendEntry& entry) { return !entry.seen; };
        entries.erase(std::remove_if(entries.begin(), entries.end(), unseen), entries.end());
    }
    if (!model) return legends;
    const auto add = [&](const std::string& title, const std::vector<LegendEntry>& entries) {
        if (entries.empty()) return;
        const bool joins = surface && !surface->scale &&
                           (surface->title == title || surface->title == chainsAndElements);
        if (!joins) legends.push_back({title, "", "", "", {}, {}});
        std::vector<LegendEntry>& to = (joins ? legends.front() : legends.back()).entries;
        for (const LegendEntry& entry : entries) addEntry(entry, to);
    };
    add("Chain", model->chains);
    add("Element", model->elements);
    add("Pocket", model->bodies.pockets);
    add("Tunnel", model->bodies.tunnels);
    return legends;
}

int legendWidth(const std::vector<Legend>& legends, int width)
{
    const Sizes sizes(width);
    const Font font(sizes.letters);
    int widest = 0;
    for (const Legend& legend : legends) {
        widest = std::max(widest, font.width(legend.title));
        if (legend.scale) {
            for (const std::string& tick : tickTexts(*legend.scale))
                widest = std::max(widest, sizes.bar + sizes.gap + font.width(tick));
            if (!legend.unit.empty()) widest = std::max(widest, font.width(unitText(legend)));
        } else {
            widest = std::max(widest, font.width(restText(legend.entries.size())));
        }
        for (const LegendEntry& entry : legend.entries)
            widest = std::max(widest, sizes.patch + sizes.gap +
                                          font.width(shortened(entry.name, font, width)));
    }
    return widest + 3 * sizes.gap;
}

Picture withLegends(const Picture& picture, const std::vector<Legend>& legends, int width,
                    const Color& background)
{
    const Sizes sizes(width);
    const Font font(sizes.letters);
    const int line = font.lineHeight(), barHeight = 9 * line;
    constexpr int fewest = 2;            // lines of names, as many as there is no room for
    int fixed = 0, least = 0, lists = 0; // heights, and number of lists
    for (const Legend& legend : legends) {
        const int below = int(legend.entries.size()) * line;
        fixed += legend.scale ? 2 * line + sizes.gap + barHeight + line + below : line + sizes.gap;
        least += legend.scale ? 0 : std::min(int(legend.entries.size()), fewest) * line;
        lists += !legend.scale;
    }
    fixed += (int(legends.size()) - 1) * line; // between them
    const int height = std::max({picture.height, fixed + least + 2 * sizes.gap, 6 * line});
    Picture out = enlarged(picture, width, height, (height - picture.height) / 2, background);
    std::vector<std::vector<LegendEntry>> shown;
    int room = (out.height - 2 * sizes.gap - fixed) / line, all = fixed;
    for (const Legend& legend : legends) {
        shown.push_back(legend.entries);
        if (legend.scale) continue;
        const int others = fewest * --lists;
        shown.back() = shownEntries(legend.entries, std::size_t(std::max(room - others, 0)));
        room -= int(shown.back().size());
        all += int(shown.back().size()) * line;
    }
    Column column(sizes, font, picture.width + sizes.gap, std::max((out.height - all) / 2, 0),
                  inkOn(background), out);
    for (std::size_t n = 0; n < legends.size(); ++n) {
        if (n > 0) column.skip(line);
        column.legend(legends[n], shown[n], barHeight);
    }
    return out;
}

Picture withScaleBar(const Picture& picture, int width, const Color& background)
{
    const Sizes sizes(width);
    const Font font(sizes.letters);
    const int thick = std::max(sizes.letters / 5, 2), strip = font.lineHeight() + sizes.gap;
    Picture out = enlarged(picture, picture.width, picture.height + strip, 0, background);
    const double length = barLength(0.25 * picture.width * picture.pixel);
    const int pixels = int(std::lround(length / picture.pixel));
    const Color ink = inkOn(background);
    const int left = sizes.gap, baseline = picture.height + sizes.letters;
    fillBox(left, baseline - sizes.letters * 3 / 8 - thick / 2, pixels, thick, ink, out);
    constexpr double nanometre = 10.0; // [Å]
    const std::string text = length < 10.0 * nanometre ? formatted("%g \xC3\x85", length)
                                                       : formatted("%g nm", length / nanometre);
    font.draw(text, left + pixels + sizes.gap, baseline, ink, out);
    return out;
}

std::vector<std::string> tickTexts(const ColorScale& scale)
{
    return {numberText(scale.high), numberText(0.5 * (scale.low + scale.high)),
            numberText(scale.low)};
}

std::string unitText(const Legend& legend)
{
    return "[" + legend.unit + "]";
}

Color inkOn(const Color& background)
{
    const double gray = 0.3 * background[0] + 0.6 * background[1] + 0.1 * background[2];
    return gray > 127.0 ? Color{30, 33, 38} : Color{235, 237, 240};
}

int widthBeside(const std::vector<Legend>& legends, int width)
{
    return legends.empty() ? width : std::max(width - legendWidth(legends, width), width / 2);
}

Picture explained(Picture picture, const std::vector<Legend>& legends, bool scaleBar, int width,
                  const Color& background)
{
    if (scaleBar && picture.pixel > 0.0) picture = withScaleBar(picture, width, background);
    if (!legends.empty()) picture = withLegends(picture, legends, width, background);
    return picture;
}

Picture drawExplained(const Mesh& mesh, DrawOptions options, const std::vector<Legend>& legends,
                      bool scaleBar, const Progress& progress)
{
    const int width = options.width;
    options.width = widthBeside(legends, width);
    options.whole = width;
    return explained(drawMesh(mesh, options, progress), legends, scaleBar, width,
                     options.background);
}

} // namespace molsurf
