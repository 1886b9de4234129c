// SPDX-License-Identifier: MPL-2.0
#include "molsurf/files.h"

#include "molsurf/error.h"
#include "molsurf/io/output_file.h"
#include "molsurf/io/read_mesh.h"
#include "molsurf/io/write_3mf.h"
#include "molsurf/io/write_glb.h"
#include "molsurf/io/write_mesh.h"
#include "molsurf/io/write_report.h"
#include "molsurf/io/write_vdb.h"
#include "molsurf/picture/draw_mesh.h"
#include "molsurf/picture/write_png.h"

#include <filesystem>

namespace molsurf
{

void writeMesh(const Mesh& mesh, const std::string& path, bool replace)
{
    const std::filesystem::path name = path;
    const std::string end = name.extension().string(), stem = name.stem().string();
    const auto write = [&](const auto& content) {
        OutputFile file(path, replace);
        content(file);
        file.commit();
    };
    if (end == ".ply") return write([&](OutputFile& file) { writePly(mesh, file); });
    if (end == ".obj") return write([&](OutputFile& file) { writeObj(mesh, file); });
    if (end == ".stl") return write([&](OutputFile& file) { writeStl(mesh, file); });
    if (end == ".off") return write([&](OutputFile& file) { writeOff(mesh, file); });
    if (end == ".wrl") return write([&](OutputFile& file) { writeWrl(mesh, file); });
    if (end == ".glb") return write([&](OutputFile& file) { writeGlb(mesh, {stem}, file); });
    if (end == ".3mf") return write([&](OutputFile& file) { write3mf(mesh, stem, 1.0, file); });
    throw Error(ErrorKind::Usage,
                path + ": expected a name that ends in .ply, .obj, .stl, .off, .wrl, .glb or .3mf");
}

void writeVdb(const MolecularSurface& surface, const std::string& path, bool replace)
{
    openvdb::GridCPtrVec grids;
    if (surface.surface) grids.push_back(surface.surface);
    grids.insert(grids.end(), surface.fields.begin(), surface.fields.end());
    OutputFile file(path, replace);
    writeVdb(grids, openvdb::MetaMap(), file);
    file.commit();
}

void writeReport(const Report& report, const std::string& path, bool replace)
{
    OutputFile file(path, replace);
    writeReport(report, file);
    file.commit();
}

void writePicture(const Mesh& mesh, const std::string& path, int width, bool replace)
{
    if (width < 16 || width > 16384)
        throw Error(ErrorKind::Usage,
                    "width: expected 16 to 16384 pixels, got " + std::to_string(width));
    DrawOptions options;
    options.width = width;
    OutputFile file(path, replace);
    writePng(drawMesh(mesh, options, Progress()), file);
    file.commit();
}

} // namespace molsurf
