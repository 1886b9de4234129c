// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/readers.h"

#include "molsurf/molecule/structure/atom_tree.h"
#include "molsurf/molecule/structure/element.h"
#include "molsurf/molecule/structure/guess_element.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <map>

namespace molsurf
{
namespace
{

using std::string_view;

/// Where a line has the element and the coordinates.
struct XyzColumns {
    std::size_t species = 0, position = 1;
};

/// Reads "Properties=species:S:1:pos:R:3" of a comment: names, types and numbers of columns.
XyzColumns columnsOf(string_view comment)
{
    constexpr string_view key = "Properties=";
    XyzColumns out;
    const std::size_t at = comment.find(key);
    if (at == string_view::npos) return out;
    string_view list = comment.substr(at + key.size());
    if (!list.empty() && list[0] == '"') list.remove_prefix(1);
    list = list.substr(0, list.find_first_of(" \t\""));
    std::vector<string_view> words;
    for (std::size_t end = 0; end != string_view::npos; list.remove_prefix(end + 1)) {
        end = list.find(':');
        words.push_back(list.substr(0, end));
        if (end == string_view::npos) break;
    }
    std::size_t column = 0;
    for (std::size_t i = 0; i + 2 < words.size(); i += 3) {
        int width = 1;
        if (!parseInteger(words[i + 2], width) || width < 1) return XyzColumns();
        if (words[i] == "species" || words[i] == "element") out.species = column;
        if (words[i] == "pos") out.position = column;
        column += std::size_t(width);
    }
    return out;
}

/// The letters at the beginning of a word.
string_view lettersAtBegin(string_view word)
{
    std::size_t end = 0;
    while (end < word.size() && isLetter(word[end])) ++end;
    return word.substr(0, end);
}

/// "C", "CL", "c", "C12", "6": the atomic number, or 0.
int elementOfSpecies(string_view species)
{
    int number = 0;
    if (parseInteger(species, number)) return number >= 0 && number <= maxElement ? number : 0;
    return elementNumber(std::string(lettersAtBegin(species)));
}

/// Whether the atoms are given by their names, as MDTraj writes them: then CA is no calcium. Some
/// of the names, as CB or OG1, are no symbols.
bool hasNames(const std::string& text)
{
    Fields fields;
    for (LineReader lines(text); lines.next();) {
        splitFields(lines.line(), fields);
        double number = 0.0;
        if (fields.size() < 4 || !parseNumber(fields[1], number) || !parseNumber(fields[3], number))
            continue;
        const string_view letters = lettersAtBegin(fields[0]);
        const int element = elementOfSpecies(fields[0]);
        if (letters.size() > 1 && !isParticleSymbol(letters) && element == 0 &&
            elementOfSpecies(letters.substr(0, 1)) != 0)
            return true;
    }
    return false;
}

/// Reads a frame whose number of atoms is the current line.
void readFrame(LineReader& lines, const std::string& path, int count, bool names, AtomTree& tree)
{
    const auto next = [&](const std::string& expected) {
        if (!lines.next())
            failAt(path, "is cut short after line " + std::to_string(lines.number()) +
                             ": expected " + expected);
    };
    next("a comment");
    const XyzColumns columns = columnsOf(lines.line());
    std::map<int, int> serials; // atoms of each element
    Fields fields;
    for (int i = 0; i < count; ++i) {
        next("atom " + std::to_string(i + 1) + " of " + std::to_string(count));
        splitFields(lines.line(), fields);
        openvdb::Vec3d position;
        bool good = fields.size() > columns.species && fields.size() >= columns.position + 3;
        for (std::size_t axis = 0; good && axis < 3; ++axis) {
            double value = 0.0;
            good = parseNumber(fields[columns.position + axis], value);
            position[int(axis)] = value;
        }
        if (!good)
            failAtLine(path, lines, "expected element, x, y and z, got " + inQuotes(lines.line()));
        AtomLine atom = unknownLigandAtom(position);
        const string_view species = fields[columns.species];
        if (!names) atom.element = elementOfSpecies(species);
        if (!names && isParticleSymbol(lettersAtBegin(species))) atom.role = AtomRole::Particle;
        atom.guess = names;
        const char* const symbol = elementSymbol(std::uint8_t(atom.element));
        const std::string name =
            names ? std::string(species) : symbol + std::to_string(++serials[atom.element]);
        atom.name = name;
        tree.add(atom);
    }
}

} // namespace

Structure readXyz(const std::string& text, const std::string& path)
{
    AtomTree tree;
    const bool names = hasNames(text);
    LineReader lines(text);
    for (int model = 1; lines.next();) {
        const string_view line = trimmed(lines.line());
        if (line.empty()) continue; // between frames and at the end
        int count = 0;
        if (!parseInteger(line, count) || count < 0)
            failAtLine(path, lines, "expected the number of atoms, got " + inQuotes(line));
        tree.startModel(model++);
        readFrame(lines, path, count, names, tree);
    }
    return tree.finish();
}

} // namespace molsurf
