// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/balls/box_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

bool meets(const Box& a, const Box& b)
{
    for (int k = 0; k < 3; ++k) {
        if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
    }
    return true;
}

/// Boxes along a curve about a centre.
std::vector<Box> someBoxes(std::size_t count, const Vec3d& centre)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> size(0.1, 2.0);
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const double t = 0.1 * double(i);
        const Vec3d at = centre + 20.0 * Vec3d(std::sin(t), std::cos(0.7 * t), std::sin(0.3 * t));
        boxes.push_back(Box::about(at, size(random)));
    }
    return boxes;
}

TEST(BoxTree, FindsAllBoxesThatMeetABox)
{
    for (const std::size_t count : {1, 8, 9, 64, 65, 1000, 5000}) {
        for (const double far : {0.0, 9e5}) {
            const Vec3d centre(far, -far, 0.5 * far);
            const std::vector<Box> boxes = someBoxes(count, centre);
            const BoxTree tree(boxes);
            std::size_t visited = 0;
            for (int q = 0; q < 50; ++q) {
                const Vec3d at = centre + 22.0 * Vec3d(std::sin(q), std::sin(2.0 * q), std::cos(q));
                const Box box = Box::about(at, 1.5);
                std::vector<bool> found(boxes.size() + BoxTree::group);
                std::ptrdiff_t last = -1;
                tree.forEachNear(box, [&](std::size_t g) {
                    EXPECT_GT(std::ptrdiff_t(g), last) << "not in ascending order";
                    last = std::ptrdiff_t(g);
                    ++visited;
                    for (std::size_t k = 0; k < BoxTree::group; ++k)
                        found[BoxTree::group * g + k] = true;
                });
                for (std::size_t i = 0; i < boxes.size(); ++i)
                    EXPECT_TRUE(found[i] || !meets(boxes[i], box)) << count << " " << i;
            }
            if (count == 5000) {
                EXPECT_LT(visited, 50u * count / BoxTree::group / 5) << "few of all groups";
            }
        }
    }
}

TEST(BoxTree, OfNothing)
{
    const BoxTree tree({});
    tree.forEachNear(Box::about(Vec3d(0.0), 1e6), [](std::size_t) { ADD_FAILURE(); });
}

} // namespace
} // namespace molsurf
