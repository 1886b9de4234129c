#compdef vdb_molsurf
# zsh completion of vdb_molsurf 1.0.0
local verb=build
local -a options
case $words[2] in
    bricks) verb="bricks $words[3]" ;;
    help|build|batch|compare|convert|bricks|info) verb=$words[2] ;;
esac
case "$verb:$words[CURRENT-1]" in
    "build:--format") compadd -- 'vdb' 'ply' 'obj' 'stl' 'vtk' 'glb' '3mf' 'vert' 'face' 'poly' 'msh' 'off' 'wrl' 'msh2' 'nvdb' 'mrc' 'dx' 'density.mrc' 'mask.mrc' 'dielx.dx' 'diely.dx' 'dielz.dx' 'kappa.dx' 'charges.pqr' 'apbs.in' 'cxc' 'pml' 'html' 'json' 'png' 'legend.svg' 'view' 'atoms.csv' 'residues.csv' 'contacts.csv' 'interfaces.csv' 'pockets.csv' 'patches.csv' 'pore.csv' 'tunnels.csv' 'forces.csv' 'pore.svg' 'pore.png' 'tunnels.pdb' 'tunnels.cif' 'tunnels.cxc' 'tunnels.pml' 'pdb' 'cif' 'residues.pdb' 'residues.cif' 'patches.pdb' 'patches.cif' 'pockets.ply' 'pockets.obj' 'pockets.stl' 'pockets.off' 'pockets.wrl' 'pockets.vtk' 'pockets.glb' 'pockets.3mf' 'pore.ply' 'pore.obj' 'pore.stl' 'pore.off' 'pore.wrl' 'pore.vtk' 'pore.glb' 'pore.3mf' 'tunnels.ply' 'tunnels.obj' 'tunnels.stl' 'tunnels.off' 'tunnels.wrl' 'tunnels.vtk' 'tunnels.glb' 'tunnels.3mf'; return ;;
    "build:--superpose") compadd -- 'auto'; return ;;
    "build:--surface") compadd -- 'variational' 'ses' 'sas' 'vdw' 'gaussian' 'smooth-sas'; return ;;
    "build:--pieces") compadd -- 'all' 'outer' 'cavities'; return ;;
    "build:--fields") compadd -- 'all' 'surface' 'sas' 'spline' 'mean_curvature' 'gaussian_curvature' 'principal_curvature_1' 'principal_curvature_2' 'shape_index' 'curvedness' 'principal_direction_1' 'principal_direction_2' 'density' 'atom_id' 'chain_id' 'group_id' 'Cd' 'value' 'pocket_id' 'pocket_depth' 'pocket_room' 'depth' 'v'; return ;;
    "build:--measures") compadd -- 'sphericity' 'gyration_radius'; return ;;
    "build:--match") compadd -- 'none' 'ses'; return ;;
    "build:--coarse") compadd -- 'atom' 'residue'; return ;;
    "build:--group-by") compadd -- 'chain' 'entity' 'class' 'copy'; return ;;
    "build:--split") compadd -- 'group'; return ;;
    "build:--color") compadd -- 'none' 'chain' 'group' 'element' 'residue' 'nucleotide' 'illustrative' 'hetero' 'mean-curvature' 'gaussian-curvature' 'pocket' 'patch' 'copy' 'entity' 'class' 'bfactor' 'occupancy' 'charge' 'hydrophobicity' 'rainbow' 'radius' 'depth' 'table=FILE' 'potential=FILE' 'groups=FILE' 'residue-type' 'plain=#RRGGBB'; return ;;
    "build:--palette") compadd -- 'viridis' 'cividis' 'batlow' 'OrRd' 'RdBu' 'BuRd' 'OrPu' 'turbo' 'plddt'; return ;;
    "build:--value-of") compadd -- 'atom' 'residue'; return ;;
    "build:--areas") compadd -- 'atoms' 'residues' 'contacts' 'interfaces' 'pockets' 'patches' 'pore' 'tunnels' 'forces'; return ;;
    "build:--contacts") compadd -- 'atom' 'residue' 'chain'; return ;;
    "build:--patches") compadd -- 'mean-curvature>' 'gaussian-curvature>' 'bfactor>' 'occupancy>' 'charge>' 'hydrophobicity>' 'rainbow>' 'radius>' 'depth>' 'table=FILE>' 'potential=FILE>'; return ;;
    "build:--for") compadd -- 'apbs' 'blender' 'blender4' 'houdini' 'usd' 'unreal' 'arnold'; return ;;
    "build:--ids") compadd -- 'int' 'float'; return ;;
    "build:--view") compadd -- 'auto'; return ;;
    "build:--background") compadd -- 'transparent'; return ;;
    "build:--style") compadd -- 'soft' 'glossy' 'outline' 'flat'; return ;;
    "build:--show") compadd -- 'sticks' 'balls' 'orders' 'spheres' 'tube' 'spheres,others' 'pockets'; return ;;
    "build:--legend") compadd -- 'auto' 'on' 'off'; return ;;
    "build:--require") compadd -- 'watertight' 'manifold' 'components=' 'cavities=' 'genus=' 'min-angle='; return ;;
    "build:--regularizer") compadd -- 'gradient' 'area'; return ;;
    "build:--flow") compadd -- 'rest' 'newton' 'paper'; return ;;
    "batch:--surface") compadd -- 'variational' 'ses' 'sas' 'vdw' 'gaussian' 'smooth-sas'; return ;;
    "batch:--fields") compadd -- 'all' 'surface' 'sas' 'spline' 'mean_curvature' 'gaussian_curvature' 'principal_curvature_1' 'principal_curvature_2' 'shape_index' 'curvedness' 'principal_direction_1' 'principal_direction_2' 'density' 'atom_id' 'chain_id' 'group_id' 'Cd' 'value' 'pocket_id' 'pocket_depth' 'pocket_room' 'depth' 'v'; return ;;
    "batch:--measures") compadd -- 'sphericity' 'gyration_radius'; return ;;
    "batch:--match") compadd -- 'none' 'ses'; return ;;
    "batch:--coarse") compadd -- 'atom' 'residue'; return ;;
    "batch:--group-by") compadd -- 'chain' 'entity' 'class' 'copy'; return ;;
    "batch:--split") compadd -- 'group'; return ;;
    "batch:--color") compadd -- 'none' 'chain' 'group' 'element' 'residue' 'nucleotide' 'illustrative' 'hetero' 'mean-curvature' 'gaussian-curvature' 'pocket' 'patch' 'copy' 'entity' 'class' 'bfactor' 'occupancy' 'charge' 'hydrophobicity' 'rainbow' 'radius' 'depth' 'table=FILE' 'potential=FILE' 'groups=FILE' 'residue-type' 'plain=#RRGGBB'; return ;;
    "batch:--palette") compadd -- 'viridis' 'cividis' 'batlow' 'OrRd' 'RdBu' 'BuRd' 'OrPu' 'turbo' 'plddt'; return ;;
    "batch:--value-of") compadd -- 'atom' 'residue'; return ;;
    "batch:--areas") compadd -- 'atoms' 'residues' 'contacts' 'interfaces' 'pockets' 'patches' 'pore' 'tunnels' 'forces'; return ;;
    "batch:--contacts") compadd -- 'atom' 'residue' 'chain'; return ;;
    "batch:--patches") compadd -- 'mean-curvature>' 'gaussian-curvature>' 'bfactor>' 'occupancy>' 'charge>' 'hydrophobicity>' 'rainbow>' 'radius>' 'depth>' 'table=FILE>' 'potential=FILE>'; return ;;
    "batch:--for") compadd -- 'apbs' 'blender' 'blender4' 'houdini' 'usd' 'unreal' 'arnold'; return ;;
    "batch:--ids") compadd -- 'int' 'float'; return ;;
    "batch:--view") compadd -- 'auto'; return ;;
    "batch:--background") compadd -- 'transparent'; return ;;
    "batch:--style") compadd -- 'soft' 'glossy' 'outline' 'flat'; return ;;
    "batch:--show") compadd -- 'sticks' 'balls' 'orders' 'spheres' 'tube' 'spheres,others' 'pockets'; return ;;
    "batch:--legend") compadd -- 'auto' 'on' 'off'; return ;;
    "batch:--require") compadd -- 'watertight' 'manifold' 'components=' 'cavities=' 'genus=' 'min-angle='; return ;;
    "batch:--regularizer") compadd -- 'gradient' 'area'; return ;;
    "batch:--flow") compadd -- 'rest' 'newton' 'paper'; return ;;
    "compare:--format") compadd -- 'vdb' 'ply' 'html' 'json' 'png' 'legend.svg' 'view'; return ;;
    "compare:--color") compadd -- 'distance' 'signed-distance'; return ;;
    "compare:--palette") compadd -- 'viridis' 'cividis' 'batlow' 'OrRd' 'RdBu' 'BuRd' 'OrPu' 'turbo' 'plddt'; return ;;
    "compare:--superpose") compadd -- 'auto'; return ;;
    "compare:--surface") compadd -- 'variational' 'ses' 'sas' 'vdw' 'gaussian' 'smooth-sas'; return ;;
    "compare:--match") compadd -- 'none' 'ses'; return ;;
    "compare:--coarse") compadd -- 'atom' 'residue'; return ;;
    "compare:--view") compadd -- 'auto'; return ;;
    "compare:--background") compadd -- 'transparent'; return ;;
    "compare:--style") compadd -- 'soft' 'glossy' 'outline' 'flat'; return ;;
    "compare:--legend") compadd -- 'auto' 'on' 'off'; return ;;
    "compare:--regularizer") compadd -- 'gradient' 'area'; return ;;
    "compare:--flow") compadd -- 'rest' 'newton' 'paper'; return ;;
    "convert:--format") compadd -- 'vdb' 'ply' 'obj' 'stl' 'vtk' 'glb' '3mf' 'vert' 'face' 'poly' 'msh' 'off' 'wrl' 'msh2' 'nvdb' 'mrc' 'dx' 'cxc' 'pml' 'html' 'json' 'png' 'legend.svg' 'view'; return ;;
    "convert:--fields") compadd -- 'all' 'surface' 'sas' 'spline' 'mean_curvature' 'gaussian_curvature' 'principal_curvature_1' 'principal_curvature_2' 'shape_index' 'curvedness' 'principal_direction_1' 'principal_direction_2' 'density' 'atom_id' 'chain_id' 'group_id' 'Cd' 'value' 'pocket_id' 'pocket_depth' 'pocket_room' 'depth' 'v'; return ;;
    "convert:--color") compadd -- 'none' 'chain' 'group' 'element' 'residue' 'nucleotide' 'illustrative' 'hetero' 'mean-curvature' 'gaussian-curvature'; return ;;
    "convert:--palette") compadd -- 'viridis' 'cividis' 'batlow' 'OrRd' 'RdBu' 'BuRd' 'OrPu' 'turbo' 'plddt'; return ;;
    "convert:--view") compadd -- 'auto'; return ;;
    "convert:--background") compadd -- 'transparent'; return ;;
    "convert:--style") compadd -- 'soft' 'glossy' 'outline' 'flat'; return ;;
    "convert:--legend") compadd -- 'auto' 'on' 'off'; return ;;
    "bricks plan:--surface") compadd -- 'variational' 'ses' 'sas' 'vdw' 'gaussian' 'smooth-sas'; return ;;
    "bricks plan:--fields") compadd -- 'all' 'surface' 'sas' 'spline' 'mean_curvature' 'gaussian_curvature' 'principal_curvature_1' 'principal_curvature_2' 'shape_index' 'curvedness' 'principal_direction_1' 'principal_direction_2' 'density' 'atom_id' 'chain_id' 'group_id' 'Cd' 'value' 'pocket_id' 'pocket_depth' 'pocket_room' 'depth' 'v'; return ;;
    "bricks plan:--match") compadd -- 'none' 'ses'; return ;;
    "bricks plan:--coarse") compadd -- 'atom' 'residue'; return ;;
    "bricks plan:--group-by") compadd -- 'chain' 'entity' 'class' 'copy'; return ;;
    "bricks plan:--color") compadd -- 'none' 'chain' 'group' 'element' 'residue' 'nucleotide' 'illustrative' 'hetero' 'mean-curvature' 'gaussian-curvature' 'pocket' 'patch' 'copy' 'entity' 'class' 'bfactor' 'occupancy' 'charge' 'hydrophobicity' 'rainbow' 'radius' 'depth' 'table=FILE' 'potential=FILE' 'groups=FILE' 'residue-type' 'plain=#RRGGBB'; return ;;
    "bricks plan:--palette") compadd -- 'viridis' 'cividis' 'batlow' 'OrRd' 'RdBu' 'BuRd' 'OrPu' 'turbo' 'plddt'; return ;;
    "bricks plan:--value-of") compadd -- 'atom' 'residue'; return ;;
    "bricks plan:--regularizer") compadd -- 'gradient' 'area'; return ;;
    "bricks plan:--flow") compadd -- 'rest' 'newton' 'paper'; return ;;
    "bricks merge:--format") compadd -- 'vdb' 'ply' 'html' 'json' 'png' 'legend.svg' 'view'; return ;;
esac
if [[ $CURRENT == 3 && $words[2] == bricks ]]; then
    compadd -- plan run merge
    return
fi
if [[ $words[CURRENT] == -* ]]; then
    case $verb in
    "build") options=(
      '--output:file to write; repeats; the extension says what\:'
      '-o:file to write; repeats; the extension says what\:'
      '--format:what -o - writes\: one of'
      '--force:replace existing files'
      '--skip-existing:do nothing if the files are of the same input, options and'
      '--select:atoms\: "chain A and resid 5-9" or "/1/A/5-9|*;polymer"'
      '--model:number of the model in the file'
      '--assembly:biological assembly to build; none\: as in the file;'
      '--instances:the surface of each distinct copy of the assembly once\:'
      '--by-symmetry:the joint surface of the whole assembly from one unit,'
      '--copies:copies of the assembly\: numbers such as 1,7,20-25, or'
      '--altloc:alternate location to take, or all'
      '--no-hydrogens:drop hydrogens'
      '--ions:keep free ions of the solution'
      '--hetero:keep all ligands, ions, buffers and lipids; otherwise'
      '--no-hetero:drop all ligands and ions'
      '--waters:keep waters'
      '--radii:van der Waals radii\: a name of --list-radii, or a file'
      '--probe:probe radius [Å]'
      '--superpose:lay B on A, structures of --panel on INPUT or frames on the'
      '--max-input:bytes that INPUT may have, unpacked, such as 10G'
      '--frames:a surface for every S-th frame from A to B\: models of'
      '--trajectory:.dcd, .xtc, .trr or .nc with the frames, its atoms those of INPUT'
      '--update-selections:selections by distance, as within 5 of resn HEM, are those'
      '--first-frame:number of the first file, such as 1001\: name.1001.vdb, ...'
      '--fps:frames per second, such as 24\: velocities of --fields v'
      '--surface:variational; ses\: solvent-excluded; sas\:'
      '--voxel:edge of a voxel [Å], 0.05 to 10'
      '--lod:with --instances\: voxels such as 1,2,4 in the place of'
      '--blobbiness:decay of the Gaussians of --surface gaussian'
      '--fill-cavities:drop the inner walls'
      '--pieces:closed pieces that meshes and pictures have\: all; outer,'
      '--remesh:triangles of even shape, with edges near L [Å]'
      '--density:the same with N vertices per Å^2 of surface'
      '--adapt:with --remesh or --density\: shorter edges where it bends,'
      '--fields:grids of the .vdb, by commas, or all of'
      '--vdb-half:floats of the .vdb in 16 bits, within 0.05 %\: half the size'
      '--curvature-totals:integrate curvature over the surface, for the report'
      '--measures:numbers of the whole surface for the report, by commas;'
      '--epsilon:tolerance of the Gaussian sum [Å]; larger is smoother'
      '--lambda:weight of the regulariser [Å^2 for gradient, 1 for area]'
      '--match:ses\: variational with --epsilon 0.1, --lambda 0.003 and 0.073 Å'
      '--resolution:blur to D [Å], 1 to 50, all atoms or those of a'
      '--coarse:beads in the place of atoms\: residue (its backbone and'
      '--match-volume:resolutions keep the volume of the fine surface'
      '--groups:groups of atoms\: JSON, or lines NAME SELECTION [COLOUR]'
      '--group-by:groups by chain, entity, class (a chain'\''s copies),'
      '--split:a level set and a closed mesh for every group, alone'
      '--surface-of:this group alone, by another --surface; repeats; the'
      '--interfaces:buried areas between groups, for the report'
      '--color:colours of the mesh and the grid Cd\: chain, group,'
      '--range:values at the ends of the colours'
      '--palette:colours of values and curvatures, low ones first\: viridis,'
      '--value-of:whose values\: atom, or residue (the mean of its atoms)'
      '--flat-values:a point has the value of one atom, not a blend of nearby ones'
      '--smooth-colors:vertices have the mean of values and curvatures over the'
      '--potential-offset:potentials are taken A outside of the surface [Å]'
      '--plain-color:of a surface without --color'
      '--sharp-colors:mesh files\: triangles are cut where colours meet'
      '--areas:tables for the report, by commas\: atoms, residues,'
      '--contacts:contact areas between atoms, residues or chains\: atom,'
      '--patches:connected pieces of the surface where a value of --color,'
      '--pockets:pockets of the surface, for the report, .pockets.csv, and a'
      '--pocket-at:only the pocket at these atoms of the file, used or not\:'
      '--probe-in:radius of the probe that gets into pockets [Å], 0.5 to 10'
      '--probe-out:radius of the probe that stays out of them [Å], above'
      '--pocket-cut:pockets begin so far below the surface of that probe [Å]'
      '--pocket-neck:two pockets, where the ball that passes between them has'
      '--pore:the pore, for the report, .pore.csv, profiles .pore.svg,'
      '--tunnels-from:the ways out of a place, for the report, pictures and pages,'
      '--tunnel-probe:tunnels are at least as wide as a ball of this radius [Å],'
      '--for:blender, blender4 (up to 4.5), houdini, usd, unreal,'
      '--fog-density:optical depth of an Å of fog at density 1 in the program,'
      '--ids:type of atom_id, chain_id, group_id and pocket_id in a .vdb\:'
      '--one-box:all grids of a .vdb have one box of active voxels'
      '--mips:N coarser levels of density and Cd in a .vdb, each with'
      '--center:the middle of the surface comes to the origin'
      '--print-scale:.stl, .obj, .wrl, .3mf in mm, S of them per Å'
      '--min-thickness:thicken what is thinner than W mm; with --print-scale'
      '--apbs-grid:an input of APBS whose dime, glen and gcent are used;'
      '--pdie:relative permittivity of the molecule'
      '--sdie:relative permittivity of the solvent'
      '--ion-conc:concentration of a 1\:1 salt [mol/L]'
      '--pixel-size:edge of a pixel of .density.mrc and .mask.mrc [Å]'
      '--box-size:pixels on an edge of the box, even; without it the least'
      '--mask-extend:pixels outside of the surface up to which .mask.mrc is 1'
      '--mask-edge:pixels over which .mask.mrc falls to 0, by a cosine'
      '--invert-density:.density.mrc is negative, as matter is in tomograms'
      '--view:a direction toward the eye, X,Y,Z or an axis as z or -z;'
      '--zoom:these atoms fill 80 % of a square frame; where something'
      '--up:what is upright, such as z, the normal of a membrane;'
      '--turn:turned by so many degrees about the upright'
      '--size:width in pixels; the height follows the shape'
      '--background:as #rrggbb or #rgb, a name such as black, or transparent'
      '--style:soft; glossy\: with highlights; outline\: as drawn with a'
      '--show:atoms beside the surface, whole and opaque, such as'
      '--label:a text at the middle of atoms, such as "A/57=active site";'
      '--ruler:a line between the middles of atoms, or places X,Y,Z, with'
      '--panel:a further picture beside the first, with its camera, scale'
      '--opacity:of the surface, seen from the front'
      '--show-behind:--opacity shows what is behind the nearest wall, too'
      '--clip:cuts away what is nearer to the eye than the middle'
      '--depth-cue:distant parts fade to the background'
      '--legend:on or off; auto\: beside colours, if 600 pixels wide'
      '--scale-bar:a bar below the picture that shows a length'
      '--dpi:pixels an inch when it is printed; --size stays'
      '--turntable:N pictures round the upright\: name.0001.png, ..., or in'
      '--memory:memory at most, such as 4G\: in bricks, one by one, if'
      '--max-hours:refuse what is estimated to take more hours'
      '--dry-run:print the estimated time and memory, and stop'
      '--require:what the mesh has to be, or nothing is written and the'
      '--threads:threads at most'
      '-j:threads at most'
      '--quiet:print errors only'
      '-q:print errors only'
      '--verbose:print the time of every stage'
      '-v:print the time of every stage'
      '--no-progress:no progress bar'
      '--config:options as lines "name = value"; the command line wins'
      '--regularizer:gradient or area'
      '--flow:rest\: in closed form, where no front moves, else newton;'
      '--max-steps:steps at most'
      '--steps:so many steps, converged or not'
      '--tolerance:converged when a step moves the surface by less than T'
      '--spline-level:spline on voxels of 2^L times the edge; 0, 1 or 2'
      '--weld:with --by-symmetry\: units share the vertices of their borders'
      '--list-radii:print the radii sets and stop'
      '--version:print the version and stop'
      '-V:print the version and stop'
      '--help:print the common options and stop'
      '-h:print the common options and stop'
      '--help-all:print all options and stop') ;;
    "batch") options=(
      '--folder:where the files go, with the names of the structures'
      '-O:where the files go, with the names of the structures'
      '--formats:files to write, by commas, of'
      '--force:do all again, and replace existing files'
      '--select:atoms\: "chain A and resid 5-9" or "/1/A/5-9|*;polymer"'
      '--model:number of the model in the file'
      '--assembly:biological assembly to build; none\: as in the file;'
      '--copies:copies of the assembly\: numbers such as 1,7,20-25, or'
      '--altloc:alternate location to take, or all'
      '--no-hydrogens:drop hydrogens'
      '--ions:keep free ions of the solution'
      '--hetero:keep all ligands, ions, buffers and lipids; otherwise'
      '--no-hetero:drop all ligands and ions'
      '--waters:keep waters'
      '--radii:van der Waals radii\: a name of --list-radii, or a file'
      '--probe:probe radius [Å]'
      '--max-input:bytes that INPUT may have, unpacked, such as 10G'
      '--surface:variational; ses\: solvent-excluded; sas\:'
      '--voxel:edge of a voxel [Å], 0.05 to 10'
      '--blobbiness:decay of the Gaussians of --surface gaussian'
      '--fill-cavities:drop the inner walls'
      '--remesh:triangles of even shape, with edges near L [Å]'
      '--density:the same with N vertices per Å^2 of surface'
      '--adapt:with --remesh or --density\: shorter edges where it bends,'
      '--fields:grids of the .vdb, by commas, or all of'
      '--vdb-half:floats of the .vdb in 16 bits, within 0.05 %\: half the size'
      '--curvature-totals:integrate curvature over the surface, for the report'
      '--measures:numbers of the whole surface for the report, by commas;'
      '--epsilon:tolerance of the Gaussian sum [Å]; larger is smoother'
      '--lambda:weight of the regulariser [Å^2 for gradient, 1 for area]'
      '--match:ses\: variational with --epsilon 0.1, --lambda 0.003 and 0.073 Å'
      '--resolution:blur to D [Å], 1 to 50, all atoms or those of a'
      '--coarse:beads in the place of atoms\: residue (its backbone and'
      '--match-volume:resolutions keep the volume of the fine surface'
      '--groups:groups of atoms\: JSON, or lines NAME SELECTION [COLOUR]'
      '--group-by:groups by chain, entity, class (a chain'\''s copies),'
      '--split:a level set and a closed mesh for every group, alone'
      '--surface-of:this group alone, by another --surface; repeats; the'
      '--interfaces:buried areas between groups, for the report'
      '--color:colours of the mesh and the grid Cd\: chain, group,'
      '--range:values at the ends of the colours'
      '--palette:colours of values and curvatures, low ones first\: viridis,'
      '--value-of:whose values\: atom, or residue (the mean of its atoms)'
      '--flat-values:a point has the value of one atom, not a blend of nearby ones'
      '--smooth-colors:vertices have the mean of values and curvatures over the'
      '--potential-offset:potentials are taken A outside of the surface [Å]'
      '--plain-color:of a surface without --color'
      '--areas:tables for the report, by commas\: atoms, residues,'
      '--contacts:contact areas between atoms, residues or chains\: atom,'
      '--patches:connected pieces of the surface where a value of --color,'
      '--pockets:pockets of the surface, for the report, .pockets.csv, and a'
      '--pocket-at:only the pocket at these atoms of the file, used or not\:'
      '--probe-in:radius of the probe that gets into pockets [Å], 0.5 to 10'
      '--probe-out:radius of the probe that stays out of them [Å], above'
      '--pocket-cut:pockets begin so far below the surface of that probe [Å]'
      '--pocket-neck:two pockets, where the ball that passes between them has'
      '--pore:the pore, for the report, .pore.csv, profiles .pore.svg,'
      '--tunnels-from:the ways out of a place, for the report, pictures and pages,'
      '--tunnel-probe:tunnels are at least as wide as a ball of this radius [Å],'
      '--for:blender, blender4 (up to 4.5), houdini, usd, unreal,'
      '--fog-density:optical depth of an Å of fog at density 1 in the program,'
      '--ids:type of atom_id, chain_id, group_id and pocket_id in a .vdb\:'
      '--one-box:all grids of a .vdb have one box of active voxels'
      '--mips:N coarser levels of density and Cd in a .vdb, each with'
      '--center:the middle of the surface comes to the origin'
      '--print-scale:.stl, .obj, .wrl, .3mf in mm, S of them per Å'
      '--min-thickness:thicken what is thinner than W mm; with --print-scale'
      '--pixel-size:edge of a pixel of .density.mrc and .mask.mrc [Å]'
      '--box-size:pixels on an edge of the box, even; without it the least'
      '--mask-extend:pixels outside of the surface up to which .mask.mrc is 1'
      '--mask-edge:pixels over which .mask.mrc falls to 0, by a cosine'
      '--invert-density:.density.mrc is negative, as matter is in tomograms'
      '--view:a direction toward the eye, X,Y,Z or an axis as z or -z;'
      '--zoom:these atoms fill 80 % of a square frame; where something'
      '--up:what is upright, such as z, the normal of a membrane;'
      '--turn:turned by so many degrees about the upright'
      '--size:width in pixels; the height follows the shape'
      '--background:as #rrggbb or #rgb, a name such as black, or transparent'
      '--style:soft; glossy\: with highlights; outline\: as drawn with a'
      '--show:atoms beside the surface, whole and opaque, such as'
      '--label:a text at the middle of atoms, such as "A/57=active site";'
      '--ruler:a line between the middles of atoms, or places X,Y,Z, with'
      '--opacity:of the surface, seen from the front'
      '--show-behind:--opacity shows what is behind the nearest wall, too'
      '--clip:cuts away what is nearer to the eye than the middle'
      '--depth-cue:distant parts fade to the background'
      '--legend:on or off; auto\: beside colours, if 600 pixels wide'
      '--scale-bar:a bar below the picture that shows a length'
      '--dpi:pixels an inch when it is printed; --size stays'
      '--turntable:N pictures round the upright\: name.0001.png, ..., or in'
      '--max-hours:refuse what is estimated to take more hours'
      '--require:what the mesh has to be, or nothing is written and the'
      '--threads:threads at most'
      '-j:threads at most'
      '--quiet:print errors only'
      '-q:print errors only'
      '--verbose:print the time of every stage'
      '-v:print the time of every stage'
      '--no-progress:no progress bar'
      '--config:options as lines "name = value"; the command line wins'
      '--regularizer:gradient or area'
      '--flow:rest\: in closed form, where no front moves, else newton;'
      '--max-steps:steps at most'
      '--steps:so many steps, converged or not'
      '--tolerance:converged when a step moves the surface by less than T'
      '--spline-level:spline on voxels of 2^L times the edge; 0, 1 or 2'
      '--version:print the version and stop'
      '-V:print the version and stop'
      '--help:print the common options and stop'
      '-h:print the common options and stop'
      '--help-all:print all options and stop') ;;
    "compare") options=(
      '--output:file to write; repeats; the extension says what\:'
      '-o:file to write; repeats; the extension says what\:'
      '--format:what -o - writes\: one of'
      '--force:replace existing files'
      '--color:distance (OrRd) or signed-distance (blue\: A is'
      '--palette:colours of values and curvatures, low ones first\: viridis,'
      '--range:distance at the end of the colours [Å]'
      '--select:atoms\: "chain A and resid 5-9" or "/1/A/5-9|*;polymer"'
      '--model:number of the model in the file'
      '--assembly:biological assembly to build; none\: as in the file;'
      '--copies:copies of the assembly\: numbers such as 1,7,20-25, or'
      '--altloc:alternate location to take, or all'
      '--no-hydrogens:drop hydrogens'
      '--ions:keep free ions of the solution'
      '--hetero:keep all ligands, ions, buffers and lipids; otherwise'
      '--no-hetero:drop all ligands and ions'
      '--waters:keep waters'
      '--radii:van der Waals radii\: a name of --list-radii, or a file'
      '--probe:probe radius [Å]'
      '--superpose:lay B on A, structures of --panel on INPUT or frames on the'
      '--max-input:bytes that INPUT may have, unpacked, such as 10G'
      '--surface:variational; ses\: solvent-excluded; sas\:'
      '--voxel:edge of a voxel [Å], 0.05 to 10'
      '--blobbiness:decay of the Gaussians of --surface gaussian'
      '--fill-cavities:drop the inner walls'
      '--epsilon:tolerance of the Gaussian sum [Å]; larger is smoother'
      '--lambda:weight of the regulariser [Å^2 for gradient, 1 for area]'
      '--match:ses\: variational with --epsilon 0.1, --lambda 0.003 and 0.073 Å'
      '--resolution:blur to D [Å], 1 to 50, all atoms or those of a'
      '--coarse:beads in the place of atoms\: residue (its backbone and'
      '--match-volume:resolutions keep the volume of the fine surface'
      '--view:a direction toward the eye, X,Y,Z or an axis as z or -z;'
      '--up:what is upright, such as z, the normal of a membrane;'
      '--turn:turned by so many degrees about the upright'
      '--size:width in pixels; the height follows the shape'
      '--background:as #rrggbb or #rgb, a name such as black, or transparent'
      '--style:soft; glossy\: with highlights; outline\: as drawn with a'
      '--opacity:of the surface, seen from the front'
      '--show-behind:--opacity shows what is behind the nearest wall, too'
      '--clip:cuts away what is nearer to the eye than the middle'
      '--depth-cue:distant parts fade to the background'
      '--legend:on or off; auto\: beside colours, if 600 pixels wide'
      '--scale-bar:a bar below the picture that shows a length'
      '--dpi:pixels an inch when it is printed; --size stays'
      '--turntable:N pictures round the upright\: name.0001.png, ..., or in'
      '--max-hours:refuse what is estimated to take more hours'
      '--dry-run:print the estimated time and memory, and stop'
      '--threads:threads at most'
      '-j:threads at most'
      '--quiet:print errors only'
      '-q:print errors only'
      '--verbose:print the time of every stage'
      '-v:print the time of every stage'
      '--no-progress:no progress bar'
      '--config:options as lines "name = value"; the command line wins'
      '--regularizer:gradient or area'
      '--flow:rest\: in closed form, where no front moves, else newton;'
      '--max-steps:steps at most'
      '--steps:so many steps, converged or not'
      '--tolerance:converged when a step moves the surface by less than T'
      '--spline-level:spline on voxels of 2^L times the edge; 0, 1 or 2'
      '--version:print the version and stop'
      '-V:print the version and stop'
      '--help:print the common options and stop'
      '-h:print the common options and stop'
      '--help-all:print all options and stop') ;;
    "convert") options=(
      '--output:file to write; repeats; the extension says what\:'
      '-o:file to write; repeats; the extension says what\:'
      '--format:what -o - writes\: one of'
      '--force:replace existing files'
      '--iso:of a map\: the level set where it has this value, negative'
      '--remesh:triangles of even shape, with edges near L [Å]'
      '--density:the same with N vertices per Å^2 of surface'
      '--adapt:with --remesh or --density\: shorter edges where it bends,'
      '--fields:curvatures for the vertices of a .ply or .glb, by commas,'
      '--color:chain, group, element, residue (or residue-type),'
      '--range:values at the ends of the colours'
      '--palette:colours of values and curvatures, low ones first\: viridis,'
      '--plain-color:of a surface without --color'
      '--print-scale:.stl, .obj, .wrl, .3mf in mm, S of them per Å'
      '--view:a direction toward the eye, X,Y,Z or an axis as z or -z;'
      '--up:what is upright, such as z, the normal of a membrane;'
      '--turn:turned by so many degrees about the upright'
      '--size:width in pixels; the height follows the shape'
      '--background:as #rrggbb or #rgb, a name such as black, or transparent'
      '--style:soft; glossy\: with highlights; outline\: as drawn with a'
      '--opacity:of the surface, seen from the front'
      '--show-behind:--opacity shows what is behind the nearest wall, too'
      '--clip:cuts away what is nearer to the eye than the middle'
      '--depth-cue:distant parts fade to the background'
      '--legend:on or off; auto\: beside colours, if 600 pixels wide'
      '--scale-bar:a bar below the picture that shows a length'
      '--dpi:pixels an inch when it is printed; --size stays'
      '--turntable:N pictures round the upright\: name.0001.png, ..., or in'
      '--max-hours:refuse what is estimated to take more hours'
      '--dry-run:print the estimated time and memory, and stop'
      '--threads:threads at most'
      '-j:threads at most'
      '--quiet:print errors only'
      '-q:print errors only'
      '--verbose:print the time of every stage'
      '-v:print the time of every stage'
      '--no-progress:no progress bar'
      '--config:options as lines "name = value"; the command line wins'
      '--version:print the version and stop'
      '-V:print the version and stop'
      '--help:print the common options and stop'
      '-h:print the common options and stop'
      '--help-all:print all options and stop') ;;
    "bricks plan") options=(
      '--output:the manifest, a name that ends in .json'
      '-o:the manifest, a name that ends in .json'
      '--force:replace existing files'
      '--select:atoms\: "chain A and resid 5-9" or "/1/A/5-9|*;polymer"'
      '--model:number of the model in the file'
      '--assembly:biological assembly to build; none\: as in the file;'
      '--copies:copies of the assembly\: numbers such as 1,7,20-25, or'
      '--altloc:alternate location to take, or all'
      '--no-hydrogens:drop hydrogens'
      '--ions:keep free ions of the solution'
      '--hetero:keep all ligands, ions, buffers and lipids; otherwise'
      '--no-hetero:drop all ligands and ions'
      '--waters:keep waters'
      '--radii:van der Waals radii\: a name of --list-radii, or a file'
      '--probe:probe radius [Å]'
      '--max-input:bytes that INPUT may have, unpacked, such as 10G'
      '--surface:variational; ses\: solvent-excluded; sas\:'
      '--voxel:edge of a voxel [Å], 0.05 to 10'
      '--blobbiness:decay of the Gaussians of --surface gaussian'
      '--fields:grids of the .vdb, by commas, or all of'
      '--vdb-half:floats of the .vdb in 16 bits, within 0.05 %\: half the size'
      '--epsilon:tolerance of the Gaussian sum [Å]; larger is smoother'
      '--lambda:weight of the regulariser [Å^2 for gradient, 1 for area]'
      '--match:ses\: variational with --epsilon 0.1, --lambda 0.003 and 0.073 Å'
      '--resolution:blur to D [Å], 1 to 50, all atoms or those of a'
      '--coarse:beads in the place of atoms\: residue (its backbone and'
      '--groups:groups of atoms\: JSON, or lines NAME SELECTION [COLOUR]'
      '--group-by:groups by chain, entity, class (a chain'\''s copies),'
      '--color:colours of the mesh and the grid Cd\: chain, group,'
      '--range:values at the ends of the colours'
      '--palette:colours of values and curvatures, low ones first\: viridis,'
      '--value-of:whose values\: atom, or residue (the mean of its atoms)'
      '--flat-values:a point has the value of one atom, not a blend of nearby ones'
      '--potential-offset:potentials are taken A outside of the surface [Å]'
      '--bricks:how many bricks, about as large each'
      '--memory:or as many bricks as it takes for each to need no more,'
      '--threads:threads at most'
      '-j:threads at most'
      '--quiet:print errors only'
      '-q:print errors only'
      '--no-progress:no progress bar'
      '--config:options as lines "name = value"; the command line wins'
      '--regularizer:gradient or area'
      '--flow:rest\: in closed form, where no front moves, else newton;'
      '--steps:so many steps, converged or not'
      '--tolerance:converged when a step moves the surface by less than T'
      '--version:print the version and stop'
      '-V:print the version and stop'
      '--help:print the common options and stop'
      '-h:print the common options and stop'
      '--help-all:print all options and stop') ;;
    "bricks run") options=(
      '--force:do it again if it is done'
      '--max-hours:refuse what is estimated to take more hours'
      '--threads:threads at most'
      '-j:threads at most'
      '--quiet:print errors only'
      '-q:print errors only'
      '--no-progress:no progress bar'
      '--version:print the version and stop'
      '-V:print the version and stop'
      '--help:print the common options and stop'
      '-h:print the common options and stop'
      '--help-all:print all options and stop') ;;
    "bricks merge") options=(
      '--output:file to write; repeats; the extension says what\:'
      '-o:file to write; repeats; the extension says what\:'
      '--format:what -o - writes\: one of'
      '--force:replace existing files'
      '--threads:threads at most'
      '-j:threads at most'
      '--quiet:print errors only'
      '-q:print errors only'
      '--verbose:print the time of every stage'
      '-v:print the time of every stage'
      '--no-progress:no progress bar'
      '--version:print the version and stop'
      '-V:print the version and stop'
      '--help:print the common options and stop'
      '-h:print the common options and stop'
      '--help-all:print all options and stop') ;;
    "info") options=(
      '--max-input:bytes that INPUT may have, unpacked, such as 10G'
      '--version:print the version and stop'
      '-V:print the version and stop'
      '--help:print the common options and stop'
      '-h:print the common options and stop'
      '--help-all:print all options and stop') ;;
    esac
    _describe option options
    return
fi
(( CURRENT == 2 )) && compadd -- help build batch compare convert bricks info
_files
