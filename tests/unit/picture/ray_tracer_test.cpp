// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/ray_tracer.h"

#include "unit/picture/add_ball.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

constexpr Color gray = {128, 128, 128};
constexpr std::array<std::array<double, 3>, 3> unturned = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Adds a rectangle that is seen from above; its normals are what is asked.
void addPlate(Mesh& mesh, float left, float right, float z, const Vec3f& normal = {0, 0, 1})
{
    const auto first = std::uint32_t(mesh.positions.size());
    for (const float x : {left, right})
        for (const float y : {-5.0f, 5.0f}) mesh.positions.push_back({x, y, z});
    mesh.normals.resize(first + 4, normal);
    mesh.colors.resize(first + 4, gray);
    mesh.triangles.push_back({first, first + 2, first + 1});
    mesh.triangles.push_back({first + 1, first + 2, first + 3});
}

/// Seen from above.
struct LayerTest : testing::Test {
    Mesh mesh;
    DrawOptions options;
    LayerTest()
    {
        options.toEye = {0, 0, 1};
        options.up = {0, 1, 0};
        options.style = findStyle("soft");
    }

    struct Layers {
        View view;
        Layer first, behind;
    };
    Layers traced() const
    {
        Layers out{chooseView(mesh, options), {}, {}};
        const Tracer tracer(mesh, out.view, *options.style, options);
        out.first = tracer.first(Progress());
        out.behind = tracer.behind(out.first, Progress());
        return out;
    }

    /// So wide that every other sample of a row has no ray of its own.
    void lookWide()
    {
        options.width = 1200;
        options.frame = PictureFrame{Vec3d(0.0), 12.0, 1.2};
    }

    /// Calls a function with each sample of a layer and its x [Å].
    template<typename Each>
    static void forEachSample(const View& view, const Layer& layer, const Each& each)
    {
        const std::size_t across = std::size_t(subpixels * view.width);
        for (std::size_t s = 0; s < layer.seen.size(); ++s)
            each(layer.seen[s],
                 view.at((double(s % across) + 0.5) / subpixels, 0.0).dot(view.right));
    }
};

// At the bottom of a bowl of 100 Å walls hide the half of the sky, and within 60 Å a tenth of it.
TEST_F(LayerTest, HalfOfTheRaysLookAtWhatIsNear)
{
    test::addBall(mesh, Vec3f(0.0f), 100.0f, gray);
    for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]); // a void
    for (Vec3f& normal : mesh.normals) normal = -normal;
    options.clip = 0.0;
    options.width = 200;
    const Layers layers = traced();
    const auto width = std::size_t(layers.view.width), height = std::size_t(layers.view.height);
    double open = 0.0;
    for (std::size_t y = height / 2 - 8; y < height / 2 + 8; ++y)
        for (std::size_t x = width / 2 - 8; x < width / 2 + 8; ++x) {
            EXPECT_NEAR(layers.first.lights[y * width + x].depth, -100.0f, 2.0f);
            open += layers.first.lights[y * width + x].open() / 256.0;
        }
    EXPECT_NEAR(open, (0.5 + 0.9) / 2.0, 0.05); // 0.9 if all rays did, 0.5 if none
}

// Places of the cut that no float has, also far from the middle.
TEST_F(LayerTest, ACutIsACutWhereverItIs)
{
    test::addBall(mesh, Vec3f(0.0f), 100.0f, gray);
    options.width = 40;
    for (const double clip : {0.1, 33.3, 40.1, 77.7, -40.1, -99.3}) {
        options.clip = clip;
        const Layers layers = traced();
        const auto across = std::size_t(subpixels * layers.view.width);
        const std::size_t rows = layers.first.seen.size() / across;
        const Seen& middle = layers.first.seen[across * (rows / 2) + across / 2];
        EXPECT_EQ(int(middle.piece), int(Seen::cut)) << clip;
        EXPECT_NEAR(middle.depth, clip, 1e-4);
    }
}

TEST_F(LayerTest, ACutLeavesTheRestOfATriangle)
{
    addPlate(mesh, -5.0f, 5.0f, 0.0f);
    for (Vec3f& p : mesh.positions) p[2] = p[0] / 5.0f;
    addPlate(mesh, -5.0f, 5.0f, 1.5f); // no ray goes there
    options.clip = 0.0;
    options.frame = PictureFrame{Vec3d(0.0), 12.0, 1.2};
    const Layers layers = traced();
    forEachSample(layers.view, layers.first, [&](const Seen& seen, double x) {
        EXPECT_EQ(seen.any(), x > -5.0 && x < 0.0) << x;
    });
}

TEST_F(LayerTest, PiecesKeepTheirBorders)
{
    addPlate(mesh, 0.0f, 5.0f, 0.0f);
    mesh.parts = {{"plate", 0}};
    lookWide();
    for (const double border : {0.0013, 0.0037, 0.0062, 0.0088}) { // in each of the samples
        options.instances = {{{unturned, {border, 0, 0}}, 0, "1", gray},
                             {{unturned, {border - 5.0, 0, 0}}, 0, "2", gray}};
        const Layers layers = traced();
        forEachSample(layers.view, layers.first, [&](const Seen& seen, double x) {
            if (!seen.any() || std::abs(x - border) < 1e-4) return;
            EXPECT_EQ(int(seen.piece), x < border) << x - border;
        });
    }
}

TEST_F(LayerTest, StepsKeepTheirEdges)
{
    addPlate(mesh, -5.0f, 0.0f, 0.0f);
    addPlate(mesh, 0.0f, 5.0f, 1.0f);
    lookWide();
    for (const double shift : {0.0013, 0.0037, 0.0062, 0.0088}) {
        options.frame->center = {shift, 0, 0};
        const Layers layers = traced();
        forEachSample(layers.view, layers.first, [&](const Seen& seen, double x) {
            if (!seen.any() || std::abs(x) < 1e-4) return;
            EXPECT_NEAR(seen.depth, x > 0.0, 1e-3) << x;
        });
    }
}

// Every other pixel of every other row asks for its light; a thing between them does so, too.
TEST_F(LayerTest, ThinThingsHaveTheirOwnLight)
{
    const Vec3f lamp = Tracer::lamp();
    lookWide(); // a pixel is 0.01 Å, and the first one on the right of the middle asks
    addPlate(mesh, 0.011f, 0.019f, 0.0f, Vec3f(-lamp[0], -lamp[1], 0.01f).unit());
    const Layers layers = traced();
    int seen = 0;
    for (const PixelLight& light : layers.first.lights) {
        if (light.depth == Seen::nothing) continue;
        ++seen;
        EXPECT_EQ(light.lit(), 0.0f); // it looks away from the lamp; 1 if nobody asked
    }
    EXPECT_EQ(seen, 120);
}

TEST_F(LayerTest, AtomsBehindAWallAreNotInItsShadow)
{
    test::addBall(mesh, Vec3f(0.0f), 10.0f, gray);
    AtomModel model;
    AtomUnit& unit = model.units.emplace_back();
    unit.balls = {{0.0f, 0.0f, 0.0f, 1.0f}};
    unit.ballColors = {gray};
    model.copies = {{{unturned, {0, 0, 0}}, 0, "", gray}};
    options.model = std::make_shared<AtomModel>(model);
    options.opacity = 0.5;
    options.width = 71; // every pixel asks for its light, and one is in the middle
    const Layers layers = traced();
    const std::size_t middle = layers.view.width * (layers.view.height / 2) + layers.view.width / 2;
    const PixelLight& light = layers.behind.lights[middle];
    EXPECT_NEAR(light.depth, 1.0f, 0.02f);
    EXPECT_EQ(light.open(), 1.0f);
    EXPECT_EQ(light.lit(), 1.0f);
}

} // namespace
} // namespace molsurf
