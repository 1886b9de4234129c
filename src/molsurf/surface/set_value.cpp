// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/set_value.h"

#include "molsurf/molecule/selection/groups.h"
#include "molsurf/show/color/color_table.h"

namespace molsurf
{

std::string memberName(const std::string& option)
{
    std::string name;
    for (std::size_t i = 0; i < option.size(); ++i) {
        const bool dash = option[i] == '-' && i + 1 < option.size();
        name += dash ? char(option[++i] - 'a' + 'A') : option[i];
    }
    return "`" + name + "`";
}

void wrongValue(const std::string& option, const std::string& expected, const std::string& got,
                const std::string& hint)
{
    throw Error(ErrorKind::Usage,
                memberName(option) + ": expected " + expected + ", got '" + got + "'" + hint);
}

std::array<std::uint8_t, 3> colorValue(const std::string& option, const std::string& more,
                                       const std::string& word)
{
    const auto color = parseColor(word);
    if (!color)
        wrongValue(option, "a colour as #rrggbb or #rgb, or a name such as black" + more, word,
                   didYouMean(word, colorNames()));
    return *color;
}

std::vector<ColorBy> completeColors()
{
    std::vector<ColorBy> out;
    for (const ColorKind& kind : colorTable())
        if (kind.complete) out.push_back(kind.by);
    return out;
}

std::vector<std::string> colorHelp()
{
    std::vector<std::string> out;
    for (const ColorKind& kind : colorTable())
        if (kind.complete && kind.by != ColorBy::Nothing)
            out.push_back(kind.word + (*kind.help ? " (" + std::string(kind.help) + ")" : ""));
    return out;
}

std::size_t sizeValue(const std::string& option, const std::string& text)
{
    const std::string expected = "a size such as 500M or 4G";
    double size = 0.0;
    const char* end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data(), end, size);
    const std::string unit(stop, end), letters = "KMGT";
    const std::size_t place = unit.empty() ? 0 : letters.find(unit[0]);
    const std::string rest = unit.empty() ? "" : unit.substr(1);
    if (problem != std::errc() || !std::isfinite(size) || place == std::string::npos ||
        !(rest.empty() || rest == "B" || rest == "iB"))
        wrongValue(option, expected, text);
    const double bytes = size * (unit.empty() ? 1.0 : std::pow(1024.0, double(place + 1)));
    if (!(bytes >= 1.0 && bytes < 1e18)) wrongValue(option, expected, text);
    return std::size_t(bytes);
}

} // namespace molsurf
