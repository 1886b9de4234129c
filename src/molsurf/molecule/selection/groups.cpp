// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/groups.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/selection/ball_names.h"
#include "molsurf/molecule/selection/choose_copies.h"
#include "molsurf/molecule/selection/match_atoms.h"
#include "molsurf/molecule/selection/selection_words.h"
#include "molsurf/molecule/selection/subset.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

namespace molsurf
{

namespace
{

std::array<std::uint8_t, 3> colorOf(const std::string& path, const std::string& text)
{
    const auto color = parseColor(text);
    if (!color) failAt(path, "expected a colour like #d55e00, got '" + text + "'");
    return *color;
}

/// The copies of a group in a file.
CopyChoice copiesOf(const std::string& group, const std::string& text)
{
    try {
        return parseCopies(text);
    } catch (const Error& e) { // the file of groups is wrong, not the call
        throw Error(ErrorKind::Input, "group " + group + ": copies: " + e.what());
    }
}

/// Groups of {"groups": [{"name": ..., "select": ..., "color": ...}, ...]}.
std::vector<GroupRule> readJson(const std::string& path, const std::string& text)
{
    if (!isModestJson(text))
        failAt(path, "is no JSON of groups: too deep, or with too many values");
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (json.is_discarded()) failAt(path, "is no valid JSON");
    if (!json.is_object() || !json.contains("groups") || !json["groups"].is_array()) {
        failAt(path, R"(expected {"groups": [{"name": ..., "select": ...}, ...]})");
    }
    std::vector<GroupRule> rules;
    for (const auto& entry : json["groups"]) {
        const auto word = [&](const char* key) {
            if (!entry.is_object() || !entry.contains(key) || !entry[key].is_string()) {
                failAt(path, "group " + std::to_string(rules.size() + 1) + ": expected a text \"" +
                                 key + "\"");
            }
            return entry[key].get<std::string>();
        };
        GroupRule rule;
        rule.name = word("name");
        rule.select = word("select");
        if (entry.contains("color")) rule.color = colorOf(path, word("color"));
        if (entry.contains("copies")) rule.copies = copiesOf(rule.name, word("copies"));
        for (const auto& item : entry.items()) {
            if (item.key() != "name" && item.key() != "select" && item.key() != "color" &&
                item.key() != "copies") {
                failAt(path, "group " + rule.name + ": unknown key \"" + item.key() +
                                 "\" [hint: name, select, color, copies]");
            }
        }
        rules.push_back(std::move(rule));
    }
    return rules;
}

/// Whether a column of a table is behind the selection, which may have blanks.
bool isEnd(std::string_view column)
{
    constexpr std::size_t longest = 64; // of a colour: the last column has the rest of the line
    return column.rfind("copies=", 0) == 0 || column[0] == '#' ||
           (column.size() <= longest && parseColor(std::string(column)).has_value());
}

/// Groups of lines NAME SELECTION [COLOUR].
std::vector<GroupRule> readTable(const std::string& path, const std::string& text)
{
    std::vector<GroupRule> rules;
    for (LineReader lines(text); lines.next();) {
        const Fields columns = splitFields(lines.line());
        if (columns.empty() || columns[0][0] == '#') continue;
        if (columns.size() < 2) {
            failAt(path, "line " + std::to_string(lines.number()) +
                             ": expected name, selection and perhaps colour, got " +
                             inQuotes(lines.line()));
        }
        GroupRule rule;
        rule.name = columns[0];
        std::size_t end = columns.size();
        while (end > 2 && isEnd(columns[end - 1])) --end;
        const char* const first = columns[1].data();
        constexpr std::size_t longest = 1 << 20; // of a selection
        const std::size_t length =
            std::size_t(columns[end - 1].data() + columns[end - 1].size() - first);
        if (length <= longest) rule.select = std::string(first, length);
        const auto isWord = [](std::string_view word) {
            return word.find_first_of("()|&<>=") != std::string_view::npos ||
                   (word.size() > 1 && selectionWord(word));
        };
        const auto last = columns.begin() + std::ptrdiff_t(end);
        if (end > 2 && std::none_of(columns.begin() + 1, last, isWord)) { // a wrong colour
            rule.select = columns[1];
            end = 2;
        }
        for (std::size_t k = end; k < columns.size(); ++k) {
            if (columns[k].rfind("copies=", 0) == 0) {
                rule.copies = copiesOf(rule.name, std::string(columns[k].substr(7)));
            } else {
                rule.color = colorOf(path, std::string(columns[k]));
            }
        }
        rules.push_back(std::move(rule));
    }
    return rules;
}

/// The kind of a residue by its name.
ResidueClass classOf(const std::string& name)
{
    static const std::map<std::string, ResidueClass> classes = [] {
        std::map<std::string, ResidueClass> out;
        const auto add = [&](ResidueClass c, std::initializer_list<const char*> names) {
            for (const char* n : names) out[n] = c;
        };
        add(ResidueClass::Hydrophobic, {"ALA", "VAL", "LEU", "ILE", "MET"});
        add(ResidueClass::Aromatic, {"PHE", "TYR", "TRP"});
        add(ResidueClass::Polar, {"SER", "THR", "ASN", "GLN"});
        add(ResidueClass::Positive, {"LYS", "ARG", "HIS"});
        add(ResidueClass::Negative, {"ASP", "GLU"});
        add(ResidueClass::Special, {"GLY", "PRO", "CYS", "SEC"});
        add(ResidueClass::Adenine, {"A", "DA"});
        add(ResidueClass::Cytosine, {"C", "DC"});
        add(ResidueClass::Guanine, {"G", "DG"});
        add(ResidueClass::Thymine, {"T", "DT", "U", "DU"});
        add(ResidueClass::Nucleic, {"I", "DI", "N", "DN"});
        return out;
    }();
    const auto found = classes.find(parentResidue(name));
    return found == classes.end() ? ResidueClass::Other : found->second;
}

/// Gives every ball the last rule that has its atom in its copy.
void labelByRules(const Selections& selections, const BallSet& atoms,
                  const std::vector<GroupRule>& rules, BallLabels& labels)
{
    const Placement& placement = atoms.placement;
    std::vector<std::vector<char>> has; // by rule and atom
    for (const GroupRule& rule : rules) {
        try {
            AtomMatch match = selections.match(rule.select);
            has.emplace_back(match.atoms.begin(), match.atoms.end());
            labels.warnings.insert(labels.warnings.end(), match.warnings.begin(),
                                   match.warnings.end());
        } catch (const Error& e) { // the file of groups is wrong, not the call
            throw Error(ErrorKind::Input, "group " + rule.name + ": " + e.what());
        }
        labels.groups.push_back({rule.name, 0, rule.color});
    }
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> lost; // to a later rule: atoms
    labels.groupOf.assign(atoms.balls.size(), -1);
    for (std::size_t c = 0; c < placement.numbers.size(); ++c) {
        const auto applies = [&](const GroupRule& rule) {
            const auto& numbers = rule.copyNumbers;
            return numbers.empty() ||
                   std::find(numbers.begin(), numbers.end(), placement.numbers[c]) != numbers.end();
        };
        for (std::size_t r = 0; r < rules.size(); ++r) {
            if (!applies(rules[r])) continue;
            for (std::size_t i = placement.begin[c]; i < placement.begin[c + 1]; ++i) {
                if (!has[r][std::size_t(atoms.balls[i].atom)]) continue;
                if (labels.groupOf[i] >= 0) ++lost[{std::size_t(labels.groupOf[i]), r}];
                labels.groupOf[i] = std::int32_t(r);
            }
        }
    }
    for (const auto& [rule, count] : lost) {
        labels.warnings.push_back("groups: " + std::to_string(count) + " atoms of " +
                                  rules[rule.first].name + " belong to " + rules[rule.second].name +
                                  ", which comes later");
    }
}

/// For each chain the residue names of its atoms' residues.
std::vector<std::string> sequences(const Structure& structure)
{
    std::vector<std::string> out(structure.chains.size());
    for (const Residue& residue : structure.residues) {
        if (!residue.water()) out[std::size_t(residue.chain)] += residue.name + " ";
    }
    return out;
}

} // namespace

namespace
{

using NamedColor = std::pair<const char*, std::array<std::uint8_t, 3>>;

constexpr NamedColor namedColors[] = {
    {"aqua", {0, 255, 255}},    {"black", {0, 0, 0}},        {"blue", {0, 0, 255}},
    {"cyan", {0, 255, 255}},    {"fuchsia", {255, 0, 255}},  {"gray", {128, 128, 128}},
    {"green", {0, 128, 0}},     {"grey", {128, 128, 128}},   {"lime", {0, 255, 0}},
    {"magenta", {255, 0, 255}}, {"maroon", {128, 0, 0}},     {"navy", {0, 0, 128}},
    {"olive", {128, 128, 0}},   {"orange", {255, 165, 0}},   {"purple", {128, 0, 128}},
    {"red", {255, 0, 0}},       {"silver", {192, 192, 192}}, {"teal", {0, 128, 128}},
    {"white", {255, 255, 255}}, {"yellow", {255, 255, 0}}};

} // namespace

const std::vector<std::string>& colorNames()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const NamedColor& color : namedColors) all.push_back(color.first);
        return all;
    }();
    return names;
}

std::optional<std::array<std::uint8_t, 3>> parseColor(const std::string& text)
{
    const std::string word = lowered(text);
    for (const NamedColor& color : namedColors)
        if (word == color.first) return color.second;
    const std::size_t digits = word.size() == 4 ? 1 : 2; // of each part
    std::array<std::uint8_t, 3> color{};
    if (word.size() != 1 + 3 * digits || word[0] != '#') return {};
    for (std::size_t k = 0; k < 3; ++k) {
        const char* begin = word.data() + 1 + digits * k;
        const auto [end, problem] = std::from_chars(begin, begin + digits, color[k], 16);
        if (problem != std::errc() || end != begin + digits) return {};
        if (digits == 1) color[k] = std::uint8_t(17 * color[k]);
    }
    return color;
}

std::vector<GroupRule> readGroups(const std::string& path, std::size_t maxBytes)
{
    const std::string text = loadBytes(path, maxBytes);
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    const bool json = first != std::string::npos && text[first] == '{';
    std::vector<GroupRule> rules = json ? readJson(path, text) : readTable(path, text);
    if (rules.empty()) failAt(path, "has no group");
    std::set<std::string> names;
    for (const GroupRule& rule : rules) {
        if (rule.name.empty()) failAt(path, "a group has no name");
        if (!names.insert(rule.name).second)
            failAt(path, "two groups are named '" + rule.name + "'");
    }
    return rules;
}

namespace
{

/// Names groups that are made without rules.
class GroupNames
{
public:
    GroupNames(const Structure& structure, const GroupBy& by) : by_(by), chains_(structure.chains)
    {
        if (by.kind != GroupBy::Kind::Entity) return;
        sequences_ = sequences(structure);
        for (const bool empty : {false, true}) // of waters alone
            for (const std::string& sequence : sequences_)
                if (sequence.empty() == empty)
                    entities_.emplace(sequence, std::int32_t(entities_.size()));
    }

    /// The group of a residue, without balls.
    /// @param[in] chain       name of its chain in this copy
    /// @param[in] chainPlace  of that chain
    /// @param[in] copy        number of the copy
    Group groupOf(const Residue& residue, const std::string& chain, std::int32_t chainPlace,
                  int copy) const
    {
        switch (by_.kind) {
        case GroupBy::Kind::Chain:
            return {chain, 0, {}, chainPlace};
        case GroupBy::Kind::Class:
            return {"class " + chains_[std::size_t(residue.chain)], 0, {}, residue.chain};
        case GroupBy::Kind::Copy:
            return {"copy " + std::to_string(copy), 0, {}, copy - 1};
        case GroupBy::Kind::Entity: {
            const std::int32_t entity = entities_.at(sequences_[std::size_t(residue.chain)]);
            return {"entity " + std::to_string(entity + 1), 0, {}, entity};
        }
        default:
            const int size = by_.residues;
            // (number - 1) / size, rounded down for numbers below 1, too.
            const int block =
                residue.number >= 1 ? (residue.number - 1) / size : (residue.number - size) / size;
            return {chain + "/" + std::to_string(block * size + 1) + "-" +
                        std::to_string((block + 1) * size),
                    0,
                    {}};
        }
    }

private:
    GroupBy by_;
    const std::vector<std::string>& chains_;       // names in the file
    std::vector<std::string> sequences_;           // of the chains
    std::map<std::string, std::int32_t> entities_; // by sequence, from 0
};

constexpr std::array<const char*, 4> groupWords = {"chain", "entity", "class", "copy"};

} // namespace

GroupBy parseGroupBy(const std::string& text)
{
    for (std::size_t k = 0; k < groupWords.size(); ++k)
        if (text == groupWords[k]) return {GroupBy::Kind(k)};
    GroupBy by{GroupBy::Kind::Residues};
    if (text.rfind("residues:", 0) == 0 &&
        parseWhole(std::string_view(text).substr(9), by.residues) && by.residues >= 1)
        return by;
    throw Error(ErrorKind::Usage,
                "`groupBy`: expected chain, entity, class, copy or residues:N, got '" + text + "'" +
                    didYouMean(text, {"chain", "entity", "class", "copy", "residues:1"}));
}

std::string textOf(const GroupBy& by)
{
    return by.kind == GroupBy::Kind::Residues ? "residues:" + std::to_string(by.residues)
                                              : groupWords[std::size_t(by.kind)];
}

void addColorGroups(const Selections& selections, const BallSet& atoms,
                    const std::vector<GroupRule>& rules, BallLabels& labels)
{
    BallLabels own;
    labelByRules(selections, atoms, rules, own);
    countBalls(atoms, own.groupOf, own.groups);
    labels.colorGroups = std::move(own.groups);
    labels.colorGroupOf = std::move(own.groupOf);
    labels.warnings.insert(labels.warnings.end(), own.warnings.begin(), own.warnings.end());
}

BallLabels labelBalls(const Selections& selections, const BallSet& atoms,
                      const std::vector<GroupRule>& rules, const std::optional<GroupBy>& by)
{
    const Structure& structure = selections.structure();
    const std::vector<Ball>& balls = atoms.balls;
    const Placement& placement = atoms.placement;
    GroupNames names(structure, by.value_or(GroupBy()));
    BallLabels labels;
    if (!by && !rules.empty()) labelByRules(selections, atoms, rules, labels);
    std::map<std::string, std::int32_t> number; // of groups by name
    // Of chains by copy: the images of a unit's copies have their numbers.
    std::map<std::pair<int, std::int32_t>, std::int32_t> chainOf;
    labels.chainOf.resize(balls.size());
    labels.elementOf.resize(balls.size());
    labels.residueClassOf.resize(balls.size());
    if (by) labels.groupOf.assign(balls.size(), -1);
    for (std::size_t c = 0; c < placement.numbers.size(); ++c) {
        const int copy = placement.numbers[c];
        const std::string suffix = chainSuffix(copy);
        std::int32_t lastResidue = -1, lastGroup = -1;
        for (std::size_t i = placement.begin[c]; i < placement.begin[c + 1]; ++i) {
            const Atom& atom = structure.atoms[std::size_t(balls[i].atom)];
            const Residue& residue = structure.residues[std::size_t(atom.residue)];
            const std::string chainName = structure.chains[std::size_t(residue.chain)] + suffix;
            const auto [index, isNew] =
                chainOf.emplace(std::pair(copy, residue.chain), std::int32_t(labels.chains.size()));
            const std::int32_t place =
                (copy - 1) * std::int32_t(structure.chains.size()) + residue.chain;
            if (isNew) {
                labels.chains.push_back(chainName);
                labels.chainPlaces.push_back(place);
            }
            labels.chainOf[i] = index->second;
            labels.elementOf[i] = atom.element;
            labels.residueClassOf[i] = classOf(residue.name);
            if (by) {
                if (atom.residue != lastResidue || i == placement.begin[c]) {
                    const Group group = names.groupOf(residue, chainName, place, copy);
                    const auto added =
                        number.emplace(group.name, std::int32_t(labels.groups.size()));
                    if (added.second) labels.groups.push_back(group);
                    lastGroup = added.first->second;
                    lastResidue = atom.residue;
                }
                labels.groupOf[i] = lastGroup;
            }
        }
    }
    countBalls(atoms, labels.groupOf, labels.groups);
    for (const Group& group : labels.groups) {
        if (group.balls == 0) {
            labels.warnings.push_back("groups: no ball is left for " + group.name);
        }
    }
    return labels;
}

} // namespace molsurf
