// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/parse_selection.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/selection/selection_phrase.h"
#include "molsurf/molecule/structure/element.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace molsurf
{
namespace
{

using std::string_view;

constexpr string_view blanks = " \t\r\n", brackets = "()", signs = "|&<>=", joins = "+,";

bool isIn(string_view letters, char c)
{
    return c != '\0' && letters.find(c) != string_view::npos;
}

/// One tree of several, without a node about one.
template<typename Node>
SubTree joinedBy(std::vector<SubTree> parts)
{
    return parts.size() == 1 ? parts[0] : treeOf(Node{std::move(parts)});
}

/// Whether a name is one of a structure's chains, residues or atoms.
bool hasChain(const Structure& s, const std::string& name)
{
    return std::find(s.chains.begin(), s.chains.end(), name) != s.chains.end();
}

bool hasResidue(const Structure& s, const std::string& name)
{
    return std::any_of(s.residues.begin(), s.residues.end(),
                       [&](const Residue& residue) { return residue.name == name; });
}

bool hasAtom(const Structure& s, const std::string& name)
{
    return std::any_of(s.atoms.begin(), s.atoms.end(),
                       [&](const Atom& atom) { return atom.name == name; });
}

/// The letters of a text and a place in it.
class TextCursor
{
public:
    explicit TextCursor(const std::string& text) : text_(text) {}

    std::size_t at() const { return at_; }
    void goTo(std::size_t at) { at_ = at; }
    char peek(std::size_t ahead = 0) const
    {
        return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
    }
    bool atEnd() const { return at_ >= text_.size(); }
    string_view rest() const { return string_view(text_).substr(at_); }
    string_view before() const { return string_view(text_).substr(0, at_); }
    string_view from(std::size_t begin) const
    {
        return trimmed(string_view(text_).substr(begin, at_ - begin));
    }

    void skipBlanks()
    {
        while (isIn(blanks, peek())) ++at_;
    }

    bool take(char c)
    {
        const bool found = c != '\0' && peek() == c;
        at_ += found;
        return found;
    }

    /// The text here up to a blank, a bracket or a sign; a bracket or a sign alone, or two signs
    /// that are one: && || <= >= == !=.
    string_view token() const
    {
        std::size_t end = at_;
        const auto ends = [&](char c) {
            return isIn(blanks, c) || isIn(brackets, c) || isIn(signs, c);
        };
        while (end < text_.size() && !ends(text_[end]) && !(text_[end] == '!' && end > at_)) {
            ++end;
            if (text_[end - 1] == '!') break;
        }
        if (end == at_ && end < text_.size()) ++end;
        while (end < text_.size() && end > at_ && isIn("|&<>=", text_[end]) &&
               (text_[end] == '=' ? isIn("<>=!", text_[end - 1]) : text_[end] == text_[at_]) &&
               isIn("|&<>=!", text_[at_]))
            ++end;
        return string_view(text_).substr(at_, end - at_);
    }

    std::string takeToken()
    {
        std::string found(token());
        at_ += found.size();
        return found;
    }

    /// Reads a number behind blanks.
    double takeNumber(const std::string& expected, double least)
    {
        skipBlanks();
        double value = 0.0;
        if (!parseNumber(token(), value) || !std::isfinite(value) || value < least) fail(expected);
        takeToken();
        return value;
    }

    /// The word behind the blanks here, if it is one.
    std::optional<SelectionWord> word()
    {
        skipBlanks();
        return isIn("\"'", peek()) ? std::nullopt : selectionWord(token());
    }

    /// Refuses what stands here, or at another place.
    [[noreturn]] void fail(const std::string& expected, const std::string& hint = "",
                           std::size_t at = std::string::npos) const
    {
        TextCursor here = *this;
        if (at != std::string::npos) here.goTo(at);
        here.skipBlanks();
        const string_view got = here.token();
        std::size_t column = 1; // of characters
        for (std::size_t i = 0; i < here.at_ && i < text_.size(); ++i)
            column += (text_[i] & 0xc0) != 0x80;
        const std::string foreign = foreignWord(got);
        throw Error(
            ErrorKind::Usage,
            "selection " + inQuotes(text_) + ": expected " + expected + ", got " +
                (got.empty() ? "the end" : inQuotes(got) + " at " + std::to_string(column)) +
                (foreign.empty() ? hint : " [hint: not known here; write " + foreign + "]"));
    }

private:
    const std::string& text_;
    std::size_t at_ = 0;
};

/// Reads the values behind the word of a property.
class ValueReader
{
public:
    ValueReader(TextCursor& in, const Structure& structure, const PropertyWord& property,
                string_view word)
        : in_(in), structure_(structure), property_(property), word_(word)
    {
    }

    SubTree read()
    {
        in_.skipBlanks();
        if (isRelation()) return comparison();
        if (!property_.lists) in_.fail("one of < <= > >= = != behind " + word_);
        return property_.text ? names() : ranges();
    }

private:
    bool isRelation() const
    {
        return isIn("<>=", in_.peek()) || (in_.peek() == '!' && in_.peek(1) == '=');
    }

    SubTree comparison()
    {
        if (!property_.number)
            in_.fail(std::string(property_.what) + " behind " + word_,
                     " [hint: names follow it, as in " + word_ + " A+B]");
        const std::string relation(in_.token());
        if (relation != "<" && relation != "<=" && relation != ">" && relation != ">=" &&
            relation != "=" && relation != "==" && relation != "!=")
            in_.fail("one of < <= > >= = !=");
        in_.takeToken();
        constexpr double least = std::numeric_limits<double>::lowest();
        return compared(property_, relation, in_.takeNumber("a number behind " + relation, least));
    }

    /// Whether the list ends here. Words end it, but not those of one letter, nor what + joins.
    bool listEnds() const
    {
        const char c = in_.peek();
        if (in_.atEnd() || isIn(brackets, c) || isIn(signs, c) || c == '!') return true;
        const string_view token = in_.token();
        return token.size() > 1 && in_.word();
    }

    /// Refuses what cannot be the first value.
    void needValue() const
    {
        if (!listEnds()) return;
        const std::string token(in_.token());
        const bool quotable = property_.text && !token.empty() && isLetter(token[0]);
        in_.fail(std::string(property_.what) + " behind " + word_,
                 quotable ? " [hint: a name that is also a word needs quotes, as in " + word_ +
                                " \"" + token + "\"]"
                          : "");
    }

    /// Calls f() for each value of a list that blanks, + and commas part.
    template<typename F>
    void forEachValue(const F& f)
    {
        needValue();
        for (bool joined = false;;) {
            f();
            const std::size_t end = in_.at();
            in_.skipBlanks();
            joined = isIn(joins, in_.peek());
            if (joined) {
                in_.goTo(in_.at() + 1);
                in_.skipBlanks();
                if (in_.atEnd() || isIn(brackets, in_.peek()) || isIn(signs, in_.peek()))
                    in_.fail(std::string(property_.what) + " behind the " +
                             (in_.at() > 0 ? "+ or comma" : ""));
            } else if (listEnds()) {
                in_.goTo(end);
                return;
            }
        }
    }

    /// A name, in quotes or with the wildcards * and ?.
    NameGlob name()
    {
        const char quote = in_.peek();
        if (isIn("\"'", quote)) {
            const std::size_t end = in_.rest().find(quote, 1);
            if (end == string_view::npos)
                in_.fail("a quote at the end of " + std::string(property_.what));
            NameGlob out{std::string(in_.rest().substr(1, end - 1)), false, true};
            in_.goTo(in_.at() + end + 1);
            return out;
        }
        const string_view token = in_.token();
        refuseForeign(token);
        std::size_t end = 0;
        while (end < token.size() && !isJoin(token, end)) ++end;
        if (end == 0) in_.fail(property_.what);
        NameGlob out{std::string(token.substr(0, end)), false};
        out.pattern = out.text.find_first_of("*?") != std::string::npos;
        in_.goTo(in_.at() + end);
        return out;
    }

    /// Refuses a word of another program, unless it is a name in the file.
    void refuseForeign(string_view token) const
    {
        if (foreignWord(token).empty() || !property_.text) return;
        const bool name =
            std::any_of(structure_.atoms.begin(), structure_.atoms.end(), [&](const Atom& atom) {
                return property_.text(structure_, atom) == token;
            });
        if (!name) in_.fail(std::string(property_.what) + ", an operator or the end");
    }

    /// Whether a + or a comma parts values: at the end of a token a + is a charge, as in NA+.
    static bool isJoin(string_view token, std::size_t i)
    {
        return token[i] == ',' || (token[i] == '+' && i > 0 && i + 1 < token.size());
    }

    SubTree names()
    {
        NameTest test{&property_, {}};
        forEachValue([&] { test.names.push_back(property_.element ? symbol() : name()); });
        return treeOf(std::move(test));
    }

    NameGlob symbol()
    {
        const std::size_t begin = in_.at();
        const std::string text = name().text;
        const std::uint8_t number = elementNumber(text);
        if (number == 0 && lowered(text) != "x") in_.fail(property_.what, "", begin);
        return {elementSymbol(number)};
    }

    /// A number, of a residue with its insertion code. PyMOL writes -5 as \-5.
    SequenceBound bound()
    {
        const std::size_t begin = in_.at();
        in_.take('\\');
        const std::size_t from = in_.at();
        in_.take('-');
        while (isDigit(in_.peek())) in_.goTo(in_.at() + 1);
        SequenceBound out{0, property_.residue ? ' ' : '*'};
        if (!parseInteger(in_.from(from), out.number)) in_.fail(property_.what, "", begin);
        if (property_.residue && isLetter(in_.peek()) && !isLetter(in_.peek(1)))
            out.insertionCode = in_.peek(), in_.goTo(in_.at() + 1);
        return out;
    }

    /// Reads what parts the ends of a range, if it stands here.
    bool takeTo()
    {
        if (in_.take('-') || in_.take(':')) return true;
        const std::size_t end = in_.at();
        in_.skipBlanks();
        const std::string two = lowered(std::string(in_.rest().substr(0, 2)));
        if (two == "to" && !isLetter(in_.peek(2))) {
            in_.goTo(in_.at() + 2);
            in_.skipBlanks();
            return true;
        }
        in_.goTo(end);
        return false;
    }

    /// Residue numbers, as 5, 5-9, 5:9 or "5 to 9", joined by blanks, commas or plus signs.
    SubTree ranges()
    {
        std::vector<NumberRange> found;
        forEachValue([&] {
            const std::size_t begin = in_.at();
            const SequenceBound first = bound();
            SequenceBound last = first;
            if (takeTo()) {
                last = {std::numeric_limits<int>::max(), '*'};
                if (isDigit(in_.peek()) || in_.peek() == '-' || in_.peek() == '\\') last = bound();
            }
            const char c = in_.peek();
            if (!in_.atEnd() && !isIn(blanks, c) && !isIn(brackets, c) && !isIn(joins, c) &&
                !isIn(signs, c))
                in_.fail(std::string(property_.what) + ", as in 10, 10-20, 10:20 or 10 to 20", "",
                         begin);
            found.push_back({first, last});
        });
        return inRanges(property_, std::move(found));
    }

    TextCursor& in_;
    const Structure& structure_;
    const PropertyWord& property_;
    std::string word_;
};

/// Recursive descent: a function for each rule of the grammar at parseSelection().
class SelectionParser
{
public:
    SelectionParser(const std::string& text, const Structure& structure)
        : in_(text), structure_(structure)
    {
    }

    Selection parse()
    {
        const SubTree tree = expression(&out_.alternatives);
        in_.skipBlanks();
        if (!in_.atEnd())
            in_.fail("and, or, within, around or the end",
                     didYouMean(std::string(in_.token()), joiners()));
        if (out_.alternatives.size() < 2) out_.alternatives = {{tree, ""}};
        return std::move(out_);
    }

private:
    using Does = SelectionOperator;
    using Alternatives = std::vector<Selection::Alternative>;
    static constexpr std::size_t none = std::string::npos;

    static std::vector<std::string> joiners()
    {
        return {"and", "or", "within", "around", "exwithin", "expand", "beyond"};
    }

    /// Counts how deep the grammar calls itself.
    auto deeper()
    {
        struct Depth {
            int& depth;
            ~Depth() { --depth; }
        };
        constexpr int most = 100;
        if (++depth_ > most) in_.fail("at most 100 operators in each other");
        return Depth{depth_};
    }

    /// The operator that stands here; null if it is none.
    const OperatorWord* peekOperator()
    {
        const auto word = in_.word();
        return word ? word->isOperator : nullptr;
    }

    const OperatorWord* takeOperator(Does does)
    {
        const OperatorWord* found = peekOperator();
        if (!found || found->does != does) return nullptr;
        in_.takeToken();
        return found;
    }

    bool takeWord(const char* word)
    {
        in_.skipBlanks();
        const bool found = lowered(std::string(in_.token())) == word;
        if (found) in_.takeToken();
        return found;
    }

    /// @param[out] alternatives  what `or` joins, if nothing else is done with it; may be null
    SubTree expression(Alternatives* alternatives = nullptr)
    {
        const auto depth = deeper();
        SubTree tree = either(alternatives);
        int steps = 0;
        for (;;) {
            const OperatorWord* word = peekOperator();
            if (!word || word->does < Does::Within) return tree;
            if (alternatives) alternatives->clear();
            constexpr int most = 100;
            if (++steps > most) in_.fail("at most 100 operators behind each other");
            in_.takeToken();
            tree = postfix(*word, tree);
        }
    }

    /// "S around 5" and "S within 5 of T".
    SubTree postfix(const OperatorWord& word, const SubTree& tree)
    {
        const double reach = distance();
        if (word.does == Does::Around) return treeOf(NearTo{reach, word.itself, tree});
        if (!takeWord("of")) in_.fail("of behind the distance");
        const auto depth = deeper();
        return treeOf(AllOf{{tree, nearTo(word, reach, either())}});
    }

    static SubTree nearTo(const OperatorWord& word, double reach, const SubTree& of)
    {
        const SubTree near = treeOf(NearTo{reach, word.itself, of});
        return word.does == Does::Beyond ? treeOf(NotOf{near}) : near;
    }

    SubTree either(Alternatives* alternatives = nullptr)
    {
        std::vector<SubTree> parts;
        do {
            in_.skipBlanks();
            const std::size_t begin = in_.at();
            parts.push_back(both());
            if (alternatives) alternatives->push_back({parts.back(), std::string(in_.from(begin))});
        } while (takeOperator(Does::Or));
        return joinedBy<AnyOf>(std::move(parts));
    }

    SubTree both()
    {
        std::vector<SubTree> parts;
        do parts.push_back(operand());
        while (takeOperator(Does::And));
        return joinedBy<AllOf>(std::move(parts));
    }

    /// What stands on either side of and and or.
    SubTree operand()
    {
        const auto depth = deeper();
        const auto word = in_.word();
        if (in_.peek() == '(') return bracket();
        if (!word || isInvertedPhrase() || isChainAlone(*word)) return phrase();
        if (word->isOperator) return operation(*word->isOperator);
        if (word->isClass) {
            in_.takeToken();
            return treeOf(AtomTest{[row = word->isClass](const SelectionFacts& f, std::size_t i) {
                return row->holds(f, f.structure().atoms[i]);
            }});
        }
        return property(*word->isProperty);
    }

    /// The words behind MDAnalysis's "prop".
    SubTree value()
    {
        const auto word = in_.word();
        if (!word || !word->isProperty || !word->isProperty->number)
            in_.fail("x, y, z, charge or another number behind prop");
        return property(*word->isProperty);
    }

    SubTree property(const PropertyWord& property)
    {
        const std::size_t begin = in_.at();
        const std::string word = in_.takeToken();
        in_.skipBlanks();
        const bool compared = isIn("<>=!", in_.peek());
        in_.goTo(begin);
        if (word.size() == 1 && !compared && (hasChain(structure_, word) || isAlone(word)))
            return phrase(); // "b" is a chain, too
        in_.takeToken();
        return ValueReader(in_, structure_, property, word).read();
    }

    /// An operand that begins with an operator: not, within, same as, byres, ...
    SubTree operation(const OperatorWord& word)
    {
        switch (word.does) {
        case Does::Value:
            in_.takeToken();
            return value();
        case Does::And:
        case Does::Or:
            failAtOperand();
        case Does::Not:
            in_.takeToken();
            return treeOf(NotOf{operand()});
        case Does::SameAs:
            return sameAs(word);
        default:
            break;
        }
        const std::size_t begin = in_.at();
        in_.takeToken();
        const double reach = distance();
        const bool of = takeWord("of");
        if (!of && word.does != Does::Around) in_.fail("of behind the distance");
        const SubTree tree = greedy(of ? begin : none);
        return nearTo(word, reach, tree);
    }

    /// "same residue as SELECTION", and words for it, as byres.
    SubTree sameAs(const OperatorWord& word)
    {
        const std::size_t begin = in_.at();
        in_.takeToken();
        std::string key = word.property ? word.property : "";
        const bool named = key.empty();
        if (named) {
            in_.skipBlanks();
            const std::size_t at = in_.at();
            key = lowered(in_.takeToken());
            const auto found = selectionWord(key);
            if (key != "residue" && !(found && found->isProperty))
                in_.fail("residue, chain, resname or another property behind same", "", at);
            if (!takeWord("as")) in_.fail("as behind same " + key);
        }
        const SubTree of = greedy(named ? begin : none);
        return treeOf(SameAs{key == "residue" ? nullptr : selectionWord(key)->isProperty, of});
    }

    /// The selection behind a prefix: all up to the end or a bracket.
    /// @param[in] begin  of a prefix that other programs end at `and` and `or`; else none
    SubTree greedy(std::size_t begin)
    {
        const std::string prefix(begin == none ? string_view() : in_.from(begin));
        in_.skipBlanks();
        const std::size_t from = in_.at();
        const SubTree tree = expression();
        const bool joined =
            std::holds_alternative<AllOf>(tree->node) || std::holds_alternative<AnyOf>(tree->node);
        if (joined && !prefix.empty() && !isBracketed(from))
            out_.notes.push_back(inQuotes(in_.from(from)) + " was taken as one behind " +
                                 inQuotes(prefix) + " [hint: brackets decide: (" + prefix +
                                 " S) and T, or " + prefix + " (S and T)]");
        return tree;
    }

    /// Whether one bracket holds all from a place to here.
    bool isBracketed(std::size_t begin) const
    {
        const string_view text = in_.from(begin);
        if (text.empty() || text[0] != '(') return false;
        int open = 0;
        for (std::size_t i = 0; i < text.size(); ++i) {
            open += (text[i] == '(') - (text[i] == ')');
            if (open == 0) return i + 1 == text.size();
        }
        return false;
    }

    double distance() { return in_.takeNumber("a distance of at least 0 Å", 0.0); }

    SubTree bracket()
    {
        if (SubTree residues = residuesInBrackets()) return residues;
        const std::size_t begin = in_.at();
        in_.take('(');
        const SubTree tree = expression();
        in_.skipBlanks();
        if (!in_.take(')'))
            in_.fail(in_.atEnd() ? ") for the bracket at " + std::to_string(begin + 1)
                                 : "and, or, within, around or )",
                     didYouMean(std::string(in_.token()), joiners()));
        return tree;
    }

    /// "(HEM)" and "(HEM,ZN)/FE", as gemmi has it; null if it is a bracket about words or chains.
    SubTree residuesInBrackets()
    {
        const string_view rest = in_.rest();
        const std::string inside(rest.substr(1, rest.find(')') - 1));
        if (rest.find(')') == string_view::npos || selectionWord(trimmed(inside)) ||
            inside.find_first_of(" (|&<>=") != std::string::npos)
            return nullptr;
        const bool chain = hasChain(structure_, inside) && !hasResidue(structure_, inside);
        return chain ? nullptr : phraseOf(phraseText());
    }

    /// The phrase of gemmi's that begins here: all up to a blank, | or & outside of its brackets
    /// and quotes, or a bracket that closes another. Blanks may stand beside < = > of its
    /// properties.
    std::string phraseText() const
    {
        const string_view rest = in_.rest();
        int open = 0;
        char quote = '\0';
        std::size_t end = 0;
        bool property = false;
        for (; end < rest.size(); ++end) {
            const char c = rest[end];
            const bool begins = end == 0 || isIn(",/([!", rest[end - 1]);
            if (quote != '\0') {
                if (c == quote) quote = '\0';
            } else if (isIn("\"'", c) && begins) {
                quote = c;
            } else if (isIn("|&", c) || (c == ')' && open == 0) ||
                       (isIn(blanks, c) && !(property && isBesideRelation(rest, end)))) {
                break;
            } else {
                open += (c == '(') - (c == ')');
                property = property || c == ';';
            }
        }
        return std::string(trimmed(rest.substr(0, end)));
    }

    /// Whether < = or > is next to the blanks at a place.
    static bool isBesideRelation(string_view text, std::size_t at)
    {
        const std::size_t before = text.find_last_not_of(blanks, at),
                          behind = text.find_first_not_of(blanks, at);
        return (before != none && isIn("<=>", text[before])) ||
               (behind != none && isIn("<=>", text[behind]));
    }

    SubTree phraseOf(const std::string& text)
    {
        const SelectionPhrase found = readPhrase(text);
        in_.goTo(in_.at() + text.size());
        out_.models.push_back(found.model);
        return found.tree;
    }

    /// Whether "!A/10" stands here, all chains but A, and not the word `not`.
    bool isInvertedPhrase() const
    {
        return in_.peek() == '!' && in_.peek(1) != '(' && phraseText().find_first_of("/;[") != none;
    }

    /// Whether nothing but | is beside what stands here.
    bool isAlone(string_view text) const
    {
        const string_view before = in_.before();
        const std::size_t last = before.find_last_not_of(blanks),
                          next = in_.rest().find_first_not_of(blanks, text.size());
        return (last == none || before[last] == '|') && (next == none || in_.rest()[next] == '|');
    }

    /// Whether the word that stands here is alone, and the name of a chain.
    bool isChainAlone(const SelectionWord& word)
    {
        const std::string text = phraseText();
        if (!word.isClass || text == "*" || !isAlone(text) || !hasChain(structure_, text))
            return false;
        out_.notes.push_back(text + " was read as the chain " + text + " [hint: (" + text +
                             ") is the word]");
        return true;
    }

    /// A phrase of gemmi, as /1/A/5-9 or (HEM). A single unknown word is refused, since it is
    /// rather a misspelt keyword than a chain.
    SubTree phrase()
    {
        const std::string text = phraseText();
        const std::size_t bracket = text.find('('); // of a function, as in sqr(x)
        if (text.empty() || (bracket != none && !foreignWord(text.substr(0, bracket)).empty()))
            failAtOperand();
        // A name alone may be a word with a slip.
        const bool name = text.find_first_of("/[(;:,*!\"'") == none && !isDigit(text[0]) &&
                          text[0] != '-' && text[0] != '.';
        if (!name || hasChain(structure_, text)) return phraseOf(text);
        if (!isAlone(text) || !isLetter(text[0]) || !foreignWord(text).empty() ||
            !nearWord(text).empty())
            failAtOperand();
        out_.hint = hintOn(text);
        return phraseOf(text);
    }

    /// " [hint: did you mean ...?]" of a word near to one that is no name of the file; else empty.
    std::string nearWord(const std::string& word) const
    {
        constexpr std::size_t shortest = 4; // shorter ones are near to too many
        if (word.size() < shortest || hasResidue(structure_, word) || hasAtom(structure_, word))
            return "";
        return didYouMean(word, selectionWords());
    }

    /// A hint on what an unknown word may stand for: a name of the file, or a word near to it.
    std::string hintOn(const std::string& word) const
    {
        if (word.empty() || !isLetter(word[0])) return "";
        if (hasResidue(structure_, word)) return " [hint: resname " + word + "]";
        if (hasAtom(structure_, word)) return " [hint: name " + word + "]";
        return nearWord(word);
    }

    [[noreturn]] void failAtOperand() const
    {
        in_.fail("a word such as protein, chain or within", hintOn(std::string(in_.token())));
    }

    TextCursor in_;
    const Structure& structure_;
    Selection out_;
    int depth_ = 0;
};

} // namespace

Selection parseSelection(const std::string& text, const Structure& structure)
{
    return SelectionParser(text, structure).parse();
}

} // namespace molsurf
