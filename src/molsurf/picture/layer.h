// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// What the rays of a picture meet.

#include "molsurf/color/crisp_borders.h"
#include "molsurf/mesh/ray_scene.h"
#include "molsurf/picture/atom_model.h"
#include "molsurf/picture/style.h"
#include "molsurf/picture/view.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace molsurf
{

constexpr std::size_t subpixels = 2; ///< a pixel is the mean of 2 x 2 rays
constexpr std::size_t eyeRays = subpixels * subpixels;

/// What one ray from the eye meets.
struct Seen {
    static constexpr float nothing = -std::numeric_limits<float>::infinity();
    static constexpr std::uint8_t cut = 255;  ///< `piece` of the inside, where it is cut
    static constexpr std::uint8_t atom = 254; ///< of what DrawOptions::model has

    float depth = nothing; ///< along toEye, from the center [Å]
    std::int16_t nx = 0,
                 ny = 0; ///< of the normal to the right and up, times 32767; it faces the eye
    Color color{};
    std::uint8_t piece = 0; ///< unlike that of other copies nearby

    bool any() const { return depth > nothing; }
    bool opaque() const { return piece >= atom; } ///< whatever the surface is
    openvdb::Vec3f normal() const;                ///< to the right, up, toward the eye
};

/// What is nearest in a pixel.
struct PixelLight {
    openvdb::Vec3f normal{0.0f}; ///< of what is nearest, as Seen::normal()
    float depth = Seen::nothing; ///< of that [Å]
    float open = 1.0f;           ///< share of the sky that is seen
    float lit = 1.0f;            ///< share of the lamp that is seen
    bool known = true;           ///< whether these are; else they are those of pixels about it
};

/// Everything that the eye sees, up to the first opaque thing.
struct Layer {
    std::vector<Seen> seen; ///< rows of samples, subpixels times as many both ways
    std::vector<PixelLight> lights;
    bool empty = true;
};

/// Triangles in Embree's hands, as they are or in copies.
struct Shapes {
    Shapes(const Mesh& mesh, const std::vector<MeshInstance>& instances);

    /// The copy that a ray has met; null: there are no copies.
    const MeshInstance* copyOf(const RTCRayHit4& rays, std::size_t s) const
    {
        return instances.empty() ? nullptr : &instances[rays.hit.instID[0][s]];
    }

    const Mesh& mesh;
    const std::vector<MeshInstance>& instances;
    std::vector<std::pair<std::size_t, std::size_t>> parts; ///< triangles [first, end)
    RayScene scene;
};

/// Sends rays. They go in packets of 4 and of 8, a quarter faster than one by one.
class Tracer
{
public:
    /// @param[in] view   of the same mesh; all arguments have to live as long
    /// @param[in] style  decides which rays are needed
    Tracer(const Mesh& mesh, const View& view, const PictureStyle& style,
           const DrawOptions& options);

    /// What stands first.
    Layer first(const Progress& progress) const;
    /// What stands behind that.
    Layer behind(const Layer& front, const Progress& progress) const;

    /// The lamp, as Seen::normal().
    static openvdb::Vec3f lamp();

private:
    /// The rays of a pixel.
    struct EyeRays {
        std::array<openvdb::Vec3d, eyeRays> from;
        alignas(16) std::array<int, eyeRays> valid; ///< -1, or 0: there is none
    };

    Layer trace(const Layer* front, const Progress& progress) const;
    void tracePixel(int x, int y, const Layer* front, Layer& layer) const;
    EyeRays from(int x, int y, const std::array<float, eyeRays>& depths) const;
    RTCRayHit4 meet(const Shapes& shapes, const EyeRays& eye) const;
    Seen hitOf(const RTCRayHit4& rays, std::size_t s, const openvdb::Vec3d& from) const;
    Seen atomOf(const RTCRayHit4& rays, std::size_t s, const openvdb::Vec3d& from) const;
    Seen facing(float depth, openvdb::Vec3d normal) const;
    Color colorAt(const std::uint32_t* corners, const openvdb::Vec3f& weights,
                  const openvdb::Vec3d& x) const;
    Color borderColor(const std::uint32_t* corners, const openvdb::Vec3d& x) const;
    float openness(const openvdb::Vec3d& at, const openvdb::Vec3d& normal, bool among,
                   int pattern) const;
    float lampShare(const openvdb::Vec3d& at, const openvdb::Vec3d& normal, bool among,
                    int pattern) const;
    template<std::size_t count, typename Rays>
    float freeShare(const std::array<double, count>& lengths, bool among, Rays& rays) const;
    double lengthTo(double length, const openvdb::Vec3d& from, const openvdb::Vec3d& way) const;

    const View& view_;
    const PictureStyle& style_;
    const DrawOptions& options_;
    Shapes surface_;
    std::optional<Shapes> atoms_;
    double top_; ///< depth where rays begin [Å]
    bool clips_; ///< whether that cuts the mesh
    openvdb::Vec3d lamp_;
    mutable std::vector<std::atomic<std::int32_t>> owners_; ///< of vertices, once known
};

} // namespace molsurf
