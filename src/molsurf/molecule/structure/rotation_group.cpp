// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/rotation_group.h"

#include "molsurf/error.h"

#include <openvdb/math/Mat3.h>

#include <numeric>
#include <utility>

namespace molsurf
{
namespace
{

using openvdb::Mat3d;
using openvdb::Vec3d;

/// Brings rotations that are a group but for rounding closer to one: the mean of R_(kl) R_l^T over
/// all l is R_k with errors of second order, which the nearest rotation makes smaller still.
void average(const std::vector<std::vector<std::size_t>>& product, std::vector<Mat3d>& rotations)
{
    const std::size_t order = rotations.size();
    std::vector<Mat3d> means(order, Mat3d::zero());
    for (std::size_t k = 0; k < order; ++k) {
        for (std::size_t l = 0; l < order; ++l)
            means[k] += rotations[product[k][l]] * rotations[l].transpose();
        means[k] = nearestRotation(means[k] * (1.0 / double(order)));
    }
    rotations = std::move(means);
}

} // namespace

RotationGroup findRotationGroup(const Assembly& assembly, const Vec3d& reference)
{
    RotationGroup group;
    group.symmetry = findSymmetry(assembly, reference);
    const Symmetry& symmetry = group.symmetry;
    const auto refuse = [](const std::string& why) { throw Error(ErrorKind::Input, why); };
    if (symmetry.order < 2)
        refuse(symmetry.helix ? "its operators are a helix with ends, no group of rotations"
                              : "its operators have no rotation axis in common");

    const std::vector<Operator> operators = operatorsOf(assembly);
    const std::size_t copies = operators.size();
    group.images.emplace_back(copies);
    std::iota(group.images[0].begin(), group.images[0].end(), std::size_t{0});
    for (const RotationAxis& axis : symmetry.axes)
        group.images.insert(group.images.end(), axis.images.begin(), axis.images.end());
    const std::size_t order = group.images.size();

    // Motions are told apart by where they take the first copy.
    std::vector<std::size_t> elementOf(copies, order);
    std::vector<Mat3d> rotations;
    const Mat3d back = nearestRotation(operators[0].matrix()).transpose();
    for (std::size_t k = 0; k < order; ++k) {
        const std::size_t to = group.images[k][0];
        if (std::exchange(elementOf[to], k) != order) refuse("its operators are no group");
        rotations.push_back(nearestRotation(operators[to].matrix()) * back);
    }
    group.product.assign(order, std::vector<std::size_t>(order));
    group.inverse.resize(order);
    for (std::size_t k = 0; k < order; ++k) {
        for (std::size_t l = 0; l < order; ++l) {
            const std::size_t m = elementOf[group.images[k][group.images[l][0]]];
            if (m == order) refuse("its operators are no group");
            group.product[k][l] = m;
            if (m == 0) group.inverse[k] = l;
        }
    }
    for (int i = 0; i < 3; ++i) average(group.product, rotations);

    for (std::size_t k = 0; k < order; ++k) {
        Operator& motion = group.motions.emplace_back();
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                motion.rotation[std::size_t(row)][std::size_t(column)] = rotations[k](row, column);
        motion.translation = symmetry.centre - rotations[k] * symmetry.centre;
        motion.name = std::to_string(k + 1);
    }
    group.orbitOf.assign(copies, copies);
    group.motionOf.assign(copies, 0);
    for (std::size_t i = 0; i < copies; ++i) {
        // There and back by a motion leads to the first of the copies that stand where copy i does.
        const std::size_t first = group.images[group.inverse[1]][group.images[1][i]];
        if (first != i || group.orbitOf[i] != copies) continue;
        for (std::size_t k = 0; k < order; ++k) {
            group.orbitOf[group.images[k][i]] = i;
            group.motionOf[group.images[k][i]] = k;
        }
    }
    return group;
}

} // namespace molsurf
