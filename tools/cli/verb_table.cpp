// SPDX-License-Identifier: MPL-2.0
#include "cli/verb_table.h"

#include "cli/complete.h"

#include "verbs.h"

#include "molsurf/io/describe_vdb.h"
#include "molsurf/io/read_vdb.h"
#include "molsurf/selection/describe_structure.h"

#include <algorithm>
#include <iostream>

namespace molsurf::tool
{

namespace
{

constexpr const char* checkedStatus =
    "3 not converged (files are written) or a result failed its own checks (none are)";

} // namespace

const std::vector<VerbInfo>& verbTable()
{
    static const std::vector<VerbInfo> all = {
        {Build, "build", "INPUT -o FILE [-o FILE ...] [options]",
         "Builds the molecular surface of the atoms in INPUT (.pdb .ent .cif .mmcif .bcif .gro\n"
         ".psf .sdf .mol .mol2 .pdbqt .xyz .pqr .xyzr .xyzrn, each also .gz, .bz2 or .xz,\n"
         "or - for standard input): a level set as OpenVDB grid,\n"
         "meshes, pictures, a report. With --frames one a frame.",
         "", checkedStatus, completeBuild,
         [](const Call& call, auto start) {
             return call.frames.empty() ? build(call, start) : frames(call, start);
         }},
        {Batch, "batch", "LIST -O DIR [options]",
         "Builds the surfaces of many structures, one after the other.",
         "LIST has the name of a structure file a line, - is standard input; empty lines and "
         "those\n"
         "with # do not count. A folder in its place stands for all structures in it.\n"
         "What fails is reported and does not stop the rest. DIR/summary.csv and summary.json "
         "have\n"
         "a line each; the same command once more does what was not done, or failed.\n",
         "1 some failed, 3 some did not converge (their files are written)", completeBatch,
         [](const Call& call, auto) { return batch(call); }},
        {Compare, "compare", "A B [-o FILE ...] [options]",
         "Measures the distances of surface A from surface B and back, areas and volumes.",
         "A and B are each a .vdb file (the grid surface, or the only level set), a mesh (.ply "
         ".obj\n"
         ".stl), or a structure, whose surface is built with the options below.\n"
         "Distances are Euclidean, from the vertices of one surface to the closest point of the\n"
         "other; signed ones are negative inside it. Means are weighted by area. Of .vdb files\n"
         "and structures both are smooth surfaces, meshes are their triangles.\n",
         checkedStatus, completeCompare,
         [](const Call& call, auto start) { return tool::compare(call, start); }},
        {Convert, "convert", "FILE.vdb -o FILE [-o FILE ...] [options]",
         "Makes meshes, pictures and other colours of a stored surface, without computing it "
         "again.",
         "The mesh is that of the grid spline; without it a spline is fitted to the grid surface.\n"
         "The grids atom_id, chain_id and group_id label the vertices.\n",
         "", completeConvert, [](const Call& call, auto start) { return convert(call, start); }},
        {BricksPlan, "bricks plan", "INPUT -o plan.json (--bricks N | --memory SIZE) [options]",
         "Cuts the space about a molecule into bricks that can be computed on many machines.",
         "It says what each brick is expected to take, and writes a manifest for bricks run and\n"
         "bricks merge, which refuse an INPUT that has changed since. Options that need the whole\n"
         "molecule at once are not for bricks. The plan fixes the number of steps.\n",
         "", completePlan, [](const Call& call, auto) { return plan(call); }},
        {BricksRun, "bricks run", "plan.json K [options]",
         "Computes brick K of a plan, from 1 to the number of bricks.",
         "It is written beside the manifest, as plan.K.brick. A brick that is there already is "
         "not\n"
         "done again.\n",
         "", completeBrick, [](const Call& call, auto) { return brick(call); }},
        {BricksMerge, "bricks merge", "plan.json -o FILE [-o FILE ...] [options]",
         "Joins the bricks of a plan to one level set and one closed mesh.",
         "All bricks have to be there. Neither the level set nor the mesh is held in memory.\n",
         checkedStatus, completeMerge,
         [](const Call& call, auto start) { return merge(call, start); }},
        {Info, "info", "FILE ...", "Prints what .vdb files and structures hold.",
         "OpenVDB files: metadata, grids with type, class, voxel size, background, active voxels,\n"
         "memory and bounding box, and the area and volume of level sets. Structures: models,\n"
         "chains, atoms, and assemblies with their copies, point group and rotation axes; for "
         "every\n"
         "fold the copies that --copies fold:N takes. The content says which it is, not the "
         "name.\n",
         "", completeInfo, [](const Call& call, auto) {
             for (const std::string& path : call.inputs)
                 std::cout << (isVdbFile(path) ? describeVdb(path)
                                               : describeStructure(path, call.atoms.maxInput));
             return 0;
         }}};
    return all;
}

const VerbInfo& infoOf(Verb verb)
{
    return *std::find_if(verbTable().begin(), verbTable().end(),
                         [=](const VerbInfo& info) { return info.verb == verb; });
}

} // namespace molsurf::tool
