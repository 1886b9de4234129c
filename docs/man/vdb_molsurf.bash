# bash completion of vdb_molsurf 1.0.0
_vdb_molsurf()
{
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
    local verb=build options= words=
    case ${COMP_WORDS[1]} in
        bricks) verb="bricks ${COMP_WORDS[2]}" ;;
        help|build|batch|compare|convert|bricks|info) verb=${COMP_WORDS[1]} ;;
    esac
    case $verb:$before in
        "build":--format) words="vdb ply obj stl vtk glb 3mf vert face poly msh off wrl msh2 nvdb mrc dx density.mrc mask.mrc dielx.dx diely.dx dielz.dx kappa.dx charges.pqr apbs.in cxc pml html json png legend.svg view atoms.csv residues.csv contacts.csv interfaces.csv pockets.csv patches.csv pore.csv tunnels.csv forces.csv pore.svg pore.png tunnels.pdb tunnels.cif tunnels.cxc tunnels.pml pdb cif residues.pdb residues.cif patches.pdb patches.cif pockets.ply pockets.obj pockets.stl pockets.off pockets.wrl pockets.vtk pockets.glb pockets.3mf pore.ply pore.obj pore.stl pore.off pore.wrl pore.vtk pore.glb pore.3mf tunnels.ply tunnels.obj tunnels.stl tunnels.off tunnels.wrl tunnels.vtk tunnels.glb tunnels.3mf" ;;
        "build":--superpose) words="auto" ;;
        "build":--surface) words="variational ses sas vdw gaussian smooth-sas" ;;
        "build":--pieces) words="all outer cavities" ;;
        "build":--fields) words="all surface sas spline mean_curvature gaussian_curvature principal_curvature_1 principal_curvature_2 shape_index curvedness principal_direction_1 principal_direction_2 density atom_id chain_id group_id Cd value pocket_id pocket_depth pocket_room depth v" ;;
        "build":--measures) words="sphericity gyration_radius" ;;
        "build":--match) words="none ses" ;;
        "build":--coarse) words="atom residue" ;;
        "build":--group-by) words="chain entity class copy" ;;
        "build":--split) words="group" ;;
        "build":--color) words="none chain group element residue nucleotide illustrative hetero mean-curvature gaussian-curvature pocket patch copy entity class bfactor occupancy charge hydrophobicity rainbow radius depth table=FILE potential=FILE groups=FILE residue-type plain=#RRGGBB" ;;
        "build":--palette) words="viridis cividis batlow OrRd RdBu BuRd OrPu turbo plddt" ;;
        "build":--value-of) words="atom residue" ;;
        "build":--areas) words="atoms residues contacts interfaces pockets patches pore tunnels forces" ;;
        "build":--contacts) words="atom residue chain" ;;
        "build":--patches) words="mean-curvature> gaussian-curvature> bfactor> occupancy> charge> hydrophobicity> rainbow> radius> depth> table=FILE> potential=FILE>" ;;
        "build":--for) words="apbs blender blender4 houdini usd unreal arnold" ;;
        "build":--ids) words="int float" ;;
        "build":--view) words="auto" ;;
        "build":--background) words="transparent" ;;
        "build":--style) words="soft glossy outline flat" ;;
        "build":--show) words="sticks balls orders spheres tube spheres,others pockets" ;;
        "build":--legend) words="auto on off" ;;
        "build":--require) words="watertight manifold components= cavities= genus= min-angle=" ;;
        "build":--regularizer) words="gradient area" ;;
        "build":--flow) words="rest newton paper" ;;
        "batch":--surface) words="variational ses sas vdw gaussian smooth-sas" ;;
        "batch":--fields) words="all surface sas spline mean_curvature gaussian_curvature principal_curvature_1 principal_curvature_2 shape_index curvedness principal_direction_1 principal_direction_2 density atom_id chain_id group_id Cd value pocket_id pocket_depth pocket_room depth v" ;;
        "batch":--measures) words="sphericity gyration_radius" ;;
        "batch":--match) words="none ses" ;;
        "batch":--coarse) words="atom residue" ;;
        "batch":--group-by) words="chain entity class copy" ;;
        "batch":--split) words="group" ;;
        "batch":--color) words="none chain group element residue nucleotide illustrative hetero mean-curvature gaussian-curvature pocket patch copy entity class bfactor occupancy charge hydrophobicity rainbow radius depth table=FILE potential=FILE groups=FILE residue-type plain=#RRGGBB" ;;
        "batch":--palette) words="viridis cividis batlow OrRd RdBu BuRd OrPu turbo plddt" ;;
        "batch":--value-of) words="atom residue" ;;
        "batch":--areas) words="atoms residues contacts interfaces pockets patches pore tunnels forces" ;;
        "batch":--contacts) words="atom residue chain" ;;
        "batch":--patches) words="mean-curvature> gaussian-curvature> bfactor> occupancy> charge> hydrophobicity> rainbow> radius> depth> table=FILE> potential=FILE>" ;;
        "batch":--for) words="apbs blender blender4 houdini usd unreal arnold" ;;
        "batch":--ids) words="int float" ;;
        "batch":--view) words="auto" ;;
        "batch":--background) words="transparent" ;;
        "batch":--style) words="soft glossy outline flat" ;;
        "batch":--show) words="sticks balls orders spheres tube spheres,others pockets" ;;
        "batch":--legend) words="auto on off" ;;
        "batch":--require) words="watertight manifold components= cavities= genus= min-angle=" ;;
        "batch":--regularizer) words="gradient area" ;;
        "batch":--flow) words="rest newton paper" ;;
        "compare":--format) words="vdb ply html json png legend.svg view" ;;
        "compare":--color) words="distance signed-distance" ;;
        "compare":--palette) words="viridis cividis batlow OrRd RdBu BuRd OrPu turbo plddt" ;;
        "compare":--superpose) words="auto" ;;
        "compare":--surface) words="variational ses sas vdw gaussian smooth-sas" ;;
        "compare":--match) words="none ses" ;;
        "compare":--coarse) words="atom residue" ;;
        "compare":--view) words="auto" ;;
        "compare":--background) words="transparent" ;;
        "compare":--style) words="soft glossy outline flat" ;;
        "compare":--legend) words="auto on off" ;;
        "compare":--regularizer) words="gradient area" ;;
        "compare":--flow) words="rest newton paper" ;;
        "convert":--format) words="vdb ply obj stl vtk glb 3mf vert face poly msh off wrl msh2 nvdb mrc dx cxc pml html json png legend.svg view" ;;
        "convert":--fields) words="all surface sas spline mean_curvature gaussian_curvature principal_curvature_1 principal_curvature_2 shape_index curvedness principal_direction_1 principal_direction_2 density atom_id chain_id group_id Cd value pocket_id pocket_depth pocket_room depth v" ;;
        "convert":--color) words="none chain group element residue nucleotide illustrative hetero mean-curvature gaussian-curvature" ;;
        "convert":--palette) words="viridis cividis batlow OrRd RdBu BuRd OrPu turbo plddt" ;;
        "convert":--view) words="auto" ;;
        "convert":--background) words="transparent" ;;
        "convert":--style) words="soft glossy outline flat" ;;
        "convert":--legend) words="auto on off" ;;
        "bricks plan":--surface) words="variational ses sas vdw gaussian smooth-sas" ;;
        "bricks plan":--fields) words="all surface sas spline mean_curvature gaussian_curvature principal_curvature_1 principal_curvature_2 shape_index curvedness principal_direction_1 principal_direction_2 density atom_id chain_id group_id Cd value pocket_id pocket_depth pocket_room depth v" ;;
        "bricks plan":--match) words="none ses" ;;
        "bricks plan":--coarse) words="atom residue" ;;
        "bricks plan":--group-by) words="chain entity class copy" ;;
        "bricks plan":--color) words="none chain group element residue nucleotide illustrative hetero mean-curvature gaussian-curvature pocket patch copy entity class bfactor occupancy charge hydrophobicity rainbow radius depth table=FILE potential=FILE groups=FILE residue-type plain=#RRGGBB" ;;
        "bricks plan":--palette) words="viridis cividis batlow OrRd RdBu BuRd OrPu turbo plddt" ;;
        "bricks plan":--value-of) words="atom residue" ;;
        "bricks plan":--regularizer) words="gradient area" ;;
        "bricks plan":--flow) words="rest newton paper" ;;
        "bricks merge":--format) words="vdb ply html json png legend.svg view" ;;
    esac
    case $verb in
        "build") options="--output -o --format --force --skip-existing --select --model --assembly --instances --by-symmetry --copies --altloc --no-hydrogens --ions --hetero --no-hetero --waters --radii --probe --superpose --max-input --frames --trajectory --update-selections --first-frame --fps --surface --voxel --lod --blobbiness --fill-cavities --pieces --remesh --density --adapt --fields --vdb-half --curvature-totals --measures --epsilon --lambda --match --resolution --coarse --match-volume --groups --group-by --split --surface-of --interfaces --color --range --palette --value-of --flat-values --smooth-colors --potential-offset --plain-color --sharp-colors --areas --contacts --patches --pockets --pocket-at --probe-in --probe-out --pocket-cut --pocket-neck --pore --tunnels-from --tunnel-probe --for --fog-density --ids --one-box --mips --center --print-scale --min-thickness --apbs-grid --pdie --sdie --ion-conc --pixel-size --box-size --mask-extend --mask-edge --invert-density --view --zoom --up --turn --size --background --style --show --label --ruler --panel --opacity --show-behind --clip --depth-cue --legend --scale-bar --dpi --turntable --memory --max-hours --dry-run --require --threads -j --quiet -q --verbose -v --no-progress --config --regularizer --flow --max-steps --steps --tolerance --spline-level --weld --list-radii --version -V --help -h --help-all" ;;
        "batch") options="--folder -O --formats --force --select --model --assembly --copies --altloc --no-hydrogens --ions --hetero --no-hetero --waters --radii --probe --max-input --surface --voxel --blobbiness --fill-cavities --remesh --density --adapt --fields --vdb-half --curvature-totals --measures --epsilon --lambda --match --resolution --coarse --match-volume --groups --group-by --split --surface-of --interfaces --color --range --palette --value-of --flat-values --smooth-colors --potential-offset --plain-color --areas --contacts --patches --pockets --pocket-at --probe-in --probe-out --pocket-cut --pocket-neck --pore --tunnels-from --tunnel-probe --for --fog-density --ids --one-box --mips --center --print-scale --min-thickness --pixel-size --box-size --mask-extend --mask-edge --invert-density --view --zoom --up --turn --size --background --style --show --label --ruler --opacity --show-behind --clip --depth-cue --legend --scale-bar --dpi --turntable --max-hours --require --threads -j --quiet -q --verbose -v --no-progress --config --regularizer --flow --max-steps --steps --tolerance --spline-level --version -V --help -h --help-all" ;;
        "compare") options="--output -o --format --force --color --palette --range --select --model --assembly --copies --altloc --no-hydrogens --ions --hetero --no-hetero --waters --radii --probe --superpose --max-input --surface --voxel --blobbiness --fill-cavities --epsilon --lambda --match --resolution --coarse --match-volume --view --up --turn --size --background --style --opacity --show-behind --clip --depth-cue --legend --scale-bar --dpi --turntable --max-hours --dry-run --threads -j --quiet -q --verbose -v --no-progress --config --regularizer --flow --max-steps --steps --tolerance --spline-level --version -V --help -h --help-all" ;;
        "convert") options="--output -o --format --force --iso --remesh --density --adapt --fields --color --range --palette --plain-color --print-scale --view --up --turn --size --background --style --opacity --show-behind --clip --depth-cue --legend --scale-bar --dpi --turntable --max-hours --dry-run --threads -j --quiet -q --verbose -v --no-progress --config --version -V --help -h --help-all" ;;
        "bricks plan") options="--output -o --force --select --model --assembly --copies --altloc --no-hydrogens --ions --hetero --no-hetero --waters --radii --probe --max-input --surface --voxel --blobbiness --fields --vdb-half --epsilon --lambda --match --resolution --coarse --groups --group-by --color --range --palette --value-of --flat-values --potential-offset --bricks --memory --threads -j --quiet -q --no-progress --config --regularizer --flow --steps --tolerance --version -V --help -h --help-all" ;;
        "bricks run") options="--force --max-hours --threads -j --quiet -q --no-progress --version -V --help -h --help-all" ;;
        "bricks merge") options="--output -o --format --force --threads -j --quiet -q --verbose -v --no-progress --version -V --help -h --help-all" ;;
        "info") options="--max-input --version -V --help -h --help-all" ;;
    esac
    if [[ $COMP_CWORD == 2 && ${COMP_WORDS[1]} == bricks ]]; then
        COMPREPLY=($(compgen -W "plan run merge" -- "$word"))
    elif [[ -n $words ]]; then
        COMPREPLY=($(compgen -W "$words" -- "$word"))
    elif [[ $word == -* ]]; then
        COMPREPLY=($(compgen -W "$options" -- "$word"))
    else
        COMPREPLY=($(compgen -f -- "$word"))
        [[ $COMP_CWORD == 1 ]] && COMPREPLY+=($(compgen -W "help build batch compare convert bricks info" -- "$word"))
    fi
}
complete -o filenames -F _vdb_molsurf vdb_molsurf
