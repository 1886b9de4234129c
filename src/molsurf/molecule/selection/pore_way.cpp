// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/pore_way.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/selection/match_atoms.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace molsurf
{

namespace
{

std::string withoutSpace(const std::string& text)
{
    const std::size_t begin = text.find_first_not_of(" \t");
    if (begin == std::string::npos) return "";
    return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

std::string placeText(const openvdb::Vec3d& x)
{
    return formatted("(%.2f, %.2f, %.2f)", x[0], x[1], x[2]);
}

/// The texts on both sides of the arrow, or the whole.
std::vector<std::string> sidesOf(const std::string& pore)
{
    const std::size_t arrow = pore.find("->");
    if (arrow == std::string::npos) return {withoutSpace(pore)};
    return {withoutSpace(pore.substr(0, arrow)), withoutSpace(pore.substr(arrow + 2))};
}

/// Three numbers with commas between.
std::optional<openvdb::Vec3d> numbersIn(const std::string& text)
{
    const std::vector<std::string> words = splitWords(text);
    openvdb::Vec3d out;
    if (words.size() != 3) return {};
    for (int i = 0; i < 3; ++i)
        if (!parseWhole(withoutSpace(words[std::size_t(i)]), out[i]) || !(std::abs(out[i]) <= 1e6))
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

/// @param[in] option  that says it, in backticks
BallSet::PoreWay::End endOf(const std::string& text, const char* option, const Structure& structure,
                            const Model& model)
{
    if (const auto point = numbersIn(text)) return {*point, true};
    openvdb::Vec3d sum(0.0);
    std::size_t count = 0;
    try {
        const AtomMatch match = matchAtoms(structure, text);
        for (std::size_t i = model.begin; i < model.end; ++i) {
            if (!match.atoms[i]) continue;
            sum += structure.atoms[i].position;
            ++count;
        }
    } catch (const Error& error) {
        throw Error(ErrorKind::Usage, std::string(option) + ": " + error.what());
    }
    if (count == 0)
        throw Error(ErrorKind::Usage, std::string(option) + ": selection " + inQuotes(text) +
                                          " matches no atom of model " +
                                          std::to_string(model.number));
    return {sum / double(count), false};
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

} // namespace

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

void checkTunnelsFrom(const std::string& from)
{
    checkEnd(from, "`tunnelsFrom`");
}

std::optional<BallSet::PoreWay::End> tunnelsFrom(const std::string& from,
                                                 const Structure& structure, const Model& model)
{
    checkTunnelsFrom(from);
    const std::string text = withoutSpace(from);
    if (text.empty()) return {};
    return endOf(text, "`tunnelsFrom`", structure, model);
}

std::vector<std::string> poreSelections(const std::string& pore)
{
    const std::vector<std::string> sides = sidesOf(pore);
    std::vector<std::string> out;
    if (sides.size() == 1) return out;
    for (const std::string& side : sides)
        if (!numbersIn(side)) out.push_back(side);
    return out;
}

std::string tunnelSelection(const std::string& from)
{
    return numbersIn(from) ? "" : withoutSpace(from);
}

std::optional<BallSet::PoreWay> poreWay(const std::string& pore, const Structure& structure,
                                        const Model& model)
{
    checkPore(pore);
    const std::vector<std::string> sides = sidesOf(pore);
    BallSet::PoreWay out;
    if (sides.size() == 2) {
        for (const std::string& side : sides)
            out.ends.push_back(endOf(side, "`pore`", structure, model));
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

} // namespace molsurf
