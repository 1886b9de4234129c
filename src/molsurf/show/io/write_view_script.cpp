// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_view_script.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/show/io/output_buffer.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <vector>

namespace molsurf
{

namespace
{

/// The entries that are shown: names that are seen, and how many there is no room for, or the
/// numbers of a scale at five stops, as text that a script reads as numbers.
std::vector<LegendEntry> entriesOf(const Legend& legend)
{
    constexpr std::size_t most = 24; // that a window has room for
    if (!legend.scale) {
        std::vector<LegendEntry> entries;
        std::copy_if(legend.entries.begin(), legend.entries.end(), std::back_inserter(entries),
                     [](const LegendEntry& entry) { return entry.seen; });
        if (entries.size() > most) {
            const std::size_t left = entries.size() - (most - 1);
            entries.resize(most - 1);
            entries.push_back({"+" + std::to_string(left), neutralColor});
        }
        return entries;
    }
    constexpr int stops = 5;
    std::vector<LegendEntry> entries;
    for (int i = 0; i < stops; ++i) {
        const ColorScale& scale = *legend.scale;
        const double value = scale.low + (scale.high - scale.low) * i / (stops - 1);
        entries.push_back({formatted("%.3g", value), scale.at(value)});
    }
    return entries;
}

std::string titleOf(const Legend& legend)
{
    return legend.title + (legend.unit.empty() ? "" : " [" + legend.unit + "]");
}

/// A text in double quotes for ChimeraX.
std::string forChimeraX(const std::string& text)
{
    std::string out;
    for (const char c : text)
        out += c == '"' || c == '\\' ? '\'' : static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    return "\"" + out + "\"";
}

/// A literal of Python.
std::string forPython(const std::string& text)
{
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
    return out + "\"";
}

/// The script of PyMOL, behind lines that set `mesh`, `name`, `title` and lists: `legend` has
/// label, red, green and blue of each entry, `scale` their numbers or None.
const char* const pymolText = R"py(
import os, struct
import pymol
from pymol import cgo, cmd

script = getattr(pymol, "__script__", None) or globals().get("__script__") or ""
path = os.path.join(os.path.dirname(script), mesh)
with open(path, "rb") as file:
    header, body = file.read().split(b"end_header\n", 1)
letters = {"float": "f", "int": "i", "uchar": "B"}
form, names, vertices, faces = "<", [], 0, 0
for line in header.decode().splitlines():
    words = line.split()
    if words[:2] == ["element", "vertex"]:
        vertices = int(words[2])
    elif words[:2] == ["element", "face"]:
        faces = int(words[2])
    elif words[:1] == ["property"] and words[1] != "list":
        form += letters[words[1]]
        names.append(words[2])
place = {word: names.index(word) for word in names}
rows = list(struct.iter_unpack(form, body[:vertices * struct.calcsize(form)]))
x = place["x"]
nx = place["nx"]
red = place.get("red")
points = []
for row in rows:
    color = [c / 255.0 for c in row[red:red + 3]] if red is not None else [0.8, 0.8, 0.8]
    points.append([cgo.COLOR] + color + [cgo.NORMAL] + list(row[nx:nx + 3]) + [cgo.VERTEX] + list(row[x:x + 3]))
shape = [cgo.BEGIN, cgo.TRIANGLES]
for _, a, b, c in struct.iter_unpack("<B3i", body[vertices * struct.calcsize(form):][:13 * faces]):
    shape += points[a] + points[b] + points[c]
shape.append(cgo.END)
cmd.load_cgo(shape, name)
if title:
    print(title)
    for label, r, g, b in legend:
        print("  %-20s #%02x%02x%02x" % (label, r, g, b))
if scale:
    cmd.ramp_new(name + "_legend", "none", scale, [[c / 255.0 for c in entry[1:]] for entry in legend])
)py";

} // namespace

void writeChimeraXScript(const std::string& mesh, const std::optional<Legend>& legend,
                         OutputFile& file)
{
    constexpr const char* id = "900"; // hardly anybody has so many models
    TextOutput out(file);
    out << "# opens the surface in UCSF ChimeraX\nopen " << forChimeraX(mesh) << " id " << id
        << "\n# as its atoms lie, and not with y upwards as in a .glb\nview matrix models #" << id
        << ".1,1,0,0,0,0,1,0,0,0,0,1,0\n";
    if (legend) {
        out << "2dlabels text " << forChimeraX(titleOf(*legend))
            << " xpos 0.03 ypos 0.94 size 18\nkey";
        for (const LegendEntry& entry : entriesOf(*legend))
            out << " " << forChimeraX(hexOf(entry.color) + ":" + entry.name);
        out << " pos 0.03,0.06 size 0.04,0.8 colorTreatment "
            << (legend->scale ? "blended" : "distinct") << "\n";
    }
    out << "view\n";
    out.finish();
}

void writePymolScript(const std::string& mesh, const std::optional<Legend>& legend,
                      OutputFile& file)
{
    TextOutput out(file);
    out << "# opens the surface in PyMOL\npython\nmesh = " << forPython(mesh)
        << "\nname = " << forPython(std::filesystem::path(mesh).stem().string())
        << "\ntitle = " << forPython(legend ? titleOf(*legend) : "") << "\nlegend = [";
    const std::vector<LegendEntry> entries =
        legend ? entriesOf(*legend) : std::vector<LegendEntry>();
    for (const LegendEntry& entry : entries) {
        out << "(" << forPython(entry.name);
        for (const std::uint8_t c : entry.color) out << ", " << int(c);
        out << "), ";
    }
    out << "]\nscale = ";
    if (legend && legend->scale) {
        out << "[";
        for (const LegendEntry& entry : entries) out << entry.name << ", ";
        out << "]";
    } else {
        out << "None";
    }
    out << pymolText << "python end\n";
    out.finish();
}

} // namespace molsurf
