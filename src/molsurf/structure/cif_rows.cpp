// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/cif_rows.h"

#include "molsurf/core/words.h"
#include "molsurf/structure/text_fields.h"

#include <algorithm>
#include <limits>
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

/// Where a piece may begin.
enum class Cut {
    No,
    Residue, ///< unless a residue of the rows before comes again in the chain
    Chain    ///< or a model
};

/// Steps through rows, and finds where chains, models and residues begin.
class Cutter
{
public:
    explicit Cutter(const std::vector<std::string>& tags)
        : width_(tags.size()), label_(column(tags, "label_asym_id")),
          author_(column(tags, "auth_asym_id")), model_(column(tags, "pdbx_pdb_model_num")),
          number_(std::min(column(tags, "auth_seq_id"), width_))
    {
        if (number_ == width_) number_ = column(tags, "label_seq_id");
    }

    bool canCut() const { return label_ < width_; }

    /// Takes the next row.
    /// @return false if it is none that can be read line by line
    bool take(const Fields& row)
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
        const bool otherChain = label != lastLabel_ && author != lastAuthor_;
        cut_ = otherModel || otherChain ? Cut::Chain : Cut::No;
        beginsModel_ = otherModel;
        if (otherModel || author != lastAuthor_) last_ = lowest;
        endsSpan_ = label != lastLabel_ || otherModel;
        lastLabel_ = label;
        lastAuthor_ = author;
        takeNumber(row);
        return true;
    }

    /// Where that row may begin a piece.
    Cut cut() const { return cut_; }

    /// Whether the label chain is another than that of the row before.
    bool endsSpan() const { return endsSpan_; }

    /// Whether the model is another than that of the row before.
    bool beginsModel() const { return beginsModel_; }

    /// The number of its residue, and the largest one before it in its chain.
    int number() const { return residue_; }
    int last() const { return before_; }

private:
    static constexpr int lowest = std::numeric_limits<int>::min();

    static std::size_t column(const std::vector<std::string>& tags, const char* name)
    {
        const std::string whole = std::string(atomSite) + name;
        const auto found = std::find_if(tags.begin(), tags.end(), [&](const std::string& tag) {
            return lowered(tag) == whole;
        });
        return std::size_t(found - tags.begin());
    }

    /// Allows a cut where a residue's number is above all before it in the chain, so it is new.
    void takeNumber(const Fields& row)
    {
        before_ = last_;
        if (number_ >= width_ || !parseInteger(row[number_], residue_)) residue_ = lowest;
        if (cut_ == Cut::No && last_ != lowest && residue_ > last_) cut_ = Cut::Residue;
        last_ = std::max(last_, residue_);
    }

    std::size_t width_, label_, author_, model_, number_;
    string_view lastLabel_, lastAuthor_, lastModel_;
    std::set<int> models_;
    Cut cut_ = Cut::No;
    bool endsSpan_ = false, beginsModel_ = false;
    int residue_ = lowest, last_ = lowest, before_ = lowest;
};

/// The places where a text is cut.
class Pieces
{
public:
    explicit Pieces(std::size_t rowsOfPiece) : enough_(rowsOfPiece) {}

    /// Takes the row at a place, which begins a piece if it may and the last one has enough rows or
    /// models. If a residue comes again, the cuts since then go.
    void take(std::size_t at, const Cutter& row)
    {
        if (row.endsSpan()) {
            joinLastResidue();
            residues_ = 0;
        }
        if (row.cut() == Cut::Chain) chain_ = begins_.size();
        // A residue from before the cuts of its chain: these would part it.
        while (begins_.size() > chain_ && row.cut() != Cut::Chain &&
               row.number() <= begins_.back().last)
            begins_.pop_back();
        const std::size_t since = begins_.empty() ? enough_ : rows_ - begins_.back().row;
        const bool may = row.cut() == Cut::Chain || (row.cut() == Cut::Residue && residues_ > 1);
        models_ += row.beginsModel();
        if (begins_.empty() || (may && (since >= enough_ || models_ >= enoughModels))) {
            begins_.push_back(
                {at, rows_, row.number(), row.cut() == Cut::Chain ? unknown : row.last()});
            residues_ = models_ = 0;
        }
        residues_ += residues_ == 0 || row.number() != lastNumber_;
        lastNumber_ = row.number();
        if (begins_.size() == 1) chain_ = 1;
        ++rows_;
    }

    std::size_t rows() const { return rows_; }

    void finish(std::size_t end, CifRows& out)
    {
        joinLastResidue();
        for (std::size_t k = 0; k < begins_.size(); ++k) {
            out.cuts.push_back(begins_[k].at);
            const std::size_t next = k + 1 < begins_.size() ? begins_[k + 1].row : rows_;
            out.longest = std::max(out.longest, next - begins_[k].row);
        }
        out.cuts.push_back(end);
        out.rows = rows_;
    }

private:
    static constexpr int unknown = std::numeric_limits<int>::min();
    static constexpr int enoughModels = 256; // gemmi looks through all models for each
    struct Begin {
        std::size_t at, row;
        int number; ///< of its residue
        int last;   ///< largest number of a residue before it in its chain
    };
    /// Undoes a cut before the last residue of a label chain: alone it would look like a ligand, as
    /// would its first one before a cut.
    void joinLastResidue()
    {
        if (begins_.size() > chain_ && begins_.back().last != unknown &&
            begins_.back().number == lastNumber_)
            begins_.pop_back();
    }

    std::size_t enough_, rows_ = 0;
    int lastNumber_ = unknown;
    int residues_ = 0;      ///< of the present label chain in the present piece
    int models_ = 0;        ///< that begin in the present piece behind its first row
    std::size_t chain_ = 0; ///< first of the begins within the chain
    std::vector<Begin> begins_;
};

} // namespace

std::optional<CifRows> findCifRows(const std::string& text, std::size_t rowsOfPiece)
{
    std::optional<AtomLoop> loop = findLoop(text);
    if (!loop) return std::nullopt;
    Cutter cutter(loop->tags);
    if (!cutter.canCut()) return std::nullopt;
    CifRows out;
    Pieces pieces(rowsOfPiece);
    std::size_t end = loop->rows;
    Fields fields;
    for (LineReader lines(string_view(text).substr(loop->rows)); lines.next();) {
        const string_view line = lines.line();
        if (trimmed(line).empty()) continue;
        if (endsLoop(line)) break;
        if (!splitRow(line, fields) || !cutter.take(fields)) return std::nullopt;
        pieces.take(offsetOf(text, line), cutter);
        end = offsetOf(text, line) + line.size();
        if (pieces.rows() == 1) out.firstEnd = end;
    }
    if (pieces.rows() == 0) return std::nullopt;
    pieces.finish(end, out);
    out.tags = std::move(loop->tags);
    return out;
}

std::vector<std::size_t> cutsOfRows(const gemmi::cif::Loop& loop, std::size_t rowsOfPiece)
{
    CifRows out;
    Cutter cutter(loop.tags);
    Pieces pieces(rowsOfPiece);
    Fields fields(loop.width());
    bool can = cutter.canCut() && loop.length() > 0;
    for (std::size_t row = 0; can && row < loop.length(); ++row) {
        std::copy_n(loop.values.begin() + std::ptrdiff_t(row * fields.size()), fields.size(),
                    fields.begin());
        can = cutter.take(fields);
        if (can) pieces.take(row, cutter);
    }
    if (!can) return {0, loop.length()};
    pieces.finish(loop.length(), out);
    return out.cuts;
}

} // namespace molsurf
