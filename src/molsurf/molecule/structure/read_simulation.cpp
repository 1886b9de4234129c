// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/readers.h"

#include "molsurf/molecule/structure/atom_tree.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <cctype>
#include <map>

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

/// The sections of a topology of Amber, each a list of fields of one width.
class Parm7Sections
{
public:
    Parm7Sections(const std::string& text, const std::string& path) : path_(path)
    {
        LineReader lines(text);
        Section* section = nullptr;
        while (lines.next()) {
            const string_view line = lines.line();
            if (line.substr(0, 5) == "%FLAG") {
                section = &sections_[std::string(trimmed(line.substr(5)))];
            } else if (section && line.substr(0, 7) == "%FORMAT") {
                section->width = widthIn(line, lines);
            } else if (section && section->width > 0 && line.substr(0, 1) != "%") {
                for (std::size_t at = 0; at < line.size(); at += section->width)
                    section->fields.push_back(line.substr(at, section->width));
            }
        }
    }

    bool has(const std::string& name) const { return sections_.count(name) > 0; }

    /// A section's fields, of which there are at least `count`.
    const std::vector<string_view>& fields(const std::string& name, std::size_t count) const
    {
        const auto found = sections_.find(name);
        const std::size_t size = found == sections_.end() ? 0 : found->second.fields.size();
        if (size < count)
            failAt(path_, "expected " + std::to_string(count) + " fields of " + name + ", got " +
                              std::to_string(size));
        return found->second.fields;
    }

    /// The numbers of a section, at least `count`.
    std::vector<double> numbers(const std::string& name, std::size_t count) const
    {
        std::vector<double> out;
        for (const string_view field : fields(name, count)) {
            double& value = out.emplace_back();
            if (!parseNumber(trimmed(field), value))
                failAt(path_, "expected numbers in " + name + ", got " + inQuotes(field));
        }
        return out;
    }

private:
    struct Section {
        std::size_t width = 0;
        std::vector<string_view> fields;
    };

    /// The width in "%FORMAT(20a4)", "%FORMAT(5E16.8)" or "%FORMAT(10I8)".
    std::size_t widthIn(string_view line, const LineReader& lines) const
    {
        int width = 0;
        const std::size_t letter = line.find_first_of("aAEI", line.find('('));
        const std::size_t end = line.find_first_of(".)", letter);
        if (letter == string_view::npos || end == string_view::npos ||
            !parseInteger(line.substr(letter + 1, end - letter - 1), width) || width <= 0)
            failAtLine(path_, lines, "expected a format as (20a4), got " + inQuotes(line));
        return std::size_t(width);
    }

    std::string path_;
    std::map<std::string, Section> sections_;
};

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

Structure readParm7(const std::string& text, const std::string& path)
{
    constexpr double perElementaryCharge = 18.2223; // Amber's unit, so that q q / r is in kcal/mol
    const Parm7Sections sections(text, path);
    const std::vector<double> pointers = sections.numbers("POINTERS", 12);
    const double atoms = pointers[0], residues = pointers[11];
    if (!(atoms >= 1.0 && residues >= 1.0 && std::max(atoms, residues) < 1e9))
        failAt(path, "expected the numbers of atoms and residues in POINTERS");
    const auto count = std::size_t(atoms), parts = std::size_t(residues);
    const std::vector<string_view>& names = sections.fields("ATOM_NAME", count);
    const std::vector<string_view>& labels = sections.fields("RESIDUE_LABEL", parts);
    const std::vector<double> begins = sections.numbers("RESIDUE_POINTER", parts),
                              masses = sections.numbers("MASS", count),
                              units = sections.numbers("CHARGE", count);
    std::vector<double> elements;
    if (sections.has("ATOMIC_NUMBER")) elements = sections.numbers("ATOMIC_NUMBER", count);
    AtomTree tree;
    std::vector<float> charges;
    std::size_t residue = 0;
    for (std::size_t i = 0; i < count; ++i) {
        while (residue + 1 < parts && begins[residue + 1] <= double(i + 1)) ++residue;
        AtomLine atom;
        atom.name = trimmed(names[i]);
        atom.residue = trimmed(labels[residue]);
        atom.number = int(residue + 1);
        atom.serial = int(i + 1);
        atom.mass = masses[i];
        if (!elements.empty() && elements[i] > 0.0 && elements[i] < 119.0)
            atom.element = int(elements[i]);
        const bool isPoint = elements.empty() ? masses[i] < 0.5 : elements[i] <= 0.0;
        if (isPoint) atom.role = AtomRole::Particle;
        charges.push_back(float(units[i] / perElementaryCharge));
        tree.add(atom);
    }
    Structure out = tree.finish(false);
    out.charges = std::move(charges);
    return out;
}

} // namespace molsurf
