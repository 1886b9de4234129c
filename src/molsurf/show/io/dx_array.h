// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Numbers on a lattice as OpenDX text, as APBS writes and reads them.

#include "molsurf/show/io/output_buffer.h"

#include <openvdb/Types.h>

#include <array>
#include <cstdint>
#include <string>

namespace molsurf
{

/// Writes a lattice and its numbers: the last axis fastest, three a line.
class DxArray
{
public:
    /// @param[in] title   a line of comment
    /// @param[in] origin  place of the first number [Å]
    DxArray(const std::string& title, const std::array<int, 3>& points,
            const openvdb::Vec3d& origin, const openvdb::Vec3d& spacing, TextOutput& out)
        : out_(out)
    {
        const auto three = [&](const char* key, const auto& values) {
            out << key;
            for (std::size_t axis = 0; axis < 3; ++axis) out << " " << values[axis];
            out << "\n";
        };
        out << "# vdb_molsurf: " << title << "\n";
        three("object 1 class gridpositions counts", points);
        three("origin", std::array<double, 3>{origin[0], origin[1], origin[2]});
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::array<double, 3> step{};
            step[axis] = spacing[int(axis)];
            three("delta", step);
        }
        three("object 2 class gridconnections counts", points);
        out << "object 3 class array type double rank 0 items "
            << std::uint64_t(points[0]) * std::uint64_t(points[1]) * std::uint64_t(points[2])
            << " data follows\n";
    }

    template<typename Number>
    void add(Number value)
    {
        out_ << value << (++written_ % 3 == 0 ? "\n" : " ");
    }

    void finish()
    {
        out_ << (written_ % 3 == 0 ? "" : "\n") << "attribute \"dep\" string \"positions\"\n"
             << "object \"regular positions regular connections\" class field\n"
             << "component \"positions\" value 1\ncomponent \"connections\" value 2\n"
             << "component \"data\" value 3\n";
        out_.finish();
    }

private:
    TextOutput& out_;
    std::uint64_t written_ = 0;
};

} // namespace molsurf
