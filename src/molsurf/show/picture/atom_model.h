// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Atoms as balls, sticks and tubes, to be seen beside a surface.

#include "molsurf/analysis/proximity/ray_unit.h"
#include "molsurf/atoms.h"
#include "molsurf/kernel/mesh/mesh_instance.h"
#include "molsurf/mesh.h"
#include "molsurf/progress.h"
#include "molsurf/show/color/legend.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

struct FileBonds;
struct ShownAtoms;

/// What is shown in the space between atoms, and what its colours mean.
struct Bodies {
    Mesh mesh; ///< with colours
    std::vector<LegendEntry> pockets, tunnels;
};

/// Balls, sticks and tubes, as meshes with colours, that copies repeat together.
struct AtomUnit : RayUnit {
    std::vector<Color> ballColors, stickColors; ///< one each
};

/// Atoms that are seen beside a surface. What the copies of an assembly have is held once.
struct AtomModel {
    std::vector<AtomUnit> units;               ///< none of them empty
    std::vector<MeshInstance> copies;          ///< of units
    std::vector<LegendEntry> chains, elements; ///< of tubes, and of balls and sticks
    Bodies bodies; ///< with a mesh if they let light through; else it is a unit
};

/// A way to show atoms.
struct AtomStyle {
    const char* word; ///< of the command line
    const char* help;
    /// Adds to the last unit, and to the legends.
    void (*add)(const ShownAtoms& shown, const Progress& progress, AtomModel& model);
    /// About what the atoms take while they are drawn [byte].
    double (*bytesOf)(const BallSet& atoms);
};

/// All of them: sticks, balls, orders, spheres, tube.
const std::vector<AtomStyle>& atomStyles();

/// Atoms of a structure and how they are shown.
struct ShowRule {
    std::string select; ///< as SelectOptions::select; empty: all
    const AtomStyle* style = nullptr;
    bool golden = false; ///< whether carbon is golden where there are several chains, too
    bool others = false; ///< whether the atoms are of the copies that the surface leaves out; they
                         ///< have its colours
    std::optional<Color> color{}; ///< of all atoms; none: as they are
    bool byCopy = false; ///< whether the copies of an assembly have colours of their own, which
                         ///< multiply those of the atoms
};

/// "sticks", or "(HEM)=sticks" for some of the atoms; behind commas "golden", "others" or a colour,
/// as ShowRule has them.
/// @param[in] others  further words that an option takes, for the hint of an error
/// @throws Error(ErrorKind::Usage) if it is neither
ShowRule parseShow(const std::string& text, const std::vector<std::string>& others = {});

/// Atoms that are shown.
struct ShownAtoms {
    BallSet atoms; ///< with labels and names
    ShowRule rule;
    std::shared_ptr<const FileBonds> bonds{}; ///< that their file gives; null: none
    bool byChain = false;                     ///< whether carbon has the colour of its chain
};

/// About what the model of these atoms takes while it is drawn [byte].
double bytesOfModel(const std::vector<ShownAtoms>& shown);

/// Atoms have their BallSet::colors. Without any carbon is golden or has the colour of its chain,
/// other elements have their colours (CPK), tubes that of their chain.
/// @throws Error(ErrorKind::Input) if a rule has nothing to show, as a tube without a backbone
AtomModel atomModel(const std::vector<ShownAtoms>& shown, const Progress& progress);

/// Adds bodies with their legends. Where atoms are shown they let light through, so that a ligand
/// is seen in its pocket.
void addBodies(const Bodies& bodies, AtomModel& model);

} // namespace molsurf
