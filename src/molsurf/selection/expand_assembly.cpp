// SPDX-License-Identifier: MPL-2.0
#include "molsurf/selection/expand_assembly.h"

#include "molsurf/error.h"
#include "molsurf/selection/choose_copies.h"
#include "molsurf/structure/text_fields.h"

#include <algorithm>
#include <set>

namespace molsurf
{
namespace
{

[[noreturn]] void fail(const Structure& structure, const std::string& name, const std::string& what)
{
    throw Error(ErrorKind::Input,
                displayName(structure.source) + ": assembly " + inQuotes(name) + ": " + what);
}

const Assembly& findAssembly(const Structure& structure, const std::string& name)
{
    std::vector<std::string> names;
    for (const Assembly& assembly : structure.assemblies) {
        names.push_back(assembly.name);
        if (assembly.name != name) continue;
        if (assembly.problem.empty()) return assembly;
        fail(structure, name, assembly.problem);
    }
    fail(structure, name,
         "expected " +
             (names.empty() ? "none: the file describes no assembly" : "one of " + joined(names)));
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

} // namespace

void appendCopy(const Operator& op, const std::vector<Ball>& balls, std::vector<Ball>& out)
{
    const auto& r = op.rotation;
    for (const Ball& ball : balls) {
        const openvdb::Vec3d& p = ball.center;
        const openvdb::Vec3d center(r[0][0] * p[0] + r[0][1] * p[1] + r[0][2] * p[2],
                                    r[1][0] * p[0] + r[1][1] * p[1] + r[1][2] * p[2],
                                    r[2][0] * p[0] + r[2][1] * p[1] + r[2][2] * p[2]);
        out.push_back({center + op.translation, ball.radius, ball.atom});
    }
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
                        const CopyChoice& copies, const std::vector<Ball>& balls)
{
    const Assembly& assembly = findAssembly(structure, name);
    AssemblyCopies out;
    std::vector<char> used(balls.size());
    out.parts = ballsOfParts(structure, assembly, balls, used);
    out.unused = std::size_t(std::count(used.begin(), used.end(), char{0}));
    const std::vector<Operator> operators = operatorsOf(assembly);
    const std::vector<std::size_t> partOf = partsOfCopies(assembly);
    for (const std::size_t i : chooseCopies(structure, assembly, copies, centroidOf(out.parts))) {
        if (out.parts[partOf[i]].empty()) continue;
        const std::string problem = rotationProblem(operators[i]);
        if (!problem.empty()) fail(structure, name, problem);
        out.copies.push_back({int(i) + 1, partOf[i], operators[i]});
    }
    return out;
}

ExpandedBalls expandAssembly(const Structure& structure, const std::string& name,
                             const CopyChoice& copies, const std::vector<Ball>& balls)
{
    const AssemblyCopies assembly = copiesOf(structure, name, copies, balls);
    ExpandedBalls out;
    std::size_t total = 0;
    for (const auto& copy : assembly.copies) total += assembly.parts[copy.part].size();
    out.balls.reserve(total);
    for (const auto& copy : assembly.copies) {
        out.copyBegin.push_back(out.balls.size());
        out.copyNumbers.push_back(copy.number);
        appendCopy(copy.op, assembly.parts[copy.part], out.balls);
    }
    out.copyBegin.push_back(out.balls.size());
    out.unused = assembly.unused;
    return out;
}

} // namespace molsurf
