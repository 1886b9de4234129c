// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/readers.h"

#include "molsurf/molecule/structure/atom_tree.h"
#include "molsurf/molecule/structure/element.h"
#include "molsurf/molecule/structure/pdb_columns.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace molsurf
{
namespace
{

using std::string_view;

/// The place in a file that a message names.
struct Place {
    const std::string& path;
    const LineReader& lines;
};

[[noreturn]] void fail(const Place& place, const std::string& what)
{
    failAtLine(place.path, place.lines, what);
}

bool isDigitOrPoint(char c)
{
    return c == '.' || std::isdigit(static_cast<unsigned char>(c));
}

/// Splits numbers that a minus sign glues together: "-36.576-112.088" -> "-36.576" "-112.088".
/// @param[in] begin  first field that may be such a number: the residue number
Fields splitGlued(const Fields& fields, std::size_t begin)
{
    Fields parts(fields.begin(), fields.begin() + static_cast<std::ptrdiff_t>(begin));
    for (std::size_t i = begin; i < fields.size(); ++i) {
        string_view rest = fields[i];
        std::size_t cut = 1;
        while (cut < rest.size()) {
            if (rest[cut] == '-' && isDigitOrPoint(rest[cut - 1])) {
                parts.push_back(rest.substr(0, cut));
                rest.remove_prefix(cut);
                cut = 0;
            }
            ++cut;
        }
        parts.push_back(rest);
    }
    return parts;
}

/// The `n` fields from one on as numbers, of which the last is a radius.
template<std::size_t n>
std::array<double, n> numbersFrom(const Fields& fields, std::size_t first,
                                  const std::array<const char*, n>& names, const Place& place)
{
    std::array<double, n> numbers{};
    for (std::size_t i = 0; i < n; ++i) {
        const string_view field = fields[first + i];
        if (!parseNumber(field, numbers[i])) {
            fail(place, std::string(names[i]) + ": expected a number, got " + inQuotes(field) +
                            " in the line " + inQuotes(place.lines.line()));
        }
    }
    constexpr double largest = 1e6; // [Å]
    const double radius = numbers[n - 1];
    if (!(radius >= 0 && radius <= largest)) {
        fail(place, "radius: expected 0 to 1e6 Å, got " + std::string(fields[first + n - 1]));
    }
    return numbers;
}

/// The last `n` fields as numbers.
template<std::size_t n>
std::array<double, n> lastNumbers(const Fields& fields, const std::array<const char*, n>& names,
                                  const Place& place)
{
    return numbersFrom(fields, fields.size() - n, names, place);
}

/// Adds an atom with a radius.
void addBall(AtomTree& tree, AtomLine atom, const openvdb::Vec3d& position, double radius)
{
    atom.position = position;
    atom.radius = radius;
    tree.add(atom);
}

/// The structure, whose atoms all have radii: that elements were guessed does not matter then.
Structure finished(AtomTree& tree)
{
    Structure out = tree.finish();
    out.hasRadii = true;
    out.guessed = 0;
    return out;
}

/// "52A" -> 52 and 'A'; false, and `id` as it was, if it does not start with an integer.
bool parseResidueNumber(string_view field, AtomLine& id)
{
    const bool code = field.size() > 1 && std::isalpha(static_cast<unsigned char>(field.back()));
    if (!parseInteger(code ? field.substr(0, field.size() - 1) : field, id.number)) return false;
    id.insertionCode = code ? field.back() : ' ';
    return true;
}

/// Reads what stands left of the coordinates: serial atom residue [chain] number.
AtomLine pqrIdentity(const Fields& fields, std::size_t size, bool hetero)
{
    AtomLine id;
    id.hetatm = hetero;
    if (size > 0) parseInteger(fields[0], id.serial);
    if (size > 1) id.name = fields[1];
    if (size > 2) id.residue = fields[2];
    if (size > 4) id.chain = fields[3];
    if (size < 4) return id;
    const string_view last = fields[size - 1];
    if (!parseResidueNumber(last, id) && size == 4 && last.size() > 1) { // chain glued: "A1234"
        id.chain = last.substr(0, 1);
        parseResidueNumber(last.substr(1), id);
    }
    return id;
}

/// Takes the symbol of an element off the end of a line, as Open Babel writes it; 0 if there is
/// none.
int takeElement(Fields& fields)
{
    double number = 0.0;
    constexpr std::size_t least = 10; // serial atom residue number x y z charge radius element
    if (fields.size() < least || parseNumber(fields.back(), number) ||
        !parseNumber(fields[fields.size() - 2], number) ||
        !parseNumber(fields[fields.size() - 3], number))
        return 0;
    const int element = elementNumber(std::string(fields.back()));
    if (element != 0) fields.pop_back();
    return element;
}

/// Whether numbers are glued: a field has two decimal points.
bool hasGlued(const Fields& fields)
{
    return std::any_of(fields.begin(), fields.end(), [](string_view field) {
        return std::count(field.begin(), field.end(), '.') > 1;
    });
}

/// Adds an atom whose coordinates and names are those of the columns of a PDB file.
void addGlued(AtomTree& tree, const Place& place, int element, std::vector<float>& charges)
{
    constexpr std::size_t behind = 54;
    const string_view line = place.lines.line();
    AtomLine atom = atomInColumns(line.substr(0, behind), PdbLayout());
    atom.position = placeInColumns(place.path, place.lines);
    const Fields fields = splitFields(line.substr(std::min(behind, line.size())));
    if (fields.size() < 2)
        fail(place, "expected charge and radius behind column 54, got " + inQuotes(line));
    const auto [charge, radius] =
        numbersFrom(fields, 0, std::array<const char*, 2>{"charge", "radius"}, place);
    charges.push_back(float(charge));
    atom.element = element;
    atom.radius = radius;
    tree.add(atom);
}

/// The atom that a name in an xyzrn file stands for; see readStructure().
AtomLine identityIn(string_view name)
{
    std::vector<string_view> parts;
    for (std::size_t end = 0; end != string_view::npos; name.remove_prefix(end + 1)) {
        end = name.find('_');
        parts.push_back(name.substr(0, end));
        if (end == string_view::npos) break;
    }
    AtomLine id;
    const std::size_t count = parts.size();
    if ((count == 3 || count == 4) && parseResidueNumber(parts[2], id)) {
        id.name = parts[0];
        id.residue = parts[1];
        if (count == 4) id.chain = parts[3];
    } else if (count == 6 && parseInteger(parts[1], id.number)) {
        id.chain = parts[0];
        if (parts[2].size() == 1 && parts[2] != "x") id.insertionCode = parts[2][0];
        id.residue = parts[3];
        id.name = parts[4];
    }
    return id;
}

} // namespace

Structure readPqr(const std::string& text, const std::string& path)
{
    AtomTree tree;
    std::vector<float> charges;
    constexpr std::array<const char*, 5> names{"x", "y", "z", "charge", "radius"};
    int model = 0;
    for (LineReader lines(text); lines.next();) {
        const string_view line = lines.line();
        if (line.substr(0, 5) == "MODEL") {
            const Fields fields = splitFields(line);
            ++model;
            if (fields.size() > 1) parseInteger(fields[1], model);
            tree.startModel(model);
        }
        if (!isAtomRecord(line)) {
            refuseMisspeltAtom(path, lines);
            continue;
        }
        const Place place{path, lines};
        const bool hetero = line[0] == 'H';
        Fields fields = splitFields(line.substr(hetero ? 6 : 4));
        constexpr std::size_t leftColumns = 4; // serial, atom, residue, number
        constexpr std::size_t columns = leftColumns + names.size();
        const int element = takeElement(fields);
        if (fields.size() < columns || hasGlued(fields))
            fields = splitGlued(fields, std::min(leftColumns - 1, fields.size()));
        if (hasGlued(fields)) { // coordinates of eight characters touch: "2009.6762995.631"
            addGlued(tree, place, element, charges);
            continue;
        }
        if (fields.size() < columns) {
            fail(place, "expected 10 or 11 columns, the last ones x y z charge radius, got " +
                            inQuotes(line));
        }
        const auto [x, y, z, charge, radius] = lastNumbers(fields, names, place);
        charges.push_back(float(charge));
        AtomLine id = pqrIdentity(fields, fields.size() - names.size(), hetero);
        id.element = element;
        addBall(tree, id, {x, y, z}, radius);
    }
    Structure out = finished(tree);
    out.charges = std::move(charges);
    return out;
}

Structure readXyzr(const std::string& text, const std::string& path)
{
    AtomTree tree;
    tree.reserve(std::size_t(std::count(text.begin(), text.end(), '\n')) + 1);
    constexpr std::array<const char*, 4> names{"x", "y", "z", "radius"};
    Fields fields;
    for (LineReader lines(text); lines.next();) {
        splitFields(lines.line(), fields);
        if (fields.empty() || fields[0][0] == '#') continue;
        const Place place{path, lines};
        if (fields.size() < names.size()) {
            fail(place, "expected x y z radius, got " + inQuotes(lines.line()));
        }
        const auto [x, y, z, radius] = lastNumbers(fields, names, place);
        AtomLine id;
        if (fields.size() == names.size() + 3 && parseResidueNumber(fields[1], id)) {
            id.chain = fields[0];
            id.name = fields[2];
        }
        addBall(tree, id, {x, y, z}, radius);
    }
    return finished(tree);
}

Structure readXyzrn(const std::string& text, const std::string& path)
{
    AtomTree tree;
    std::vector<std::string> labels;
    constexpr std::array<const char*, 4> names{"x", "y", "z", "radius"};
    Fields fields;
    for (LineReader lines(text); lines.next();) {
        splitFields(lines.line(), fields);
        if (fields.empty() || fields[0][0] == '#') continue;
        const Place place{path, lines};
        if (fields.size() < names.size())
            fail(place, "expected x y z radius number name, got " + inQuotes(lines.line()));
        const auto [x, y, z, radius] = numbersFrom(fields, 0, names, place);
        const string_view name = fields.size() > names.size() ? fields.back() : string_view();
        constexpr std::size_t longest = 1024;
        if (name.size() > longest)
            fail(place,
                 "expected a name of at most 1024 characters, got " + std::to_string(name.size()));
        addBall(tree, identityIn(name), {x, y, z}, radius);
        labels.emplace_back(name);
    }
    Structure out = finished(tree);
    out.labels = std::move(labels);
    return out;
}

} // namespace molsurf
