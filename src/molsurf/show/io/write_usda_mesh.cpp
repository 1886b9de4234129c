// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_usda_mesh.h"

#include "molsurf/show/io/usda_mesh.h"

#include <string_view>

namespace molsurf
{

namespace
{

constexpr const char *ofMesh = "vdb_molsurf, mesh", *ofFilm = "vdb_molsurf, film";

/// Creator and times of a layer, and the metadata of its root prim behind the kind.
struct Head {
    const char* creator;
    int first = 0, last = 0; ///< of frames
    std::string prim{};
};

class SceneText
{
public:
    SceneText(const Mesh& mesh, const UsdScene& scene, OutputFile& file)
        : mesh_(mesh), scene_(scene), name_(usdaIdentifier(scene.name)), out_(file)
    {
    }

    /// @param[in] declared  a film's layer, whose properties have no values: files of frames do
    void write(const Head& head, bool declared)
    {
        writeHead(head, !declared);
        const std::vector<PartRange> parts = partRanges(mesh_, "surface");
        for (std::size_t p = 0; p < parts.size(); ++p) {
            if (p > 0) out_ << "\n";
            writeMesh(parts[p], parts.size() > 1 ? "part_" + std::to_string(p) : "surface",
                      declared);
        }
        out_ << "\n";
        putUsdaMaterial(out_, "/" + name_, "material", scene_.color, !mesh_.colors.empty(), "    ");
        out_ << "}\n";
        out_.finish();
    }

    const std::string& name() const { return name_; }

private:
    void writeHead(const Head& head, bool ofFrame)
    {
        const auto& frame = scene_.frame;
        out_ << usdaFirstLine << "\n(\n    customLayerData = {\n"
             << usdaDataLine("creator", head.creator) << "\n";
        if (frame && ofFrame)
            out_ << usdaDataLine(usdaFrameOptions, frame->options) << "\n"
                 << usdaDataLine(usdaFrame, std::to_string(frame->number)) << "\n";
        out_ << "    }\n    defaultPrim = \"" << name_ << "\"\n";
        if (frame)
            out_ << "    endTimeCode = " << head.last
                 << "\n    framesPerSecond = " << frame->framesPerSecond << "\n";
        out_ << "    metersPerUnit = " << usdaMetersPerAngstrom / scene_.scale << "\n";
        if (frame)
            out_ << "    startTimeCode = " << head.first
                 << "\n    timeCodesPerSecond = " << frame->framesPerSecond << "\n";
        out_ << "    upAxis = \"Z\"\n)\n\ndef Xform \"" << name_
             << "\" (\n    kind = \"component\"\n"
             << head.prim << ")\n{\n";
        if (scene_.scale == 1.0) return;
        out_ << "    double3 xformOp:scale = (" << scene_.scale << ", " << scene_.scale << ", "
             << scene_.scale << ")\n    uniform token[] xformOpOrder = [\"xformOp:scale\"]\n\n";
    }

    void writeMesh(const PartRange& part, const std::string& prim, bool declared)
    {
        const std::string in = "        ";
        out_ << "    def Mesh \"" << prim << "\" (\n"
             << in << "prepend apiSchemas = [\"MaterialBindingAPI\"]\n";
        if (prim != part.name) out_ << in << "displayName = " << usdaString(part.name) << "\n";
        out_ << "    )\n    {\n" << in << "rel material:binding = </" << name_ << "/material>\n";
        UsdaMesh what{mesh_, part, openvdb::Vec3d(0.0), in};
        if (scene_.frame) {
            what.time = scene_.frame->time;
            what.velocityFactor = scene_.frame->velocityFactor;
        }
        what.fields = scene_.fields;
        what.declared = declared;
        putUsdaMesh(out_, what);
        out_ << "    }\n";
    }

    const Mesh& mesh_;
    const UsdScene& scene_;
    std::string name_;
    TextOutput out_;
};

} // namespace

void writeUsdaMesh(const Mesh& mesh, const UsdScene& scene, OutputFile& file)
{
    const int time = scene.frame ? scene.frame->time : 0;
    SceneText(mesh, scene, file).write({ofMesh, time, time}, false);
}

void writeUsdaFilm(const Mesh& mesh, const UsdScene& scene,
                   const std::vector<std::pair<int, std::string>>& frames, OutputFile& file)
{
    SceneText text(mesh, scene, file);
    const std::string in = "            ";
    std::string active, files;
    for (std::size_t n = 0; n < frames.size(); ++n) {
        const std::string between = n == 0 ? "" : ", ";
        active += between + "(" + std::to_string(frames[n].first) + ", " + std::to_string(n) + ")";
        files += between + usdaAsset(frames[n].second);
    }
    Head head{ofFilm, frames.front().first, frames.back().first};
    head.prim = "    clips = {\n        dictionary default = {\n" + in + "double2[] active = [" +
                active + "]\n" + in + "asset[] assetPaths = [" + files + "]\n" + in +
                "asset manifestAssetPath = " + usdaAsset(frames.front().second) + "\n" + in +
                "string primPath = \"/" + text.name() + "\"\n        }\n    }\n";
    text.write(head, true);
}

bool isOwnFilm(const std::string& path)
{
    return usdaData(path, "creator") == ofFilm;
}

} // namespace molsurf
