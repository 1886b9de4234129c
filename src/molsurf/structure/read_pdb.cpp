// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/readers.h"

#include "molsurf/core/cancel.h"
#include "molsurf/structure/assembly_operators.h"
#include "molsurf/structure/atom_tree.h"
#include "molsurf/structure/element.h"
#include "molsurf/structure/guess_element.h"
#include "molsurf/structure/residue_bonds.h"
#include "molsurf/structure/residue_names.h"
#include "molsurf/structure/text_fields.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

namespace molsurf
{
namespace
{

using std::string_view;

/// The columns [first, first + size) of a line, counted from 0, without blanks around them.
string_view columns(string_view line, std::size_t first, std::size_t size)
{
    return first < line.size() ? trimmed(line.substr(first, size)) : string_view();
}

char column(string_view line, std::size_t at)
{
    return at < line.size() ? line[at] : ' ';
}

/// The element of columns 77-78; empty if columns 73-80 hold something else than segment, element
/// and charge, as the name of the entry and the number of the line before 1992 ("4AT1  83").
string_view elementIn(string_view line)
{
    constexpr std::size_t at = 76;
    if (line.size() <= at) return {};
    const char first = line[at], second = column(line, at + 1);
    const char digit = column(line, at + 2), sign = column(line, at + 3);
    const auto good = [](char c) { return c == ' ' || isLetter(c); };
    if (!good(first) || !good(second)) return {};
    const auto isSign = [](char c) { return c == '+' || c == '-'; };
    const bool charge = (digit == ' ' && sign == ' ') || (isDigit(digit) && isSign(sign)) ||
                        (isSign(digit) && isDigit(sign));
    if (!charge && (second == ' ' || isDigit(sign))) return {};
    return trimmed(line.substr(at, 2));
}

/// How the atoms of a file use columns that programs use in several ways.
struct Layout {
    bool fourLetters = false; ///< columns 18-21 are the name of a residue, column 22 is the chain
    bool placedNames = true;  ///< names begin in column 13 if their elements have two letters
};

/// Looks at all atoms before they are read.
class LayoutFinder
{
public:
    void add(string_view line)
    {
        ++atoms_;
        if (column(line, 20) != ' ') wide_.emplace(line.substr(17, 5));
        if (!layout_.placedNames || !isLetter(column(line, 12)) || column(line, 15) != ' ') return;
        if (!isLetter(column(line, 13)) && elementIn(line).empty()) layout_.placedNames = false;
    }

    /// Columns 18-21 are a name where they hold a known one, or where column 22 is blank. A file in
    /// which a known name is followed by two letters for the chain has such chains.
    Layout layout()
    {
        bool known = false, blank = false;
        for (const std::string& text : wide_) {
            const string_view four = trimmed(string_view(text).substr(0, 4));
            const string_view three = trimmed(string_view(text).substr(0, 3));
            if (three.size() < 3 || nameClass(four) == NameClass::Unknown) {
                const NameClass kind = nameClass(three);
                if (text[4] != ' ' && kind != NameClass::Unknown) return layout_;
                blank = blank || (text[4] == ' ' && three.size() == 3);
            } else {
                known = true;
            }
        }
        layout_.fourLetters = known || blank;
        return layout_;
    }

    std::size_t atoms() const { return atoms_; }

private:
    std::size_t atoms_ = 0;
    Layout layout_;
    std::set<std::string, std::less<>> wide_; ///< columns 18-22 of residues with a letter in 21
};

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
            const int lowered = std::tolower(static_cast<unsigned char>(c));
            if (!isDigit(c) && !isLetter(c)) return 0;
            number = base * number + (isDigit(c) ? c - '0' : lowered - 'a' + 10);
        }
        return number - firstOfLetters + firstNumber +
               (std::islower(static_cast<unsigned char>(field[0])) ? capitals : 0);
    }
    std::size_t digits = field[0] == '-';
    while (digits < field.size() && isDigit(field[digits])) ++digits;
    parseInteger(field.substr(0, digits), number);
    return number;
}

int modelNumber(string_view line, int previous)
{
    const Fields fields = splitFields(line);
    int number = previous + 1;
    if (fields.size() > 1) parseInteger(fields[1], number);
    return number;
}

/// Reads the records of a PDB or PDBQT file.
class PdbReader
{
public:
    PdbReader(const std::string& path, bool autoDock) : path_(path), autoDock_(autoDock) {}

    Structure read(const std::string& text, const Progress& progress)
    {
        LayoutFinder finder;
        // CONECT comes first, too: names are kept of those atoms alone that a bond asks for.
        for (LineReader lines(text); lines.next();) {
            if (isAtomRecord(lines.line()))
                finder.add(lines.line());
            else if (lines.line().substr(0, 6) == "CONECT")
                connect(lines.line());
        }
        layout_ = finder.layout();
        constexpr std::size_t shortest = 54; // of the line of an atom
        tree_.reserve(std::min(finder.atoms(), text.size() / shortest + 1));
        stopIfCancelled(progress);
        for (LineReader lines(text); lines.next();) record(lines);
        stopIfCancelled(progress);
        Structure out = tree_.finish();
        out.assemblies = parseRemark350(remarks_);
        auto ncs = parseMtrix(matrices_, out.warnings);
        if (ncs) out.assemblies.push_back(std::move(*ncs));
        out.bonds = bonds();
        if (autoDock_ && charges_.size() == out.atoms.size()) out.charges = std::move(charges_);
        return out;
    }

private:
    /// Counts the bonds of a record CONECT, an atom and up to four that it is bonded to, for each
    /// direction. Some programs give a double bond twice.
    void connect(string_view line)
    {
        constexpr std::size_t first = 6, width = 5, most = 4;
        int from = 0;
        if (!parseInteger(columns(line, first, width), from)) return;
        for (std::size_t n = 1; n <= most; ++n) {
            int to = 0;
            if (!parseInteger(columns(line, first + n * width, width), to) || to == from) continue;
            ++connected_[{std::min(from, to), std::max(from, to)}][from < to];
            ends_[from] = ends_[to] = std::nullopt;
        }
    }

    std::shared_ptr<const FileBonds> bonds() const
    {
        const auto all = std::make_shared<FileBonds>();
        for (const auto& [pair, times] : connected_) {
            const auto &a = ends_.at(pair.first), &b = ends_.at(pair.second);
            if (!a || !b) continue;
            const int most = std::max(times[0], times[1]);
            const BondOrder order = most == 2   ? BondOrder::Double
                                    : most == 3 ? BondOrder::Triple
                                                : BondOrder::Single;
            all->links.push_back({*a, *b, order});
        }
        return all->links.empty() ? nullptr : all;
    }

    void record(const LineReader& lines)
    {
        const string_view line = lines.line();
        const string_view name = line.substr(0, 6);
        if (isAtomRecord(line)) {
            if (!inModel_) tree_.startModel(last_ = next_);
            inModel_ = true;
            atom(lines);
        } else if (name.substr(0, 5) == "MODEL") {
            next_ = modelNumber(line, last_);
            inModel_ = false;
        } else if (name == "ENDMDL" || trimmed(name) == "END") {
            if (inModel_) next_ = last_ + 1;
            inModel_ = false;
        } else if (line.substr(0, 10) == "REMARK 350") {
            remarks_.push_back(line);
        } else if (line.substr(0, 5) == "MTRIX") {
            matrices_.push_back(line);
        } else {
            refuseMisspeltAtom(path_, lines);
        }
    }

    void atom(const LineReader& lines)
    {
        const string_view line = lines.line();
        AtomLine atom;
        atom.position = position(lines);
        const bool four = layout_.fourLetters;
        atom.chain = four ? columns(line, 21, 1) : columns(line, 20, 2);
        atom.residue = columns(line, 17, four ? 4 : 3);
        atom.name = columns(line, 12, 4);
        atom.segment = segment(line);
        atom.number = residueNumber(columns(line, 22, 4));
        parseInteger(columns(line, 6, 5), atom.serial);
        atom.insertionCode = column(line, 26);
        atom.hetatm = line[0] == 'H';
        atom.altloc = column(line, 16) == ' ' ? '\0' : line[16];
        double value = 0.0;
        if (parseNumber(columns(line, 54, 6), value)) atom.occupancy = float(value);
        if (parseNumber(columns(line, 60, 6), value)) atom.bFactor = float(value);
        if (autoDock_)
            autoDockType(line, atom);
        else
            element(line, atom);
        const auto end = ends_.find(atom.serial);
        if (end != ends_.end() && !end->second)
            end->second = {std::string(atom.chain), atom.number, atom.insertionCode,
                           std::string(atom.name)};
        tree_.add(atom);
    }

    /// Columns 73-76, but for those of AutoDock, which are of the charge, and for the name of the
    /// entry, before 1992.
    string_view segment(string_view line) const
    {
        const bool old = elementIn(line).empty() && !columns(line, 76, 4).empty();
        return autoDock_ || old ? string_view() : columns(line, 72, 4);
    }

    openvdb::Vec3d position(const LineReader& lines) const
    {
        constexpr std::size_t first = 30, width = 8;
        openvdb::Vec3d out;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t begin = first + axis * width;
            const string_view field = columns(lines.line(), begin, width);
            double value = 0;
            if (!parseNumber(field, value))
                failAtLine(path_, lines,
                           std::string(1, "xyz"[axis]) + ": expected a number in columns " +
                               std::to_string(begin + 1) + "-" + std::to_string(begin + width) +
                               ", got " + inQuotes(field) + " in the line " +
                               inQuotes(lines.line()));
            out[int(axis)] = value;
        }
        return out;
    }

    void element(string_view line, AtomLine& atom) const
    {
        const string_view symbol = elementIn(line);
        atom.inFirstColumn =
            layout_.placedNames && isLetter(column(line, 12)) && atom.name.size() < 4;
        if (symbol.empty()) return;
        atom.element = elementNumber(std::string(symbol));
        if (atom.element == 0 && isParticleSymbol(symbol)) atom.role = AtomRole::Particle;
        if (isMisread(std::uint8_t(atom.element), atom.name, atom.residue)) atom.element = 0;
    }

    void autoDockType(string_view line, AtomLine& atom)
    {
        const string_view type = columns(line, 77, 4);
        atom.element = elementOfAutoDockType(type);
        const std::uint8_t ion = ionElement(atom.residue);
        if (ion != 0 && ion == elementNumber(std::string(type))) atom.element = ion; // NA of NA
        if (isAutoDockParticle(type)) {
            atom.element = 0;
            atom.role = AtomRole::Particle;
        }
        double charge = 0.0;
        if (parseNumber(columns(line, 70, 6), charge)) charges_.push_back(float(charge));
    }

    /// Types of the glue of rings that are open, of hydrating water and of a zinc's fourth ligand.
    static bool isAutoDockParticle(string_view type)
    {
        return type == "W" || type == "TZ" || type == "Z" || type == "J" || type == "Q" ||
               type == "GA" || (type.size() == 2 && type[0] == 'G' && isDigit(type[1]));
    }

    const std::string& path_;
    bool autoDock_;
    Layout layout_;
    AtomTree tree_;
    std::vector<string_view> remarks_, matrices_;
    std::vector<float> charges_;
    /// By numbers of atoms: how often a bond is given from either end, and the atoms, once known.
    std::map<std::pair<int, int>, std::array<int, 2>> connected_;
    std::unordered_map<int, std::optional<FileBonds::End>> ends_;
    int next_ = 1, last_ = 0; ///< numbers of the model that the next atom starts, and of the last
    bool inModel_ = false;
};

} // namespace

Structure readPdb(std::string text, const std::string& path, const Progress& progress)
{
    return PdbReader(path, false).read(text, progress);
}

Structure readPdbqt(std::string text, const std::string& path, const Progress& progress)
{
    return PdbReader(path, true).read(text, progress);
}

} // namespace molsurf
