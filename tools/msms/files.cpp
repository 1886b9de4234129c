// SPDX-License-Identifier: MPL-2.0
#include "msms/files.h"

#include "molsurf/kernel/core/printable.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/show/io/output_buffer.h"

#include <algorithm>
#include <cstdio>

namespace molsurf::msms
{

namespace
{

/// Adds a line: the values, in at most `room` letters, and behind them the name, of any length.
template<typename... Values>
void print(OutputFile& file, Buffer& buffer, const std::string& name, const char* format,
           Values... values)
{
    constexpr std::size_t room = 160;
    char* place = buffer.take(room);
    const int used = std::snprintf(place, room, format, values...);
    buffer.untake(room - std::size_t(used));
    if (!name.empty()) {
        buffer.flush();
        file.write((" " + name).data(), name.size() + 1);
    }
    *buffer.take(1) = '\n';
}

const std::string& nameOf(const Spheres& spheres, std::size_t atom)
{
    static const std::string nameless;
    return spheres.structure.labels.empty() ? nameless : spheres.structure.labels[atom];
}

void writeHeader(const MsmsCall& call, const Spheres& spheres, const char* what, const char* count,
                 std::size_t size, OutputFile& file)
{
    if (!call.header) return;
    file.write(std::string("# MSMS solvent excluded surface ") + what + " for " + call.input +
               "\n" + count + " #sphere density probe_r\n" +
               formatted("%7zu %7zu %5.2f %5.2f\n", size, spheres.structure.atoms.size(),
                         call.density, call.probe));
}

} // namespace

std::string componentName(const std::string& base, std::size_t component, const char* ending)
{
    return base + (component == 0 ? "" : "_" + std::to_string(component)) + ending;
}

void writeVertices(const MsmsCall& call, const Spheres& spheres, const Component& component,
                   OutputFile& file)
{
    const Mesh& mesh = component.mesh;
    writeHeader(call, spheres, "vertices", "#vertex", mesh.positions.size(), file);
    Buffer buffer(file);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const openvdb::Vec3f &x = mesh.positions[v], &n = mesh.normals[v];
        const Face& face = component.vertexFaces[v];
        const auto atom = std::size_t(spheres.balls[std::size_t(component.balls[v])].atom);
        print(file, buffer, nameOf(spheres, atom),
              "%9.3f %9.3f %9.3f %9.3f %9.3f %9.3f %7u %7zu %2d", double(x[0]), double(x[1]),
              double(x[2]), double(n[0]), double(n[1]), double(n[2]), face.number, atom + 1,
              int(face.kind));
    }
    buffer.flush();
}

void writeFaces(const MsmsCall& call, const Spheres& spheres, const Component& component,
                OutputFile& file)
{
    const Mesh& mesh = component.mesh;
    writeHeader(call, spheres, "faces", "#faces ", mesh.triangles.size(), file);
    Buffer buffer(file);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& corners = mesh.triangles[t];
        const Face& face = component.triangleFaces[t];
        print(file, buffer, "", "%6u %6u %6u %2d %6u", corners[0] + 1, corners[1] + 1,
              corners[2] + 1, int(face.kind), face.number);
    }
    buffer.flush();
}

void writeAreas(const Spheres& spheres, const MsmsSurface& surface, OutputFile& file)
{
    // A sphere that is not used, as one that equals another one, has no area.
    std::vector<double> excluded(spheres.structure.atoms.size(), 0.0), accessible = excluded;
    for (std::size_t i = 0; i < spheres.balls.size(); ++i) {
        excluded[std::size_t(spheres.balls[i].atom)] = surface.excludedOf[i];
        accessible[std::size_t(spheres.balls[i].atom)] = surface.accessibleOf[i];
    }
    Buffer buffer(file);
    print(file, buffer, "", "%s", "  Atom #     ses_0     sas_0");
    for (std::size_t atom = 0; atom < excluded.size(); ++atom)
        print(file, buffer, nameOf(spheres, atom), "%8zu %9.3f %9.3f", atom, excluded[atom],
              accessible[atom]);
    buffer.flush();
}

std::string titleText(const MsmsCall& call, const Spheres& spheres)
{
    double least = spheres.balls[0].radius, most = least;
    for (const Ball& ball : spheres.balls) {
        least = std::min(least, ball.radius);
        most = std::max(most, ball.radius);
    }
    return std::string("MSMS 2.6.1 interface of vdb_molsurf_msms ") + MOLSURF_VERSION +
           "\nINPUT  " + printable(call.input) +
           formatted(" %zu spheres 0 collision only, radii %6.3f to %6.3f\n", spheres.balls.size(),
                     least, most) +
           formatted("PARAM  Probe_radius %6.3f density %6.3f hdensity %6.3f\n", call.probe,
                     call.density, call.highDensity);
}

std::string resultText(const MsmsCall& call, const MsmsSurface& surface)
{
    std::string text;
    const std::size_t count = surface.components.size();
    for (std::size_t n = 1; n < count; ++n)
        text += formatted("    RS component %zu identified\n", n);
    if (call.totals) {
        text += "ANALYTICAL SURFACE AREA :\n"
                "    Comp. probe_radius,   reent,    toric,   contact    SES       SAS\n";
        std::vector<Areas> rows;
        for (const Component& component : surface.components) rows.push_back(component.areas);
        rows.insert(rows.end(), surface.joined.begin(), surface.joined.end());
        for (std::size_t n = 0; n < rows.size(); ++n) {
            const Areas& a = rows[n];
            text +=
                formatted("    %3zu       %5.3f  %10.3f %9.3f %9.3f %9.3f %9.3f\n", n, call.probe,
                          a.spherical, a.toric, a.contact, a.excluded(), a.accessible);
        }
    }
    text += "TRIANGULATION\n    Comp. vertices triangles\n";
    for (std::size_t n = 0; n < count; ++n) {
        const Mesh& mesh = surface.components[n].mesh;
        text += formatted("    %3zu %10zu %9zu\n", n, mesh.positions.size(), mesh.triangles.size());
    }
    text += "NUMERICAL VOLUMES AND AREA\n    Comp. probe_radius SES_volume SES_area)\n";
    double total = 0.0;
    for (std::size_t n = 0; n < count; ++n) {
        const Component& c = surface.components[n];
        text +=
            formatted("    %3zu      %5.2f  %11.3f %10.3f\n", n, call.probe, c.volume, c.meshArea);
        total += c.volume;
    }
    return text + formatted("    Total ses_volume: %9.3f\n", total);
}

} // namespace molsurf::msms
