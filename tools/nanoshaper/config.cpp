// SPDX-License-Identifier: MPL-2.0
#include "nanoshaper/config.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <functional>

namespace molsurf::nanoshaper
{

namespace
{

/// Says what is wrong with a value.
using Fail = std::function<void(const std::string& expected)>;

/// A key, and what its value does.
struct Key {
    const char* name;
    const char* help; ///< "": what it names is not needed here, and nothing is said of it
    std::function<void(Config&, const std::string& value, const Fail&)> set;
};

double number(const std::string& text, double least, double most, const Fail& fail)
{
    double value = 0.0;
    if (!parseNumber(text, value) || !(value >= least && value <= most))
        fail(formatted("a number from %g to %g", least, most));
    return value;
}

bool truth(const std::string& text, const Fail& fail)
{
    const std::string word = lowered(text);
    if (word == "true" || word == "1" || word == "yes") return true;
    if (word != "false" && word != "0" && word != "no") fail("true or false");
    return false;
}

Key text(const char* name, const char* help, std::string Config::*member)
{
    return {name, help, [=](Config& c, const std::string& v, const Fail& fail) {
                if (v.empty()) fail("a name");
                c.*member = v;
            }};
}

Key flag(const char* name, const char* help, bool Config::*member)
{
    return {name, help,
            [=](Config& c, const std::string& v, const Fail& fail) { c.*member = truth(v, fail); }};
}

Key number(const char* name, const char* help, double Config::*member, double least, double most)
{
    return {name, help, [=](Config& c, const std::string& v, const Fail& fail) {
                c.*member = number(v, least, most, fail);
            }};
}

/// A key that is refused if it is true: the run would lack what it asks for.
Key refused(const char* name)
{
    return {name, "is refused if it is true", [](Config&, const std::string& v, const Fail& fail) {
                if (truth(v, fail)) fail("false, since this program makes meshes alone");
            }};
}

/// A key of how NanoShaper works inside, which changes nothing here.
Key passed(const char* name)
{
    return {name, "", [](Config&, const std::string&, const Fail&) {}};
}

void setSurface(Config& config, const std::string& value, const Fail& fail)
{
    const std::string word = lowered(value);
    if (word == "ses")
        config.kind = SurfaceKind::SolventExcluded;
    else if (word == "blobby")
        config.kind = SurfaceKind::Gaussian;
    else
        fail("ses or blobby, the surfaces that this program makes");
}

void setMode(Config&, const std::string& value, const Fail& fail)
{
    if (lowered(value) != "normal") fail("normal, since this program makes meshes alone");
}

const std::vector<Key>& keys()
{
    static const std::vector<Key> all = {
        text("XYZR_FileName", "spheres: x y z radius on each line [molecule.xyzr]", &Config::input),
        {"Surface", "ses or blobby; skin and others are refused [ses]", setSurface},
        number("Grid_scale", "voxels an Å, 0.1 to 20 [2.0]", &Config::scale, 0.1, 20.0),
        number("Probe_Radius", "radius of the probe [1.4]", &Config::probe, 0.0, 100.0),
        {"Blobbyness", "decay of the Gaussians of blobby, below 0 [-2.5]",
         [](Config& c, const std::string& v, const Fail& fail) {
             c.blobbyness = -number(v, -100.0, -0.1, fail);
         }},
        text("Output_Folder", "where files are written [.]", &Config::folder),
        text("Root_FileName", "how the names of files begin [nothing]", &Config::root),
        flag("Triangulation", "writes the mesh [true]", &Config::mesh),
        flag("Save_Mesh_MSMS_Format", "writes .vert and .face instead of .off [false]",
             &Config::msms),
        flag("Save_Mesh_PLY_Format", "writes .ply instead of .off [false]", &Config::ply),
        flag("Compute_Vertex_Normals", "the .off has normals: OFF+N [false]", &Config::normals),
        flag("Vertex_Atom_Info", "the .off has the nearest sphere, from 0: OFF+A [false]",
             &Config::atoms),
        flag("Cavity_Detection_Filling", "leaves out small cavities [false]", &Config::fill),
        number("Conditional_Volume_Filling_Value", "volume of those that are small in Å^3 [11.4]",
               &Config::filled, 0.0, 1e9),
        {"Number_thread", "threads, 0 for all [0]",
         [](Config& c, const std::string& v, const Fail& fail) {
             c.threads = int(number(v, -1.0, 4096.0, fail));
         }},
        {"Operative_Mode", "normal; pockets and others are refused [normal]", setMode},
        refused("Build_epsilon_maps"),
        refused("Save_eps_maps"),
        refused("Save_Status_map"),
        refused("Save_Cavities"),
        refused("Save_PovRay"),
        refused("Save_Ideb_map"),
        passed("Grid_perfil"),
        passed("Grid_perfill"), // as VMD spells it
        passed("Build_status_map"),
        passed("Accurate_Triangulation"),
        passed("Check_duplicated_vertices"),
        passed("Skin_Surface_Parameter"),
        passed("Skin_Fast_Projection"),
        passed("Smooth_Mesh"),
        passed("Patch_Based_Algorithm"),
        passed("Analytical_Ray_Vs_Torus_Intersection"),
        passed("Max_Probes_Self_Intersections"),
        passed("Self_Intersections_Grid_Coefficient"),
        passed("Max_skin_patches_per_auxiliary_grid_cell"),
        passed("Max_ses_patches_per_auxiliary_grid_cell"),
        passed("Max_ses_patches_per_auxiliary_grid_2d_cell"),
        passed("Max_mesh_patches_per_auxiliary_grid_cell"),
        passed("Max_mesh_patches_per_auxiliary_grid_2d_cell"),
        passed("Ray_Casting_Accuracy"),
        passed("Debug_Internals"),
        passed("Cpu_threads"),
        passed("Pocket_Radius_Big"),
        passed("Pocket_Radius_Small"),
        passed("Optimize_Grids"),
        passed("Project_boundary_grid_points"),
        passed("Surface_File_Name"),
        passed("Keep_Water_Shaped_Cavities"),
        passed("Max_Num_Atoms"),
        passed("Domain_Shrinkage"),
        passed("Sys_Name"),
        passed("Debug_Status"),
    };
    return all;
}

const char* const usage = "vdb_molsurf_nanoshaper [surfaceConfiguration.prm]";
const char* const about =
    "Computes the surface of spheres and its mesh. It reads the configuration files of NanoShaper\n"
    "and writes its files, so it can stand in for it under the name NanoShaper. Keys that it does\n"
    "not know are passed over, with a line that says so. Defaults are in brackets.\n";
const char* const statuses = "Exit status: 0 done, 1 failed or asked for what this program does "
                             "not make, 2 wrong usage, 3 a "
                             "result failed its own checks, 75 failed; try again later, 130 "
                             "interrupted.";

} // namespace

std::string Config::path(const std::string& end) const
{
    return (folder.empty() ? "" : folder + (folder.back() == '/' ? "" : "/")) + root + end;
}

Config readConfig(const std::string& path)
{
    constexpr std::size_t enough = 1 << 20; // bytes
    const std::string content = loadSmallText(path, enough);
    Config config;
    config.file = path;
    for (LineReader lines(content); lines.next();) {
        const std::string_view line = trimmed(lines.line().substr(0, lines.line().find('#')));
        const std::size_t equals = line.find('=');
        if (line.empty() || line[0] == '%') continue;
        if (equals == std::string_view::npos)
            failAtLine(path, lines, "expected Key = value, got " + inQuotes(line));
        const std::string name(trimmed(line.substr(0, equals)));
        const std::string value(trimmed(line.substr(equals + 1)));
        const auto key = std::find_if(keys().begin(), keys().end(), [&](const Key& k) {
            return lowered(k.name) == lowered(name);
        });
        if (key == keys().end()) {
            config.warnings.push_back(displayName(path) + ": line " +
                                      std::to_string(lines.number()) + ": " + inQuotes(name) +
                                      " is no key that this program knows: it is passed over");
            continue;
        }
        key->set(config, value, [&](const std::string& expected) {
            failAtLine(path, lines, name + ": expected " + expected + ", got " + inQuotes(value));
        });
    }
    return config;
}

std::string helpText()
{
    std::string out = std::string("Usage: ") + usage + "\n\n" + about + "\n";
    for (const Key& key : keys()) {
        if (!*key.help) continue;
        std::string left = std::string("  ") + key.name;
        constexpr std::size_t column = 36;
        left.resize(std::max(left.size() + 1, column), ' ');
        out += left + key.help + "\n";
    }
    return out + "\n" + statuses + "\n";
}

std::string manualText()
{
    const auto escaped = [](const std::string& plain) {
        std::string out;
        for (const char c : plain) out += c == '-' ? std::string("\\-") : std::string(1, c);
        return out;
    };
    std::string out =
        std::string(".TH VDB_MOLSURF_NANOSHAPER 1 \"\" \"vdb_molsurf ") + MOLSURF_VERSION +
        "\"\n.SH NAME\n" + escaped("vdb_molsurf_nanoshaper - stands in for NanoShaper") +
        "\n.SH SYNOPSIS\n" + escaped(usage) + "\n.SH DESCRIPTION\n" + escaped(about) + ".SH KEYS\n";
    for (const Key& key : keys())
        if (*key.help) out += ".TP\n\\fB" + escaped(key.name) + "\\fR\n" + escaped(key.help) + "\n";
    return out + ".SH EXIT STATUS\n" + escaped(statuses) + "\n";
}

} // namespace molsurf::nanoshaper
