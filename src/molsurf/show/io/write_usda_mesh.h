// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A mesh as a scene of OpenUSD, and a film of meshes.

#include "molsurf/mesh.h"
#include "molsurf/show/io/output_file.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

/// A frame of a film.
struct UsdFrame {
    int time = 0;
    int number = 0;      ///< in the input
    std::string options; ///< `frames.options` of the film that it belongs to
    double framesPerSecond = 24.0;
    double velocityFactor = 1.0; ///< that makes v_x, v_y and v_z of the mesh Å per second
};

/// The scene of a mesh.
struct UsdScene {
    std::string name = "surface"; ///< of the prim; letters that USD does not take become _
    double scale = 1.0;           ///< scene units per Å, in the prim; metersPerUnit follows
    std::array<std::uint8_t, 3> color{255, 255, 255}; ///< of a mesh without colours
    std::vector<std::string> fields{}; ///< scalars of vertices that are wanted, by name
    std::optional<UsdFrame> frame{};
};

/// Writes USD as text: an Xform of kind component with a Mesh for each part, up is z. The values of
/// a frame are samples at its time, so that the file is a clip of writeUsdaFilm().
///
/// @param[in] mesh  with normals; of a frame without parts; positions below 1e6 Å
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeUsdaMesh(const Mesh& mesh, const UsdScene& scene, OutputFile& file);

/// Writes the film that plays frames: a Mesh without values, which come from a value clip a frame.
/// The topology may change from one to the next; `velocities` are for the blur.
///
/// @param[in] mesh    of one frame
/// @param[in] frames  times and files that writeUsdaMesh() has made, in this order
void writeUsdaFilm(const Mesh& mesh, const UsdScene& scene,
                   const std::vector<std::pair<int, std::string>>& frames, OutputFile& file);

/// Whether a file is one that writeUsdaFilm() has made.
bool isOwnFilm(const std::string& path);

} // namespace molsurf
