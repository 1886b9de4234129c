// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/write_html.h"

#include "support/folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace molsurf
{
namespace
{

Mesh triangle(float size)
{
    Mesh mesh;
    mesh.positions = {{10, 0, 0}, {10 + size, 0, 0}, {10, size, 0}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

nlohmann::json headerOf(const Mesh& mesh, const HtmlPage& page)
{
    const std::string text = test::written([&](OutputFile& file) { writeHtml(mesh, page, file); });
    const std::string before = "id=\"header\">";
    const std::size_t begin = text.find(before) + before.size();
    return nlohmann::json::parse(text.substr(begin, text.find("</script>", begin) - begin));
}

TEST(WriteHtml, ALoneMeshHasNoCopies)
{
    const auto header = headerOf(triangle(2), {"a", {}});
    EXPECT_TRUE(header["copies"].empty());
    ASSERT_EQ(header["levels"].size(), 1u);
    EXPECT_EQ(header["levels"][0]["parts"], nlohmann::json::parse("[[0, 3, 0, 1]]"));
    EXPECT_EQ(header["modes"].size(), 1u);
}

TEST(WriteHtml, ACutHasTheColoursOfBalls)
{
    HtmlPage page;
    page.legends = {{"Curvature", "curvature", "curvature", "", scaleOf("RdBu", -1, 1), {}},
                    {"Chain", "chain", "", "", {}, {{"A", {1, 2, 3}}}}};
    page.balls = {{{10, 1, 0}, 1.5, 0}, {{12, 1, 0}, 2.0, 1}};
    page.cutColors = {{}, {{1, 2, 3}, {4, 5, 6}}};
    Mesh mesh = triangle(2);
    mesh.scalars = {{"curvature", {0, 1, 2}}};
    mesh.colors = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
    const auto header = headerOf(mesh, page);
    EXPECT_EQ(header["cut"]["low"], nlohmann::json::parse("[-1.0, 0.0, 0.0]")); // about (11, 1, 0)
    EXPECT_EQ(header["modes"][1]["cut"], "cut_chain");
    EXPECT_FALSE(header["modes"][0].contains("cut"));
    int found = 0;
    for (const auto& array : header["arrays"])
        found += array["name"] == "cut_chain" && array["count"] == 2 && array["components"] == 3;
    EXPECT_EQ(found, 1);
    page.instances = {{Motion::identity(), 0, "1", {1, 2, 3}}};
    EXPECT_TRUE(headerOf(mesh, page)["cut"].is_null()); // balls of copies are not there
}

TEST(WriteHtml, CopiesArePlacedAboutTheMiddleOfTheMesh)
{
    const Mesh coarse = triangle(4);
    HtmlPage page;
    page.copiesFirst = true;
    const Motion xToY{{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}, openvdb::Vec3d(100, 0, 0.12345)};
    page.instances = {{xToY, 0, "1", {1, 2, 3}}};
    page.coarser = {&coarse};
    const auto header = headerOf(triangle(2), page);
    ASSERT_EQ(header["copies"].size(), 1u);
    // The middle (11, 1, 0) comes to (99, 11, 0.123).
    EXPECT_EQ(
        header["copies"][0],
        nlohmann::json::parse(
            "[0, [0.0, -1.0, 0.0, 99.0, 1.0, 0.0, 0.0, 11.0, 0.0, 0.0, 1.0, 0.123], [1, 2, 3]]"));
    EXPECT_EQ(header["modes"][0]["id"], "copy");
    EXPECT_EQ(header["modes"][1]["id"], "none");
    ASSERT_EQ(header["levels"].size(), 2u);
    EXPECT_EQ(header["levels"][1]["level"], "_lod1");
    EXPECT_EQ(header["levels"][1]["middle"], nlohmann::json::parse("[1.0, 1.0, 0.0]"));
}

} // namespace
} // namespace molsurf
