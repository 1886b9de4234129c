// SPDX-License-Identifier: MPL-2.0
#include "cli_table.h"

#include "molsurf/bricks/plan_bricks.h"

#include <algorithm>

namespace molsurf::tool
{

namespace
{

// The lines of an option in a help text.
std::string helpLine(const Entry& entry)
{
    const std::string name = entry.name;
    const std::size_t comma = name.find(',');
    std::string line =
        comma == std::string::npos ? "      --" : "  -" + name.substr(comma + 1) + ", --";
    line += longName(entry);
    if (entry.value) line += std::string(" ") + entry.value;

    const std::size_t column = 26;
    std::string text = entry.text;
    if (!entry.preset.empty()) text += " [" + entry.preset + "]";
    line.resize(std::max(line.size() + 1, column), ' ');
    for (char letter : text) {
        line += letter;
        if (letter == '\n') line.append(column, ' ');
    }
    return line + "\n";
}

std::string tableOf(const std::vector<Group>& groups)
{
    std::string text;
    for (const Group& group : groups) {
        text += std::string("\n") + group.title + "\n";
        for (const Entry& entry : group.entries) text += helpLine(entry);
    }
    return text;
}

const char* const runOptions =
    "\n"
    "Also --threads, --quiet, --verbose and --no-progress of vdb_molsurf --help.\n";

} // namespace

std::string helpText()
{
    std::string text =
        "vdb_molsurf INPUT -o FILE [-o FILE ...] [options]\n"
        "vdb_molsurf batch LIST -O DIR [options]\n"
        "vdb_molsurf compare A B [-o FILE ...] [options]\n"
        "vdb_molsurf plan INPUT -o plan.json, brick plan.json K, merge plan.json -o FILE\n"
        "vdb_molsurf mesh|color FILE.vdb -o FILE [-o FILE ...] [options]\n"
        "vdb_molsurf info FILE ...\n"
        "\n"
        "Builds the molecular surface of the atoms in INPUT (.pdb .ent .cif .mmcif .pqr .xyzr,\n"
        "each also .gz, or - for standard input). Lengths are in Å. Defaults are in brackets.\n";
    text += tableOf(groups());
    text += "\n"
            "Exit status: 0 done, 1 failed, 2 wrong usage, 3 not converged (files are written) or\n"
            "a result failed its own checks (none are), 130 interrupted.\n";
    return text;
}

std::string batchHelpText()
{
    std::string text =
        "vdb_molsurf batch LIST -O DIR [options]\n"
        "\n"
        "Builds the surfaces of many structures, one after the other. LIST has the name of a\n"
        "structure file a line, - is standard input; empty lines and those with # do not count.\n"
        "A folder in its place stands for all structures in it.\n"
        "What fails is reported and does not stop the rest. DIR/summary.csv and summary.json have\n"
        "a line each; the same command once more does what was not done, or failed.\n";
    text += tableOf(batchGroups());
    text +=
        "\n"
        "All other options are those of vdb_molsurf --help.\n"
        "\n"
        "Exit status: 0 all done, 1 some failed, 2 wrong usage, 3 some did not converge (their\n"
        "files are written), 130 interrupted.\n";
    return text;
}

std::string compareHelpText()
{
    std::string text =
        "vdb_molsurf compare A B [-o FILE ...] [options]\n"
        "\n"
        "Distances of surface A from surface B and back, areas and volumes. A and B are each a\n"
        ".vdb file (the grid surface, or the only level set), a mesh (.ply .obj .stl), or a\n"
        "structure, whose surface is built with the options below. Lengths are in Å.\n";
    text += tableOf(shownGroups(Verb::Compare));
    text +=
        "\n"
        "Distances are Euclidean, from the vertices of one surface to the closest point of the\n"
        "other; signed ones are negative inside it. Means are weighted by area. On .vdb files\n"
        "and structures both are smooth surfaces, meshes are their triangles.\n"
        "\n"
        "Exit status: 0 done, 1 failed, 2 wrong usage, 3 not converged (files are written) or\n"
        "a result failed its own checks (none are), 130 interrupted.\n";
    return text;
}

std::string storedHelpText(Verb verb)
{
    std::string text =
        verb == Verb::ColorHelp
            ? "vdb_molsurf color FILE.vdb --color WORD -o FILE [-o FILE ...] [options]\n"
              "\n"
              "Colours a stored surface anew, without the atoms: the grids of FILE.vdb with\n"
              "another Cd, meshes, pictures.\n"
            : "vdb_molsurf mesh FILE.vdb -o FILE [-o FILE ...] [options]\n"
              "\n"
              "Meshes and pictures of a stored surface, without computing it again.\n";
    text += "The mesh is that of the grid spline; without it a spline is fitted to the grid\n"
            "surface. The grids atom_id, chain_id and group_id label the vertices.\n";
    text += tableOf(groupsOf(verb == Verb::ColorHelp ? Verb::Color : Verb::Mesh));
    text += "\n"
            "Exit status: 0 done, 1 failed, 2 wrong usage, 130 interrupted.\n";
    return text;
}

std::string infoHelpText()
{
    return "vdb_molsurf info FILE ...\n"
           "\n"
           "Prints what files hold. OpenVDB files: metadata, grids with type, class, voxel size,\n"
           "background, active voxels, memory and bounding box, and the area and volume of level\n"
           "sets. Structures: models, chains, atoms, and assemblies with their copies, point "
           "group\n"
           "and rotation axes; for every fold the copies that --copies fold:N takes. The content\n"
           "says which it is, not the name.\n";
}

std::string planHelpText()
{
    return "vdb_molsurf plan INPUT -o plan.json (--bricks N | --memory SIZE) [options]\n"
           "\n"
           "Cuts the space about a molecule into bricks that can be computed one by one, on one\n"
           "machine or many, and says what each of them is expected to take. Writes a manifest\n"
           "for the verbs brick and merge, which refuse an INPUT that has changed since.\n" +
           tableOf(planGroups()) +
           "\n"
           "All other options are those of vdb_molsurf --help, but for pictures and for what "
           "needs\n"
           "the whole molecule at once. The number of steps is fixed by the plan [--steps " +
           std::to_string(defaultBrickSteps) + "].\n";
}

std::string brickHelpText()
{
    return "vdb_molsurf brick plan.json K [options]\n"
           "\n"
           "Computes brick K of a plan, from 1 to the number of bricks, and writes it beside the\n"
           "manifest, as plan.K.brick. A brick that is there already is not done again.\n" +
           tableOf(brickGroups()) + runOptions;
}

std::string mergeHelpText()
{
    return "vdb_molsurf merge plan.json -o FILE [-o FILE ...] [options]\n"
           "\n"
           "Joins the bricks of a plan, all of which have to be there, to one level set and one\n"
           "closed mesh. Holds neither in memory.\n" +
           tableOf(mergeGroups()) + runOptions +
           "\n"
           "Exit status: 0 done, 1 failed, 2 wrong usage, 3 not converged (files are written) or\n"
           "a result failed its own checks (none are), 130 interrupted.\n";
}

} // namespace molsurf::tool
