// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/selection_tree.h"

#include "molsurf/molecule/selection/near_atoms.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <unordered_set>

namespace molsurf
{
namespace
{

using std::string_view;

/// Whether a number stands to another as a relation says.
bool holds(double a, const std::string& relation, double b)
{
    if (relation == "<") return a < b;
    if (relation == "<=") return a <= b;
    if (relation == ">") return a > b;
    if (relation == ">=") return a >= b;
    return (a == b) != (relation == "!=");
}

/// Finds the atoms of each node.
class Evaluation
{
public:
    explicit Evaluation(const SelectionFacts& facts) : facts_(facts), structure_(facts.structure())
    {
    }

    AtomMask of(const SubTree& tree) const
    {
        return std::visit([&](const auto& node) { return of(node); }, tree->node);
    }

    AtomMask of(const AtomTest& test) const
    {
        return where([&](std::size_t i, const Atom&) { return test.holds(facts_, i); });
    }

    AtomMask of(const NameTest& test) const
    {
        // Neighbours mostly share a name of a chain or residue.
        std::string last;
        bool known = false, had = false;
        return where([&](std::size_t, const Atom& atom) {
            const std::string_view name = test.property->text(structure_, atom);
            if (known && name == last) return had;
            known = true;
            last = name;
            return had = test.inverted !=
                         std::any_of(test.names.begin(), test.names.end(),
                                     [&](const NameGlob& glob) { return glob.matches(name); });
        });
    }

    AtomMask of(const AllOf& all) const
    {
        AtomMask out(structure_.atoms.size(), 1);
        for (const SubTree& part : all.parts) {
            const AtomMask one = of(part);
            for (std::size_t i = 0; i < out.size(); ++i) out[i] &= one[i];
        }
        return out;
    }

    AtomMask of(const AnyOf& any) const
    {
        AtomMask out(structure_.atoms.size());
        for (const SubTree& part : any.parts) {
            const AtomMask one = of(part);
            for (std::size_t i = 0; i < out.size(); ++i) out[i] |= one[i];
        }
        return out;
    }

    AtomMask of(const NotOf& no) const
    {
        AtomMask out = of(no.of);
        for (char& one : out) one = !one;
        return out;
    }

    AtomMask of(const SameAs& same) const
    {
        const AtomMask some = of(same.of);
        if (!same.property) return sharing(some, [&](std::size_t i) { return atom(i).residue; });
        if (same.property->number)
            return sharing(some, [&](std::size_t i) { return same.property->number(facts_, i); });
        return sharing(some,
                       [&](std::size_t i) { return same.property->text(structure_, atom(i)); });
    }

    AtomMask of(const NearTo& near) const
    {
        const AtomMask some = of(near.of);
        AtomMask out = nearAtoms(structure_, some, near.distance);
        for (std::size_t i = 0; i < out.size() && !near.itself; ++i) out[i] &= !some[i];
        return out;
    }

private:
    const Atom& atom(std::size_t i) const { return structure_.atoms[i]; }

    template<typename F>
    AtomMask where(F holds) const
    {
        AtomMask out(structure_.atoms.size());
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = char(holds(i, atom(i)));
        return out;
    }

    /// The atoms whose key is that of a marked one.
    template<typename Key>
    AtomMask sharing(const AtomMask& some, const Key& key) const
    {
        std::unordered_set<decltype(key(0))> keys;
        for (std::size_t i = 0; i < some.size(); ++i)
            if (some[i]) keys.insert(key(i));
        return where([&](std::size_t i, const Atom&) { return keys.count(key(i)) > 0; });
    }

    const SelectionFacts& facts_;
    const Structure& structure_;
};

} // namespace

SubTree treeOf(decltype(SelectionTree::node) node)
{
    return std::make_shared<const SelectionTree>(SelectionTree{std::move(node)});
}

SubTree inRanges(const PropertyWord& property, std::vector<NumberRange> ranges)
{
    const auto holds = [&property, all = std::move(ranges)](const SelectionFacts& facts,
                                                            std::size_t i) {
        Residue place{};
        place.number = std::int32_t(property.number(facts, i));
        const Structure& structure = facts.structure();
        if (property.residue)
            place.insertionCode = residueOf(structure, structure.atoms[i]).insertionCode;
        return std::any_of(all.begin(), all.end(), [&](const NumberRange& range) {
            return range.from.compare(place) <= 0 && range.to.compare(place) >= 0;
        });
    };
    return treeOf(AtomTest{holds});
}

SubTree compared(const PropertyWord& property, const std::string& relation, double value)
{
    if (!property.lists) value = double(float(value));
    const auto isSo = [=, &property](const SelectionFacts& facts, std::size_t i) {
        return holds(property.number(facts, i), relation, value);
    };
    return treeOf(AtomTest{isSo, property.place});
}

int SequenceBound::compare(const Residue& residue) const
{
    if (number != residue.number) return number < residue.number ? -1 : 1;
    if (insertionCode == '*' || insertionCode == residue.insertionCode) return 0;
    return insertionCode < residue.insertionCode ? -1 : 1;
}

bool NameGlob::matches(std::string_view name) const
{
    if (!pattern) return name == text;
    // Backtracking: where letters differ, the last * takes one letter more.
    std::size_t at = 0, in = 0, star = std::string::npos, from = 0;
    while (in < name.size()) {
        if (at < text.size() && text[at] == '*') {
            star = at++;
            from = in;
        } else if (at < text.size() && (text[at] == '?' || text[at] == name[in])) {
            ++at;
            ++in;
        } else if (star != std::string::npos) {
            at = star + 1;
            in = ++from;
        } else {
            return false;
        }
    }
    while (at < text.size() && text[at] == '*') ++at;
    return at == text.size();
}

AtomMask atomsOf(const SelectionTree& tree, const SelectionFacts& facts)
{
    const Evaluation evaluation(facts);
    return std::visit([&](const auto& node) { return evaluation.of(node); }, tree.node);
}

namespace
{

/// The selections that a node is made of.
std::vector<SubTree> partsOf(const SelectionTree& tree)
{
    if (const auto* all = std::get_if<AllOf>(&tree.node)) return all->parts;
    if (const auto* phrase = std::get_if<PhraseOf>(&tree.node)) return phrase->parts;
    if (const auto* some = std::get_if<AnyOf>(&tree.node)) return some->parts;
    if (const auto* no = std::get_if<NotOf>(&tree.node)) return {no->of};
    if (const auto* same = std::get_if<SameAs>(&tree.node)) return {same->of};
    if (const auto* near = std::get_if<NearTo>(&tree.node)) return {near->of};
    return {};
}

} // namespace

bool asksForPlaces(const SelectionTree& tree)
{
    if (const auto* same = std::get_if<SameAs>(&tree.node))
        if (same->property && same->property->place) return true;
    if (const auto* test = std::get_if<AtomTest>(&tree.node)) return test->place;
    const std::vector<SubTree> parts = partsOf(tree);
    return std::holds_alternative<NearTo>(tree.node) ||
           std::any_of(parts.begin(), parts.end(),
                       [](const SubTree& part) { return asksForPlaces(*part); });
}

std::vector<std::string> unknownNames(const SelectionTree& tree, const Structure& structure)
{
    std::vector<std::string> out;
    for (const SubTree& part : partsOf(tree))
        for (std::string& line : unknownNames(*part, structure)) out.push_back(std::move(line));
    const auto* const test = std::get_if<NameTest>(&tree.node);
    if (!test || test->inverted || test->property->element) return out;
    std::unordered_set<std::string_view> names;
    for (const Atom& atom : structure.atoms) names.insert(test->property->text(structure, atom));
    for (const NameGlob& glob : test->names) {
        const auto has = [&](const NameGlob& one) {
            return std::any_of(names.begin(), names.end(),
                               [&](std::string_view name) { return one.matches(name); });
        };
        if (has(glob) || glob.text.empty()) continue;
        const string_view words = test->property->words;
        const std::string word(words.substr(0, words.find(' ')));
        std::string upper = glob.text, hint;
        for (char& c : upper) c = char(std::toupper(static_cast<unsigned char>(c)));
        if (glob.quoted && glob.text.find_first_of("*?") != std::string::npos)
            hint = " [hint: in quotes * and ? are letters: " + word + " " + glob.text + "]";
        else if (has({upper, glob.pattern}))
            hint =
                " [hint: did you mean " + word + " " + upper + "? Names have the case of the file]";
        out.push_back(word + " " + inQuotes(glob.text) + " matches no atom of the file" + hint);
    }
    return out;
}

} // namespace molsurf
