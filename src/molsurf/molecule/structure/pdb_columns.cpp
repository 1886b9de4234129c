// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/pdb_columns.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/element.h"
#include "molsurf/molecule/structure/guess_element.h"
#include "molsurf/molecule/structure/residue_names.h"

#include <algorithm>
#include <cctype>

namespace molsurf
{
namespace
{

using std::string_view;

char column(string_view line, std::size_t at)
{
    return at < line.size() ? line[at] : ' ';
}

/// The element of columns 77-78, or 78-79 where a program writes them one column late; empty if
/// columns 73-80 hold something else than segment, element and charge, as the name of the entry and
/// the number of the line before 1992 ("4AT1  83").
string_view elementIn(string_view line)
{
    constexpr std::size_t at = 76;
    if (line.size() <= at) return {};
    const char first = line[at], second = column(line, at + 1);
    const char digit = column(line, at + 2), sign = column(line, at + 3);
    if (first == ' ' && isLetter(second) && isLetter(digit)) return line.substr(at + 1, 2);
    const auto good = [](char c) { return c == ' ' || isLetter(c); };
    if (!good(first) || !good(second)) return {};
    const auto isSign = [](char c) { return c == '+' || c == '-'; };
    const bool charge = (digit == ' ' && sign == ' ') || (isDigit(digit) && isSign(sign)) ||
                        (isSign(digit) && isDigit(sign));
    if (!charge && (second == ' ' || isDigit(sign))) return {};
    return trimmed(line.substr(at, 2));
}

/// The symbol of an element that begins in column 75 or 76 and fits the name of its atom; empty if
/// something else stands there. (Segments begin in column 73.)
string_view strayElement(string_view line)
{
    constexpr std::size_t segment = 72, first = 74;
    if (!columns(line, segment, first - segment).empty()) return {};
    const string_view word = columns(line, first, 4);
    const std::size_t letters =
        std::size_t(std::find_if_not(word.begin(), word.end(), isLetter) - word.begin());
    const string_view symbol = word.substr(0, letters);
    if (elementNumber(std::string(symbol)) == 0) return {};
    string_view name = columns(line, 12, 4);
    while (!name.empty() && isDigit(name[0])) name.remove_prefix(1); // 1HB
    const bool fits = lowered(std::string(name.substr(0, letters))) == lowered(std::string(symbol));
    return fits ? symbol : string_view();
}

/// Columns 73-76, but for the name of the entry before 1992.
string_view segmentIn(string_view line)
{
    const bool old = elementIn(line).empty() && !columns(line, 76, 4).empty();
    return old ? string_view() : columns(line, 72, 4);
}

/// Whether column 17 can be the fourth letter of a name that begins in column 14, as " CL12" of
/// DOCK 3.5 and " H5'1" of Insight, of an atom that is there as a whole.
bool mayReachColumn17(string_view line)
{
    double occupancy = 1.0;
    parseNumber(columns(line, 54, 6), occupancy);
    return column(line, 12) == ' ' && columns(line, 13, 3).size() == 3 &&
           (occupancy <= 0.0 || occupancy >= 1.0);
}

/// A number of a residue. Hybrid-36 counts on from 9999 in base 36: A000 (firstOfLetters) is 10000,
/// and behind ZZZZ comes a000.
int residueNumber(string_view field)
{
    int number = 0;
    if (parseInteger(field, number) || field.empty()) return number;
    if (field.size() == 4 && isLetter(field[0])) {
        constexpr int base = 36, firstOfLetters = 466560, firstNumber = 10000;
        constexpr int capitals = 26 * base * base * base; // from A000 to ZZZZ
        for (const char c : field) {
            const int lower = std::tolower(static_cast<unsigned char>(c));
            if (!isDigit(c) && !isLetter(c)) return 0;
            number = base * number + (isDigit(c) ? c - '0' : lower - 'a' + 10);
        }
        return number - firstOfLetters + firstNumber +
               (std::islower(static_cast<unsigned char>(field[0])) ? capitals : 0);
    }
    std::size_t digits = field[0] == '-';
    while (digits < field.size() && isDigit(field[digits])) ++digits;
    parseInteger(field.substr(0, digits), number);
    return number;
}

/// Columns 23-26 and the insertion code. CHARMM writes a fifth digit in the column of the code.
void readNumber(string_view line, AtomLine& atom)
{
    constexpr std::size_t first = 22, width = 4;
    const string_view field = columns(line, first, width);
    const char code = column(line, first + width);
    const bool five =
        field.size() == width && std::all_of(field.begin(), field.end(), isDigit) && isDigit(code);
    atom.number = residueNumber(five ? columns(line, first, width + 1) : field);
    if (!five) atom.insertionCode = code;
}

void readElement(string_view line, const PdbLayout& layout, AtomLine& atom)
{
    const string_view stray = layout.strayElements ? strayElement(line) : string_view();
    const string_view symbol = stray.empty() ? elementIn(line) : stray;
    atom.inFirstColumn = layout.placedNames && isLetter(column(line, 12)) && atom.name.size() < 4;
    if (symbol.empty()) return;
    atom.element = elementNumber(std::string(symbol));
    if (atom.element == 0 && isParticleSymbol(symbol)) atom.role = AtomRole::Particle;
}

} // namespace

string_view columns(string_view line, std::size_t first, std::size_t size)
{
    return first < line.size() ? trimmed(line.substr(first, size)) : string_view();
}

void PdbLayoutFinder::add(string_view line)
{
    ++atoms_;
    if (column(line, 20) != ' ') residueFields_.emplace(line.substr(17, 5));
    const bool placed = !isLetter(column(line, 12)) || column(line, 15) != ' ' ||
                        isLetter(column(line, 13)) || !elementIn(line).empty();
    placedNames_ = placedNames_ && placed;
    const char label = column(line, 16);
    alternates_ = alternates_ || (label != ' ' && !mayReachColumn17(line));
    wideNames_ = wideNames_ || string_view(" ABC").find(label) == string_view::npos;
    if (columns(line, 72, 4).empty()) return;
    (strayElement(line).empty() ? segments_ : strayElements_) = true;
}

/// Columns 18-21 are a name where they hold a known one, or where column 22 is blank. A file in
/// which a known name is followed by two letters for the chain has such chains.
bool PdbLayoutFinder::hasFourLetters() const
{
    bool known = false, blank = false;
    for (const std::string& text : residueFields_) {
        const string_view four = trimmed(string_view(text).substr(0, 4));
        const string_view three = trimmed(string_view(text).substr(0, 3));
        if (three.size() < 3 || nameClass(four) == NameClass::Unknown) {
            const NameClass kind = nameClass(three);
            if (text[4] != ' ' && kind != NameClass::Unknown) return false;
            blank = blank || (text[4] == ' ' && three.size() == 3);
        } else {
            known = true;
        }
    }
    return known || blank;
}

PdbLayout PdbLayoutFinder::layout() const
{
    PdbLayout out;
    out.fourLetters = hasFourLetters();
    out.placedNames = placedNames_;
    out.wideNames = wideNames_ && !alternates_;
    out.strayElements = strayElements_ && !segments_;
    return out;
}

AtomLine atomInColumns(string_view line, const PdbLayout& layout)
{
    AtomLine atom;
    const bool four = layout.fourLetters;
    atom.chain = four ? columns(line, 21, 1) : columns(line, 20, 2);
    atom.residue = columns(line, 17, four ? 4 : 3);
    atom.name = columns(line, 12, layout.wideNames ? 5 : 4);
    atom.altloc = layout.wideNames || column(line, 16) == ' ' ? '\0' : line[16];
    atom.hetatm = line[0] == 'H';
    readNumber(line, atom);
    parseInteger(columns(line, 6, 5), atom.serial);
    if (!layout.autoDock && !layout.strayElements) atom.segment = segmentIn(line);
    if (atom.chain.empty()) atom.chain = atom.segment; // HADDOCK, CNS, X-PLOR, NAMD
    double value = 0.0;
    if (parseNumber(columns(line, 54, 6), value)) atom.occupancy = float(value);
    if (parseNumber(columns(line, 60, 6), value)) atom.bFactor = float(value);
    if (!layout.autoDock) readElement(line, layout, atom);
    return atom;
}

openvdb::Vec3d placeInColumns(const std::string& path, const LineReader& lines)
{
    constexpr std::size_t first = 30, width = 8;
    openvdb::Vec3d out;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t begin = first + axis * width;
        const string_view field = columns(lines.line(), begin, width);
        double value = 0;
        if (!parseNumber(field, value))
            failAtLine(path, lines,
                       std::string(1, "xyz"[axis]) + ": expected a number in columns " +
                           std::to_string(begin + 1) + "-" + std::to_string(begin + width) +
                           ", got " + inQuotes(field) + " in the line " + inQuotes(lines.line()));
        out[int(axis)] = value;
    }
    return out;
}

} // namespace molsurf
