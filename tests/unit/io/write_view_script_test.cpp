// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_view_script.h"

#include "support/folder.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

/// Chains C1, C2, ... in shades of red.
Legend chains(int count)
{
    Legend legend{"Chain", "chain", "chain_id", "", {}, {}};
    for (int i = 1; i <= count; ++i)
        legend.entries.push_back({"C" + std::to_string(i), {std::uint8_t(i), 0, 0}});
    return legend;
}

std::string pymolOf(const std::string& mesh, const std::optional<Legend>& legend)
{
    return test::written([&](OutputFile& file) { writePymolScript(mesh, legend, file); });
}

std::string chimeraXOf(const std::string& mesh, const std::optional<Legend>& legend)
{
    return test::written([&](OutputFile& file) { writeChimeraXScript(mesh, legend, file); });
}

/// The rest of the line that begins with some words.
std::string lineOf(const std::string& text, const std::string& begin)
{
    const std::size_t at = text.find("\n" + begin);
    if (at == std::string::npos) return "no line";
    const std::size_t from = at + 1 + begin.size();
    return text.substr(from, text.find('\n', from) - from);
}

// Literals of Python; ChimeraX knows no backslashes in quotes.
TEST(ViewScript, NamesAreLiterals)
{
    const std::string mesh = "a \\ \"b\"\n.c.ply";
    const std::string pymol = pymolOf(mesh, {});
    EXPECT_EQ(lineOf(pymol, "mesh = "), "\"a \\\\ \\\"b\\\" .c.ply\"");
    EXPECT_EQ(lineOf(pymol, "name = "), "\"a \\\\ \\\"b\\\" .c\"");
    EXPECT_EQ(lineOf(pymol, "title = "), "\"\"");
    EXPECT_EQ(lineOf(pymol, "legend = "), "[]");
    EXPECT_EQ(lineOf(pymol, "scale = "), "None");
    EXPECT_EQ(lineOf(chimeraXOf(mesh, {}), "open "), "\"a ' 'b' .c.ply\" id 900");
    EXPECT_EQ(lineOf(chimeraXOf(mesh, {}), "key"), "no line");
}

// Names that are seen, up to 24 entries: of more there are 23, and how many there are besides.
TEST(ViewScript, ALegendHasRoomForTwentyFour)
{
    for (const int count : {2, 24, 25, 60}) {
        Legend legend = chains(count + 1);
        legend.entries[0].seen = false;
        std::string python, key;
        const int shown = count > 24 ? 23 : count;
        for (int i = 2; i < 2 + shown; ++i) {
            const std::string number = std::to_string(i);
            python += "(\"C" + number + "\", " + number + ", 0, 0), ";
            char red[16];
            std::snprintf(red, sizeof red, "#%02x0000", i);
            key += std::string(" \"") + red + ":C" + number + "\"";
        }
        if (count > 24) {
            const std::string rest = "+" + std::to_string(count - 23);
            python += "(\"" + rest + "\", 190, 190, 190), ";
            key += " \"#bebebe:" + rest + "\"";
        }
        EXPECT_EQ(lineOf(pymolOf("a.ply", legend), "legend = "), "[" + python + "]") << count;
        EXPECT_EQ(lineOf(chimeraXOf("a.ply", legend), "key"),
                  key + " pos 0.03,0.06 size 0.04,0.8 colorTreatment distinct");
    }
}

// A scale has its numbers at five even stops, with their colours.
TEST(ViewScript, AScaleHasFiveStops)
{
    Legend legend{"Charge", "charge", "charge", "e", {}, {}};
    legend.scale = ColorScale{"own", -1.0, 3.0, {{0, 0, 0}, {200, 100, 40}}, false};
    const std::string pymol = pymolOf("a.ply", legend), chimeraX = chimeraXOf("a.ply", legend);
    EXPECT_EQ(lineOf(pymol, "title = "), "\"Charge [e]\"");
    EXPECT_EQ(lineOf(pymol, "legend = "),
              "[(\"-1\", 0, 0, 0), (\"0\", 50, 25, 10), (\"1\", 100, 50, 20), "
              "(\"2\", 150, 75, 30), (\"3\", 200, 100, 40), ]");
    EXPECT_EQ(lineOf(pymol, "scale = "), "[-1, 0, 1, 2, 3, ]");
    EXPECT_EQ(lineOf(chimeraX, "2dlabels text "), "\"Charge [e]\" xpos 0.03 ypos 0.94 size 18");
    EXPECT_EQ(lineOf(chimeraX, "key"),
              " \"#000000:-1\" \"#32190a:0\" \"#643214:1\" \"#964b1e:2\" \"#c86428:3\" "
              "pos 0.03,0.06 size 0.04,0.8 colorTreatment blended");
}

} // namespace
} // namespace molsurf
