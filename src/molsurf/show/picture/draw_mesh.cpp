// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/draw_mesh.h"

#include "molsurf/kernel/core/parallel.h"
#include "molsurf/show/picture/draw_notes.h"
#include "molsurf/show/picture/outline.h"
#include "molsurf/show/picture/ray_tracer.h"
#include "molsurf/show/picture/style.h"
#include "molsurf/show/picture/view.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace molsurf
{

using openvdb::Vec3f;

namespace
{

constexpr float farthestFade = 0.22f; // of a depth cue
constexpr double outlinePixels = 8;   // least jump in depth that gets an outline, in pixels,
constexpr double outlineLength = 2;   // and in Å
constexpr float creaseCosine = 0.6f;  // of the normals at a crease, at most
constexpr int mostLayers = 12;        // of things that let light through
constexpr float bodyOpacity = 0.2f;   // of one wall of a body, seen from the front
constexpr float inkLight = 0.004f;    // of black lines
constexpr float faint = 1e-3f;        // share of light that is not followed any more

enum Edge : std::uint8_t { None, Jump, Crease };

/// fromLinearLight() of a table.
std::uint8_t byteOf(float light)
{
    constexpr int last = 1 << 15;
    static const std::vector<std::uint8_t> bytes = [] {
        std::vector<std::uint8_t> all;
        for (int i = 0; i <= last; ++i) all.push_back(fromLinearLight(double(i) / last));
        return all;
    }();
    return bytes[std::size_t(std::clamp(light, 0.0f, 1.0f) * float(last) + 0.5f)];
}

/// Light from a pixel, already times its cover, which is the share that it hides of what is behind.
struct Light {
    Vec3f light{0.0f};
    float cover = 0.0f;

    /// The compositing "over" of Porter and Duff.
    void addBehind(const Light& other)
    {
        light += (1.0f - cover) * other.light;
        cover += (1.0f - cover) * other.cover;
    }
};

/// Turns layers into light.
class Painter
{
    /// Shares of the sky and of the lamp that are seen.
    struct Shade {
        float open = 1.0f, lit = 1.0f;
    };

public:
    Painter(const View& view, const PictureStyle& style, const DrawOptions& options)
        : view_(view), style_(style), options_(options),
          background_(linearLight(options.background))
    {
        half_ = (lamp_ + Vec3f(0.0f, 0.0f, 1.0f)).unit();
    }

    /// Adds a layer behind those before.
    void add(const Layer& layer, const Progress& progress, std::vector<Light>& lights) const
    {
        const std::vector<std::uint8_t> ink = linesOf(layer, progress);
        parallelFor(std::size_t(view_.height), progress, [&](std::size_t y) {
            for (int x = 0; x < view_.width; ++x)
                lights[placeOf(x, int(y))].addBehind(pixelOf(layer, ink, x, int(y)));
        });
    }

private:
    std::size_t placeOf(int x, int y) const
    {
        return std::size_t(y) * std::size_t(view_.width) + std::size_t(x);
    }

    std::size_t columns() const { return std::size_t(subpixels * view_.width); }

    /// The mean of a pixel's samples, each with the ink of lines over its colour.
    /// @param[in] ink  of samples, from 0 to 255; empty: there are no lines
    Light pixelOf(const Layer& layer, const std::vector<std::uint8_t>& ink, int x, int y) const
    {
        const std::size_t first =
            std::size_t(subpixels * y) * columns() + std::size_t(subpixels * x);
        const Places places = {first, first + 1, first + columns(), first + columns() + 1};
        const auto isDrawn = [&](std::size_t n) { return !ink.empty() && ink[n] > 0; };
        const bool drawn = std::any_of(places.begin(), places.end(), isDrawn);
        const bool any = std::any_of(places.begin(), places.end(),
                                     [&](std::size_t n) { return layer.seen[n].any(); });
        if (!any && !drawn) return {};
        const Shade shared = smoothed(layer, x, y);
        if (!drawn && areNearlyOne(layer, places)) return lightOf(meanOf(layer, places), shared);
        Light out;
        for (const std::size_t n : places) {
            const Seen& seen = layer.seen[n];
            const float line = isDrawn(n) ? style_.ink * float(ink[n]) / 255.0f : 0.0f;
            Light one = seen.any() ? lightOf(seen, shared) : Light();
            one.light = (1.0f - line) * one.light + Vec3f(line * inkLight);
            one.cover = 1.0f - (1.0f - one.cover) * (1.0f - line);
            out.light += one.light / float(samplesPerPixel);
            out.cover += one.cover / float(samplesPerPixel);
        }
        return out;
    }

    /// Whether the light of samples is that of their mean, to less than a step of a byte.
    bool areNearlyOne(const Layer& layer, const Places& places) const
    {
        constexpr int turned = 32767 / 10, shades = 4; // of normals and colours
        const Seen& one = layer.seen[places[0]];
        if (opacityOf(one) < 1.0f) return false; // that of the others may be another
        return std::all_of(places.begin(), places.end(), [&](std::size_t n) {
            const Seen& seen = layer.seen[n];
            bool near = seen.any() && seen.piece == one.piece &&
                        std::max(std::abs(seen.nx - one.nx), std::abs(seen.ny - one.ny)) <= turned;
            for (std::size_t k = 0; k < 3; ++k)
                near = near && std::abs(int(seen.color[k]) - int(one.color[k])) <= shades;
            return near;
        });
    }

    Light lightOf(const Seen& seen, const Shade& shared) const
    {
        const float cover = opacityOf(seen);
        return {cover * colorOf(seen, shared), cover};
    }

    /// The law of Beer and Lambert for a thin skin: a slanted ray goes 1 / cosine as far in it.
    float opacityOf(const Seen& seen) const
    {
        const bool solid = options_.glass && seen.color != *options_.glass;
        const float opacity = seen.ofBody() ? bodyOpacity : float(options_.opacity);
        if (opacity >= 1.0f || seen.opaque() || (solid && !seen.ofBody())) return 1.0f;
        const float facing = std::max(seen.normal()[2], 0.05f);
        return 1.0f - std::pow(1.0f - opacity, 1.0f / facing);
    }

    /// The light of a sample: sky, lamp and a fill light by Lambert's law, a highlight of the lamp
    /// by Blinn and Phong, and fading with depth. A style without sky has plain colours.
    Vec3f colorOf(const Seen& seen, const Shade& shared) const
    {
        Vec3f color = linearLight(seen.color);
        if (style_.sky > 0.0f) {
            const Vec3f normal = seen.normal();
            const Vec3f fill = Vec3f(0.75f, 0.1f, 0.65f);
            const float seenLamp = 1.0f - style_.shadow * (1.0f - shared.lit);
            const float key = std::max(0.0f, normal.dot(lamp_)) * seenLamp;
            // Walls that hide the sky give back less the deeper the hollow is: the share of sky
            // counts with the power 1.5, and dims lamp and fill too.
            const float open = shared.open * std::sqrt(shared.open);
            const float hollow = 0.4f + 0.6f * open;
            const float light =
                style_.sky * (0.06f + 0.94f * open) +
                hollow * (style_.key * key + style_.fill * std::max(0.0f, normal.dot(fill)));
            const float mirrored = style_.highlight * seenLamp * open *
                                   std::pow(std::max(0.0f, normal.dot(half_)), style_.gloss);
            color = light * color + Vec3f(mirrored);
        }
        if (!options_.depthCue) return color;
        const double behind = (view_.far - double(seen.depth)) / (view_.far - view_.low);
        const float haze = farthestFade * float(std::clamp(behind, 0.0, 1.0));
        return (1.0f - haze) * color + haze * background_;
    }

    /// The light of a pixel by a bilateral filter: the mean of the pixels with rays about it, up to
    /// 5 x 5, less of those that face elsewhere or lie at another depth. Those at its rim count
    /// half, so that all sixteen patterns of rays weigh the same.
    Shade smoothed(const Layer& layer, int x, int y) const
    {
        const PixelLight& here = layer.lights[placeOf(x, y)];
        const Vec3f normal = here.normal();
        if (here.depth == Seen::nothing || style_.sky == 0.0f) return {here.open(), here.lit()};
        const int step = lightStep(options_, view_), reach = 2 * step;
        const auto firstFrom = [&](int place) {
            return (std::max(place, 0) + step - 1) / step * step;
        };
        const float deepest = float(4.0 * reach * view_.pixel);
        float open = 0.0f, lit = 0.0f, weights = 0.0f;
        const int right = std::min(x + reach, view_.width - 1);
        const int bottom = std::min(y + reach, view_.height - 1);
        for (int j = firstFrom(y - reach); j <= bottom; j += step) {
            for (int i = firstFrom(x - reach); i <= right; i += step) {
                const PixelLight& other = layer.lights[placeOf(i, j)];
                if (other.depth == Seen::nothing) continue;
                const float alike = other.normal().dot(normal);
                // Those that face elsewhere count a little, lest a single one be a speck.
                float weight = std::clamp(2.5f * (alike - 0.5f), 0.1f, 1.0f);
                if (std::abs(other.depth - here.depth) > deepest)
                    weight = 1e-6f; // which counts only if there is no other
                for (const int d : {i - x, j - y})
                    if (d == reach || d == -reach) weight *= 0.5f;
                open += weight * other.open();
                lit += weight * other.lit();
                weights += weight;
            }
        }
        if (weights == 0.0f) return {here.open(), here.lit()};
        return {open / weights, lit / weights};
    }

    /// The edge between two neighbours, the first of which is not farther away.
    Edge edgeOf(const Seen& near, const Seen& far, float jump) const
    {
        if (!far.any() || near.depth - far.depth > jump) return Jump;
        if ((near.piece == Seen::cut) != (far.piece == Seen::cut)) return Jump;
        if (style_.crease == 0.0f) return None;
        if (near.piece != far.piece || near.normal().dot(far.normal()) < creaseCosine)
            return Crease;
        return options_.borders && near.color != far.color ? Crease : None;
    }

    /// The ink of lines along the near side of edges.
    std::vector<std::uint8_t> linesOf(const Layer& layer, const Progress& progress) const
    {
        const float scale = 0.5f * float(subpixels) * float(view_.width) / 1000.0f;
        // By Edge [sample]; styles give widths in pixels of a picture that is 1000 wide.
        const std::vector<float> radii = {0.0f, scale * style_.outline, scale * style_.crease};
        if (radii[Jump] == 0.0f && radii[Crease] == 0.0f) return {};
        const float jump = float(std::max(outlinePixels * view_.pixel, outlineLength));
        std::vector<std::uint8_t> edges(layer.seen.size(), None);
        const std::size_t width = columns(), height = layer.seen.size() / width;
        parallelFor(height, progress, [&](std::size_t y) {
            for (std::size_t x = 0; x < width; ++x) {
                const std::size_t n = y * width + x;
                const Seen& here = layer.seen[n];
                if (!here.any()) continue;
                const auto look = [&](bool there, std::size_t other) {
                    if (!there || edges[n] == Jump) return;
                    const Seen& seen = layer.seen[other];
                    if (seen.depth > here.depth) return;
                    const Edge edge = edgeOf(here, seen, jump);
                    if (edge == Jump || edges[n] == None) edges[n] = edge;
                };
                look(x > 0, n - 1);
                look(x + 1 < width, n + 1);
                look(y > 0, n - width);
                look(y + 1 < height, n + width);
            }
        });
        return inkOf(width, edges, radii, progress);
    }

    const View& view_;
    const PictureStyle& style_;
    const DrawOptions& options_;
    const Vec3f lamp_ = Tracer::lamp();
    Vec3f background_, half_;
};

/// A picture without anything in it.
Picture blank(const DrawOptions& options, int height)
{
    Picture picture;
    picture.width = options.width;
    picture.height = height;
    picture.dpi = options.dpi;
    const auto pixels = std::size_t(options.width) * std::size_t(height);
    picture.rgb.reserve(3 * pixels);
    for (std::size_t n = 0; n < pixels; ++n)
        picture.rgb.insert(picture.rgb.end(), options.background.begin(), options.background.end());
    if (options.transparent) picture.alpha.resize(pixels, 0);
    return picture;
}

/// Depth peeling: layers from front to back, each composed behind those before; background last.
Picture drawShot(const Mesh& mesh, const View& view, const DrawOptions& options,
                 const Progress& progress)
{
    const PictureStyle& style = options.style ? *options.style : styleTable().front();
    std::vector<Light> lights;
    {
        const bool bodies = options.model && !options.model->bodies.mesh.triangles.empty();
        const bool behind = options.opacity < 1.0 && (options.showBehind || options.model);
        const bool many = bodies || (options.opacity < 1.0 && options.showBehind);
        const int layers = many ? mostLayers : behind ? 2 : 1;
        std::optional<Tracer> tracer(std::in_place, mesh, view, style, options);
        const Painter painter(view, style, options);
        Layer layer = tracer->first(progress);
        if (layers == 1) tracer.reset(); // lines need its memory
        lights.resize(std::size_t(view.width) * std::size_t(view.height));
        painter.add(layer, progress, lights);
        for (int n = 1; n < layers && !layer.empty; ++n) {
            layer = tracer->behind(layer, progress);
            painter.add(layer, progress, lights);
        }
    }
    const Vec3f background = linearLight(options.background);
    Picture picture = blank(options, view.height);
    picture.pixel = view.pixel;
    parallelFor(std::size_t(view.height), progress, [&](std::size_t y) {
        for (std::size_t n = y * std::size_t(view.width); n < (y + 1) * std::size_t(view.width);
             ++n) {
            const Light& light = lights[n];
            if (light.cover < faint) continue;
            Vec3f color = light.light;
            if (options.transparent) {
                color /= light.cover;
                picture.alpha[n] = std::uint8_t(std::lround(255.0f * std::min(light.cover, 1.0f)));
            } else {
                color += (1.0f - light.cover) * background;
            }
            for (std::size_t c = 0; c < 3; ++c) picture.rgb[3 * n + c] = byteOf(color[int(c)]);
        }
    });
    drawNotes(options.notes, view, options.whole > 0 ? options.whole : options.width, picture);
    return picture;
}

} // namespace

Picture drawMesh(const Mesh& mesh, const DrawOptions& options, const Progress& progress)
{
    if (mesh.triangles.empty()) return blank(options, options.width);
    const View view = chooseView(mesh, options);
    const std::optional<double> clip = clipBefore(mesh, view, options);
    if (!clip) return drawShot(mesh, view, options, progress);
    DrawOptions cut = options;
    cut.clip = clip;
    return drawShot(mesh, view, cut, progress);
}

} // namespace molsurf
