// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The report of a comparison, as JSON and as lines to read.

#include "molsurf/kernel/core/superposition.h"
#include "molsurf/mesh.h"
#include "molsurf/show/color/color_map.h"
#include "molsurf/show/color/legend.h"
#include "molsurf/show/io/output_file.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

/// One of the two surfaces.
struct ComparedFile {
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

/// The report of a comparison: the content of its .json file.
struct ComparisonReport {
    std::string program = "vdb_molsurf";
    std::string version;
    std::string command;
    ComparedFile a, b;
    Comparison distances;
    std::optional<Superposition> superposition{}; ///< that laid B on A
    std::string shown; ///< quantity that the colours show: "distance" or "signed_distance"
    ColorScale color;
    std::vector<std::pair<std::string, double>> seconds; ///< stage, wall seconds; "total" last
    std::size_t peakMemoryBytes = 0;
    int threads = 0;
    std::vector<std::string> warnings;
};

/// The report as JSON text, indented, with a final line feed. Undefined numbers are null.
std::string comparisonText(const ComparisonReport& report);

/// Writes comparisonText().
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeComparison(const ComparisonReport& report, OutputFile& file);

/// A table of the numbers, some ten lines.
std::string comparisonTable(const ComparisonReport& report);

/// Chooses the scale of the colours.
/// @param[in] bySign  whether they show the signed distance
/// @param[in] range   distance at the end of the colours [Å]; 0: that of 99 % of the vertices
/// @param[in] palette  that there is; empty: light where the surfaces agree
void chooseColors(bool bySign, double range, const std::string& palette, ComparisonReport& report);

/// The mesh of A with the distances of its vertices from B, and their colours.
Mesh comparisonMesh(const Mesh& a, const ComparisonReport& report);

/// The legend of these colours.
Legend comparisonLegend(const ComparisonReport& report);

/// Writes the mesh of A with the distances of its vertices from B, and their colours, as .ply. A
/// comment in the file has the scale.
void writeComparisonMesh(const Mesh& a, const ComparisonReport& report, OutputFile& file);

} // namespace molsurf
