// SPDX-License-Identifier: MPL-2.0
#include "molsurf/selection/instance_assembly.h"

#include "molsurf/selection/expand_assembly.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace molsurf
{

namespace
{

/// What two operators have in common if they are the same motion, to 1e-4 of a rotation and 1e-3 Å.
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

InstancedBalls instanceAssembly(const Structure& structure, const std::string& name,
                                const CopyChoice& copies, const std::vector<Ball>& balls)
{
    const AssemblyCopies assembly = copiesOf(structure, name, copies, balls);
    // The parts that move together, motion by motion in the order of the file.
    struct Motion {
        const Operator* op;
        std::vector<std::size_t> parts;
    };
    std::vector<Motion> motions;
    std::map<MotionKey, std::size_t> motionOf;
    for (const AssemblyCopy& copy : assembly.copies) {
        const auto [found, isNew] = motionOf.emplace(keyOf(copy.op), motions.size());
        if (isNew) motions.push_back({&copy.op, {}});
        motions[found->second].parts.push_back(copy.part);
    }

    InstancedBalls out;
    out.begin = {0};
    out.unused = assembly.unused;
    std::map<std::vector<std::size_t>, std::size_t> prototypeOf;
    for (Motion& motion : motions) {
        std::sort(motion.parts.begin(), motion.parts.end());
        motion.parts.erase(std::unique(motion.parts.begin(), motion.parts.end()),
                           motion.parts.end());
        const auto [found, isNew] = prototypeOf.emplace(motion.parts, prototypeOf.size());
        if (isNew) {
            std::vector<char> taken(structure.atoms.size(), 0); // parts may share chains
            for (const std::size_t part : motion.parts) {
                for (const Ball& ball : assembly.parts[part])
                    if (!std::exchange(taken[std::size_t(ball.atom)], char{1}))
                        out.balls.push_back(ball);
            }
            out.begin.push_back(out.balls.size());
        }
        out.instances.push_back(
            {found->second, motion.op->name, motion.op->rotation, motion.op->translation});
    }
    return out;
}

} // namespace molsurf
