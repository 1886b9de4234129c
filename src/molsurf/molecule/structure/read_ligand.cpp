// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/readers.h"

#include "molsurf/molecule/structure/atom_tree.h"
#include "molsurf/molecule/structure/element.h"
#include "molsurf/molecule/structure/guess_element.h"
#include "molsurf/molecule/structure/residue_bonds.h"
#include "molsurf/molecule/structure/residue_names.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <memory>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace molsurf
{
namespace
{

using std::string_view;

/// The order that a file writes so, of a bond that is no other one.
BondOrder orderOf(string_view type)
{
    if (type == "2") return BondOrder::Double;
    if (type == "3") return BondOrder::Triple;
    return type == "4" || type == "ar" ? BondOrder::Aromatic : BondOrder::Single;
}

/// The bonds of a file of molecules: those of all if they are the same, as of conformers, and if
/// the names of atoms differ; else none.
class MoleculeBonds
{
public:
    void startMolecule()
    {
        endMolecule();
        ends_.clear();
        names_.clear();
        own_.clear();
    }

    /// @param[in] id  of the atom in its molecule
    void add(const std::string& id, const FileBonds::End& end)
    {
        if (usable_) usable_ = names_.insert(end).second && ends_.emplace(id, end).second;
    }

    void join(string_view a, string_view b, BondOrder order)
    {
        if (!usable_) return;
        const auto first = ends_.find(std::string(a)), second = ends_.find(std::string(b));
        if (first == ends_.end() || second == ends_.end()) return;
        own_.emplace_back(first->second, second->second, order);
    }

    /// Null: there are none.
    std::shared_ptr<const FileBonds> finish()
    {
        endMolecule();
        if (!usable_ || all_.empty()) return nullptr;
        auto out = std::make_shared<FileBonds>();
        for (const auto& [a, b, order] : all_) out->links.push_back({a, b, order});
        return out;
    }

private:
    void endMolecule()
    {
        if (ends_.empty()) return;
        if (count_++ == 0)
            all_ = own_;
        else
            usable_ = usable_ && !(all_ < own_) && !(own_ < all_);
    }

    using Link = std::tuple<FileBonds::End, FileBonds::End, BondOrder>;
    std::map<std::string, FileBonds::End> ends_; ///< of the molecule, by id
    std::set<FileBonds::End> names_;
    std::vector<Link> own_, all_; ///< of the molecule, and of the first one
    std::size_t count_ = 0;
    bool usable_ = true;
};

/// Reads the molecules of an .sdf file, one after the other.
class SdfReader
{
public:
    SdfReader(const std::string& text, const std::string& path) : lines_(text), path_(path) {}

    Structure read()
    {
        for (int model = 1; lines_.next(); ++model) {
            if (model > 1 && restIsBlank()) break;
            tree_.startModel(model);
            readMolecule();
            while (trimmed(lines_.line()) != "$$$$" && lines_.next()) {
            }
        }
        Structure out = tree_.finish();
        out.bonds = bonds_.finish();
        const auto isDrawn = [](const Model& m) { return !m.problem.empty(); };
        if (!out.models.empty() && std::all_of(out.models.begin(), out.models.end(), isDrawn))
            failAt(path_, out.models[0].problem);
        return out;
    }

private:
    /// Whether nothing but blank lines is left. Goes on to the next line that is not.
    bool restIsBlank()
    {
        LineReader ahead = lines_;
        do {
            if (!trimmed(ahead.line()).empty()) return false;
        } while (ahead.next());
        return true;
    }

    void next(const char* expected)
    {
        if (!lines_.next())
            failAt(path_, "is cut short after line " + std::to_string(lines_.number()) +
                              ": expected " + expected);
    }

    [[noreturn]] void fail(const std::string& expected) const
    {
        failAtLine(path_, lines_, "expected " + expected + ", got " + inQuotes(lines_.line()));
    }

    /// Reads from the title, which is the current line, to the last atom.
    void readMolecule()
    {
        serials_.clear();
        bonds_.startMolecule();
        atoms_ = 0;
        next("the line of the program");
        drawn_ = lines_.line().size() >= 22 && lines_.line().substr(20, 2) == "2D";
        next("the comment");
        next("the numbers of atoms and bonds");
        const std::string counts(lines_.line());
        const std::size_t line = lines_.number();
        flat_ = true;
        if (counts.find("V3000") != std::string::npos) {
            readV3000();
        } else {
            int atoms = 0;
            if (!parseInteger(trimmed(string_view(counts).substr(0, 3)), atoms) || atoms < 0)
                fail("the number of atoms in columns 1-3");
            for (int i = 0; i < atoms; ++i) {
                next("an atom");
                readV2000Atom();
            }
            readV2000Bonds(counts);
        }
        if (drawn_ && flat_ && atoms_ > 1)
            tree_.spoil("line " + std::to_string(line) +
                        ": the molecule is drawn in two dimensions, expected three [hint: "
                        "Open Babel (gen3d) and RDKit (EmbedMolecule) make conformers]");
    }

    void readV2000Atom()
    {
        const string_view line = lines_.line();
        constexpr std::size_t width = 10, symbol = 31;
        openvdb::Vec3d position;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double value = 0.0;
            const std::size_t begin = std::min(axis * width, line.size());
            if (!parseNumber(trimmed(line.substr(begin, width)), value))
                fail(std::string(1, "xyz"[axis]) + " in columns " + std::to_string(begin + 1) +
                     "-" + std::to_string(begin + width));
            position[int(axis)] = value;
        }
        if (line.size() <= symbol) fail("the symbol of an element in columns 32-34");
        add(trimmed(line.substr(symbol, 3)), position, std::to_string(atoms_ + 1));
    }

    /// Reads the bonds up to the first line that is none.
    /// @param[in] counts  the line of the numbers of atoms and bonds
    void readV2000Bonds(const std::string& counts)
    {
        constexpr std::size_t width = 3; // of two atoms and the type
        int bonds = 0;
        if (counts.size() < 2 * width ||
            !parseInteger(trimmed(string_view(counts).substr(width, width)), bonds))
            return;
        for (int i = 0; i < bonds && lines_.next(); ++i) {
            const string_view line = lines_.line();
            if (line.size() < 3 * width) return;
            bonds_.join(trimmed(line.substr(0, width)), trimmed(line.substr(width, width)),
                        orderOf(trimmed(line.substr(2 * width, width))));
        }
    }

    /// A line of V3000 without "M  V30 ", with what follows it if it ends in "-".
    std::string line3000()
    {
        constexpr string_view begin = "M  V30 ";
        std::string out;
        for (bool more = true; more;) {
            next("M  V30 END ATOM");
            if (lines_.line().substr(0, begin.size()) != begin) fail("a line that begins M  V30");
            out += lines_.line().substr(begin.size());
            more = !out.empty() && out.back() == '-';
            if (more) out.pop_back();
        }
        return out;
    }

    void readV3000()
    {
        std::string line;
        do line = line3000();
        while (line.substr(0, 10) != "BEGIN ATOM");
        while ((line = line3000()).substr(0, 8) != "END ATOM") {
            const Fields fields = splitFields(line);
            openvdb::Vec3d position;
            for (int axis = 0; axis < 3; ++axis) {
                double value = 0.0;
                if (fields.size() < 5 || !parseNumber(fields[std::size_t(2 + axis)], value))
                    fail("number, symbol, x, y and z");
                position[axis] = value;
            }
            add(fields[1], position, std::string(fields[0]));
        }
        readV3000Bonds();
    }

    /// Reads the bonds up to the end of the molecule.
    void readV3000Bonds()
    {
        constexpr std::size_t type = 3, first = 4, second = 5; // M V30 number type atom atom
        bool inside = false;
        while (lines_.next() && trimmed(lines_.line()) != "$$$$") {
            const Fields fields = splitFields(lines_.line());
            if (fields.size() > type && fields[type] == "BOND") inside = fields[2] == "BEGIN";
            if (inside && fields.size() > second)
                bonds_.join(fields[first], fields[second], orderOf(fields[type]));
        }
    }

    void add(string_view symbol, const openvdb::Vec3d& position, const std::string& id)
    {
        ++atoms_;
        flat_ = flat_ && position.z() == 0.0;
        AtomLine atom = unknownLigandAtom(position);
        atom.element = elementNumber(std::string(symbol));
        atom.guess = false;
        if (isParticleSymbol(symbol)) atom.role = AtomRole::Particle;
        const std::string name = std::string(symbol) + std::to_string(++serials_[atom.element]);
        atom.name = name;
        bonds_.add(id, {"", atom.number, atom.insertionCode, name});
        tree_.add(atom);
    }

    LineReader lines_;
    const std::string& path_;
    AtomTree tree_;
    std::map<int, int> serials_; ///< atoms of each element up to now
    MoleculeBonds bonds_;
    std::size_t atoms_ = 0; ///< of the molecule up to now
    bool drawn_ = false, flat_ = true;
};

/// A residue of a .mol2 file.
struct Substructure {
    std::string name;
    int number = 0;
    char insertionCode = ' ';
};

/// A line of the section SUBSTRUCTURE.
struct SubstructureLine {
    std::string chain, residue; ///< empty if it has none
};

/// Whether a name is one of the links of chains, or of water.
bool isOfChainOrWater(string_view residue)
{
    const NameClass name = nameClass(residue);
    return isLink(name) || name == NameClass::Water;
}

/// How many letters of "SO4404" or "ALA12" are the name of the residue: those of `known`, if the
/// text begins so; all but the digits at the end, if that is a name of a chain's link or of water
/// ("CYS16"); else the longest known name that digits follow, if it is no ion.
std::size_t nameLength(string_view text, std::size_t digits, const std::string& known)
{
    const auto isNumber = [&](std::size_t from) {
        const std::size_t begin = from + (from < text.size() && text[from] == '-');
        return begin < text.size() &&
               std::all_of(text.begin() + std::ptrdiff_t(begin), text.end(), isDigit);
    };
    if (!known.empty() && text.substr(0, known.size()) == known && isNumber(known.size()))
        return known.size();
    if (isOfChainOrWater(text.substr(0, digits))) return digits;
    for (std::size_t n = std::min<std::size_t>(5, text.size()); n > digits; --n)
        if (isDigit(text[n - 1]) && isNumber(n)) {
            const NameClass kind = nameClass(text.substr(0, n));
            if (kind != NameClass::Unknown && kind != NameClass::Ion) return n;
        }
    return digits;
}

/// Residue name, number and insertion code of a substructure of mol2, whose name has them together,
/// as ALA5, ALA-5 or ALA52A. `known` is the residue name elsewhere in the file.
Substructure substructureOf(string_view id, string_view name, const std::string& known)
{
    Substructure out;
    parseInteger(id, out.number);
    std::size_t end = name.size();
    const bool code = end > 2 && std::isalpha(static_cast<unsigned char>(name[end - 1])) &&
                      isDigit(name[end - 2]);
    std::size_t digits = end -= code;
    while (digits > 0 && isDigit(name[digits - 1])) --digits;
    if (digits > 0 && name[digits - 1] == '-') --digits; // ALA-5
    digits = nameLength(name.substr(0, end), digits, known);
    int number = 0;
    if (digits > 0 && digits < end && parseInteger(name.substr(digits, end - digits), number)) {
        out.number = number;
        if (code) out.insertionCode = name[end];
        name = name.substr(0, digits);
    }
    out.name = name;
    return out;
}

/// Whether the names of a molecule's substructures end in their numbers, as PyMOL and ChimeraX
/// write them (CYS16, SO4404). Those of Amber do not: a link or water stands there without a number
/// (DC), or all of them are whole names (DA5, DT3).
bool endInNumbers(const std::set<std::string>& names)
{
    const auto isPlain = [](const std::string& name) {
        return !isDigit(name.back()) && isOfChainOrWater(name);
    };
    const auto isWhole = [](const std::string& name) {
        return isDigit(name.back()) && isLink(nameClass(name));
    };
    return std::none_of(names.begin(), names.end(), isPlain) &&
           !std::all_of(names.begin(), names.end(), isWhole);
}

/// Whether a field is a number with a decimal point: a charge, where a name may be missing.
bool isChargeField(string_view field)
{
    double charge = 0.0;
    return field.find('.') != string_view::npos && parseNumber(field, charge);
}

/// Whether a type can be one of SYBYL: "C.ar", "H", "Cl".
bool isSybyl(string_view type)
{
    const string_view symbol = type.substr(0, type.find('.'));
    if (symbol.size() < type.size() || symbol == "LP" || symbol == "Du") return true;
    const auto isUpper = [](char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; };
    if (symbol.empty() || !isUpper(symbol[0]) || (symbol.size() == 2 && isUpper(symbol[1])))
        return false;
    return elementNumber(std::string(symbol)) != 0 || symbol == "Any" || symbol == "Hal" ||
           symbol == "Het" || symbol == "Hev";
}

/// Reads the sections of a .mol2 file.
class Mol2Reader
{
public:
    Mol2Reader(const std::string& text, const std::string& path) : text_(text), path_(path) {}

    Structure read()
    {
        readAhead();
        std::string section;
        int model = 0;
        for (LineReader lines(text_); lines.next();) {
            const string_view line = trimmed(lines.line());
            if (line.empty() || line[0] == '#') continue;
            if (line[0] == '@') {
                section = line;
                if (section == "@<TRIPOS>MOLECULE") {
                    tree_.startModel(++model);
                    bonds_.startMolecule();
                }
            } else if (section == "@<TRIPOS>BOND") {
                join(splitFields(line));
            } else if (section == "@<TRIPOS>ATOM") {
                add(lines, model);
            }
        }
        Structure out = tree_.finish();
        out.bonds = bonds_.finish();
        if (charges_.size() == out.atoms.size()) out.charges = std::move(charges_);
        return out;
    }

private:
    enum Column { Id, Name, X, Y, Z, Type, SubstId, SubstName, Charge };

    /// Finds what comes after the atoms, the chains and names of substructures, and whether the
    /// types of a molecule are those of SYBYL.
    void readAhead()
    {
        std::string section;
        int model = 0;
        for (LineReader lines(text_); lines.next();) {
            const string_view line = trimmed(lines.line());
            if (line.substr(0, 1) == "@") {
                section = line;
                model += section == "@<TRIPOS>MOLECULE";
                continue;
            }
            if (section == "@<TRIPOS>ATOM") {
                const Fields fields = splitAtom(line);
                if (fields.size() > Type && !isSybyl(fields[Type])) foreign_.insert(model);
                if (fields.size() > SubstName && !fields[SubstName].empty())
                    names_[model].emplace(fields[SubstName]);
                continue;
            }
            constexpr std::size_t chain = 5, residue = 6; // id name root_atom type dictionary
            if (section != "@<TRIPOS>SUBSTRUCTURE") continue;
            const Fields fields = splitFields(line);
            if (fields.size() <= chain) continue;
            SubstructureLine& known = substructures_[{model, std::string(fields[0])}];
            if (fields[chain] != "****") known.chain = fields[chain];
            if (fields.size() > residue && fields[residue] != "****")
                known.residue = fields[residue];
        }
        for (const auto& [molecule, names] : names_)
            if (endInNumbers(names)) numbered_.insert(molecule);
    }

    /// The fields of an atom. GOLD leaves out the name of the substructure, DOCK 3.7 its number,
    /// too.
    static Fields splitAtom(string_view line)
    {
        Fields fields = splitFields(line);
        for (const Column column : {SubstId, SubstName})
            if (fields.size() > column && isChargeField(fields[column]))
                fields.insert(fields.begin() + column, string_view());
        return fields;
    }

    /// Of a line of a bond: id, two atoms and the type; "nc": they are not connected.
    void join(const Fields& fields)
    {
        if (fields.size() > 3 && fields[3] != "nc")
            bonds_.join(fields[1], fields[2], orderOf(fields[3]));
    }

    void add(const LineReader& lines, int model)
    {
        const Fields fields = splitAtom(lines.line());
        AtomLine atom;
        bool good = fields.size() > Type;
        for (int axis = 0; good && axis < 3; ++axis) {
            double value = 0.0;
            good = parseNumber(fields[std::size_t(X + axis)], value);
            atom.position[axis] = value;
        }
        if (!good)
            failAtLine(path_, lines,
                       "expected number, name, x, y, z and type, got " + inQuotes(lines.line()));
        SubstructureLine known;
        if (fields.size() > SubstId) {
            const auto found = substructures_.find({model, std::string(fields[SubstId])});
            if (found != substructures_.end()) known = found->second;
        }
        Substructure residue;
        if (fields.size() > SubstId) parseInteger(fields[SubstId], residue.number);
        if (fields.size() > SubstName) {
            if (numbered_.count(model) > 0)
                residue = substructureOf(fields[SubstId], fields[SubstName], known.residue);
            else
                residue.name = fields[SubstName];
        }
        double charge = 0.0;
        if (fields.size() > Charge && parseNumber(fields[Charge], charge))
            charges_.push_back(float(charge));
        atom.chain = known.chain;
        atom.residue = residue.name;
        atom.name = fields[Name];
        parseInteger(fields[0], atom.serial);
        atom.number = residue.number;
        atom.insertionCode = residue.insertionCode;
        atom.hetatm = !isStandardResidue(residue.name);
        findElement(fields[Type], foreign_.count(model) > 0, atom);
        bonds_.add(std::string(fields[Id]), {std::string(atom.chain), atom.number,
                                             atom.insertionCode, std::string(atom.name)});
        tree_.add(atom);
    }

    /// By the type, if it is one of SYBYL; of others by the names of ions, then by the type.
    static void findElement(string_view type, bool foreign, AtomLine& atom)
    {
        const string_view symbol = type.substr(0, type.find('.'));
        if (symbol == "LP" || symbol == "Du") {
            atom.role = AtomRole::Particle;
            return;
        }
        if (!foreign || symbol.size() < type.size()) {
            atom.element = elementNumber(std::string(symbol));
            return;
        }
        const bool ion = nameClass(atom.residue) == NameClass::Ion;
        if (!ion) atom.element = elementOfForceFieldType(type);
        if (!ion && atom.element == 0 && isSybyl(type))
            atom.element = elementNumber(std::string(type));
        if (type == "EP" || type == "lp") atom.role = AtomRole::Particle;
    }

    const std::string &text_, &path_;
    AtomTree tree_;
    std::map<std::pair<int, std::string>, SubstructureLine> substructures_; ///< by model and number
    std::map<int, std::set<std::string>> names_; ///< of substructures, by model
    std::set<int> numbered_; ///< models whose names of substructures end in numbers
    std::set<int> foreign_;  ///< models whose types are not SYBYL's
    std::vector<float> charges_;
    MoleculeBonds bonds_;
};

} // namespace

Structure readSdf(const std::string& text, const std::string& path)
{
    return SdfReader(text, path).read();
}

Structure readMol2(const std::string& text, const std::string& path)
{
    return Mol2Reader(text, path).read();
}

} // namespace molsurf
