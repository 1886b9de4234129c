// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/report_keys.h"

#include "molsurf/show/io/write_report.h"

#include <iterator>

namespace molsurf
{

namespace
{

constexpr ReportKey keyTable[] = {
    {"schema", "", "Version of these keys; it grows when a key changes its meaning or is removed"},
    {"program", "", "The program's name"},
    {"version", "", "The program's version"},
    {"commit", "",
     "Commit that the program was built of, with + if files had changed; null if not from git"},
    {"options_sha256", "",
     "SHA-256 of version, options and files that they name; null for other verbs than build and "
     "batch"},
    {"command", "", "Command line, quoted for a shell"},
    {"input", "", "Path of the file with the atoms"},
    {"input_sha256", "", "SHA-256 of its bytes; null for standard input and arrays"},
    {"atoms", "", "Number of atoms or beads of the surface"},
    {"voxel", "Å", "Edge of a voxel; null if no grid was made"},
    {"center", "Å",
     "Point of the input at the origin of the files; null if the surface was not moved"},
    {"surface", "", "Measures of the surface"},
    {"surface.kind", "", "Kind, as variational or ses; mixed, of parts of several kinds"},
    {"surface.area", "Å²",
     "Area of all walls, those of cavities included. That of the mesh for ses by symmetry and with "
     "filled cavities, and for ses, sas and vdw in bricks and with thickened walls"},
    {"surface.volume", "Å³", "Volume inside, cavities left out"},
    {"surface.euler_characteristic", "",
     "Euler number of all walls: twice their number less twice the tunnels. For ses, sas and vdw "
     "that of the exact boundary; null in bricks, for ses by symmetry, where units do not add up "
     "to a closed one or were glued otherwise than they meet, or four probes touch in one point"},
    {"surface.mesh_euler_characteristic", "",
     "Euler number of the mesh, which on ses, sas and vdw bridges gaps narrower than a voxel. Null "
     "without a mesh"},
    {"surface.components", "",
     "Number of closed pieces except walls of cavities; null if unknown, as for ses, sas and vdw "
     "by "
     "symmetry and in bricks"},
    {"surface.cavities", "", "Number of cavities; null if unknown"},
    {"surface.outer_area", "Å²", "Area without the walls of cavities"},
    {"surface.outer_volume", "Å³", "Volume with the cavities"},
    {"surface.cavity_list", "", "Cavities, the largest first"},
    {"surface.cavity_list[].area", "Å²", "Area of the wall"},
    {"surface.cavity_list[].volume", "Å³", "Volume inside the wall"},
    {"surface.vertices", "", "Number of vertices of the mesh"},
    {"surface.triangles", "", "Number of triangles of the mesh"},
    {"surface.closed", "",
     "Whether every edge of the mesh has two triangles; other meshes are not written"},
    {"surface.manifold", "",
     "Whether the triangles about each vertex form one fan and are oriented alike"},
    {"surface.degenerate_triangles", "", "Number of triangles without area"},
    {"surface.max_residual", "Å", "Largest distance of a vertex from the surface, by the spline"},
    {"surface.gradient_share", "",
     "Of the vertices away from kinks, the share at which the spline's gradient has a length "
     "within 0.03 of 1"},
    {"surface.kink_share", "", "Share of vertices within two voxels of a kink of the distance"},
    {"surface.mesh_area", "Å²",
     "Area of curved patches over the mesh of ses, sas and vdw, which bridges gaps narrower than a "
     "voxel; null for other kinds and without a mesh"},
    {"surface.triangle_area", "Å²",
     "Area of the flat triangles, as in files, but for those that `sharp_colors` cuts; null "
     "without a "
     "mesh and in bricks"},
    {"surface.mesh_components", "",
     "Number of closed pieces of the mesh, walls of cavities included; null without a mesh"},
    {"surface.mesh_volume", "Å³", "Volume of that mesh"},
    {"surface.mesh_shape", "", "Triangles of `remesh`; null without it"},
    {"surface.mesh_shape.least_angle", "degree", "Least angle of all triangles"},
    {"surface.mesh_shape.share_below_20", "", "Share of triangles with an angle below 20 degrees"},
    {"surface.mesh_shape.share_below_28", "", "Share of triangles with an angle below 28 degrees"},
    {"surface.mesh_shape.shortest_edge", "Å", "Shortest edge"},
    {"surface.mesh_shape.longest_edge", "Å", "Longest edge"},
    {"surface.mesh_shape.kept_pieces", "",
     "Number of closed pieces that are too small for the edges and stay as they were"},
    {"surface.mesh_shape.euler_characteristics", "",
     "Euler characteristic of each closed piece of the mesh, as before"},
    {"surface.cusp_length", "Å",
     "Length of the creases of sas at which ses touches itself in cusps. Voxels round these, so "
     "the mesh lacks area there; null for other kinds"},
    {"surface.mean_curvature", "1/Å",
     "Distribution of the mean curvature over the area, positive where convex"},
    {"surface.mean_curvature.mean", "1/Å", "Mean"},
    {"surface.mean_curvature.standard_deviation", "1/Å", "Standard deviation"},
    {"surface.mean_curvature.min", "1/Å", "Least value"},
    {"surface.mean_curvature.max", "1/Å", "Largest value"},
    {"surface.mean_curvature.percentiles", "1/Å",
     "By the percentage of the area that does not exceed it: 1, 5, 10, 25, 50, 75, 90, 95, 99"},
    {"surface.gaussian_curvature", "1/Å²", "Same of the Gaussian curvature"},
    {"surface.total_mean_curvature", "Å", "Integral of the mean curvature, if it was asked for"},
    {"surface.total_gaussian_curvature", "",
     "Integral of the Gaussian curvature: 2 pi times the Euler number"},
    {"surface.willmore_energy", "", "Integral of the squared mean curvature"},
    {"surface.integrated_area", "Å²", "Area by the same quadrature"},
    {"surface.integrated_volume", "Å³", "Volume by the same quadrature"},
    {"surface.unresolved_area", "Å²", "Area without integrated curvature, at gaps below a voxel"},
    {"coarse", "", "Null without beads"},
    {"coarse.beads", "", "Number of beads"},
    {"coarse.atoms", "", "Number of atoms that they represent"},
    {"resolution", "", "Rules of resolution, in their order"},
    {"resolution[].selection", "", "Selection, or all"},
    {"resolution[].resolution", "Å", "Resolution"},
    {"resolution[].atoms", "", "Number of atoms that have it"},
    {"resolution[].level", "",
     "Logarithm of the factor of their Gaussians, where the volume is kept"},
    {"evolution", "", "Flow of the variational surface; null for other kinds"},
    {"evolution.steps", "",
     "Number of steps; 0 at rest in closed form, where the lists below are empty"},
    {"evolution.converged", "", "Whether the interface is at rest within the tolerance"},
    {"evolution.energy", "Å²", "Energy before the first step and after each"},
    {"evolution.mean_displacement", "Å", "Mean displacement of each step"},
    {"evolution.max_speed", "1/Å", "Largest speed of each step"},
    {"evolution.final_energy", "Å²", "Energy by a quadrature that does not depend on the voxels"},
    {"evolution.displacement_rms", "Å",
     "Root mean square of the way of the interface in the last step; in closed form to rest"},
    {"evolution.displacement_tail", "Å", "99.9 % quantile of that way"},
    {"evolution.area_error", "",
     "Estimated share by which the area may still change on the way to rest; at lambda above 0.04, "
     "except in bricks, between two places of the molecule on the grid"},
    {"evolution.unsettled_share", "", "Share of the interface with a way above 0.1 voxel"},
    {"evolution.crevice_voxels", "",
     "Number of voxels at gaps too narrow for the grid; null without a step"},
    {"evolution.front_steps", "", "Number of steps of fronts only, between those of the whole"},
    {"evolution.restless_fronts", "",
     "Number of blocks of 8³ voxels where one still moved at the end"},
    {"evolution.gaps", "",
     "Gaps decided by psi; null in bricks, and where voxels and fronts decide"},
    {"evolution.gaps.found", "", "Number of cavities, tunnels and slits near the decision"},
    {"evolution.gaps.closed", "",
     "Number of those that tension closes although no atom fills them"},
    {"evolution.gaps.nearest", "", "Least distance from the decision, as a value of psi"},
    {"evolution.gaps.closed_by_field", "",
     "Number of passages and voids that a probe fits into and the field closes; not with "
     "resolution"},
    {"evolution.gaps.widest_closed", "Å", "Most room beside the probe there"},
    {"evolution.gaps.opens_below", "Å", "Epsilon below which the widest opens"},
    {"evolution.walls", "",
     "Thin walls and necks decided by psi; null where gaps are, and on voxels above 0.75 Å or two "
     "thirds of the probe"},
    {"evolution.walls.found", "", "Number of those near the decision"},
    {"evolution.walls.closed", "", "Number of those thicker than 0.12 Å"},
    {"evolution.walls.nearest", "Å", "Least distance from the decision, as a depth"},
    {"evolution.area", "Å²", "Area of the interface, before the first step and after each"},
    {"evolution.volume", "Å³", "Volume inside it, likewise"},
    {"grid", "", "Level set"},
    {"grid.active_voxels", "", "Number of its active voxels"},
    {"grid.bytes", "byte", "Its memory"},
    {"seconds", "s", "Wall times by stage; the last is total"},
    {"peak_memory_bytes", "byte", "Largest memory of the process"},
    {"threads", "", "Number of threads that the run could use"},
    {"groups", "", "Groups of atoms; their areas and volumes add up to the whole"},
    {"groups[].name", "", "Name, or other for the atoms of no group"},
    {"groups[].atoms", "", "Number of its atoms"},
    {"groups[].area", "Å²", "Area of the surface nearest to its atoms"},
    {"groups[].volume", "Å³", "Volume inside nearest to its atoms; null without a grid"},
    {"groups[].color", "", "Its colour as #rrggbb if the surface is coloured by group"},
    {"groups[].alone_area", "Å²", "Area of the group by itself, on the surface of areas_of"},
    {"areas_of", "",
     "Kind of surface of interfaces and tables: sas unless another is asked for; null if there are "
     "none"},
    {"interfaces", "", "Pairs of groups that bury area between them"},
    {"interfaces[].groups", "", "Names of both"},
    {"interfaces[].buried_area", "Å²", "Half of the area that both lose by meeting"},
    {"interfaces[].count", "", "Number of such interfaces in a whole by symmetry"},
    {"interfaces[].shape_complementarity", "",
     "Sc of their solvent-excluded surfaces for a probe of 1.7 Å, after Lawrence and Colman; null "
     "where nothing is buried more than 1.5 Å from the rim"},
    {"interfaces[].median_distance", "Å", "Median distance of these surfaces, without the rim"},
    {"interfaces[].gap_volume", "Å³", "Volume between them that such a probe does not reach"},
    {"interfaces[].gap_index", "Å", "Gap volume by the area that each buries"},
    {"pockets", "", "Pockets, if they were asked for, else null"},
    {"pockets.probe_in", "Å", "Radius of the probe that gets into pockets"},
    {"pockets.probe_out", "Å", "Radius of the probe that stays out of them"},
    {"pockets.cut", "Å", "Depth below the surface of that probe at which pockets begin"},
    {"pockets.neck", "",
     "Share of the smaller pocket's radius below which a neck between two parts them"},
    {"pockets.voxel", "Å", "Edge of the voxels that they are found on"},
    {"pockets.list", "", "The pockets, the largest first"},
    {"pockets.list[].volume", "Å³", "Volume"},
    {"pockets.list[].area", "Å²", "Area of the wall"},
    {"pockets.list[].depth", "Å",
     "Depth of the deepest point below the surface of the large probe"},
    {"pockets.list[].radius", "Å", "Radius of the largest ball in it"},
    {"pockets.list[].center", "Å", "Middle of its volume"},
    {"pockets.list[].open", "", "Whether a way leads out, perhaps by neighbors"},
    {"pockets.list[].mouths", "", "Mouths, the largest first"},
    {"pockets.list[].mouths[].area", "Å²", "Area of the mouth at the cut"},
    {"pockets.list[].mouths[].radius", "Å",
     "Radius of the largest ball that gets there from the widest place"},
    {"pockets.list[].mouths[].center", "Å", "Where that ball just passes"},
    {"pockets.list[].rank", "", "Rank among all pockets that were found, the largest 1"},
    {"pockets.list[].neighbors", "", "Ranks of the pockets beyond necks"},
    {"pore", "", "Pore, if it was asked for, else null"},
    {"pore.axis", "", "Unit vector from end to end"},
    {"pore.crossed", "", "Share of the height of the molecule along the axis that it crosses"},
    {"pore.length", "Å", "Length across its sections"},
    {"pore.radius", "Å", "Radius of its narrowest place; negative where atoms close it"},
    {"pore.conductance", "pS",
     "Conductance by Ohm's rule, 1 / (resistivity · ∫ ds / (π radius²)); null where it is narrower "
     "than water, 1.15 Å"},
    {"pore.resistivity", "Ω m", "Resistivity of the bath that it fills, of 1 M KCl at 25 °C"},
    {"pore.bottlenecks", "", "Places that are narrower than the way on both sides of them"},
    {"pore.bottlenecks[].center", "Å", "Center of the ball that fits there"},
    {"pore.bottlenecks[].distance", "Å", "Distance from the first end, across the sections"},
    {"pore.bottlenecks[].radius", "Å", "Radius of that ball"},
    {"pore.profile", "", "Sections from end to end, an entry each"},
    {"pore.profile.distance", "Å", "Distance from the first end, across the sections"},
    {"pore.profile.radius", "Å", "Radius of the largest ball in the section"},
    {"pore.profile.center", "Å", "Its center"},
    {"pore.bundle", "",
     "Further pores along the axis that are as wide, within 5 %, with these keys"},
    {"pore.others", "", "Narrower ways along the axis that water passes, the widest first"},
    {"pore.others[].radius", "Å", "Radius of the narrowest place"},
    {"pore.others[].center", "Å", "That place"},
    {"tunnels", "", "Tunnels, if they were asked for, else null"},
    {"tunnels.start", "", "Room where they begin"},
    {"tunnels.start.center", "Å", "Its center"},
    {"tunnels.start.radius", "Å", "Radius of its ball"},
    {"tunnels.probe", "Å", "Radius that they have at least"},
    {"tunnels.probe_out", "Å", "Radius of the ball that gets to their ends from outside"},
    {"tunnels.list", "", "Ways out, one for each mouth, the widest first"},
    {"tunnels.list[].number", "", "Its number, from 1; over frames one for each tunnel"},
    {"tunnels.list[].radius", "Å", "Radius of the narrowest place"},
    {"tunnels.list[].center", "Å", "That place"},
    {"tunnels.list[].length", "Å", "Length along the way"},
    {"tunnels.list[].curvature", "", "Its length over the distance of its ends"},
    {"tunnels.list[].bottlenecks", "", "Places that are narrower than the way on both sides"},
    {"tunnels.list[].bottlenecks[].center", "Å", "Center of the ball that fits there"},
    {"tunnels.list[].bottlenecks[].distance", "Å", "Distance from the start, along the way"},
    {"tunnels.list[].bottlenecks[].radius", "Å", "Radius of that ball"},
    {"tunnels.list[].profile", "", "Places along the way, an entry each"},
    {"tunnels.list[].profile.distance", "Å", "Distance from the start, along the way"},
    {"tunnels.list[].profile.radius", "Å", "Radius of the largest ball there"},
    {"tunnels.list[].profile.center", "Å", "Its center"},
    {"parts", "", "Groups with surfaces of their own"},
    {"parts[].name", "", "Name of the group"},
    {"parts[].atoms", "", "Number of its atoms"},
    {"parts[].surface", "", "Its measures, with the keys of surface"},
    {"instances", "", "Copies of an assembly that nodes place"},
    {"instances[].part", "", "Index of the copied part"},
    {"instances[].operator", "", "Name of the operator"},
    {"instances[].matrix", "", "x to matrix x of points (x, y, z, 1), row by row"},
    {"symmetry", "", "How the whole follows from a unit by symmetry; null if it was made at once"},
    {"symmetry.point_group", "", "Schoenflies' symbol"},
    {"symmetry.order", "", "Number of units"},
    {"symmetry.copies_in_unit", "", "Number of the assembly's copies in a unit"},
    {"symmetry.deviation", "Å",
     "Largest distance of a copy from the place that a rotation gives it"},
    {"symmetry.gap", "Å", "Largest gap between units that was closed"},
    {"symmetry.open_vertices", "",
     "Edges of a unit's border without a partner: triangles fill holes there"},
    {"warnings", "", "One text each"},
    {"measures", "", "Numbers that were asked for, by name, in the unit of the option's page"},
    {"areas", "", "Requested tables by their names; each row has the keys of the .csv"}};

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
