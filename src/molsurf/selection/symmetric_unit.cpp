// SPDX-License-Identifier: MPL-2.0
#include "molsurf/selection/symmetric_unit.h"

#include "molsurf/balls/ball_index.h"
#include "molsurf/core/words.h"
#include "molsurf/error.h"
#include "molsurf/selection/expand_assembly.h"
#include "molsurf/structure/text_fields.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <map>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

openvdb::BBoxd boxOf(const Ball* begin, const Ball* end)
{
    openvdb::BBoxd box;
    for (const Ball* ball = begin; ball != end; ++ball) box.expand(Vec3d(ball->center));
    return box;
}

/// How far a motion of a copy of the unit ends from where the assembly has it.
double deviationOf(const Operator& motion, const Operator& unit, const Operator& copy,
                   const openvdb::BBoxd& box)
{
    double farthest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3d x((corner & 1 ? box.max() : box.min()).x(),
                      (corner & 2 ? box.max() : box.min()).y(),
                      (corner & 4 ? box.max() : box.min()).z());
        farthest = std::max(farthest, (moved(motion, moved(unit, x)) - moved(copy, x)).length());
    }
    return farthest;
}

[[noreturn]] void fail(const Structure& structure, const std::string& name, const std::string& what)
{
    throw Error(ErrorKind::Input,
                displayName(structure.source) + ": assembly " + inQuotes(name) + ": " + what);
}

} // namespace

UnitBalls unitBalls(const Structure& structure, const std::string& name,
                    const std::vector<Ball>& balls)
{
    const AssemblyCopies assembly = copiesOf(structure, name, {}, balls);
    // The copies that have balls, as an assembly of their own: the others have no symmetry.
    Assembly used;
    std::vector<std::size_t> copyOf; // of an operator
    for (std::size_t part = 0; part < assembly.parts.size(); ++part) {
        AssemblyPart& kept = used.parts.emplace_back();
        for (std::size_t i = 0; i < assembly.copies.size(); ++i) {
            if (assembly.copies[i].part != part) continue;
            kept.operators.push_back(assembly.copies[i].op);
            copyOf.push_back(i);
        }
    }
    UnitBalls out;
    out.unused = assembly.unused;
    out.copyBegin = {0};
    if (assembly.copies.empty()) return out;
    std::vector<openvdb::BBoxd> boxes;
    for (const std::vector<Ball>& part : assembly.parts)
        boxes.push_back(boxOf(part.data(), part.data() + part.size()));
    const auto copyAt = [&](std::size_t i) -> const AssemblyCopy& {
        return assembly.copies[copyOf[i]];
    };
    const auto middleOf = [&](std::size_t i) {
        return moved(copyAt(i).op, boxes[copyAt(i).part].getCenter());
    };
    try {
        out.group = findRotationGroup(used, boxes[copyAt(0).part].getCenter());
    } catch (const Error& e) {
        fail(structure, name,
             std::string("by symmetry: ") + e.what() + " [hint: without `bySymmetry`]");
    }
    const RotationGroup& group = out.group;

    // The copies nearest to a point, one of each orbit; the point moves to their middle.
    std::map<std::size_t, std::size_t> unit; // of orbits: the copy
    Vec3d point = middleOf(0);
    constexpr int rounds = 8;
    for (int round = 0; round < rounds; ++round) {
        std::map<std::size_t, std::pair<double, std::size_t>> nearest;
        for (std::size_t i = 0; i < copyOf.size(); ++i) {
            if (group.orbitOf[i] == copyOf.size()) continue; // it stands more than once
            const double distance = (middleOf(i) - point).length();
            const auto [found, isNew] = nearest.emplace(group.orbitOf[i], std::pair(distance, i));
            if (!isNew && distance < found->second.first) found->second = {distance, i};
        }
        Vec3d middle(0.0);
        std::map<std::size_t, std::size_t> chosen;
        for (const auto& [orbit, best] : nearest) {
            chosen[orbit] = best.second;
            middle += middleOf(best.second) / double(nearest.size());
        }
        if (chosen == unit) break;
        unit = std::move(chosen);
        point = middle;
    }

    for (const auto& [orbit, i] : unit) {
        const AssemblyCopy& copy = copyAt(i);
        appendCopy(copy.op, assembly.parts[copy.part], out.balls);
        out.copyBegin.push_back(out.balls.size());
        out.copyNumbers.push_back(copy.number);
        for (std::size_t k = 0; k < group.motions.size(); ++k)
            out.deviation = std::max(out.deviation,
                                     deviationOf(group.motions[k], copy.op,
                                                 copyAt(group.images[k][i]).op, boxes[copy.part]));
    }
    constexpr double largest = 1.0; // [Å]
    if (out.deviation > largest) {
        fail(structure, name,
             formatted("by symmetry: its copies lie up to %.3g Å from where its rotations bring "
                       "them, expected at most %g Å [hint: without `bySymmetry`]",
                       out.deviation, largest));
    }
    return out;
}

std::vector<std::int32_t> surround(const RotationGroup& group, double reach, BallSet& out)
{
    const std::vector<Ball> unit = out.balls;
    const std::size_t copies = out.copyNumbers.size();
    const BallIndex index(unit, {0.0, 0.0, 6.0});
    std::vector<Vec3d> middles;
    std::vector<double> radii;
    for (std::size_t c = 0; c < copies; ++c) {
        const openvdb::BBoxd box =
            boxOf(unit.data() + out.copyBegin[c], unit.data() + out.copyBegin[c + 1]);
        middles.push_back(out.copyBegin[c] < out.copyBegin[c + 1] ? box.getCenter() : Vec3d(0.0));
        radii.push_back(out.copyBegin[c] < out.copyBegin[c + 1] ? 0.5 * box.extents().length()
                                                                : -1e9);
    }
    std::vector<std::int32_t> motionOf(unit.size(), 0);
    std::vector<Ball> images;
    std::vector<char> near;
    for (std::size_t m = 1; m < group.motions.size(); ++m) {
        const openvdb::Mat3d rotation = matrixOf(group.motions[m]);
        const Vec3d& shift = group.motions[m].translation;
        for (std::size_t c = 0; c < copies; ++c) {
            const Vec3d middle = rotation * middles[c] + shift;
            bool close = false;
            for (std::size_t d = 0; d < copies && !close; ++d)
                close = (middle - middles[d]).length() < radii[c] + radii[d] + reach;
            if (!close) continue;
            images.assign(unit.begin() + std::ptrdiff_t(out.copyBegin[c]),
                          unit.begin() + std::ptrdiff_t(out.copyBegin[c + 1]));
            near.assign(images.size(), 0);
            tbb::parallel_for(std::size_t(0), images.size(), [&](std::size_t i) {
                const Vec3d x = rotation * Vec3d(images[i].center) + shift;
                images[i].center = x;
                double least = std::numeric_limits<double>::max();
                index.forEachNear(x, x, reach, [&](const Ball& ball, std::int32_t) {
                    least = std::min(least, (x - Vec3d(ball.center)).lengthSqr());
                });
                near[i] = least <= reach * reach;
            });
            const std::size_t before = out.balls.size();
            for (std::size_t i = 0; i < images.size(); ++i)
                if (near[i]) out.balls.push_back(images[i]);
            if (out.balls.size() == before) continue;
            motionOf.resize(out.balls.size(), std::int32_t(m));
            out.copyBegin.push_back(out.balls.size());
            out.copyNumbers.push_back(out.copyNumbers[c]);
        }
    }
    return motionOf;
}

} // namespace molsurf
