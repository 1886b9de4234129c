// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/choose_copies.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/symmetry.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <string_view>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using std::string_view;

constexpr string_view foldWord = "fold:";

[[noreturn]] void usageError(const std::string& text)
{
    throw Error(ErrorKind::Usage, "`copies`: expected numbers from 1 such as 1,7,20-25, or fold:N "
                                  "with N from 2, got " +
                                      inQuotes(text));
}

[[noreturn]] void fail(const Structure& structure, const Assembly& assembly,
                       const std::string& what)
{
    failAt(structure.source, "assembly " + inQuotes(assembly.name) + ": " + what);
}

std::pair<int, int> parseRange(string_view item, const std::string& text)
{
    const std::size_t dash = item.find('-');
    int first = 0, last = 0;
    if (!parseInteger(trimmed(item.substr(0, dash)), first)) usageError(text);
    last = first;
    if (dash != string_view::npos && !parseInteger(trimmed(item.substr(dash + 1)), last)) {
        usageError(text);
    }
    if (first < 1 || last < first) usageError(text);
    return {first, last};
}

bool areEqual(const Operator& a, const Operator& b)
{
    return a.rotation == b.rotation && a.translation == b.translation;
}

/// Copy 1, and the one of every further part that belongs to it.
std::vector<std::size_t> firstOfParts(const Assembly& assembly, const Vec3d& centroid)
{
    const std::vector<Operator> operators = operatorsOf(assembly);
    const Vec3d home = operators[0].placed(centroid);
    std::vector<std::size_t> chosen;
    std::size_t begin = 0;
    for (const AssemblyPart& part : assembly.parts) {
        const std::size_t end = begin + part.operators.size();
        std::size_t best = begin;
        double nearest = std::numeric_limits<double>::max();
        for (std::size_t i = begin; i < end; ++i) {
            const double away = areEqual(operators[i], operators[0])
                                    ? -1.0
                                    : (operators[i].placed(centroid) - home).length();
            if (away < nearest) {
                nearest = away;
                best = i;
            }
        }
        if (end > begin) chosen.push_back(best);
        begin = end;
    }
    return chosen;
}

std::string foldName(int fold)
{
    static constexpr std::array<const char*, 7> names{
        "", "", "two-fold", "three-fold", "four-fold", "five-fold", "six-fold"};
    return fold < int(names.size()) ? names[std::size_t(fold)] : std::to_string(fold) + "-fold";
}

/// The copies that the rotations about an axis make of the given ones, these among them, ascending
/// and each once.
std::vector<std::size_t> copiesAbout(const RotationAxis& axis,
                                     const std::vector<std::size_t>& copies)
{
    std::vector<std::size_t> all = copies;
    for (const auto& images : axis.images) {
        for (const std::size_t i : copies) all.push_back(images[i]);
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

} // namespace

CopyChoice parseCopies(const std::string& text)
{
    CopyChoice choice;
    if (text.empty()) return choice;
    if (text.rfind(foldWord, 0) == 0) {
        if (!parseInteger(string_view(text).substr(foldWord.size()), choice.fold) ||
            choice.fold < 2) {
            usageError(text);
        }
        return choice;
    }
    for (const std::string& item : splitWords(text))
        choice.ranges.push_back(parseRange(trimmed(item), text));
    return choice;
}

std::string textOf(const CopyChoice& copies)
{
    if (copies.fold > 0) return std::string(foldWord) + std::to_string(copies.fold);
    std::string text;
    for (const auto& [first, last] : copies.ranges)
        text += (text.empty() ? "" : ",") + std::to_string(first) +
                (last == first ? "" : "-" + std::to_string(last));
    return text;
}

void checkCopies(const CopyChoice& copies)
{
    bool good = copies.fold == 0 || (copies.fold > 1 && copies.ranges.empty());
    for (const auto& [first, last] : copies.ranges) good = good && first >= 1 && last >= first;
    if (!good) usageError(textOf(copies));
}

const RotationAxis* nearestAxis(const Symmetry& symmetry, int fold, const Vec3d& point)
{
    constexpr double equal = 0.01; // [Å]
    const RotationAxis* nearest = nullptr;
    double least = 0.0;
    for (const RotationAxis& axis : symmetry.axes) {
        if (axis.fold != fold) continue;
        const double away = (point - symmetry.centre).cross(axis.direction).length();
        if (nearest && away > least - equal) continue;
        nearest = &axis;
        least = away;
    }
    return nearest;
}

std::string describeSymmetry(const Symmetry& symmetry)
{
    std::string text;
    for (std::size_t i = 0; i < symmetry.axes.size();) {
        const int fold = symmetry.axes[i].fold;
        std::size_t count = 0;
        for (; i < symmetry.axes.size() && symmetry.axes[i].fold == fold; ++i) ++count;
        text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + foldName(fold);
    }
    text =
        text.empty() ? "no rotation axis" : text + (symmetry.axes.size() == 1 ? " axis" : " axes");
    if (!symmetry.helix) return text;
    return formatted("helical, rise %.2f Å, twist %.2f degrees", symmetry.helix->rise,
                     symmetry.helix->twist * 180.0 / M_PI) +
           (", " + text);
}

std::vector<std::size_t> chooseCopies(const Structure& structure, const Assembly& assembly,
                                      const CopyChoice& choice, const Vec3d& centroid)
{
    const std::vector<Operator> operators = operatorsOf(assembly);
    std::vector<std::size_t> chosen, all(operators.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    if (choice.all()) return all;
    if (choice.others) {
        CopyChoice left = choice;
        left.others = false;
        const std::vector<std::size_t> taken = chooseCopies(structure, assembly, left, centroid);
        std::set_difference(all.begin(), all.end(), taken.begin(), taken.end(),
                            std::back_inserter(chosen));
        if (chosen.empty())
            fail(structure, assembly,
                 "others: expected copies that `copies` leaves out, got all " +
                     std::to_string(all.size()) + " chosen");
        return chosen;
    }
    for (const auto& [first, last] : choice.ranges) {
        if (std::size_t(last) > operators.size()) {
            fail(structure, assembly,
                 "copies: expected numbers from 1 to " + std::to_string(operators.size()) +
                     ", got " + std::to_string(last));
        }
        for (int i = first; i <= last; ++i) chosen.push_back(std::size_t(i) - 1);
    }
    if (choice.fold != 0) {
        Symmetry symmetry;
        try {
            symmetry = findSymmetry(assembly, centroid);
        } catch (const Error& error) {
            fail(structure, assembly, error.what());
        }
        const Vec3d home = operators.empty() ? centroid : operators[0].placed(centroid);
        const RotationAxis* axis = nearestAxis(symmetry, choice.fold, home);
        if (!axis) {
            fail(structure, assembly,
                 "copies: expected the fold of one of its axes, got fold:" +
                     std::to_string(choice.fold) + " [" + describeSymmetry(symmetry) + "]");
        }
        return copiesAbout(*axis, firstOfParts(assembly, centroid));
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    return chosen;
}

} // namespace molsurf
