// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/readers.h"

#include "molsurf/molecule/structure/atom_tree.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <cctype>

namespace molsurf
{
namespace
{

using std::string_view;

constexpr std::size_t groFirst = 20; ///< column of a .gro file where the coordinates begin

/// The width of the columns of coordinates in a line: the distance of two decimal points.
std::size_t groWidth(const LineReader& lines, const std::string& path)
{
    const string_view line = lines.line();
    const std::size_t first = line.find('.', groFirst);
    const std::size_t second = first == string_view::npos ? first : line.find('.', first + 1);
    if (second == string_view::npos)
        failAtLine(path, lines,
                   "expected residue, atom and coordinates in the columns of a .gro file, got " +
                       inQuotes(line));
    return second - first;
}

AtomLine groAtom(const LineReader& lines, std::size_t width, const std::string& path)
{
    const string_view line = lines.line();
    AtomLine atom;
    const string_view number = trimmed(line.substr(0, std::min<std::size_t>(5, line.size())));
    if (!parseInteger(number, atom.number))
        failAtLine(path, lines,
                   "expected a residue number in columns 1-5, got " + inQuotes(number) +
                       " in the line " + inQuotes(line));
    const auto column = [&](std::size_t begin, std::size_t size) {
        return begin < line.size() ? trimmed(line.substr(begin, size)) : string_view();
    };
    atom.residue = column(5, 5);
    atom.name = column(10, 5);
    parseInteger(column(15, 5), atom.serial);
    constexpr double perNanometre = 10.0; // [Å]
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t begin = groFirst + axis * width;
        double value = 0.0;
        if (!parseNumber(column(begin, width), value))
            failAtLine(path, lines,
                       std::string(1, "xyz"[axis]) + ": expected a number in columns " +
                           std::to_string(begin + 1) + "-" + std::to_string(begin + width) +
                           ", got " + inQuotes(column(begin, width)) + " in the line " +
                           inQuotes(line));
        atom.position[int(axis)] = perNanometre * value;
    }
    return atom;
}

[[noreturn]] void failShort(const std::string& path, const LineReader& lines,
                            const std::string& expected)
{
    failAt(path,
           "is cut short after line " + std::to_string(lines.number()) + ": expected " + expected);
}

/// Whether a line has three numbers or more. Large ones are glued: "40000.0000040000.00000".
bool isGroBox(string_view line)
{
    const auto points = std::count(line.begin(), line.end(), '.');
    const bool numbers = line.find_first_not_of("0123456789.+-eE \t") == string_view::npos;
    return numbers && (points >= 3 || splitFields(line).size() >= 3);
}

/// Reads a frame whose title is the current line.
void readGroFrame(LineReader& lines, const std::string& path, AtomTree& tree)
{
    int count = 0;
    if (!lines.next()) failShort(path, lines, "the number of atoms");
    if (!parseInteger(trimmed(lines.line()), count) || count < 0)
        failAtLine(path, lines, "expected the number of atoms, got " + inQuotes(lines.line()));
    std::size_t width = 0;
    for (int i = 0; i < count; ++i) {
        if (!lines.next())
            failShort(path, lines,
                      "atom " + std::to_string(i + 1) + " of " + std::to_string(count));
        if (i == 0) width = groWidth(lines, path);
        tree.add(groAtom(lines, width, path));
    }
    if (!lines.next()) failShort(path, lines, "the box");
    if (!isGroBox(lines.line()))
        failAtLine(path, lines,
                   "expected the box after " + std::to_string(count) + " atoms, got " +
                       inQuotes(lines.line()));
}

AtomLine psfAtom(const LineReader& lines, const std::string& path)
{
    enum Column { Serial, Segment, Number, Residue, Name, Type, Charge, Mass, Count };
    Fields fields = splitFields(lines.line());
    AtomLine atom;
    double mass = 0.0;
    const bool nameless = fields.size() > 2 && parseInteger(fields[1], atom.number) &&
                          !parseInteger(fields[2], atom.number);
    if (nameless) fields.insert(fields.begin() + Segment, string_view());
    if (fields.size() < Count || !parseNumber(fields[Mass], mass))
        failAtLine(path, lines,
                   "expected number, segment, residue number, residue, atom, type, charge and "
                   "mass, got " +
                       inQuotes(lines.line()));
    string_view number = fields[Number];
    if (number.size() > 1 && std::isalpha(static_cast<unsigned char>(number.back()))) {
        atom.insertionCode = number.back();
        number.remove_suffix(1);
    }
    if (!parseInteger(number, atom.number))
        failAtLine(path, lines, "expected a residue number, got " + inQuotes(fields[Number]));
    atom.chain = atom.segment = fields[Segment];
    atom.residue = fields[Residue];
    atom.name = fields[Name];
    parseInteger(fields[Serial], atom.serial);
    constexpr double lightest = 0.5; // [u]: lone pairs have none, Drude particles 0.4
    if (mass < lightest) atom.role = AtomRole::Particle;
    atom.mass = mass;
    return atom;
}

} // namespace

Structure readGro(const std::string& text, const std::string& path)
{
    AtomTree tree;
    LineReader lines(text);
    for (int model = 1; lines.next(); ++model) {
        if (model > 1 && trimmed(lines.line()).empty()) continue; // blank lines at the end
        tree.startModel(model);
        readGroFrame(lines, path, tree);
    }
    return tree.finish();
}

Structure readPsf(const std::string& text, const std::string& path)
{
    AtomTree tree;
    LineReader lines(text);
    bool found = false;
    int count = 0;
    while (!found && lines.next()) {
        found = lines.line().find("!NATOM") != string_view::npos;
        if (found && (!parseInteger(splitFields(lines.line())[0], count) || count < 0))
            failAtLine(path, lines, "expected the number of atoms, got " + inQuotes(lines.line()));
    }
    if (!found) failShort(path, lines, "the section !NATOM");
    for (int i = 0; i < count; ++i) {
        if (!lines.next())
            failShort(path, lines,
                      "atom " + std::to_string(i + 1) + " of " + std::to_string(count));
        tree.add(psfAtom(lines, path));
    }
    return tree.finish(false);
}

} // namespace molsurf
