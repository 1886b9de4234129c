// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/symmetric_unit.h"

#include "molsurf/error.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/rotation_group.h"

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
        farthest = std::max(farthest, (motion.placed(unit.placed(x)) - copy.placed(x)).length());
    }
    return farthest;
}

/// The copies of an assembly that have balls.
class Copies
{
public:
    explicit Copies(const AssemblyCopies& assembly) : assembly_(assembly)
    {
        for (std::size_t part = 0; part < assembly.parts.size(); ++part) {
            AssemblyPart& kept = used_.parts.emplace_back();
            for (std::size_t i = 0; i < assembly.copies.size(); ++i) {
                if (assembly.copies[i].part != part) continue;
                kept.operators.push_back(assembly.copies[i].op);
                copyOf_.push_back(i);
            }
        }
        for (const std::vector<Ball>& part : assembly.parts)
            boxes_.push_back(boxOf(part.data(), part.data() + part.size()));
    }
    /// An assembly of their own: the others have no symmetry.
    const Assembly& used() const { return used_; }
    std::size_t size() const { return copyOf_.size(); }
    /// The copy that operator i of used() makes.
    const AssemblyCopy& at(std::size_t i) const { return assembly_.copies[copyOf_[i]]; }
    /// The box of its part, in the coordinates of the file.
    const openvdb::BBoxd& box(std::size_t i) const { return boxes_[at(i).part]; }
    Vec3d middle(std::size_t i) const { return at(i).op.placed(box(i).getCenter()); }

private:
    const AssemblyCopies& assembly_;
    Assembly used_;
    std::vector<std::size_t> copyOf_; // of an operator
    std::vector<openvdb::BBoxd> boxes_;
};

/// The copies nearest to a point, one of each orbit; as in k-means, the point then moves to their
/// middle, until they stay the same.
/// @return by orbit
std::map<std::size_t, std::size_t> nearestOfOrbits(const Copies& copies, const RotationGroup& group)
{
    std::map<std::size_t, std::size_t> unit;
    Vec3d point = copies.middle(0);
    constexpr int rounds = 8;
    for (int round = 0; round < rounds; ++round) {
        std::map<std::size_t, std::pair<double, std::size_t>> nearest;
        for (std::size_t i = 0; i < copies.size(); ++i) {
            if (group.orbitOf[i] == copies.size()) continue; // it stands more than once
            const double distance = (copies.middle(i) - point).length();
            const auto [found, isNew] = nearest.emplace(group.orbitOf[i], std::pair(distance, i));
            if (!isNew && distance < found->second.first) found->second = {distance, i};
        }
        Vec3d middle(0.0);
        std::map<std::size_t, std::size_t> chosen;
        for (const auto& [orbit, best] : nearest) {
            chosen[orbit] = best.second;
            middle += copies.middle(best.second) / double(nearest.size());
        }
        if (chosen == unit) break;
        unit = std::move(chosen);
        point = middle;
    }
    return unit;
}

} // namespace

Placement chooseUnit(const AssemblyCopies& assembly, std::vector<Ball>& out)
{
    Placement placement;
    placement.begin = {0};
    if (assembly.copies.empty()) return placement;
    const Copies copies(assembly);
    RotationGroup group;
    try {
        group = findRotationGroup(copies.used(), copies.box(0).getCenter());
    } catch (const Error& e) {
        throw Error(ErrorKind::Input,
                    assembly.title + "by symmetry: " + e.what() + " [hint: without `bySymmetry`]");
    }
    double deviation = 0.0;
    for (const auto& [orbit, i] : nearestOfOrbits(copies, group)) {
        const AssemblyCopy& copy = copies.at(i);
        appendCopy(copy.op, assembly.parts[copy.part], out);
        placement.begin.push_back(out.size());
        placement.numbers.push_back(copy.number);
        for (std::size_t k = 0; k < group.motions.size(); ++k)
            deviation =
                std::max(deviation, deviationOf(group.motions[k], copy.op,
                                                copies.at(group.images[k][i]).op, copies.box(i)));
    }
    constexpr double largest = 1.0; // [Å]
    if (deviation > largest)
        throw Error(
            ErrorKind::Input,
            assembly.title +
                formatted("by symmetry: its copies lie up to %.3g Å from where its rotations bring "
                          "them, expected at most %g Å [hint: without `bySymmetry`]",
                          deviation, largest));
    placement.unit = Placement::Unit{group.symmetry.pointGroup, group.symmetry.centre,
                                     placement.numbers.size(),  deviation,
                                     std::move(group.product),  std::move(group.inverse)};
    for (const Operator& motion : group.motions)
        placement.instances.push_back({motion, 0, motion.name});
    return placement;
}

void surround(double reach, BallSet& out)
{
    Placement& placement = out.placement;
    if (!placement.unit) return;
    const std::vector<Ball> unit = out.balls;
    const std::size_t copies = placement.numbers.size();
    const BallIndex index(unit, {0.0, 0.0, 6.0});
    std::vector<Vec3d> middles;
    std::vector<double> radii;
    for (std::size_t c = 0; c < copies; ++c) {
        const std::size_t begin = placement.begin[c], end = placement.begin[c + 1];
        const openvdb::BBoxd box = boxOf(unit.data() + begin, unit.data() + end);
        middles.push_back(begin < end ? box.getCenter() : Vec3d(0.0));
        radii.push_back(begin < end ? 0.5 * box.extents().length() : -1e9);
    }
    placement.motionOf.assign(unit.size(), 0);
    std::vector<Ball> images;
    std::vector<char> near;
    for (std::size_t m = 1; m < placement.instances.size(); ++m) {
        const Instance& motion = placement.instances[m];
        for (std::size_t c = 0; c < copies; ++c) {
            const Vec3d middle = motion.placed(middles[c]);
            bool close = false;
            for (std::size_t d = 0; d < copies && !close; ++d)
                close = (middle - middles[d]).length() < radii[c] + radii[d] + reach;
            if (!close) continue; // by balls about the boxes of copies
            images.assign(unit.begin() + std::ptrdiff_t(placement.begin[c]),
                          unit.begin() + std::ptrdiff_t(placement.begin[c + 1]));
            near.assign(images.size(), 0);
            tbb::parallel_for(std::size_t(0), images.size(), [&](std::size_t i) {
                const Vec3d x = motion.placed(Vec3d(images[i].center));
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
            placement.motionOf.resize(out.balls.size(), std::int32_t(m));
            placement.begin.push_back(out.balls.size());
            placement.numbers.push_back(placement.numbers[c]);
        }
    }
    placement.around = out.balls.size() - unit.size();
}

} // namespace molsurf
