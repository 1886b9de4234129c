// SPDX-License-Identifier: MPL-2.0
#include "molsurf/files.h"

#include "molsurf/core/words.h"
#include "molsurf/error.h"
#include "molsurf/io/output_file.h"
#include "molsurf/io/read_mesh.h"
#include "molsurf/io/write_mesh.h"
#include "molsurf/io/write_report.h"
#include "molsurf/io/write_vdb.h"
#include "molsurf/picture/draw_mesh.h"
#include "molsurf/picture/write_png.h"
#include "molsurf/structure/detect_format.h"

#include <filesystem>

namespace molsurf
{

std::vector<std::string> structureEndings()
{
    std::vector<std::string> all;
    for (const StructureFormatRow& row : structureFormats())
        all.insert(all.end(), row.endings.begin(), row.endings.end());
    return all;
}

std::vector<std::string> meshEndings()
{
    std::vector<std::string> all;
    for (const MeshFormat& format : meshFormats()) all.push_back(std::string(".") + format.word);
    return all;
}

void writeMesh(const Mesh& mesh, const std::string& path, bool replace)
{
    const std::filesystem::path name = path;
    for (const MeshFormat& format : meshFormats()) {
        if (name.extension().string() != std::string(".") + format.word) continue;
        OutputFile file(path, replace);
        format.write(mesh, {name.stem().string()}, file);
        file.commit();
        return;
    }
    throw Error(ErrorKind::Usage,
                path + ": expected a name that ends in " + joinWords(meshEndings(), " or "));
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
