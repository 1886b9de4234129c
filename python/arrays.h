// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Vectors as NumPy arrays and back. The Python part of the module has checked what comes in.

#include <molsurf/molsurf.h>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace molsurf::python
{

namespace nb = nanobind;

namespace
{

using Positions = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Numbers = nb::ndarray<const double, nb::shape<-1>, nb::c_contig, nb::device::cpu>;
using Floats3 = nb::ndarray<const float, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Whole3 = nb::ndarray<const std::int32_t, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

/// An array of T over the values of a vector, (n,) or (n, k), which the owner keeps.
template<typename T, typename V>
nb::object view(std::vector<V>& values, nb::handle owner)
{
    static_assert(sizeof(V) % sizeof(T) == 0);
    static T nothing{};
    constexpr std::size_t k = sizeof(V) / sizeof(T);
    const std::size_t shape[2] = {values.size(), k};
    void* data = values.empty() ? static_cast<void*>(&nothing) : values.data();
    return nb::cast(nb::ndarray<nb::numpy, T>(data, k == 1 ? 1 : 2, shape, owner));
}

/// An array that owns the values of a vector.
template<typename T, typename V>
nb::object owned(std::vector<V>&& values)
{
    auto kept = std::make_unique<std::vector<V>>(std::move(values));
    std::vector<V>& vector = *kept;
    const nb::capsule owner(kept.get(),
                            [](void* p) noexcept { delete static_cast<std::vector<V>*>(p); });
    kept.release();
    return view<T>(vector, owner);
}

/// Numbers of the balls that a surface is of; read-only where others repeat them, which would not
/// follow.
/// @param[in] first    that of the first ball
/// @param[in] columns  1 or 3 of each
inline nb::object columnsOf(BallSet& atoms, double* first, std::size_t columns, nb::handle owner)
{
    static_assert(sizeof(Ball) % sizeof(double) == 0);
    static double nothing[3];
    const std::size_t shape[2] = {atoms.own(), columns}, axes = columns == 1 ? 1 : 2;
    const std::int64_t strides[2] = {std::int64_t(sizeof(Ball) / sizeof(double)), 1};
    double* const data = atoms.balls.empty() ? nothing : first;
    if (atoms.placement.isWhole())
        return nb::cast(nb::ndarray<nb::numpy, double>(data, axes, shape, owner, strides));
    return nb::cast(nb::ndarray<nb::numpy, const double>(data, axes, shape, owner, strides));
}

/// @param[in] radii  one a position
inline std::vector<Ball> ballsOf(const Positions& positions, const Numbers& radii)
{
    std::vector<Ball> balls(positions.shape(0));
    const double* x = positions.data();
    for (std::size_t i = 0; i < balls.size(); ++i, x += 3)
        balls[i] = {{x[0], x[1], x[2]}, radii.data()[i], std::int32_t(i)};
    return balls;
}

/// A table as a dict of arrays; texts are lists, which the Python part makes arrays of.
inline nb::dict dictOf(Table&& table)
{
    nb::dict out;
    for (Table::Column& column : table.columns) {
        nb::object values;
        if (auto* texts = std::get_if<std::vector<std::string>>(&column.values))
            values = nb::cast(*texts);
        else if (auto* whole = std::get_if<std::vector<std::int64_t>>(&column.values))
            values = owned<std::int64_t>(std::move(*whole));
        else
            values = owned<double>(std::move(std::get<std::vector<double>>(column.values)));
        out[column.name.c_str()] = values;
    }
    return out;
}

} // namespace

} // namespace molsurf::python
