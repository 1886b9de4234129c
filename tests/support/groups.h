// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Operators of made-up assemblies: point groups from their generators, helices.

#include "molsurf/molecule/structure/assembly_operators.h"

#include <openvdb/math/Mat3.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace molsurf::test
{

const double golden = 0.5 * (1.0 + std::sqrt(5.0));

/// The rotation by an angle [rad] about an axis through the origin, then a shift.
inline Operator turn(const openvdb::Vec3d& axis, double angle,
                     const openvdb::Vec3d& shift = openvdb::Vec3d(0.0))
{
    // OpenVDB's rotation matrices are for row vectors.
    const auto m = openvdb::math::rotation<openvdb::Mat3d>(axis.unit(), -angle);
    Operator op{};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) op.rotation[std::size_t(i)][std::size_t(j)] = m(i, j);
    }
    op.translation = shift;
    return op;
}

inline Operator inverseOf(const Operator& op)
{
    return {op.inverse(), ""};
}

/// All products of the generators, the identity first.
inline std::vector<Operator> groupOf(const std::vector<Operator>& generators)
{
    std::vector<Operator> all{turn({0, 0, 1}, 0.0)};
    auto isNew = [&](const Operator& op) {
        const openvdb::Vec3d x(1.0, 2.0, 4.0); // in general position
        return std::none_of(all.begin(), all.end(), [&](const Operator& other) {
            return (op.placed(x) - other.placed(x)).length() < 1e-6;
        });
    };
    for (std::size_t i = 0; i < all.size() && all.size() < 100; ++i) {
        for (const Operator& generator : generators) {
            const Operator product = multiplied(generator, all[i]);
            if (isNew(product)) all.push_back(product);
        }
    }
    return all;
}

inline std::vector<Operator> cyclic(int n)
{
    return groupOf({turn({0, 0, 1}, 2 * M_PI / n)});
}
inline std::vector<Operator> dihedral(int n)
{
    return groupOf({turn({0, 0, 1}, 2 * M_PI / n), turn({1, 0, 0}, M_PI)});
}
inline std::vector<Operator> tetrahedral()
{
    return groupOf({turn({1, 1, 1}, 2 * M_PI / 3), turn({0, 0, 1}, M_PI)});
}
inline std::vector<Operator> octahedral()
{
    return groupOf({turn({1, 1, 1}, 2 * M_PI / 3), turn({0, 0, 1}, M_PI / 2)});
}

/// Five-fold axes through (0, +-1, +-golden) and its cyclic permutations, two-fold ones along the
/// axes of coordinates.
inline std::vector<Operator> icosahedral()
{
    return groupOf({turn({0, 1, golden}, 2 * M_PI / 5), turn({0, 0, 1}, M_PI)});
}

/// Screws along z: rise [Å], twist [rad].
inline std::vector<Operator> helix(int copies, double rise, double twist)
{
    std::vector<Operator> all;
    for (int i = 0; i < copies; ++i) {
        all.push_back(turn({0, 0, 1}, i * twist, openvdb::Vec3d(0, 0, i * rise)));
    }
    return all;
}

/// Numbers them as a file does.
inline Assembly assemblyOf(std::vector<Operator> operators)
{
    for (std::size_t i = 0; i < operators.size(); ++i) operators[i].name = std::to_string(i + 1);
    return {"1", {{{}, std::move(operators)}}, {}};
}

} // namespace molsurf::test
