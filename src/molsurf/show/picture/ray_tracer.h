// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The surfaces that the rays of a picture meet.

#include "molsurf/analysis/proximity/ray_scene.h"
#include "molsurf/show/color/crisp_borders.h"
#include "molsurf/show/picture/atom_model.h"
#include "molsurf/show/picture/style.h"
#include "molsurf/show/picture/view.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace molsurf
{

constexpr int subpixels = 2; ///< a pixel is the mean of 2 x 2 samples
constexpr std::size_t samplesPerPixel = std::size_t(subpixels * subpixels);

/// Whether there are fewer rays than samples: more are not seen in wide pictures, nor where pixels
/// are small beside an atom. At 0.25 Å the means of such pictures differ by 1.6 of 255, at 0.14 Å
/// by 1.3 (4AT1 by chain at 500 and 800 pixels).
inline bool isSparse(const DrawOptions& options, const View& view)
{
    constexpr int widestDense = 1000;    // [pixel]
    constexpr double finestDense = 0.25; // [Å]
    return options.quick || options.width > widestDense || view.pixel < finestDense;
}

/// Every which pixel, both ways, asks for its light.
inline int lightStep(const DrawOptions& options, const View& view)
{
    return isSparse(options, view) ? 2 : 1;
}

/// A normal that faces the eye.
inline openvdb::Vec3f normalOf(std::int16_t nx, std::int16_t ny)
{
    const float x = float(nx) / 32767.0f, y = float(ny) / 32767.0f;
    return {x, y, std::sqrt(std::max(0.0f, 1.0f - x * x - y * y))};
}

/// The nearest point in one place of a picture.
struct Seen {
    static constexpr float nothing = -std::numeric_limits<float>::infinity();
    static constexpr std::uint8_t cut = 255;        ///< `piece` of the inside, where it is cut
    static constexpr std::uint8_t atom = 254;       ///< of what DrawOptions::model has
    static constexpr std::uint8_t bodyInside = 253; ///< of a body behind a wall of the surface
    static constexpr std::uint8_t body = 252;       ///< of a body before any wall of it

    float depth = nothing; ///< along toEye, from the center [Å]
    std::int16_t nx = 0,
                 ny = 0; ///< of the normal to the right and up, times 32767; it faces the eye
    Color color{};
    std::uint8_t piece = 0; ///< unlike that of other copies nearby

    bool any() const { return depth > nothing; }
    bool opaque() const { return piece >= atom; } ///< whatever the surface is
    bool ofBody() const { return piece == body || piece == bodyInside; }
    /// To the right, up, toward the eye.
    openvdb::Vec3f normal() const { return normalOf(nx, ny); }
};

/// The nearest point in a pixel, and its light if the pixel asks for it: there are millions of
/// them.
struct PixelLight {
    static constexpr std::size_t skyRays = 8, lampRays = 4;

    float depth = Seen::nothing;     ///< of what is nearest [Å]
    std::int16_t nx = 0, ny = 0;     ///< of its normal, as Seen has it
    std::uint8_t openRays = skyRays, ///< rays that reach the sky
        litRays = lampRays;          ///< rays that reach the lamp

    openvdb::Vec3f normal() const { return normalOf(nx, ny); }
    float open() const { return float(openRays) / float(skyRays); } ///< share of the sky
    float lit() const { return float(litRays) / float(lampRays); }  ///< share of the lamp
};

/// Everything that the eye sees, up to the first opaque thing.
struct Layer {
    std::vector<Seen> seen; ///< rows of samples, subpixels times as many both ways
    std::vector<PixelLight> lights;
    bool empty = true;
};

/// Four samples, by their places in Layer::seen.
using Places = std::array<std::size_t, 4>;

/// The mean of samples that see nearly the same, or all see nothing.
Seen meanOf(const Layer& layer, const Places& places);

/// Triangles in Embree's hands, as they are or in copies.
struct Shapes {
    /// @param[in] some  of the triangles, those that rays meet; empty: all
    Shapes(const Mesh& mesh, const std::vector<MeshInstance>& instances,
           RayScene::Triangles some = {});

    /// The copy that a ray has met; null: there are no copies.
    const MeshInstance* copyOf(const RTCRayHit4& rays, std::size_t s) const
    {
        return instances.empty() ? nullptr : &instances[rays.hit.instID[0][s]];
    }

    /// The triangle that a ray has met.
    const auto& triangleOf(const RTCRayHit4& rays, std::size_t s) const
    {
        const std::size_t first = instances.empty() ? 0 : parts[copyOf(rays, s)->part].first;
        return (kept.empty() ? mesh.triangles : kept)[first + rays.hit.primID[s]];
    }

    const Mesh& mesh;
    const std::vector<MeshInstance>& instances;
    RayScene::Triangles kept;                               ///< those in the scene; empty: all
    std::vector<std::pair<std::size_t, std::size_t>> parts; ///< triangles [first, end)
    RayScene scene;
};

/// Atoms in Embree's hands.
struct AtomShapes {
    explicit AtomShapes(const AtomModel& atoms);

    const AtomModel& model;
    RayScene scene;
};

/// Sends rays. They go in packets of 4 and of 8, a quarter faster than one by one.
class Tracer
{
    static constexpr std::size_t packet = 4;

public:
    /// @param[in] view   of the same mesh; all arguments have to live as long
    /// @param[in] style  decides which rays are needed
    Tracer(const Mesh& mesh, const View& view, const PictureStyle& style,
           const DrawOptions& options);

    /// The nearest layer.
    Layer first(const Progress& progress) const;
    /// The layer behind another.
    Layer behind(const Layer& front, const Progress& progress) const;

    /// The lamp, as Seen::normal().
    static openvdb::Vec3f lamp();

private:
    /// A packet of rays.
    struct EyeRays {
        std::array<openvdb::Vec3d, packet> from;
        alignas(16) std::array<int, packet> valid; ///< -1, or 0: there is none
    };
    /// Where samples are, from the upper left corner: column and row.
    using Samples = std::vector<std::array<int, 2>>;

    Layer trace(const Layer* front, const Progress& progress) const;
    std::size_t placeOf(int column, int row) const
    {
        return std::size_t(row) * std::size_t(subpixels * view_.width) + std::size_t(column);
    }
    void look(const Samples& samples, const Layer* front, Layer& layer) const;
    void lookBetween(int y, Layer& layer) const;
    std::optional<Places> sentAbout(int column, int row) const;
    bool areAlike(const Layer& layer, const Places& places) const;
    EyeRays from(const std::array<int, 2>* samples, const std::array<float, packet>& depths) const;
    RTCRayHit4 meet(const RayScene& scene, const EyeRays& eye) const;
    PixelLight lightOf(int x, int y, bool isFirst, const Layer& layer) const;
    Seen hitOf(const RTCRayHit4& rays, std::size_t s, const openvdb::Vec3d& from) const;
    Seen atomOf(const RTCRayHit4& rays, std::size_t s, const openvdb::Vec3d& from) const;
    Seen bodyOf(const RTCRayHit4& rays, std::size_t s, const openvdb::Vec3d& from) const;
    Seen facing(float depth, openvdb::Vec3d normal) const;
    Color colorAt(const std::uint32_t* corners, const openvdb::Vec3f& weights,
                  const openvdb::Vec3d& x) const;
    Color borderColor(const std::uint32_t* corners, const openvdb::Vec3d& x) const;
    std::uint8_t skyRaysAt(const openvdb::Vec3d& at, const openvdb::Vec3d& normal, bool among,
                           int pattern) const;
    std::uint8_t lampRaysAt(const openvdb::Vec3d& at, const openvdb::Vec3d& normal, bool among,
                            int pattern) const;
    template<std::size_t count, typename Rays>
    std::uint8_t freeRays(const std::array<double, count>& lengths, bool among, Rays& rays) const;
    double lengthTo(double length, const openvdb::Vec3d& from, const openvdb::Vec3d& way) const;

    const View& view_;
    const PictureStyle& style_;
    const DrawOptions& options_;
    Shapes surface_;
    std::optional<AtomShapes> atoms_;
    std::optional<Shapes> bodies_;
    double top_; ///< depth where rays begin [Å]
    bool clips_; ///< whether that cuts the mesh
    openvdb::Vec3d lamp_;
    mutable std::vector<std::atomic<std::int32_t>> owners_; ///< of vertices, once known
};

} // namespace molsurf
