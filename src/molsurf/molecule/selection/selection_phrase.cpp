// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/selection_phrase.h"

#include "molsurf/error.h"
#include "molsurf/molecule/structure/element.h"
#include "molsurf/molecule/structure/residue_kind.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <limits>
#include <string_view>

namespace molsurf
{
namespace
{

using std::string_view;

constexpr std::uint32_t bitOf(ResidueKind kind)
{
    return 1u << unsigned(kind);
}

constexpr std::uint32_t polymerKinds = bitOf(ResidueKind::Protein) | bitOf(ResidueKind::Nucleic) |
                                       bitOf(ResidueKind::Modified) | bitOf(ResidueKind::Bead);

/// The kinds that a word names; 0 if it names none.
std::uint32_t kindsOf(string_view word)
{
    if (word == "polymer") return polymerKinds;
    if (word == "solvent") return bitOf(ResidueKind::Water);
    if (word == "hetero") return ~(polymerKinds | bitOf(ResidueKind::Water));
    for (auto kind = ResidueKind::Protein; kind <= ResidueKind::Bead;
         kind = ResidueKind(unsigned(kind) + 1))
        if (word == kindWord(kind)) return bitOf(kind);
    return 0;
}

/// Recursive descent: a function for each part of the grammar at readPhrase().
class PhraseReader
{
public:
    explicit PhraseReader(const std::string& text) : text_(text) {}

    SelectionPhrase read()
    {
        enum Part { Model, Chains, Residues, Atoms };
        const Part first = peek() == '/'                      ? Model
                           : isDigit(peek()) || beginsRange() ? Residues
                           : hasBefore("[:", "/;(")           ? Atoms
                           : hasBefore("(", "/;")             ? Residues
                                                              : Chains;
        if (first == Model) {
            ++at_;
            model();
        }
        const bool chains = first == Model && !atEnd();
        if (chains && !take('/')) fail("a / behind the model");
        if (chains || (first == Chains && !atEnd())) names("chain", "chains", "/;");
        if (first <= Chains && !atEnd() && !take('/')) fail("a / or ; behind the chains");
        if (first <= Residues && !atEnd()) residues();
        if (first <= Residues && !atEnd() && !take('/')) fail("a / or ; behind the residues");
        if (!atEnd()) atoms();
        while (take(';')) property();
        if (at_ < text_.size()) fail("the end or a ;");
        return {treeOf(PhraseOf{{std::move(parts_)}}), model_};
    }

private:
    [[noreturn]] void fail(const std::string& expected) const
    {
        const std::string_view rest = string_view(text_).substr(at_);
        throw Error(ErrorKind::Usage, "selection " + inQuotes(text_) + ": expected " + expected +
                                          ", got " + (rest.empty() ? "nothing" : inQuotes(rest)) +
                                          " [hint: for example /1/A/53-132 or *;polymer]");
    }

    char peek(std::size_t ahead = 0) const
    {
        return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
    }

    /// Whether a chain, residues and atoms are all read.
    bool atEnd() const { return at_ >= text_.size() || peek() == ';'; }

    bool take(char c)
    {
        const bool found = peek() == c && c != '\0';
        at_ += found;
        return found;
    }

    bool beginsRange() const
    {
        return peek() == '(' || peek() == '.' || (peek() == '-' && isDigit(peek(1)));
    }

    /// Whether one of some letters comes before all of others, outside of quotes.
    bool hasBefore(string_view letters, string_view others) const
    {
        char quote = '\0';
        for (std::size_t i = at_; i < text_.size(); ++i) {
            const char c = text_[i];
            const bool opens = (c == '"' || c == '\'') && (i == at_ || text_[i - 1] == ',');
            if (quote != '\0' || opens) {
                if (quote == '\0')
                    quote = c;
                else if (c == quote)
                    quote = '\0';
                continue;
            }
            if (others.find(c) != string_view::npos) return false;
            if (letters.find(c) != string_view::npos) return true;
        }
        return false;
    }

    void model()
    {
        if (peek() == '/' || atEnd() || take('*')) return;
        std::size_t end = at_;
        while (end < text_.size() && text_[end] != '/' && text_[end] != ';') ++end;
        if (!parseInteger(string_view(text_).substr(at_, end - at_), model_) || model_ < 1)
            fail("the number of a model");
        at_ = end;
        add([number = model_](const SelectionFacts& facts, std::size_t i) {
            return facts.modelOf(i).number == number;
        });
    }

    /// A name, which ends before one of some letters, or a text in quotes.
    std::string name(const std::string& what, string_view ends)
    {
        const char quote = peek();
        if (quote == '"' || quote == '\'') {
            const std::size_t end = text_.find(quote, at_ + 1);
            const char behind =
                end != std::string::npos && end + 1 < text_.size() ? text_[end + 1] : '\0';
            if (end == std::string::npos ||
                (behind != '\0' && behind != ',' && ends.find(behind) == string_view::npos))
                fail("a quote at the end of a name of " + what);
            std::string quoted = text_.substr(at_ + 1, end - at_ - 1);
            at_ = end + 1;
            return quoted;
        }
        const std::size_t begin = at_;
        while (at_ < text_.size() && text_[at_] != ',' &&
               ends.find(text_[at_]) == string_view::npos) {
            if (string_view("[]()!/*:").find(text_[at_]) != string_view::npos)
                fail(what + " joined by commas, with quotes around names such as 'A*'");
            ++at_;
        }
        return text_.substr(begin, at_ - begin);
    }

    /// Reads names of a property, or * for all.
    /// @return the names; empty: all
    std::vector<NameGlob> names(const char* property, const std::string& what, string_view ends)
    {
        NameTest test{&propertyOf(property), {}};
        if (peek() == '*' && (at_ + 1 == text_.size() || ends.find(peek(1)) != string_view::npos)) {
            ++at_;
            return {};
        }
        test.inverted = take('!');
        do test.names.push_back({name(what, ends), false, true});
        while (take(','));
        parts_.push_back(treeOf(test));
        return test.names;
    }

    /// A number with its insertion code, or * or nothing, which are `open`.
    SequenceBound bound(int open)
    {
        SequenceBound out{open, '*'};
        const bool any = take('*');
        const std::size_t digits = at_ + (peek() == '-');
        if (!any && digits < text_.size() && isDigit(text_[digits])) {
            std::size_t end = digits;
            while (end < text_.size() && isDigit(text_[end])) ++end;
            if (!parseInteger(string_view(text_).substr(at_, end - at_), out.number))
                fail("the number of a residue");
            at_ = end;
            out.insertionCode = ' ';
        }
        const bool number = out.insertionCode == ' ';
        take('.');
        if (number && (isLetter(peek()) || peek() == '*')) out.insertionCode = text_[at_++];
        if (!number) take('*');
        return out;
    }

    /// Names in brackets, behind which MMDB's "." and "*" may stand.
    void residueNames()
    {
        if (named_ || !take('(')) return;
        named_ = !names("resname", "residues", ")").empty();
        if (!take(')')) fail("a ) behind the names of residues");
        take('.');
        take('*');
    }

    void residues()
    {
        if (peek() == '/') return;
        constexpr int least = std::numeric_limits<int>::min();
        constexpr int most = std::numeric_limits<int>::max();
        NumberRange range{{least, '*'}, {most, '*'}};
        if (peek() != '(') range.from = bound(least);
        residueNames();
        const bool open = range.from.number == least;
        if (take('-')) {
            range.to = bound(most);
            residueNames();
            if (open && range.to.number == most && !named_ && text_[at_ - 1] == '-')
                fail("a number of a residue beside the -");
        } else if (!open) {
            range.to = range.from;
        }
        parts_.push_back(inRanges(propertyOf("resid"), {range}));
    }

    void atoms()
    {
        if (peek() != '[' && peek() != ':' && !atEnd()) names("name", "atoms", "[:;");
        if (take('[')) elements();
        if (take(':')) {
            for (const NameGlob& label : names("alt", "alternate locations", ";"))
                if (label.text.size() > 1) fail("alternate locations of one letter");
        }
    }

    void elements()
    {
        if (take('*')) {
            if (!take(']')) fail("a ] behind the elements");
            return;
        }
        NameTest test{&propertyOf("element"), {}, take('!')};
        do {
            const std::string symbol = name("elements", "]");
            const std::uint8_t number = elementNumber(symbol);
            if (number == 0 && symbol != "X" && symbol != "x") fail("the symbol of an element");
            if (symbol != "D" && symbol != "d") test.names.push_back({elementSymbol(number)});
        } while (take(','));
        parts_.push_back(treeOf(std::move(test)));
        if (!take(']')) fail("a ] behind the elements");
    }

    void property()
    {
        std::size_t end = std::min(text_.find(';', at_), text_.size());
        const string_view word = trimmed(string_view(text_).substr(at_, end - at_));
        const std::size_t relation = word.find_first_of("<=>");
        if (relation != string_view::npos) {
            const std::string property(trimmed(word.substr(0, relation)));
            double value = 0.0;
            if ((property != "q" && property != "b") ||
                !parseNumber(trimmed(word.substr(relation + 1)), value))
                fail("q (occupancy) or b (B factor), one of < = > and a number");
            parts_.push_back(compared(propertyOf(property), {word[relation]}, value));
            at_ = end;
            return;
        }
        const bool inverted = word.substr(0, 1) == "!";
        std::uint32_t kinds = 0;
        for (string_view rest = word.substr(inverted);;) {
            const std::size_t comma = rest.find(',');
            const std::uint32_t kind = kindsOf(trimmed(rest.substr(0, comma)));
            if (kind == 0)
                fail("q, b, or a kind of residues (polymer, protein, nucleic, modified, water, "
                     "solvent, "
                     "hetero, ion, buffer, lipid, sugar, ligand, particle, bead)");
            kinds |= kind;
            if (comma == string_view::npos) break;
            rest.remove_prefix(comma + 1);
        }
        if (inverted) kinds = ~kinds;
        add([kinds](const SelectionFacts& facts, std::size_t i) {
            const Structure& structure = facts.structure();
            return (kinds & bitOf(residueOf(structure, structure.atoms[i]).kind)) != 0;
        });
        at_ = end;
    }

    void add(decltype(AtomTest::holds) holds) { parts_.push_back(treeOf(AtomTest{holds})); }

    static const PropertyWord& propertyOf(const std::string& word)
    {
        return *selectionWord(word)->isProperty;
    }

    const std::string& text_;
    std::size_t at_ = 0;
    std::vector<SubTree> parts_;
    int model_ = 0;
    bool named_ = false; ///< whether names of residues were read
};

} // namespace

SelectionPhrase readPhrase(const std::string& text)
{
    return PhraseReader(text).read();
}

} // namespace molsurf
