// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/assembly.h"

#include "molsurf/error.h"
#include "molsurf/molecule/selection/choose_copies.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <unordered_set>
#include <utility>

namespace molsurf
{
namespace
{

std::string titleOf(const Structure& structure, const std::string& name)
{
    return displayName(structure.source) + ": assembly " + inQuotes(name) + ": ";
}

const Assembly& findAssembly(const Structure& structure, const std::string& name)
{
    std::vector<std::string> names;
    for (const Assembly& assembly : structure.assemblies) {
        names.push_back(assembly.name);
        if (assembly.name != name) continue;
        if (assembly.problem.empty()) return assembly;
        throw Error(ErrorKind::Input, titleOf(structure, name) + assembly.problem);
    }
    throw Error(ErrorKind::Input, titleOf(structure, name) + "expected " +
                                      (names.empty() ? "none: the file describes no assembly"
                                                     : "one of " + joined(names)));
}

/// The balls whose chains a part of an assembly lists.
std::vector<Ball> ballsOfPart(const Structure& structure, const AssemblyPart& part,
                              const std::vector<Ball>& balls, std::vector<char>& used)
{
    const std::set<std::string> names(part.chains.begin(), part.chains.end());
    std::vector<char> listed;
    for (const std::string& asym : structure.asyms) {
        listed.push_back(names.empty() || names.count(asym) != 0);
    }
    std::vector<Ball> chosen;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Atom& atom = structure.atoms[std::size_t(balls[i].atom)];
        const Residue& residue = structure.residues[std::size_t(atom.residue)];
        if (!listed[std::size_t(residue.asym)]) continue;
        chosen.push_back(balls[i]);
        used[i] = 1;
    }
    return chosen;
}

/// The centre of the balls that an assembly uses first: those of its first part that has any.
openvdb::Vec3d centroidOf(const std::vector<std::vector<Ball>>& parts)
{
    openvdb::Vec3d sum(0.0);
    for (const std::vector<Ball>& part : parts) {
        for (const Ball& ball : part) sum += ball.center;
        if (!part.empty()) return sum / double(part.size());
    }
    return sum;
}

/// The balls of every part of an assembly.
std::vector<std::vector<Ball>> ballsOfParts(const Structure& structure, const Assembly& assembly,
                                            const std::vector<Ball>& balls, std::vector<char>& used)
{
    std::vector<std::vector<Ball>> parts;
    for (const AssemblyPart& part : assembly.parts) {
        parts.push_back(ballsOfPart(structure, part, balls, used));
    }
    return parts;
}

/// Key that two operators share if they are the same motion, to 1e-4 of a rotation and 1e-3 Å.
using MotionKey = std::array<long, 12>;

MotionKey keyOf(const Operator& op)
{
    MotionKey key;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column)
            key[3 * row + column] = std::lround(1e4 * op.rotation[row][column]);
        key[9 + row] = std::lround(1e3 * op.translation[int(row)]);
    }
    return key;
}

} // namespace

void appendCopy(const Operator& op, const std::vector<Ball>& balls, std::vector<Ball>& out)
{
    for (const Ball& ball : balls) out.push_back({op.placed(ball.center), ball.radius, ball.atom});
}

std::vector<int> findCopies(const Structure& structure, const std::string& name,
                            const CopyChoice& copies, const std::vector<Ball>& balls)
{
    const Assembly& assembly = findAssembly(structure, name);
    std::vector<char> used(balls.size());
    const auto parts = ballsOfParts(structure, assembly, balls, used);
    std::vector<int> numbers;
    for (const std::size_t i : chooseCopies(structure, assembly, copies, centroidOf(parts))) {
        numbers.push_back(static_cast<int>(i) + 1);
    }
    return numbers;
}

AssemblyCopies copiesOf(const Structure& structure, const std::string& name,
                        const CopyChoice& copies, const std::vector<Ball>& balls, BallSet& out)
{
    const Assembly& assembly = findAssembly(structure, name);
    AssemblyCopies found{titleOf(structure, name), {}, {}};
    std::vector<char> used(balls.size());
    found.parts = ballsOfParts(structure, assembly, balls, used);
    const auto unused = std::size_t(std::count(used.begin(), used.end(), char{0}));
    if (unused > 0) out.record.drops.push_back({"not in the assembly", unused});
    const std::vector<Operator> operators = operatorsOf(assembly);
    const std::vector<std::size_t> partOf = partsOfCopies(assembly);
    for (const std::size_t i : chooseCopies(structure, assembly, copies, centroidOf(found.parts))) {
        if (found.parts[partOf[i]].empty()) continue;
        const std::string problem = rotationProblem(operators[i]);
        if (!problem.empty()) throw Error(ErrorKind::Input, found.title + problem);
        found.copies.push_back({int(i) + 1, partOf[i], operators[i]});
    }
    return found;
}

Placement expandAssembly(const AssemblyCopies& assembly, std::vector<Ball>& out)
{
    std::size_t total = 0;
    for (const auto& copy : assembly.copies) total += assembly.parts[copy.part].size();
    out.reserve(total);
    Placement placement;
    placement.copies = assembly.copies.size();
    for (const auto& copy : assembly.copies) {
        placement.begin.push_back(out.size());
        placement.numbers.push_back(copy.number);
        appendCopy(copy.op, assembly.parts[copy.part], out);
    }
    placement.begin.push_back(out.size());
    return placement;
}

Placement instanceAssembly(const AssemblyCopies& assembly, std::vector<Ball>& out)
{
    // The parts that move together, motion by motion in the order of the file.
    struct MovedPart {
        const Operator* op;
        std::vector<std::size_t> parts;
    };
    std::vector<MovedPart> motions;
    std::map<MotionKey, std::size_t> motionOf;
    for (const AssemblyCopy& copy : assembly.copies) {
        const auto [found, isNew] = motionOf.emplace(keyOf(copy.op), motions.size());
        if (isNew) motions.push_back({&copy.op, {}});
        motions[found->second].parts.push_back(copy.part);
    }

    Placement placement;
    placement.begin = {0};
    std::map<std::vector<std::size_t>, std::size_t> prototypeOf;
    for (MovedPart& motion : motions) {
        std::sort(motion.parts.begin(), motion.parts.end());
        motion.parts.erase(std::unique(motion.parts.begin(), motion.parts.end()),
                           motion.parts.end());
        const auto [found, isNew] = prototypeOf.emplace(motion.parts, prototypeOf.size());
        if (isNew) {
            std::unordered_set<std::int32_t> taken; // parts may share chains
            for (const std::size_t part : motion.parts) {
                for (const Ball& ball : assembly.parts[part])
                    if (taken.insert(ball.atom).second) out.push_back(ball);
            }
            placement.begin.push_back(out.size());
            placement.numbers.push_back(int(prototypeOf.size()));
        }
        placement.instances.push_back({*motion.op, found->second, motion.op->name});
    }
    placement.copies = prototypeOf.size();
    return placement;
}

Placement foldAssembly(const AssemblyCopies& assembly, std::vector<Ball>& out)
{
    Placement placement;
    placement.folded = true;
    placement.begin = {0};
    std::map<std::size_t, std::size_t> placeOf; // of parts that have copies
    for (const AssemblyCopy& copy : assembly.copies) {
        const auto [found, isNew] = placeOf.emplace(copy.part, placeOf.size());
        if (isNew) {
            const std::vector<Ball>& part = assembly.parts[copy.part];
            out.insert(out.end(), part.begin(), part.end());
            placement.begin.push_back(out.size());
        }
        placement.instances.push_back({copy.op, found->second, copy.op.name});
    }
    placement.copies = placeOf.size();
    return placement;
}

} // namespace molsurf
