// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_usda_instances.h"

#include "molsurf/show/color/color_map.h"
#include "molsurf/show/io/part_ranges.h"
#include "molsurf/show/io/rotation_quaternion.h"
#include "molsurf/show/io/usda_mesh.h"

#include <array>
#include <map>
#include <string_view>
#include <utility>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;
using openvdb::Vec3f;

constexpr int quaternionDigits = 8; // single precision

/// A part of the mesh in the colour of some of its copies.
struct Prototype {
    std::size_t part;
    std::array<std::uint8_t, 3> color;
};

/// One mesh and what is known of its parts.
struct Level {
    const Mesh* mesh;
    std::vector<PartRange> parts;
    std::vector<openvdb::BBoxd> boxes;
};

class Stage
{
public:
    Stage(const Mesh& mesh, const UsdInstances& copies, OutputFile& file)
        : copies_(copies), name_(usdaIdentifier(copies.name)), out_(file)
    {
        std::vector<const Mesh*> meshes = {&mesh};
        meshes.insert(meshes.end(), copies.coarser.begin(), copies.coarser.end());
        for (const Mesh* each : meshes) {
            Level level{each, partRanges(*each, copies.name), {}};
            for (const PartRange& part : level.parts) level.boxes.push_back(boxOf(*each, part));
            levels_.push_back(std::move(level));
        }
        std::map<std::pair<std::size_t, std::array<std::uint8_t, 3>>, std::size_t> numbers;
        for (const MeshInstance& copy : copies.instances) {
            const auto [found, isNew] =
                numbers.emplace(std::make_pair(copy.part, copy.color), prototypes_.size());
            if (isNew) prototypes_.push_back({copy.part, copy.color});
            prototypeOf_.push_back(found->second);
        }
        for (const Prototype& prototype : prototypes_)
            materials_.emplace(prototype.color, materials_.size());
    }

    void write()
    {
        writeHead();
        for (const auto& [color, number] : materials_)
            putUsdaMaterial(out_, "/" + name_ + "/materials", "color_" + std::to_string(number),
                            color, !levels_[0].mesh->colors.empty(), "        ");
        out_ << "    }\n\n    class \"geometry\"\n    {\n";
        for (std::size_t level = 0; level < levels_.size(); ++level)
            for (std::size_t part = 0; part < levels_[level].parts.size(); ++part)
                writeGeometry(level, part);
        out_ << "    }\n\n";
        writeInstancer();
        if (levels_.size() > 1) {
            out_ << "    variantSet \"lod\" = {\n";
            for (std::size_t level = 0; level < levels_.size(); ++level) {
                out_ << "        \"lod" << level << "\" {\n            over \"copies\"\n"
                     << "            {\n";
                writeLevel(level, "                ");
                writePrototypes(level, "                ");
                out_ << "            }\n        }\n";
            }
            out_ << "    }\n";
        }
        out_ << "}\n";
        out_.finish();
    }

private:
    Vec3d middle(std::size_t part) const { return levels_[0].boxes[part].getCenter(); }

    void writeHead()
    {
        out_ << usdaFirstLine << "\n(\n    customLayerData = {\n"
             << "        string creator = \"vdb_molsurf, copies\"\n    }\n    defaultPrim = \""
             << name_ << "\"\n    metersPerUnit = " << usdaMetersPerAngstrom / copies_.scale
             << "\n    upAxis = \"Z\"\n)\n\ndef Xform \"" << name_
             << "\" (\n    kind = \"component\"\n";
        if (levels_.size() > 1)
            out_ << "    variants = {\n        string lod = \"lod0\"\n    }\n"
                 << "    prepend variantSets = \"lod\"\n";
        out_ << ")\n{\n";
        if (copies_.scale != 1.0) {
            const double scale = copies_.scale;
            out_ << "    double3 xformOp:scale = (" << scale << ", " << scale << ", " << scale
                 << ")\n    uniform token[] xformOpOrder = [\"xformOp:scale\"]\n\n";
        }
        out_ << "    def Scope \"materials\"\n    {\n";
    }

    void writeGeometry(std::size_t number, std::size_t part)
    {
        const Level& level = levels_[number];
        out_ << "        def Mesh \"" << partName(number, part) << "\"\n        {\n";
        UsdaMesh what{*level.mesh, level.parts[part], middle(part), "            "};
        what.fields = copies_.fields;
        putUsdaMesh(out_, what);
        out_ << "        }\n";
    }

    void writeInstancer()
    {
        const std::string in = "        ";
        const std::vector<MeshInstance>& all = copies_.instances;
        out_ << "    def PointInstancer \"copies\"\n    {\n";
        if (levels_.size() == 1) writeLevel(0, in);
        out_ << in;
        putArray(out_, "int64[] ids", all.size(), [&](std::size_t i) { out_ << i + 1; });
        out_ << "\n" << in;
        putArray(out_, "int[] protoIndices", all.size(),
                 [&](std::size_t i) { out_ << prototypeOf_[i]; });
        out_ << "\n" << in;
        putArray(out_, "point3f[] positions", all.size(), [&](std::size_t i) {
            putTuple(out_, all[i].placed(middle(all[i].part)), 3, usdaLengthDigits);
        });
        for (const char* type : {"quath[] orientations", "quatf[] orientationsf"}) {
            out_ << "\n" << in;
            putArray(out_, type, all.size(), [&](std::size_t i) {
                const auto [x, y, z, w] = quaternionOf(all[i].rotation);
                putTuple(out_, std::array<double, 4>{w, x, y, z}, 4, quaternionDigits);
            });
        }
        out_ << "\n";
        if (levels_.size() == 1) writePrototypes(0, in);
        out_ << "    }\n";
    }

    /// Those of the level that is shown and no others: some programs show each mesh that is no
    /// prototype.
    void writePrototypes(std::size_t level, const std::string& in)
    {
        out_ << "\n" << in << "def Scope \"prototypes\"\n" << in << "{\n";
        for (const Prototype& prototype : prototypes_)
            writePrototype(level, prototype, in + "    ");
        out_ << in << "}\n";
    }

    void writePrototype(std::size_t level, const Prototype& prototype, const std::string& in)
    {
        const std::string more = in + "    ";
        const std::size_t material = materials_.at(prototype.color);
        out_ << in << "def Mesh \"" << prototypeName(level, prototype) << "\" (\n"
             << more << "prepend apiSchemas = [\"MaterialBindingAPI\"]\n"
             << more << "prepend references = </" << name_ << "/geometry/"
             << partName(level, prototype.part) << ">\n"
             << in << ")\n"
             << in << "{\n"
             << more << "rel material:binding = </" << name_ << "/materials/color_" << material
             << ">\n";
        if (levels_[level].mesh->colors.empty()) {
            out_ << more << "color3f[] primvars:displayColor = [";
            putTuple(out_, linearLight(prototype.color), 3, usdaDirectionDigits);
            out_ << "]\n";
        }
        out_ << in << "}\n";
    }

    /// The properties of the instancer that depend on the level of detail.
    void writeLevel(std::size_t number, const std::string& in)
    {
        out_ << in;
        const openvdb::BBoxd box = extentOf(levels_[number]);
        putArray(out_, "float3[] extent", 2, [&](std::size_t i) {
            putTuple(out_, i == 0 ? box.min() : box.max(), 3, usdaLengthDigits);
        });
        out_ << "\n" << in;
        putArray(out_, "rel prototypes", prototypes_.size(), [&](std::size_t i) {
            out_ << "</" << name_ << "/copies/prototypes/" << prototypeName(number, prototypes_[i])
                 << ">";
        });
        out_ << "\n";
    }

    /// The box of the turned boxes of the copies, as USD computes it.
    openvdb::BBoxd extentOf(const Level& level) const
    {
        openvdb::BBoxd all;
        for (const MeshInstance& copy : copies_.instances) {
            const Vec3d &low = level.boxes[copy.part].min(), &high = level.boxes[copy.part].max();
            for (int corner = 0; corner < 8; ++corner)
                all.expand(
                    copy.placed({corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1],
                                 corner & 4 ? high[2] : low[2]}));
        }
        return all;
    }

    /// Names of parts may be alike once they are identifiers, hence the number.
    std::string partName(std::size_t level, std::size_t part) const
    {
        return "part_" + std::to_string(part) +
               (levels_.size() > 1 ? "_lod" + std::to_string(level) : "");
    }
    std::string prototypeName(std::size_t level, const Prototype& prototype) const
    {
        return partName(level, prototype.part) + "_color_" +
               std::to_string(materials_.at(prototype.color));
    }

    const UsdInstances& copies_;
    std::string name_;
    TextOutput out_;
    std::vector<Level> levels_; // the finest first
    std::vector<Prototype> prototypes_;
    std::vector<std::size_t> prototypeOf_; // of each copy
    std::map<std::array<std::uint8_t, 3>, std::size_t> materials_;
};

} // namespace

void writeUsdaInstances(const Mesh& mesh, const UsdInstances& copies, OutputFile& file)
{
    Stage(mesh, copies, file).write();
}

} // namespace molsurf
