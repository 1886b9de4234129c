// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/cif_rows.h"

#include "molsurf/core/words.h"
#include "molsurf/structure/text_fields.h"

#include <algorithm>
#include <string_view>

namespace molsurf
{
namespace
{

using std::string_view;

constexpr string_view atomSite = "_atom_site.";

bool isCifBlank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/// Whether a line ends a loop: a tag, a keyword, or a comment, behind which no row may come.
bool endsLoop(string_view line)
{
    const string_view text = trimmed(line);
    if (text.empty()) return false;
    if (text[0] == '_' || text[0] == '#') return true;
    const std::string word = lowered(std::string(text.substr(0, 5)));
    return word == "loop_" || word == "data_";
}

bool isOfAtoms(string_view tag)
{
    return lowered(std::string(tag.substr(0, atomSite.size()))) == atomSite;
}

std::size_t offsetOf(const std::string& text, string_view part)
{
    return std::size_t(part.data() - text.data());
}

/// Where a loop of atoms begins in a text.
struct AtomLoop {
    std::vector<std::string> tags;
    std::size_t rows; ///< its first byte behind the tags
};

/// The first loop of atoms whose tags lie on lines of their own.
std::optional<AtomLoop> findLoop(const std::string& text)
{
    bool inText = false, inTags = false;
    std::vector<std::string> tags;
    for (LineReader lines(text); lines.next();) {
        const string_view line = lines.line();
        if (!line.empty() && line[0] == ';') {
            inText = !inText;
            tags.clear();
            inTags = false;
            continue;
        }
        if (inText) continue;
        const string_view word = trimmed(line);
        if (inTags && !word.empty() && word[0] == '_') {
            if (word.find_first_of(" \t#") != string_view::npos) return std::nullopt;
            tags.emplace_back(word);
            continue;
        }
        if (inTags && !tags.empty() && isOfAtoms(tags[0]))
            return AtomLoop{std::move(tags), offsetOf(text, line)};
        tags.clear();
        inTags = lowered(std::string(word.substr(0, 6))) == "loop_";
        if (isOfAtoms(word)) return std::nullopt; // values in pairs
    }
    return std::nullopt;
}

} // namespace

bool splitRow(string_view line, Fields& fields)
{
    fields.clear();
    if (!line.empty() && line[0] == ';') return false;
    for (std::size_t at = 0; at < line.size();) {
        if (isCifBlank(line[at])) {
            ++at;
            continue;
        }
        const char first = line[at];
        if (first == '#' || first == '_' || first == '$' || first == '[') return false;
        std::size_t end = at + 1;
        if (first == '\'' || first == '"') {
            while (end < line.size() &&
                   !(line[end] == first && (end + 1 == line.size() || isCifBlank(line[end + 1]))))
                ++end;
            if (end >= line.size()) return false;
            ++end;
        } else {
            while (end < line.size() && !isCifBlank(line[end])) ++end;
        }
        fields.push_back(line.substr(at, end - at));
        at = end;
    }
    return true;
}

std::optional<CifRows> findCifRows(const std::string& text)
{
    std::optional<AtomLoop> loop = findLoop(text);
    if (!loop) return std::nullopt;
    CifRows out;
    out.begin = out.end = loop->rows;
    for (LineReader lines(string_view(text).substr(loop->rows)); lines.next();) {
        const string_view line = lines.line();
        if (trimmed(line).empty()) continue;
        if (endsLoop(line)) break;
        out.end = offsetOf(text, line) + line.size();
        if (out.firstEnd == 0) out.firstEnd = out.end;
    }
    Fields fields;
    const string_view first = string_view(text).substr(out.begin, out.firstEnd - out.begin);
    if (out.firstEnd == 0 ||
        !splitRow(first.substr(std::min(first.find_first_not_of("\r\n"), first.size())), fields) ||
        fields.size() != loop->tags.size())
        return std::nullopt;
    out.tags = std::move(loop->tags);
    return out;
}

} // namespace molsurf
