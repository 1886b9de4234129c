// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/cif_rows.h"

#include "molsurf/core/words.h"
#include "molsurf/structure/text_fields.h"

#include <algorithm>
#include <set>
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

/// Splits a line by the rules of CIF, quotes included.
/// @return false if it holds more than values: a comment, a keyword, a text of several lines
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

/// Steps through rows, and finds where a chain or a model begins.
class Cutter
{
public:
    explicit Cutter(const std::vector<std::string>& tags)
        : width_(tags.size()), label_(column(tags, "label_asym_id")),
          author_(column(tags, "auth_asym_id")), model_(column(tags, "pdbx_pdb_model_num"))
    {
    }

    bool canCut() const { return label_ < width_; }

    /// Takes the next row.
    /// @param[out] cut  whether a piece may begin with it
    /// @return false if it is none that can be read line by line
    bool take(const Fields& row, bool& cut)
    {
        if (row.size() != width_) return false;
        const string_view label = row[label_], author = author_ < width_ ? row[author_] : label;
        bool otherModel = false;
        if (model_ < width_ && row[model_] != lastModel_) {
            int number = 0;
            if (!parseInteger(row[model_], number) || !models_.insert(number).second) return false;
            otherModel = !lastModel_.empty();
            lastModel_ = row[model_];
        }
        cut = otherModel || (label != lastLabel_ && author != lastAuthor_);
        lastLabel_ = label;
        lastAuthor_ = author;
        return true;
    }

private:
    static std::size_t column(const std::vector<std::string>& tags, const char* name)
    {
        const std::string whole = std::string(atomSite) + name;
        const auto found = std::find_if(tags.begin(), tags.end(), [&](const std::string& tag) {
            return lowered(tag) == whole;
        });
        return std::size_t(found - tags.begin());
    }

    std::size_t width_, label_, author_, model_;
    string_view lastLabel_, lastAuthor_, lastModel_;
    std::set<int> models_;
};

} // namespace

std::optional<CifRows> findCifRows(const std::string& text, std::size_t rowsOfPiece)
{
    std::optional<AtomLoop> loop = findLoop(text);
    if (!loop) return std::nullopt;
    Cutter cutter(loop->tags);
    if (!cutter.canCut()) return std::nullopt;
    CifRows out;
    out.firstEnd = 0;
    std::size_t end = loop->rows, inPiece = 0;
    Fields fields;
    for (LineReader lines(string_view(text).substr(loop->rows)); lines.next();) {
        const string_view line = lines.line();
        if (trimmed(line).empty()) continue;
        if (endsLoop(line)) break;
        bool cut = false;
        if (!splitRow(line, fields) || !cutter.take(fields, cut)) return std::nullopt;
        if (out.cuts.empty() || (cut && inPiece >= rowsOfPiece)) {
            out.cuts.push_back(offsetOf(text, line));
            inPiece = 0;
        }
        ++inPiece;
        ++out.rows;
        out.longest = std::max(out.longest, inPiece);
        end = offsetOf(text, line) + line.size();
        if (out.rows == 1) out.firstEnd = end;
    }
    if (out.rows == 0) return std::nullopt;
    out.cuts.push_back(end);
    out.tags = std::move(loop->tags);
    return out;
}

} // namespace molsurf
