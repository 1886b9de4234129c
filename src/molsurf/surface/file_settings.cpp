// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/file_settings.h"

#include "molsurf/kernel/mesh/measure.h"
#include "molsurf/kernel/mesh/specks.h"
#include "molsurf/show/io/file_content.h"

namespace molsurf
{

namespace
{

using Values = std::vector<std::string>;

/// The programs whose files have conventions of their own.
Values programNames()
{
    Values all = hostNames();
    all.insert(all.begin(), "apbs");
    return all;
}

FileSetting programSetting()
{
    return {"for",
            "PROGRAM[=SCALE]",
            "blender, blender4 (up to 4.5), houdini, usd, unreal,\n"
            "arnold: a .vdb with density and Cd as it takes them; SCALE mn-0.01,\n"
            "mn-0.1, nm, or units per Å; usd: a .usda beside the .vdb; apbs:\n"
            "-o FOLDER/ gets its input, charges and maps",
            "",
            holds::SceneUnits | holds::Solver,
            programNames(),
            [](FileSettings& to, const Values& values) {
                to.forApbs = lowered(values.back()) == "apbs";
                if (to.forApbs) return;
                const auto scene = parseScene(values.back());
                if (!scene)
                    wrongValue("for",
                               "apbs, blender, blender4, houdini, usd, unreal or arnold, all but "
                               "apbs perhaps with =mn-0.01, =mn-0.1, =nm or =UNITS_PER_Å",
                               values.back(), didYouMean(values.back(), programNames()));
                to.scene.host = scene->host;
                to.scene.scale = scene->scale;
                to.scene.form.oneBox |= scene->form.oneBox;
                to.scene.form.half = scene->form.half;
            },
            [](const FileSettings& of) {
                return SettingValue(std::string(of.forApbs ? "apbs" : nameOf(of.scene.host)));
            }};
}

FileSetting mipsSetting()
{
    return {
        "mips",
        "N",
        "N coarser levels of density and Cd in a .vdb, each with\n"
        "voxels twice as large: density_level_0, density_level_1, ...",
        "0",
        holds::anyGrids,
        {},
        countSetter("mips", 0, 10, MOLSURF_OF(scene.form.mips)),
        [](const FileSettings& of) { return SettingValue(std::to_string(of.scene.form.mips)); }};
}

FileSetting rateSetting()
{
    return stored(numberRow<FileSettings>(
                      {"fps", "N",
                       "frames per second, such as 24: velocities of `fields` v\n"
                       "are per second; a .usda and a film play at this rate",
                       ""},
                      holds::anyGrids | holds::VertexCurvatures | holds::Stage | holds::Moving,
                      {1e-3, 1e6, "a number from 0.001 to 1e6"}, MOLSURF_OF(fps)),
                  MOLSURF_OF(fps));
}

FileSetting turntableSetting()
{
    return {"turntable",
            "N",
            "N pictures round the upright: name.0001.png, ..., or in\na film, such as name.mp4",
            "",
            holds::Pixels,
            {},
            countSetter("turntable", 2, 9999, MOLSURF_OF(turntable))};
}

FileSetting contactsSetting()
{
    constexpr ContactLevel preset = ContactLevel::Residue;
    FileSetting row = wordRow<FileSettings>(
        "contacts", "contact areas between atoms, residues or chains: atom,\nresidue, chain",
        holds::Areas, std::vector{ContactLevel::Atom, ContactLevel::Residue, ContactLevel::Chain},
        MOLSURF_OF(contacts));
    row.value = "LEVEL";
    row.preset = nameOf(preset);
    return row;
}

FileSetting latticeSetting()
{
    return {"apbs-grid",
            "FILE.in",
            "an input of APBS whose dime, glen and gcent are used;\n"
            "without it the lattice is by pdb2pqr's rule psize",
            "",
            holds::Solver,
            {},
            [](FileSettings& to, const Values& values) { to.apbsInput = values.back(); }};
}

/// A constant of the Poisson-Boltzmann equation.
template<typename Of>
FileSetting constantSetting(RowTexts texts, const NumberRange& range, const Of& of)
{
    return numberRow<FileSettings>(std::move(texts), holds::Solver, range, of);
}

} // namespace

const char* nameOf(Walls walls)
{
    return walls == Walls::Outer ? "outer" : walls == Walls::Cavities ? "cavities" : "all";
}

const std::vector<FileSetting>& fileSettings()
{
    static const std::vector<FileSetting> all = {
        wordRow<FileSettings>(
            "walls",
            "closed pieces that meshes and pictures have: all; outer,\n"
            "without cavities; or cavities alone",
            holds::Triangles | holds::VertexCurvatures | holds::Stage | holds::ColorChoices |
                holds::Pixels,
            std::vector{Walls::All, Walls::Outer, Walls::Cavities}, MOLSURF_OF(walls),
            {{"outside exterior", "outer"}, {"inner inside interior", "cavities"}}),
        switchRow<FileSettings>("crisp", "mesh files: triangles are cut where colours meet",
                                holds::CutBorders, MOLSURF_OF(crisp)),
        programSetting(),
        stored(
            numberRow<FileSettings>({"fog-density", "D",
                                     "optical depth of an Å of fog at density 1 in the program,\n"
                                     "in any unit; without it the values of density are 0 to 1",
                                     ""},
                                    holds::anyGrids, {1e-6, 1e6, "a number from 1e-6 to 1e6"},
                                    MOLSURF_OF(scene.fogDensity)),
            MOLSURF_OF(scene.fogDensity)),
        stored(
            wordRow<FileSettings>("ids",
                                  "type of atom_id, chain_id, group_id and pocket_id in a .vdb:\n"
                                  "int32; or float, for readers that know no int32",
                                  holds::anyGrids, std::vector{IdType::Int, IdType::Float},
                                  MOLSURF_OF(scene.form.ids)),
            [](const FileSettings& of) { return std::string(nameOf(of.scene.form.ids)); }),
        stored(switchRow<FileSettings>("one-box",
                                       "all grids of a .vdb have one box of active voxels",
                                       holds::anyGrids, MOLSURF_OF(scene.form.oneBox)),
               MOLSURF_OF(scene.form.oneBox)),
        mipsSetting(),
        stored(switchRow<FileSettings>("center", "the middle of the surface comes to the origin",
                                       holds::anyGrids | holds::Triangles | holds::VertexCurvatures,
                                       MOLSURF_OF(center)),
               MOLSURF_OF(center)),
        stored(switchRow<FileSettings>(
                   "weld", "with `bySymmetry`: units share the vertices of their borders",
                   holds::Triangles, MOLSURF_OF(weld)),
               MOLSURF_OF(weld)),
        rateSetting(), turntableSetting(), contactsSetting(),
        numberRow<FileSettings>(
            {"print-scale", "S", ".stl, .obj, .wrl, .3mf in mm, S of them per Å", ""},
            holds::Millimetres, {1e-6, 1e6, "mm per Å, from 1e-6 to 1e6"}, MOLSURF_OF(printScale)),
        latticeSetting(),
        constantSetting({"pdie", "E", "relative permittivity of the molecule", "2"},
                        {1.0, 1e6, "a number from 1 on"}, MOLSURF_OF(dielectric.inside)),
        constantSetting({"sdie", "E", "relative permittivity of the solvent", "78.54"},
                        {1.0, 1e6, "a number from 1 on"}, MOLSURF_OF(dielectric.outside)),
        // Salts of water saturate near 6 mol/L: what is above 10 is in mmol/L.
        constantSetting({"ion-conc", "C", "concentration of a 1:1 salt [mol/L]", "0"},
                        {0.0, 10.0, "0 to 10 mol/L"}, MOLSURF_OF(dielectric.salt))};
    return all;
}

void keepWalls(Walls walls, const Progress& progress, Mesh& mesh)
{
    if (walls == Walls::All || mesh.triangles.empty()) return; // no file has a mesh
    const MeshPieces pieces = piecesOf(mesh, progress);
    std::vector<char> gone;
    for (const PieceMeasure& piece : pieces.measures)
        gone.push_back((piece.volume < 0.0) != (walls == Walls::Cavities));
    removePieces(pieces, gone, mesh);
    if (mesh.triangles.empty())
        throw Error(ErrorKind::Input, "`walls` cavities: the surface has no cavity");
}

openvdb::Vec3d moveToOrigin(Mesh& mesh, const openvdb::Vec3d* center)
{
    openvdb::BBoxd box;
    for (const openvdb::Vec3f& p : mesh.positions) box.expand(openvdb::Vec3d(p));
    const openvdb::Vec3d origin = center ? *center : box.getCenter();
    for (openvdb::Vec3f& p : mesh.positions) p = openvdb::Vec3f(openvdb::Vec3d(p) - origin);
    return origin;
}

} // namespace molsurf
