// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/search_places.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/selection/match_atoms.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>

namespace molsurf
{

namespace
{

std::string placeText(const openvdb::Vec3d& x)
{
    return formatted("(%.2f, %.2f, %.2f)", x[0], x[1], x[2]);
}

/// The texts on both sides of the arrow, or the whole.
std::vector<std::string> sidesOf(const std::string& pore)
{
    const std::size_t arrow = pore.find("->");
    if (arrow == std::string::npos) return {std::string(trimmed(pore))};
    return {std::string(trimmed(pore.substr(0, arrow))),
            std::string(trimmed(pore.substr(arrow + 2)))};
}

/// Three numbers with commas between.
std::optional<openvdb::Vec3d> numbersIn(const std::string& text)
{
    const std::vector<std::string> words = splitWords(text);
    openvdb::Vec3d out;
    if (words.size() != 3) return {};
    for (int i = 0; i < 3; ++i)
        if (!parseWhole(trimmed(words[std::size_t(i)]), out[i]) || !(std::abs(out[i]) <= 1e6))
            return {};
    return out;
}

/// Whether it is of numbers alone, with commas or spaces between, though not of three.
bool isOfNumbers(const std::string& text)
{
    std::string spaced = text;
    std::replace(spaced.begin(), spaced.end(), ',', ' ');
    std::istringstream words(spaced);
    bool some = false;
    for (std::string word; words >> word; some = true) {
        char* end = nullptr;
        std::strtod(word.c_str(), &end); // also what is no number, or has no end
        if (*end != '\0') return false;
    }
    return some;
}

/// The axis that a text without an arrow says; 0: it is to be found.
openvdb::Vec3d axisIn(const std::string& text)
{
    const std::string word = lowered(text);
    if (word == "auto") return openvdb::Vec3d(0.0);
    if (word == "x") return {1.0, 0.0, 0.0};
    if (word == "y") return {0.0, 1.0, 0.0};
    if (word == "z") return {0.0, 0.0, 1.0};
    const auto axis = numbersIn(text);
    if (!axis)
        throw Error(ErrorKind::Usage, "`pore`: expected auto, an axis as z or 1,1,0, or two ends "
                                      "as 'A -> B', got " +
                                          inQuotes(text));
    if (!(axis->length() > 1e-9))
        throw Error(ErrorKind::Usage,
                    "`pore`: expected an axis that is longer than 0, got " + inQuotes(text));
    return axis->unit();
}

/// The atoms of a model that a selection takes.
/// @param[in] option  that says it, in backticks
/// @throws Error(ErrorKind::Usage) if there are none
std::vector<std::size_t> atomsOf(const std::string& select, const char* option,
                                 const Selections& selections, const Model& model)
{
    std::vector<std::size_t> out;
    try {
        const AtomMatch match = selections.match(select);
        for (std::size_t i = model.begin; i < model.end; ++i)
            if (match.atoms[i]) out.push_back(i);
    } catch (const Error& error) {
        throw Error(ErrorKind::Usage, std::string(option) + ": " + error.what());
    }
    if (out.empty())
        throw Error(ErrorKind::Usage, std::string(option) + ": selection " + inQuotes(select) +
                                          " matches no atom of model " +
                                          std::to_string(model.number));
    return out;
}

/// @param[in] option  that says it, in backticks
SearchPlaces::End endOf(const std::string& text, const char* option, const Selections& selections,
                        const Model& model)
{
    if (const auto point = numbersIn(text)) return {*point, true};
    openvdb::Vec3d sum(0.0);
    const std::vector<std::size_t> atoms = atomsOf(text, option, selections, model);
    for (const std::size_t i : atoms) sum += selections.structure().atoms[i].position;
    return {sum / double(atoms.size()), false};
}

/// @throws Error(ErrorKind::Usage) if it is of numbers but no point
void checkEnd(const std::string& text, const char* option)
{
    if (numbersIn(text) || !isOfNumbers(text)) return;
    throw Error(ErrorKind::Usage,
                std::string(option) +
                    ": expected X,Y,Z, numbers within 1e6 Å, or a selection, got " +
                    inQuotes(text));
}

/// Checks the text of a pore.
/// @throws Error(ErrorKind::Usage) if it says neither ends nor an axis
void checkPore(const std::string& pore)
{
    const std::vector<std::string> sides = sidesOf(pore);
    if (sides.size() == 1) {
        if (!sides[0].empty()) axisIn(sides[0]);
        return;
    }
    if (sides[0].empty() || sides[1].empty())
        throw Error(ErrorKind::Usage,
                    "`pore`: expected a point as 1,2,3 or a selection on both sides of ->, got " +
                        inQuotes(pore));
    for (const std::string& side : sides) checkEnd(side, "`pore`");
}

/// Finds where a pore is searched for.
/// @throws Error(ErrorKind::Usage) if a selection matches no atom of the model, or both ends are in
///         one place
std::optional<SearchPlaces::PoreWay> poreWay(const std::string& pore, const Selections& selections,
                                             const Model& model)
{
    const std::vector<std::string> sides = sidesOf(pore);
    SearchPlaces::PoreWay out;
    if (sides.size() == 2) {
        for (const std::string& side : sides)
            out.ends.push_back(endOf(side, "`pore`", selections, model));
        constexpr double apart = 1.0; // [Å]
        if ((out.ends[1].place - out.ends[0].place).length() < apart)
            throw Error(ErrorKind::Usage, "`pore`: expected two ends 1 Å apart or more, got " +
                                              placeText(out.ends[0].place) + " and " +
                                              placeText(out.ends[1].place));
        return out;
    }
    if (sides[0].empty()) return {};
    out.axis = axisIn(sides[0]);
    return out;
}

/// Finds the atoms that a pocket is at, and warns if ligands among them are a part of the molecule,
/// which fill the pocket.
/// @throws Error(ErrorKind::Usage) if there are none
std::vector<openvdb::Vec3d> pocketPlaces(const std::string& select, const Selections& selections,
                                         const Model& model, BallSet& atoms)
{
    const Structure& structure = selections.structure();
    std::vector<openvdb::Vec3d> out;
    std::vector<char> used(structure.atoms.size());
    for (const Ball& ball : atoms.balls) used[std::size_t(ball.atom)] = 1;
    std::set<std::string> names;
    std::size_t filled = 0;
    for (const std::size_t i : atomsOf(select, "`pocketAt`", selections, model)) {
        out.push_back(structure.atoms[i].position);
        const Residue& residue = residueOf(structure, structure.atoms[i]);
        if (!used[i] || !residue.hetero()) continue;
        ++filled;
        names.insert(residue.name);
    }
    if (filled > 0)
        atoms.record.warnings.push_back(
            "`pocketAt`: " + counted(filled, "atom", "atoms") + " of " +
            joined({names.begin(), names.end()}) +
            " are a part of the molecule, and fill the pocket [hint: `select` \"not resname " +
            *names.begin() + "\" leaves them out]");
    return out;
}

} // namespace

void checkOptions(const PlaceOptions& options)
{
    checkPore(options.pore);
    checkEnd(options.tunnelsFrom, "`tunnelsFrom`");
}

std::vector<std::string> selectionsOf(const PlaceOptions& options)
{
    std::vector<std::string> out = sidesOf(options.pore);
    if (out.size() == 1) out.clear(); // an axis
    out.emplace_back(trimmed(options.tunnelsFrom));
    out.push_back(options.pocketAt);
    out.erase(std::remove_if(out.begin(), out.end(),
                             [](const std::string& end) { return numbersIn(end).has_value(); }),
              out.end());
    return out;
}

SearchPlaces findPlaces(const Selections& selections, const PlaceOptions& options, BallSet& atoms)
{
    const std::vector<Model>& models = selections.structure().models;
    SearchPlaces out;
    const Model& model = *std::find_if(models.begin(), models.end(), [&](const Model& one) {
        return one.number == atoms.record.model;
    });
    if (!options.pocketAt.empty())
        out.pocketAt = pocketPlaces(options.pocketAt, selections, model, atoms);
    out.pore = poreWay(options.pore, selections, model);
    if (const std::string from(trimmed(options.tunnelsFrom)); !from.empty())
        out.tunnelsFrom = endOf(from, "`tunnelsFrom`", selections, model);
    return out;
}

} // namespace molsurf
