// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Rotations as scene files take them.

#include <boost/qvm/mat.hpp>
#include <boost/qvm/quat.hpp>
#include <boost/qvm/quat_operations.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace molsurf
{

/// The unit quaternion x, y, z, w (w real) of a rotation matrix, which may be rounded as in files.
/// @param[in] rotation  rows
inline std::array<double, 4> quaternionOf(const std::array<std::array<double, 3>, 3>& rotation)
{
    boost::qvm::mat<double, 3, 3> matrix;
    for (std::size_t row = 0; row < 3; ++row)
        std::copy(rotation[row].begin(), rotation[row].end(), matrix.a[row]);
    auto q = boost::qvm::convert_to<boost::qvm::quat<double>>(matrix);
    boost::qvm::normalize(q);
    return {q.a[1], q.a[2], q.a[3], q.a[0]};
}

} // namespace molsurf
