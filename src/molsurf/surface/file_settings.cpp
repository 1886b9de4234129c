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
    FileSetting row{"for",
                    SettingType::Text,
                    "PROGRAM[=SCALE]",
                    "blender, blender4 (up to 4.5), houdini, usd, unreal,\n"
                    "arnold: a .vdb with density and Cd as it takes them; SCALE mn-0.01,\n"
                    "mn-0.1, nm, or units per Å; usd: a .usda beside the .vdb; apbs:\n"
                    "-o FOLDER/ gets its input, charges and maps",
                    "",
                    programNames()};
    row.set = [](FileSettings& to, const Values& values) {
        to.forApbs = lowered(values.back()) == "apbs";
        if (to.forApbs) return;
        const auto scene = parseScene(values.back());
        constexpr const char* tomography[] = {"relion", "pytom", "pytom-match-pick", "cryocat"};
        const bool isTomography =
            std::count(std::begin(tomography), std::end(tomography), lowered(values.back())) > 0;
        if (!scene)
            wrongValue("for",
                       "apbs, blender, blender4, houdini, usd, unreal or arnold, all but "
                       "apbs perhaps with =mn-0.01, =mn-0.1, =nm or =UNITS_PER_Å",
                       values.back(),
                       isTomography ? " [hint: -o NAME.density.mrc and NAME.mask.mrc with "
                                      "`pixelSize` are what it reads]"
                                    : didYouMean(values.back(), programNames()));
        to.scene.host = scene->host;
        to.scene.scale = scene->scale;
        to.scene.form.oneBox |= scene->form.oneBox;
        to.scene.form.half = scene->form.half;
    };
    row.get = [](const FileSettings& of) {
        return std::string(of.forApbs ? "apbs" : nameOf(of.scene.host));
    };
    return shownIn(holds::SceneUnits | holds::Solver, row);
}

/// The rows of a .vdb for programs.
std::vector<FileSetting> sceneSettings()
{
    return {programSetting(),
            stored(numberRow<FileSettings>(
                       {"fog-density", "D",
                        "optical depth of an Å of fog at density 1 in the program,\n"
                        "in any unit; without it the values of density are 0 to 1"},
                       {1e-6, 1e6, "a number from 1e-6 to 1e6"}, MOLSURF_OF(scene.fogDensity)),
                   MOLSURF_OF(scene.fogDensity)),
            stored(wordRow<FileSettings>(
                       "ids",
                       "type of atom_id, chain_id, group_id and pocket_id in a .vdb:\n"
                       "int32; or float, for readers that know no int32",
                       std::vector{IdType::Int, IdType::Float}, MOLSURF_OF(scene.form.ids)),
                   [](const FileSettings& of) { return std::string(nameOf(of.scene.form.ids)); }),
            stored(switchRow<FileSettings>("one-box",
                                           "all grids of a .vdb have one box of active voxels",
                                           MOLSURF_OF(scene.form.oneBox)),
                   MOLSURF_OF(scene.form.oneBox)),
            stored(countRow<FileSettings>(
                       {"mips", "N",
                        "N coarser levels of density and Cd in a .vdb, each with\n"
                        "voxels twice as large: density_level_0, density_level_1, ...",
                        "0"},
                       0, 10, MOLSURF_OF(scene.form.mips)),
                   [](const FileSettings& of) { return std::to_string(of.scene.form.mips); })};
}

/// The rows of films and tables.
std::vector<FileSetting> seriesSettings()
{
    const auto rate =
        numberRow<FileSettings>({"fps", "N",
                                 "frames per second, such as 24: velocities of `fields` v\n"
                                 "are per second; a .usda and a film play at this rate"},
                                {1e-3, 1e6, "a number from 0.001 to 1e6"}, MOLSURF_OF(fps));
    auto contacts = wordRow<FileSettings>(
        "contacts", "contact areas between atoms, residues or chains: atom,\nresidue, chain",
        std::vector{ContactLevel::Atom, ContactLevel::Residue, ContactLevel::Chain},
        MOLSURF_OF(contacts));
    contacts.value = "LEVEL";
    contacts.preset = nameOf(ContactLevel::Residue);
    return {shownIn(holds::anyGrids | holds::VertexCurvatures | holds::Stage | holds::Moving,
                    stored(rate, MOLSURF_OF(fps))),
            shownIn(holds::Pixels,
                    countRow<FileSettings>({"turntable", "N",
                                            "N pictures round the upright: name.0001.png, ..., or "
                                            "in\na film, such as name.mp4"},
                                           2, 9999, MOLSURF_OF(turntable))),
            shownIn(holds::Areas, contacts)};
}

/// The rows of the files that APBS reads.
std::vector<FileSetting> solverSettings()
{
    return {
        ofFile(textRow<FileSettings>({"apbs-grid", "FILE.in",
                                      "an input of APBS whose dime, glen and gcent are used;\n"
                                      "without it the lattice is by pdb2pqr's rule psize"},
                                     MOLSURF_OF(apbsInput))),
        numberRow<FileSettings>({"pdie", "E", "relative permittivity of the molecule", "2"},
                                {1.0, 1e6, "a number from 1 on"}, MOLSURF_OF(dielectric.inside)),
        numberRow<FileSettings>({"sdie", "E", "relative permittivity of the solvent", "78.54"},
                                {1.0, 1e6, "a number from 1 on"}, MOLSURF_OF(dielectric.outside)),
        // Salts of water saturate near 6 mol/L: what is above 10 is in mmol/L.
        numberRow<FileSettings>({"ion-conc", "C", "concentration of a 1:1 salt [mol/L]", "0"},
                                {0.0, 10.0, "0 to 10 mol/L"}, MOLSURF_OF(dielectric.salt))};
}

/// The rows of densities and masks.
std::vector<FileSetting> tomogramSettings()
{
    constexpr unsigned both = holds::Density | holds::Mask;
    auto box = countRow<FileSettings>(
        {"box-size", "N", "pixels on an edge of the box, even; without it the least"}, 2, 1290,
        MOLSURF_OF(tomogram.box));
    box.set = [set = box.set](FileSettings& to, const Values& values) {
        set(to, values);
        if (to.tomogram.box % 2 != 0)
            wrongValue("box-size", "an even number from 2 to 1290", values.back());
    };
    return {
        shownIn(both, numberRow<FileSettings>(
                          {"pixel-size", "A", "edge of a pixel of .density.mrc and .mask.mrc [Å]"},
                          {0.1, 100.0, "0.1 to 100 Å"}, MOLSURF_OF(tomogram.pixel))),
        shownIn(both, box),
        shownIn(holds::Mask, numberRow<FileSettings>(
                                 {"mask-extend", "W",
                                  "pixels outside of the surface up to which .mask.mrc is 1", "0"},
                                 {0.0, 100.0, "0 to 100 pixels"}, MOLSURF_OF(tomogram.maskExtend))),
        shownIn(holds::Mask,
                numberRow<FileSettings>(
                    {"mask-edge", "W", "pixels over which .mask.mrc falls to 0, by a cosine", "3"},
                    {0.0, 100.0, "0 to 100 pixels"}, MOLSURF_OF(tomogram.maskEdge))),
        shownIn(holds::Density,
                switchRow<FileSettings>("invert-density",
                                        ".density.mrc is negative, as matter is in tomograms",
                                        MOLSURF_OF(tomogram.invert)))};
}

/// The rows of meshes.
std::vector<FileSetting> meshFileSettings()
{
    using namespace holds;
    return {
        shownIn(
            Triangles | VertexCurvatures | Stage | ColorChoices | Pixels,
            renamed("walls",
                    wordRow<FileSettings>(
                        "pieces",
                        "closed pieces that meshes and pictures have: all; outer,\n"
                        "without cavities; or cavities alone",
                        std::vector{KeptPieces::All, KeptPieces::Outer, KeptPieces::Cavities},
                        MOLSURF_OF(pieces),
                        {{"outside exterior", "outer"}, {"inner inside interior", "cavities"}}))),
        shownIn(CutBorders, renamed("crisp", switchRow<FileSettings>(
                                                 "sharp-colors",
                                                 "mesh files: triangles are cut where colours meet",
                                                 MOLSURF_OF(sharpColors)))),
        shownIn(anyGrids | Triangles | VertexCurvatures,
                stored(switchRow<FileSettings>("center",
                                               "the middle of the surface comes to the origin",
                                               MOLSURF_OF(center)),
                       MOLSURF_OF(center))),
        shownIn(Triangles,
                stored(switchRow<FileSettings>(
                           "weld", "with `bySymmetry`: units share the vertices of their borders",
                           MOLSURF_OF(weld)),
                       MOLSURF_OF(weld))),
        shownIn(Millimetres,
                numberRow<FileSettings>(
                    {"print-scale", "S", ".stl, .obj, .wrl, .3mf in mm, S of them per Å"},
                    {1e-6, 1e6, "mm per Å, from 1e-6 to 1e6"}, MOLSURF_OF(printScale)))};
}

} // namespace

const char* nameOf(KeptPieces pieces)
{
    return pieces == KeptPieces::Outer      ? "outer"
           : pieces == KeptPieces::Cavities ? "cavities"
                                            : "all";
}

const std::vector<FileSetting>& fileSettings()
{
    static const std::vector<FileSetting> all = [] {
        std::vector<FileSetting> rows = meshFileSettings();
        for (const FileSetting& row : sceneSettings())
            rows.push_back(row.shownIn ? row : shownIn(holds::anyGrids, row));
        for (const FileSetting& row : seriesSettings()) rows.push_back(row);
        for (const FileSetting& row : tomogramSettings()) rows.push_back(row);
        for (const FileSetting& row : solverSettings()) rows.push_back(shownIn(holds::Solver, row));
        return rows;
    }();
    return all;
}

void keepPieces(KeptPieces kept, const Progress& progress, Mesh& mesh)
{
    if (kept == KeptPieces::All || mesh.triangles.empty()) return; // no file has a mesh
    const MeshPieces pieces = piecesOf(mesh, progress);
    std::vector<char> gone;
    for (const PieceMeasure& piece : pieces.measures)
        gone.push_back((piece.volume < 0.0) != (kept == KeptPieces::Cavities));
    removePieces(pieces, gone, mesh);
    if (mesh.triangles.empty())
        throw Error(ErrorKind::Input, "`pieces` cavities: the surface has no cavity");
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
