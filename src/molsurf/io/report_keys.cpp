// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/report_keys.h"

#include "molsurf/io/write_report.h"

#include <iterator>

namespace molsurf
{

namespace
{

constexpr ReportKey keyTable[] = {
    {"schema", "", "The version of these keys; it grows when one changes its meaning or goes"},
    {"program", "", "The program's name"},
    {"version", "", "The program's version"},
    {"command", "", "The command line, quoted for a shell"},
    {"input", "", "The path of the file with the atoms"},
    {"atoms", "", "The number of atoms or beads that the surface is made of"},
    {"voxel", "Å", "The edge of a voxel; null if no grid was made"},
    {"center", "Å",
     "The point of the input that is the origin of the files; null if the surface was not "
     "moved"},
    {"surface", "", "The measures of the surface"},
    {"surface.kind", "", "The kind, as variational or ses; mixed, of parts of several kinds"},
    {"surface.area", "Å²",
     "The area of all walls, those of cavities included. Of ses by symmetry and with filled "
     "cavities, and of ses, sas and vdw in bricks and with walls thickened, that of the mesh, "
     "which lacks "
     "what is narrower than a voxel"},
    {"surface.volume", "Å³", "The volume inside, cavities left out"},
    {"surface.euler_characteristic", "",
     "The Euler number of all walls: twice their number less twice the tunnels. Of ses, sas "
     "and vdw it is that of the exact boundary, null where units do not add up to a closed one, or "
     "four probes touch each other in one point"},
    {"surface.mesh_euler_characteristic", "",
     "The Euler number of the mesh; on ses, sas and vdw the mesh bridges what is narrower than "
     "a "
     "voxel. Null without a mesh"},
    {"surface.components", "",
     "The number of closed pieces that are no walls of cavities; null if it is not known, as "
     "of sas and vdw by symmetry"},
    {"surface.cavities", "", "The number of cavities; null if it is not known"},
    {"surface.outer_area", "Å²", "The area without the walls of cavities"},
    {"surface.outer_volume", "Å³", "The volume with the cavities"},
    {"surface.cavity_list", "", "The cavities, the largest first"},
    {"surface.cavity_list[].area", "Å²", "The area of the wall"},
    {"surface.cavity_list[].volume", "Å³", "The volume inside the wall"},
    {"surface.vertices", "", "The number of vertices of the mesh"},
    {"surface.triangles", "", "The number of triangles of the mesh"},
    {"surface.closed", "",
     "Whether every edge of the mesh has two triangles; a mesh that has not is not written"},
    {"surface.manifold", "",
     "Whether the triangles about each vertex form one fan and are oriented alike"},
    {"surface.degenerate_triangles", "", "The number of triangles without area"},
    {"surface.max_residual", "Å",
     "The largest distance of a vertex from the surface, by the spline"},
    {"surface.gradient_share", "",
     "Of the vertices away from kinks, the share at which the spline's gradient has a length "
     "within 0.03 of 1"},
    {"surface.kink_share", "", "The share of vertices within two voxels of a kink of the distance"},
    {"surface.mesh_area", "Å²",
     "The area of the mesh, where that of the surface is exact: of ses, sas and vdw. It lacks "
     "what is narrower than a voxel; null of other kinds and without a mesh"},
    {"surface.mesh_volume", "Å³", "The volume of the mesh, where that of the surface is exact"},
    {"surface.cusp_length", "Å",
     "The length of the creases of sas at which ses touches itself in cusps. Voxels round "
     "these off, so that area is missing there; null of other kinds"},
    {"surface.mean_curvature", "1/Å",
     "The distribution of the mean curvature over the area, positive where convex"},
    {"surface.mean_curvature.mean", "1/Å", "The mean"},
    {"surface.mean_curvature.standard_deviation", "1/Å", "The standard deviation"},
    {"surface.mean_curvature.min", "1/Å", "The least value"},
    {"surface.mean_curvature.max", "1/Å", "The largest value"},
    {"surface.mean_curvature.percentiles", "1/Å",
     "By the percentage of the area that does not exceed it: 1, 5, 10, 25, 50, 75, 90, 95, 99"},
    {"surface.gaussian_curvature", "1/Å²", "The same of the Gaussian curvature"},
    {"surface.total_mean_curvature", "Å",
     "The integral of the mean curvature, if it was asked for"},
    {"surface.total_gaussian_curvature", "",
     "The integral of the Gaussian curvature: 2 pi times the Euler number"},
    {"surface.willmore_energy", "", "The integral of the squared mean curvature"},
    {"surface.integrated_area", "Å²", "The area by the same quadrature"},
    {"surface.integrated_volume", "Å³", "The volume by the same quadrature"},
    {"surface.unresolved_area", "Å²",
     "The area that curvatures are not integrated over, at gaps below a voxel"},
    {"coarse", "", "Null without beads"},
    {"coarse.beads", "", "The number of beads"},
    {"coarse.atoms", "", "The number of atoms that they stand for"},
    {"resolution", "", "The rules of resolution, in their order"},
    {"resolution[].selection", "", "The selection, or all"},
    {"resolution[].resolution", "Å", "The resolution"},
    {"resolution[].atoms", "", "The number of atoms that have it"},
    {"resolution[].level", "",
     "The logarithm of the factor of their Gaussians, where the volume is kept"},
    {"evolution", "", "The flow of the variational surface; null of other kinds"},
    {"evolution.steps", "", "The number of steps"},
    {"evolution.converged", "", "Whether the interface is at rest within the tolerance"},
    {"evolution.energy", "Å²", "The energy before the first step and after each"},
    {"evolution.mean_displacement", "Å", "The mean displacement of each step"},
    {"evolution.max_speed", "1/Å", "The largest speed of each step"},
    {"evolution.final_energy", "Å²",
     "The energy by a quadrature that does not depend on the voxels"},
    {"evolution.displacement_rms", "Å",
     "The root mean square of the way of the interface in the last step"},
    {"evolution.displacement_tail", "Å",
     "The way that 99.9 % of the interface do not exceed in it"},
    {"evolution.area_error", "",
     "How much the area may still change on the way to rest, estimated as a share of it"},
    {"evolution.unsettled_share", "", "The share of the interface at which it is above 0.1 voxel"},
    {"evolution.crevice_voxels", "",
     "The number of voxels at gaps that are too narrow for the grid"},
    {"evolution.front_steps", "",
     "The number of steps that fronts made alone, between those of the whole"},
    {"evolution.restless_fronts", "",
     "The number of blocks of 8³ voxels where one still moved at the end"},
    {"evolution.gaps", "",
     "How gaps were decided by psi; null in bricks, and where voxels and fronts decide"},
    {"evolution.gaps.found", "", "The number of cavities, tunnels and slits near the decision"},
    {"evolution.gaps.closed", "",
     "The number of those that tension closes though no atom fills them"},
    {"evolution.gaps.nearest", "",
     "How near to the decision the nearest one is, as a value of psi"},
    {"evolution.walls", "",
     "How thin walls and necks were decided by psi; null where gaps are, and on voxels above "
     "0.75 Å or two thirds of the probe"},
    {"evolution.walls.found", "", "The number of those near the decision"},
    {"evolution.walls.closed", "", "The number of those that are thicker than 0.12 Å"},
    {"evolution.walls.nearest", "Å", "How near to the decision the nearest one is, as a depth"},
    {"evolution.area", "Å²", "The area of the interface, before the first step and after each"},
    {"evolution.volume", "Å³", "The volume inside it, likewise"},
    {"grid", "", "The level set"},
    {"grid.active_voxels", "", "The number of its active voxels"},
    {"grid.bytes", "byte", "The memory that it takes"},
    {"seconds", "s", "Wall times by stage; the last is total"},
    {"peak_memory_bytes", "byte", "The largest memory of the process"},
    {"threads", "", "The number of threads that the run could use"},
    {"groups", "", "Groups of atoms; their areas and volumes add up to the whole"},
    {"groups[].name", "", "The name, or other for the atoms of no group"},
    {"groups[].atoms", "", "The number of its atoms"},
    {"groups[].area", "Å²", "The area of the surface that is nearest to its atoms"},
    {"groups[].volume", "Å³",
     "The volume inside that is nearest to its atoms; null without a grid"},
    {"groups[].color", "", "Its colour as #rrggbb if the surface is coloured by group"},
    {"groups[].alone_area", "Å²", "The area of the group alone, on the surface of areas_of"},
    {"areas_of", "",
     "The kind of surface that interfaces and tables are of: sas unless another is asked for; "
     "null if there are none"},
    {"interfaces", "", "Pairs of groups that bury area between them"},
    {"interfaces[].groups", "", "The names of both"},
    {"interfaces[].buried_area", "Å²", "Half of the area that both lose by meeting"},
    {"interfaces[].count", "", "How many such there are in a whole by symmetry"},
    {"parts", "", "Groups with surfaces of their own"},
    {"parts[].name", "", "The name of the group"},
    {"parts[].atoms", "", "The number of its atoms"},
    {"parts[].surface", "", "Its measures, with the keys of surface"},
    {"instances", "", "The copies of an assembly that nodes place"},
    {"instances[].part", "", "The index of the part that it is a copy of"},
    {"instances[].operator", "", "The name of the operator"},
    {"instances[].matrix", "", "x to matrix x of points (x, y, z, 1), row by row"},
    {"symmetry", "", "How the whole follows from a unit by symmetry; null if it was made at once"},
    {"symmetry.point_group", "", "Schoenflies' symbol"},
    {"symmetry.order", "", "The number of units"},
    {"symmetry.copies_in_unit", "", "The number of the assembly's copies in a unit"},
    {"symmetry.deviation", "Å", "The farthest that a copy lies from where a rotation brings it"},
    {"symmetry.gap", "Å", "The largest gap between units that was closed"},
    {"symmetry.open_vertices", "",
     "The edges of a unit's border that fit none: triangles fill holes there"},
    {"warnings", "", "One text each"},
    {"areas", "",
     "The tables of areas that were asked for, by their names; each row has the keys of the "
     ".csv"}};

} // namespace

const std::vector<ReportKey>& reportKeys()
{
    static const std::vector<ReportKey> all(std::begin(keyTable), std::end(keyTable));
    return all;
}

std::string reportPage()
{
    std::string page =
        "# The report\n\nA .json file holds a report of the surface and of the run. The keys of "
        "schema " +
        std::to_string(reportSchema) +
        " are these; a number that is\nnot known is null. Keys may be added; one that changes its "
        "meaning or goes raises `schema`.\n\n| key | unit | meaning |\n|---|---|---|\n";
    for (const ReportKey& key : reportKeys())
        page += "| `" + std::string(key.path) + "` | " + key.unit + " | " + key.meaning + " |\n";
    return page;
}

} // namespace molsurf
