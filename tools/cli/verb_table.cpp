// SPDX-License-Identifier: MPL-2.0
#include "cli/verb_table.h"

#include "cli/complete.h"

#include "verbs.h"

#include "molsurf/show/io/describe_structure.h"
#include "molsurf/show/io/describe_vdb.h"
#include "molsurf/show/io/read_vdb.h"

#include <algorithm>
#include <iostream>

namespace molsurf::tool
{

namespace
{

constexpr const char* checkedStatus =
    "not converged (files are written) or a result failed its own checks (none are)";

VerbInfo buildVerb()
{
    return {
        Build,
        "build",
        "INPUT -o FILE [-o FILE ...] [options]",
        "Builds the molecular surface of the atoms in INPUT (.pdb .ent .cif .mmcif .bcif .gro\n"
        ".psf .parm7 .sdf .mol .mol2 .pdbqt .xyz .pqr .xyzr .xyzrn, each also .gz, .bz2 or .xz, or "
        "-\n"
        "for standard input): a level set as OpenVDB grid, meshes, pictures, a report.\n"
        "With --frames, one output per frame.",
        "",
        checkedStatus,
        {{"vdb_molsurf 1crn.pdb -o 1crn.vdb -o 1crn.ply",
          "the smooth surface as level set and mesh"},
         {"vdb_molsurf 4hhb.cif.gz --assembly 1 --color chain -o 4hhb.png", "a picture by chain"},
         {"vdb_molsurf 1ubq.pdb --surface ses -o 1ubq.json -o 1ubq.residues.csv",
          "exact area and volume, and the areas of residues"}},
        completeBuild,
        [](const CommandLine& call, auto start) {
            return call.frames.empty() ? build(call, start) : frames(call, start);
        }};
}

VerbInfo batchVerb()
{
    return {
        Batch,
        "batch",
        "LIST -O DIR [options]",
        "Builds the surfaces of many structures, one after the other.",
        "LIST names a structure file a line, - is standard input; empty lines and lines with #\n"
        "do not count. A folder or an archive (.tar .tar.gz .tgz) in its place means all\n"
        "structures in it; a member of an archive is called archive.tar::member.\n"
        "A failed structure is reported; the others continue. DIR/summary.csv and summary.json\n"
        "have a line each; the same command once more makes those that are missing, failed or\n"
        "of an input that has changed. Several lists may share DIR, also at the same time.\n"
        "The exit status is 1 if some failed, or 75 if it helps to try one of these again later.\n",
        "some did not converge (their files are written)",
        {{"vdb_molsurf batch structures/ -O surfaces --surface sas --formats json",
          "a report for each structure of a folder, and a table of all"}},
        completeBatch,
        [](const CommandLine& call, auto) { return batch(call); }};
}

VerbInfo compareVerb()
{
    return {
        Compare,
        "compare",
        "A B [-o FILE ...] [options]",
        "Measures the distances of surface A from surface B and back, areas and volumes.",
        "A and B are each a .vdb file (the grid surface, or the only level set), a mesh (.ply\n"
        ".obj .stl), or a structure, whose surface is built with the options below.\n"
        "Distances are Euclidean, from the vertices of one surface to the closest point of the\n"
        "other; signed ones are negative inside it. Means are weighted by area. Of .vdb files\n"
        "and structures both are smooth surfaces, meshes are their triangles.\n",
        checkedStatus,
        {{"vdb_molsurf compare a.vdb b.vdb -o difference.ply", "a mesh coloured by distance"}},
        completeCompare,
        [](const CommandLine& call, auto start) { return tool::compare(call, start); }};
}

VerbInfo convertVerb()
{
    return {Convert,
            "convert",
            "FILE -o FILE [-o FILE ...] [options]",
            "Makes meshes, pictures and other colours of a stored surface, and volumes of maps.",
            "The surface is not computed again. The mesh is that of the grid spline; without this\n"
            "grid a spline is fitted to the grid surface.\n"
            "The grids atom_id, chain_id and group_id label the vertices.\n"
            "A map (.mrc .map .ccp4 .dx) becomes the fog or level set of a .vdb or .nvdb.\n",
            "",
            {{"vdb_molsurf convert 1crn.vdb -o 1crn.stl", "a mesh of a stored surface"},
             {"vdb_molsurf convert emd_1234.map.gz --iso 0.1 -o emd.vdb",
              "the level set of a map at a value"}},
            completeConvert,
            [](const CommandLine& call, auto start) { return convert(call, start); }};
}

VerbInfo planVerb()
{
    return {
        BricksPlan,
        "bricks plan",
        "INPUT -o plan.json (--bricks N | --memory SIZE) [options]",
        "Cuts the space about a molecule into bricks that can be computed on many machines.",
        "It prints what each brick is expected to take, and writes a manifest and plan.atoms, the\n"
        "atoms sorted by place. bricks run needs these two; bricks merge refuses an INPUT that\n"
        "has changed since. Options that need the whole molecule at once are not for bricks. The\n"
        "plan fixes the number of steps of a flow.\n",
        "",
        {{"vdb_molsurf bricks plan 4v5a.cif.gz --memory 500M -o plan.json",
          "a plan whose bricks take 500 MiB each"}},
        completePlan,
        [](const CommandLine& call, auto) { return plan(call); }};
}

VerbInfo brickVerb()
{
    return {
        BricksRun,
        "bricks run",
        "plan.json K [options]",
        "Computes brick K of a plan, from 1 to the number of bricks.",
        "It is written beside the manifest, as plan.K.brick. A brick that exists is not computed\n"
        "again.\n",
        "",
        {},
        completeBrick,
        [](const CommandLine& call, auto) { return brick(call); }};
}

VerbInfo mergeVerb()
{
    return {BricksMerge,
            "bricks merge",
            "plan.json -o FILE [-o FILE ...] [options]",
            "Joins the bricks of a plan to one level set and one closed mesh.",
            "All bricks have to exist. Neither the level set nor the mesh is held in memory.\n",
            checkedStatus,
            {{"vdb_molsurf bricks merge plan.json -o 4v5a.vdb", "the surface of all bricks"}},
            completeMerge,
            [](const CommandLine& call, auto start) { return merge(call, start); }};
}

VerbInfo infoVerb()
{
    return {
        Info,
        "info",
        "FILE ...",
        "Prints what .vdb files and structures hold.",
        "OpenVDB files: metadata, grids with type, class, voxel size, background, active voxels,\n"
        "memory and bounding box, and the area and volume of level sets. Structures: models,\n"
        "chains, atoms, and assemblies with their copies, point group and rotation axes; for\n"
        "every fold the copies that --copies fold:N takes. The content decides which it is, not\n"
        "the name.\n",
        "",
        {{"vdb_molsurf info 4hhb.cif.gz", "its chains and assemblies"}},
        completeInfo,
        [](const CommandLine& call, auto) {
            for (const std::string& path : call.inputs)
                std::cout << (isVdbFile(path)
                                  ? describeVdb(path)
                                  : describeStructure(path, call.atoms.limits.maxInput));
            return 0;
        }};
}

} // namespace

const std::vector<VerbInfo>& verbTable()
{
    static const std::vector<VerbInfo> all = {buildVerb(),   batchVerb(), compareVerb(),
                                              convertVerb(), planVerb(),  brickVerb(),
                                              mergeVerb(),   infoVerb()};
    return all;
}

const VerbInfo& infoOf(Verb verb)
{
    return *std::find_if(verbTable().begin(), verbTable().end(),
                         [=](const VerbInfo& info) { return info.verb == verb; });
}

} // namespace molsurf::tool
