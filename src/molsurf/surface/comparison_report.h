// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What a comparison tells: the content of its .json report.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

/// One of the two surfaces.
struct OperandReport {
    std::string input;
    std::string kind;             ///< "structure", "level set" or "mesh"
    std::size_t atoms = 0;        ///< of a structure
    double voxel = 0.0;           ///< [Å]; 0 for a mesh
    double area = 0.0;            ///< [Å^2]
    std::optional<double> volume; ///< [Å^3]; none if the surface is not closed
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    bool closed = false;
};

/// Distances of one surface's points from the other surface; means over the area.
struct OneWayReport {
    double mean = 0.0, rms = 0.0, max = 0.0; ///< [Å]
    std::array<double, 3> maxAt{};           ///< [Å]
    std::optional<double> meanSigned;        ///< [Å]; none if the other surface is not closed
    std::optional<double> inside;            ///< share of the area inside the other surface
    std::size_t samples = 0;
};

/// How the vertices are coloured.
struct ColorReport {
    std::string attribute; ///< "distance" or "signed_distance"
    std::string map;
    double low = 0.0, high = 0.0;                                    ///< [Å]
    std::vector<std::pair<double, std::array<std::uint8_t, 3>>> bar; ///< value [Å], colour
};

/// Everything in the .json report of a comparison.
struct ComparisonReport {
    std::string program = "vdb_molsurf";
    std::string version;
    std::string command;
    OperandReport a, b;
    OneWayReport aToB, bToA;
    double hausdorff = 0.0; ///< [Å]
    ColorReport color;
    std::vector<std::pair<std::string, double>> seconds; ///< stage, wall seconds; "total" last
    std::size_t peakMemoryBytes = 0;
    int threads = 0;
    std::vector<std::string> warnings;
};

} // namespace molsurf
