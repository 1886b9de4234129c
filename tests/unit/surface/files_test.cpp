// SPDX-License-Identifier: MPL-2.0
#include "molsurf/files.h"

#include "molsurf/molecule/structure/sha256.h"
#include "molsurf/surface.h"
#include "molsurf/surface/drawn_surface.h"
#include "support/folder.h"
#include "unit/structure/temp_file.h"

#include <openvdb/io/File.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace molsurf::test
{
namespace
{

/// Crambin, coloured by element.
struct Colored {
    BallSet atoms = readAtoms(dataFile("1crn.pdb"));
    SurfaceOptions options = [] {
        SurfaceOptions o;
        o.kind = SurfaceKind::SolventExcluded;
        o.voxel = 1.0;
        o.color = ColorBy::Element;
        return o;
    }();
    MolecularSurface surface = makeSurface(atoms, options);
};

/// The level set of a file, and the units per Å that the file tells.
std::pair<openvdb::FloatGrid::Ptr, double> levelSetIn(const std::string& path)
{
    openvdb::initialize();
    openvdb::io::File file(path);
    file.open();
    return {openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("surface")),
            file.getMetadata()->metaValue<double>("scene.units_per_angstrom")};
}

TEST(Files, PlaceALevelSetInAScene)
{
    const Colored made;
    const Folder folder;
    writeVdb(made.surface, folder / "a.vdb");
    writeVdb(made.surface, folder / "b.vdb", true, "blender4=0.5");
    const auto [plain, one] = levelSetIn(folder / "a.vdb");
    const auto [placed, half] = levelSetIn(folder / "b.vdb");
    EXPECT_EQ(one, 1.0);
    EXPECT_EQ(half, 0.5);
    EXPECT_EQ(plain->activeVoxelCount(), placed->activeVoxelCount());
    const openvdb::Coord voxel(3, 4, 5);
    const openvdb::Vec3d at = placed->indexToWorld(voxel);
    EXPECT_LT((at - (0.5 * plain->indexToWorld(voxel) - openvdb::Vec3d(0.25))).length(), 1e-12);
    EXPECT_FLOAT_EQ(placed->tree().getValue(voxel), 0.5f * plain->tree().getValue(voxel));
    EXPECT_HAS(
        errorOf(ErrorKind::Usage, [&] { writeVdb(made.surface, folder / "c.vdb", true, "maya"); }),
        "expected blender, houdini or usd");
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.vdb", "b.vdb"}));
}

TEST(Files, HaveTheDigestOfTheInput)
{
    const Folder folder;
    const Colored made;
    writeSurface({{&made.atoms, &made.surface, &made.options}}, folder / "a.json", {}, false);
    const std::string digest = sha256OfFile(dataFile("1crn.pdb"));
    EXPECT_EQ(digest.size(), 64u);
    EXPECT_HAS(contentOf(folder / "a.json"), "\"input_sha256\": \"" + digest + "\"");
    BallSet loose = made.atoms;
    loose.record.isFile = false;
    writeSurface({{&loose, &made.surface, &made.options}}, folder / "b.json", {}, false);
    EXPECT_HAS(contentOf(folder / "b.json"), "\"input_sha256\": null");
}

TEST(Files, DrawASurfaceWithItsLegend)
{
    const Colored made;
    const Folder folder;
    writePicture(made.atoms, made.surface, made.options, folder / "legend.png",
                 {{"size", "200"}, {"legend", "on"}});
    writePicture(made.surface.mesh, folder / "bare.png", 200);
    const std::string legend = contentOf(folder / "legend.png");
    const std::string bare = contentOf(folder / "bare.png");
    EXPECT_EQ(legend.substr(1, 3), "PNG");
    EXPECT_EQ(legend.substr(16, 4), bare.substr(16, 4)); // the width
    EXPECT_NE(legend, bare);
    const auto draw = [&](const char* name, const char* value) {
        writePicture(made.atoms, made.surface, made.options, folder / "a.png",
                     {{"size", "200"}, {name, value}});
        return contentOf(folder / "a.png");
    };
    EXPECT_EQ(draw("legend", "on"), legend);
    EXPECT_NE(draw("legend", "auto"), legend); // 200 pixels are too narrow for one
    EXPECT_NE(draw("view", "1,0,0"), draw("view", "0,1,0"));
    const auto errorWith = [&](const char* name, const char* value) {
        return errorOf(ErrorKind::Usage, [&] { draw(name, value); });
    };
    EXPECT_HAS(errorWith("size", "15"), "`size`: expected a whole number from 16 to 16384");
    EXPECT_HAS(errorWith("view", "A/10"),
               "`view`: expected auto, a direction X,Y,Z, an axis as z or a FILE");
    EXPECT_HAS(errorWith("sise", "15"), "no option of pictures is named");
}

/// The box of a mesh.
openvdb::BBoxd boxOf(const Mesh& mesh)
{
    openvdb::BBoxd box;
    for (const openvdb::Vec3f& p : mesh.positions) box.expand(openvdb::Vec3d(p));
    return box;
}

TEST(Files, HoldMeshesAsSettingsSay)
{
    const Colored made;
    const Folder folder;
    const ShownSurface shown{&made.atoms, &made.surface, &made.options, ""};
    using Words = std::vector<std::pair<std::string, std::string>>;
    const auto read = [&](const std::string& name, const Words& settings) {
        writeSurface({shown}, folder / name, settings);
        return readMesh(folder / name);
    };
    const Mesh all = read("a.ply", {}), crisp = read("a.ply", {{"sharp-colors", ""}});
    EXPECT_EQ(all.triangles.size(), made.surface.mesh.triangles.size());
    EXPECT_GT(crisp.triangles.size(), all.triangles.size());
    const Mesh outer = read("a.obj", {{"pieces", "outer"}});
    const Mesh cavities = read("a.ply", {{"pieces", "cavities"}, {"center", ""}});
    EXPECT_EQ(outer.triangles.size() + cavities.triangles.size(), all.triangles.size());
    EXPECT_LT(cavities.triangles.size(), outer.triangles.size());
    EXPECT_EQ(read("a.obj", {{"walls", "outer"}}).triangles, outer.triangles); // its former name
    EXPECT_LT(boxOf(cavities).getCenter().length(), 1e-5);
    EXPECT_GT(boxOf(outer).getCenter().length(), 1.0);
    EXPECT_LT(boxOf(read("a.stl", {{"center", ""}})).getCenter().length(), 1e-4);
    const Mesh printed = read("a.stl", {{"print-scale", "0.5"}});
    EXPECT_LT((boxOf(printed).extents() - 0.5 * boxOf(all).extents()).length(), 1e-4);
    writeSurface({shown}, folder / "a.glb", {{"for", "blender=0.25"}, {"plain-color", "#010203"}});
    EXPECT_HAS(contentOf(folder / "a.glb"), "0.25");
    const auto errorWith = [&](const std::string& name, const Words& settings) {
        return errorOf(ErrorKind::Usage, [&] { read(name, settings); });
    };
    EXPECT_HAS(errorWith("b.stl", {{"sharp-colors", ""}}), "`sharpColors`: ");
    EXPECT_HAS(errorWith("b.ply", {{"print-scale", "2"}}), "b.ply does not show it");
    EXPECT_HAS(errorWith("b.ply", {{"size", "100"}}), "`size`: ");
    EXPECT_HAS(errorWith("b.png", {{"center", ""}}), "`center`: ");
    EXPECT_HAS(errorWith("b.json", {{"pieces", "outer"}}), "`pieces`: ");
    EXPECT_HAS(errorWith("b.stl", {{"pieces", "inner"}}), "expected all or outer or cavities");
    EXPECT_HAS(errorWith("b.xyz", {}), "expected a name that ends in .vdb, .ply");
    EXPECT_HAS(errorWith("b.ply", {{"sise", "1"}}), "is named");
    EXPECT_HAS(errorOf(ErrorKind::Usage,
                       [&] {
                           writeSurface({shown, shown}, folder / "b.ply");
                       }),
               "expected one surface, got 2");
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.glb", "a.obj", "a.ply", "a.stl"}));
}

/// All but films, which take the program ffmpeg.
TEST(Files, HaveEveryEnding)
{
    SurfaceOptions options;
    options.kind = SurfaceKind::SolventExcluded;
    options.voxel = 1.0;
    options.color = ColorBy::Chain;
    options.ballAreas = options.contacts = options.pockets = options.pocketBodies = true;
    options.patches = {ColorBy::MeanCurvature, true, 0.2};
    const BallSet atoms = readAtoms(dataFile("1crn.pdb"), {}, 1.4);
    const MolecularSurface made = makeSurface(atoms, options);
    const ShownSurface shown{&atoms, &made, &options, ""};
    const Folder folder;
    std::size_t count = 0;
    for (const std::string& ending : surfaceEndings()) {
        SCOPED_TRACE(ending);
        const bool isFilm = ending == ".mp4" || ending == ".webm" || ending == ".gif";
        const bool isOfAPore = ending.rfind(".pore", 0) == 0 || ending.rfind(".tunnels", 0) == 0;
        if (isFilm) continue;
        const auto write = [&] { writeSurface({shown}, folder / "a" + ending, {}, false); };
        if (isOfAPore)
            EXPECT_HAS(errorOf(ErrorKind::Usage, write), "got one without");
        else if (ending == ".density.mrc" || ending == ".mask.mrc")
            EXPECT_HAS(errorOf(ErrorKind::Usage, write), "expected `pixelSize`");
        else if (ending == ".interfaces.csv")
            EXPECT_HAS(errorOf(ErrorKind::Usage, write), "expected a surface with `interfaces`");
        else
            EXPECT_NO_THROW(write());
        count += !isOfAPore;
    }
    EXPECT_GT(count, 35u);
    EXPECT_HAS(contentOf(folder / "a.atoms.csv"), "residue");
    EXPECT_HAS(contentOf(folder / "a.pocket1.ply"), "element face");
    writeSurface({shown}, folder / "turn.png", {{"turntable", "3"}, {"size", "64"}});
    EXPECT_NE(contentOf(folder / "turn.0001.png"), contentOf(folder / "turn.0003.png"));
    EXPECT_EQ(contentOf(folder / "a.vdb").find("option.select") == std::string::npos, false);
}

/// A molecule without pockets has no file of one.
TEST(Files, AreNoneOfPocketsThatAreNot)
{
    SurfaceOptions options;
    options.kind = SurfaceKind::VanDerWaals;
    options.pockets = options.pocketBodies = true;
    const BallSet atoms = readAtoms(FileContent{"a.xyz", "1\n\nC 0 0 0\n"});
    const MolecularSurface made = makeSurface(atoms, options);
    ASSERT_TRUE(made.report.pockets && made.report.pockets->list.empty());
    const Folder folder;
    writeSurface({{&atoms, &made, &options}}, folder / "a.pockets.ply");
    EXPECT_TRUE(folder.names().empty());
}

TEST(Files, SayWhatTheSurfaceWasMadeWithout)
{
    const Colored made;
    const Folder folder;
    const ShownSurface shown{&made.atoms, &made.surface, &made.options, ""};
    const auto errorOfFile = [&](const std::string& name) {
        return errorOf(ErrorKind::Usage, [&] { writeSurface({shown}, folder / name); });
    };
    EXPECT_HAS(errorOfFile("a.atoms.csv"), "a.atoms.csv: expected a surface with `ballAreas`");
    EXPECT_HAS(errorOfFile("a.pdb"), "expected a surface with `ballAreas`");
    EXPECT_HAS(errorOfFile("a.pockets.ply"), "expected a surface with `pockets`");
    EXPECT_TRUE(folder.names().empty());
}

TEST(Files, MoveAndFogALevelSet)
{
    Colored made;
    made.options.fields = {"density"};
    made.surface = makeSurface(made.atoms, made.options);
    const Folder folder;
    const ShownSurface shown{&made.atoms, &made.surface, &made.options, ""};
    writeSurface({shown}, folder / "a.vdb");
    writeSurface({shown}, folder / "b.vdb",
                 {{"for", "houdini=0.5"}, {"center", ""}, {"fog-density", "0.2"}});
    const auto [plain, one] = levelSetIn(folder / "a.vdb");
    const auto [moved, half] = levelSetIn(folder / "b.vdb");
    EXPECT_EQ(half / one, 0.5);
    const openvdb::Coord voxel(3, 4, 5);
    const openvdb::Vec3d middle = boxOf(made.surface.mesh).getCenter();
    EXPECT_LT((2.0 * moved->indexToWorld(voxel) + middle - plain->indexToWorld(voxel)).length(),
              1e-9);
    openvdb::io::File file(folder / "b.vdb");
    file.open();
    float most = 0.0f;
    const auto density = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("density"));
    for (auto value = density->cbeginValueOn(); value; ++value) most = std::max(most, *value);
    EXPECT_FLOAT_EQ(most, 0.4f); // of a unit, 2 Å
}

/// Two charges in a ball: the files of APBS come all or none.
TEST(Files, HoldWhatApbsReads)
{
    const Folder folder;
    std::ofstream(folder / "ion.pqr") << "ATOM 1 C ION 1 0.0 0.0 0.0 1.0 2.0\n"
                                         "ATOM 2 C ION 2 3.0 0.0 0.0 -0.5 1.0\n";
    LabelOptions labels;
    labels.charges = true;
    SurfaceOptions options;
    options.kind = SurfaceKind::SolventExcluded;
    BallSet atoms = Molecule(folder / "ion.pqr").balls({}, labels);
    MolecularSurface surface = makeSurface(atoms, options);
    surface.report.input = "my ion.pqr";
    const ShownSurface shown{&atoms, &surface, &options, ""};
    const std::string run = folder / "run";
    writeSurface({shown}, run, {{"for", "apbs"}, {"pdie", "3"}, {"ion-conc", "0.1"}});
    const std::string input = contentOf(run + "/apbs.in");
    EXPECT_HAS(input, "pdie 3");
    EXPECT_HAS(input, "conc 0.1");
    EXPECT_HAS(input, run + "/my_ion.dielx.dx");
    EXPECT_HAS(contentOf(run + "/my_ion.charges.pqr"), "-0.5");
    const auto errorWith = [&](const std::vector<std::pair<std::string, std::string>>& more) {
        std::vector<std::pair<std::string, std::string>> settings = {{"for", "apbs"}};
        settings.insert(settings.end(), more.begin(), more.end());
        return errorOf(ErrorKind::Usage, [&] { writeSurface({shown}, folder / "run2", settings); });
    };
    EXPECT_HAS(errorWith({{"pdie", "0"}}), "`pdie`: expected a number from 1 on");
    EXPECT_HAS(errorWith({{"pieces", "outer"}}), "`pieces`: ");
    atoms.charges.reset();
    EXPECT_HAS(errorWith({}), "with their `charges`");
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"ion.pqr", "run"}));
}

/// Legends of one scale are one, and others have the name of their surface.
TEST(DrawnSurface, HasALegendForEachScale)
{
    Colored made;
    made.options.color = ColorBy::MeanCurvature;
    made.surface = makeSurface(made.atoms, made.options);
    Colored finer = made;
    finer.options.kind = SurfaceKind::VanDerWaals;
    finer.surface = makeSurface(finer.atoms, finer.options);
    const auto drawn = [](const Colored& of, const char* name) {
        DrawnSurface out{of.atoms, of.surface.mesh, of.options, DrawOptions()};
        out.name = name;
        return out;
    };
    const auto legends = legendsOf({drawn(made, "SES"), drawn(made, "again")}, Progress());
    ASSERT_EQ(legends.size(), 1u);
    const auto both = legendsOf({drawn(made, "SES"), drawn(finer, "VDW")}, Progress());
    ASSERT_EQ(both.size(), 2u);
    EXPECT_EQ(both[0].title, legends[0].title);
    EXPECT_EQ(both[1].title, legends[0].title + ", VDW");
    EXPECT_NE(both[0].scale->high, both[1].scale->high);
    DrawnSurface first = drawn(made, "one"), second = drawn(made, "two");
    first.legend = legends[0];
    second.legend = legends[0];
    second.legend->scale->high *= 2.0; // and the same low end
    EXPECT_EQ(legendsOf({first, second}, Progress()).size(), 2u);
}

/// Half a turn of panels is another view; two of them would be none.
TEST(DrawnSurface, TurnsPanelsOnce)
{
    const Colored made;
    const auto draw = [&](double turn) {
        PictureSettings settings;
        settings.picture.width = 200;
        settings.picture.turn = turn;
        const DrawnSurface panel{made.atoms, made.surface.mesh, made.options, settings.picture};
        return drawSurfaces({panel, panel}, settings, Progress()).rgb;
    };
    const auto half = draw(180.0), whole = draw(360.0);
    ASSERT_EQ(whole.size(), half.size());
    double apart = 0.0;
    for (std::size_t i = 0; i < half.size(); ++i)
        apart += std::abs(double(half[i]) - double(whole[i]));
    EXPECT_GT(apart / double(half.size()), 5.0);
}

/// Two panels are wider than they are high, the names are below, and atoms are seen beside.
TEST(Files, DrawSurfacesSideBySide)
{
    const Colored made;
    const Folder folder;
    const ShownSurface one{&made.atoms, &made.surface, &made.options, "one"};
    const auto draw = [&](const std::vector<ShownSurface>& panels) {
        writePicture(panels, folder / "a.png", {{"size", "300"}});
        return contentOf(folder / "a.png");
    };
    const auto sideOf = [](const std::string& png, std::size_t at) {
        return 256 * int(std::uint8_t(png[at + 2])) + int(std::uint8_t(png[at + 3]));
    };
    const std::string alone = draw({one}), two = draw({one, one});
    EXPECT_EQ(sideOf(two, 16), 300);
    EXPECT_LT(sideOf(two, 20), 0.7 * sideOf(alone, 20));
    ShownSurface other = one;
    other.name = "two";
    EXPECT_EQ(draw({one, other}), two); // no names without a legend
    const auto named = [&](const ShownSurface& last) {
        writePicture(std::vector{one, last}, folder / "a.png", {{"size", "300"}, {"legend", "on"}});
        return contentOf(folder / "a.png");
    };
    EXPECT_NE(named(one), named(other));
    other.show = {{"spheres", &made.atoms}};
    EXPECT_NE(draw({one, other}), two);
    writePicture(std::vector{one, one}, folder / "a.png", {{"size", "300"}, {"dpi", "300"}});
    EXPECT_HAS(contentOf(folder / "a.png"), "pHYs");
    const auto errorWith = [&](const std::vector<ShownSurface>& panels) {
        return errorOf(ErrorKind::Usage, [&] { draw(panels); });
    };
    EXPECT_HAS(errorWith({}), "expected a surface, got none");
    for (const auto& [word, atoms] : {std::pair("A/1=sticks", &made.atoms),
                                      std::pair("sticks", static_cast<const BallSet*>(nullptr))}) {
        other.show = {{word, atoms}};
        EXPECT_HAS(errorWith({other}), "`show`: expected a word and atoms with names");
    }
}

/// A label lies in the frame of its own structure alone: another one far away keeps its size.
TEST(Files, LabelTheirOwnStructure)
{
    const Colored made;
    Colored far = made;
    for (Ball& ball : far.atoms.balls) ball.center += openvdb::Vec3f(300.0f, 0.0f, 0.0f);
    far.surface = makeSurface(far.atoms, far.options);
    const Folder folder;
    const ShownSurface one{&made.atoms, &made.surface, &made.options, ""},
        other{&far.atoms, &far.surface, &far.options, ""};
    const auto highOf = [&](const ShownSurface& second) {
        writePicture(std::vector{one, second}, folder / "a.png",
                     {{"size", "300"}, {"view", "0,0,1"}, {"label", "10,10,10=here"}});
        const std::string png = contentOf(folder / "a.png");
        return 256 * int(std::uint8_t(png[22])) + int(std::uint8_t(png[23]));
    };
    EXPECT_NEAR(highOf(other), highOf(one), 2);
}

#ifndef MOLSURF_NO_VIEWER
TEST(Files, WriteAPageThatNamesTheAtoms)
{
    const Colored made;
    const Folder folder;
    writePicture(made.atoms, made.surface, made.options, folder / "crambin.html");
    const std::string page = contentOf(folder / "crambin.html");
    EXPECT_HAS(page, "<title>1crn"); // the atoms' file, as the command has it
    EXPECT_HAS(page, "\"TYR\"");
    EXPECT_HAS(page, "Element");
    BallSet nameless = made.atoms;
    nameless.names.reset();
    writePicture(nameless, made.surface, made.options, folder / "crambin.html");
    EXPECT_EQ(contentOf(folder / "crambin.html").find("\"TYR\""), std::string::npos);
    const ShownSurface first{&made.atoms, &made.surface, &made.options, "first layer"};
    ShownSurface second = first;
    second.name = "second layer";
    writePicture(std::vector{first, second}, folder / "crambin.html");
    EXPECT_HAS(contentOf(folder / "crambin.html"), "first layer");
    EXPECT_HAS(contentOf(folder / "crambin.html"), "second layer");
}

/// Layers have the scale of values of the first.
TEST(Files, WriteAPageOfLayersInOneScale)
{
    Colored made;
    made.options.color = ColorBy::MeanCurvature;
    made.surface = makeSurface(made.atoms, made.options);
    SurfaceOptions other = made.options;
    other.kind = SurfaceKind::VanDerWaals;
    const MolecularSurface vdw = makeSurface(made.atoms, other);
    const Folder folder;
    const auto scalesOf = [&](const std::vector<ShownSurface>& layers) {
        writePicture(layers, folder / "a.html");
        const std::string page = contentOf(folder / "a.html");
        std::vector<std::string> out;
        for (std::size_t at = page.find("\"high\":"); at != std::string::npos;
             at = page.find("\"high\":", at + 1))
            out.push_back(page.substr(at, page.find(',', at) - at));
        return out;
    };
    const ShownSurface one{&made.atoms, &made.surface, &made.options, "one"},
        two{&made.atoms, &vdw, &other, "two"};
    const std::vector<std::string> first = scalesOf({one}), second = scalesOf({two});
    ASSERT_FALSE(first.empty());
    EXPECT_NE(first, second);
    std::vector<std::string> both = first;
    both.insert(both.end(), first.begin(), first.end());
    EXPECT_EQ(scalesOf({one, two}), both);
}

/// The balls of a copy have the names of those that it is made of.
TEST(Files, WriteAPageOfCopiesThatNamesTheAtoms)
{
    SelectOptions select;
    select.assembly.name = "1";
    select.assembly.instances = true;
    SurfaceOptions options;
    options.kind = SurfaceKind::VanDerWaals;
    options.voxel = 1.0;
    const BallSet atoms = readAtoms(dataFile("1a8o.pdb.gz"), select);
    const MolecularSurface dimer = makeSurface(atoms, options);
    ASSERT_EQ(dimer.mesh.parts.size(), 2u);
    const Folder folder;
    writePicture(atoms, dimer, options, folder / "dimer.html");
    EXPECT_HAS(contentOf(folder / "dimer.html"), "MSE");
}
#endif

} // namespace
} // namespace molsurf::test
