// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The report on a surface and on the run that made it: the content of the .json file.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace molsurf
{

struct BallSet;

/// The percentages that Statistics::percentiles has values for.
constexpr std::array<int, 9> percents = {1, 5, 10, 25, 50, 75, 90, 95, 99};

/// The distribution of a quantity over the area of a surface, in the unit of the quantity.
struct Statistics {
    double mean = 0.0;
    double standardDeviation = 0.0;
    double min = 0.0;
    double max = 0.0;
    std::array<double, percents.size()> percentiles = {}; ///< values that `percents` of the area
                                                          ///< do not exceed
};

/// Integrals over a closed surface, the walls of cavities included. docs/math.md, section 9.
struct SurfaceIntegrals {
    double area = 0.0;              ///< [Å^2]
    double volume = 0.0;            ///< [Å^3]
    double meanCurvature = 0.0;     ///< integral of the mean curvature H [Å]
    double gaussianCurvature = 0.0; ///< integral of the Gaussian curvature K [sr]: 2 pi times the
                                    ///< Euler characteristic
    double squaredMeanCurvature = 0.0; ///< integral of H^2 (Willmore), no unit: at least 4 pi
    double unresolvedArea = 0.0;       ///< part of the area that H and H^2 are not integrated over,
                                       ///< at gaps that the voxels do not resolve [Å^2]

    /// Adds the integrals of another surface.
    SurfaceIntegrals& operator+=(const SurfaceIntegrals& o)
    {
        area += o.area;
        volume += o.volume;
        meanCurvature += o.meanCurvature;
        gaussianCurvature += o.gaussianCurvature;
        squaredMeanCurvature += o.squaredMeanCurvature;
        unresolvedArea += o.unresolvedArea;
        return *this;
    }
};

/// Area, volume and topology of a closed surface.
struct SurfaceReport {
    /// A cavity: a closed inner wall of the surface.
    struct Cavity {
        double area;   ///< area of the wall [Å^2]
        double volume; ///< volume inside the wall [Å^3], > 0
    };

    /// How well the triangles of a mesh are made.
    struct Shape {
        double leastAngle = 180.0;            ///< of all triangles [degree]
        std::size_t below20 = 0, below28 = 0; ///< triangles with an angle below 20, 28 degrees
        double shortestEdge = std::numeric_limits<double>::infinity(); ///< [Å]
        double longestEdge = 0.0;                                      ///< [Å]
        std::size_t keptPieces = 0; ///< closed pieces that are too small for the edges asked for
        std::vector<int>
            eulerNumbers; ///< of the closed pieces, in the order of their first vertices
    };

    std::string kind = "variational";           ///< a word of nameOf(SurfaceKind)
    double area = 0.0;                          ///< area of all walls [Å^2]
    double volume = 0.0;                        ///< enclosed volume without cavities [Å^3]
    std::optional<int> eulerCharacteristic = 0; ///< of all walls; none where it is not known, as
                                                ///< of some wholes in closed form from a unit
    int meshEulerCharacteristic = 0; ///< of the mesh; where the surface is known in closed form,
                                     ///< the mesh may bridge what is narrower than a voxel
    /// Of the mesh, where area and volume are known in closed form: it lacks what is narrower than
    /// a voxel [Å^2, Å^3].
    std::optional<double> meshArea, meshVolume;
    int meshComponents = 0; ///< number of closed pieces of the mesh, walls of cavities included
    std::optional<double> triangleArea; ///< area of the mesh's flat triangles [Å^2]; none of bricks
    bool piecesKnown = true; ///< whether components, cavities, outerArea and outerVolume are; not
                             ///< those of a whole in closed form that follows from a unit
    int components = 0;      ///< number of closed pieces that are not walls of cavities
    std::vector<Cavity> cavities;
    double outerArea = 0.0;    ///< area without the walls of cavities [Å^2]
    double outerVolume = 0.0;  ///< enclosed volume with the cavities [Å^3]
    std::size_t vertices = 0;  ///< of the mesh
    std::size_t triangles = 0; ///< of the mesh
    bool closed = false;       ///< whether every edge has two triangles
    bool manifold = false;     ///< whether the triangles about each vertex form one fan and are
                               ///< oriented alike
    std::size_t degenerateTriangles = 0; ///< number of triangles without area
    double maxResidual = 0.0;            ///< largest |S| at a vertex, S being the spline [Å]
    /// Of the vertices away from kinks of the distance, the share at which the gradient of the
    /// spline has a length within 0.03 of 1; not a number if every vertex is near a kink.
    double gradientShare = 0.0;
    /// Share of the vertices within two voxels of a kink: a place where the direction to the
    /// closest point turns by over 20 degrees in a voxel, of which the curvature of the surface
    /// leaves 10 or more unexplained. A ball has none. docs/math.md, section 7.
    double kinkShare = 0.0;
    /// Of the solvent-excluded surface: the length of the circles in which the grown balls meet
    /// and that are smaller than the probe [Å]. It touches itself there, in cusps that voxels round
    /// off.
    std::optional<double> cuspLength;
    Statistics meanCurvature;     ///< mean curvature at the vertices [1/Å], positive where convex
    Statistics gaussianCurvature; ///< Gaussian curvature at the vertices [1/Å^2]
    std::optional<SurfaceIntegrals> integrals; ///< of the curvature, if they were asked for
    std::optional<Shape> shape;                ///< of the mesh, if its edges were asked for
};

/// The history of the flow. Its interface is that of the evolving level set, near the
/// solvent-accessible surface. Energy, area and volume have an entry for the initial interface and
/// one for each step; the displacement and the speed have one for each step. At rest in closed form
/// there is no step, and all of them are empty.
struct EvolutionReport {
    /// How the gaps of a molecule were decided: cavities, tunnels and slits that are open or closed
    /// by a little.
    struct Gaps {
        std::size_t found = 0;  ///< number of those about which it was asked
        std::size_t closed = 0; ///< number of those that tension closes though no atom fills them
        double nearest = 0.0;   ///< how near to the decision the nearest one is, as a value of psi
        /// Number of passages and voids that a probe fits into and that are closed. None where it
        /// was not asked for.
        std::optional<std::size_t> closedByField{};
        double widestClosed = 0.0; ///< the most room beside the probe in one of these [Å]
        double opensBelow = 0.0;   ///< the tolerance eps at which the widest opens [Å]
    };

    int steps = 0;              ///< number of steps made
    bool converged = false;     ///< whether the interface is at rest: the stopping rule of
                                ///< EvolveOptions::tolerance is met
    std::vector<double> energy; ///< integral of w over the interface [Å^2]
    std::vector<double> area;   ///< area of the interface [Å^2]
    std::vector<double> volume; ///< volume inside the interface [Å^3]
    std::vector<double> meanDisplacement; ///< mean way of the interface in the step [Å]
    std::vector<double> maxSpeed;         ///< largest |F| near the interface in the step [1/Å]
    /// The way of the interface in the last step, or to rest where it is so in closed form [Å]: its
    /// root mean square, and what 99.9 % of the interface does not exceed.
    double displacementRms = 0.0, displacementTail = 0.0;
    double toleranceMet = 0.0; ///< the smallest EvolveOptions::tolerance that it meets [voxel]
    /// How much the area may still change on the way to rest, an estimate as a share of the area
    /// that holds in 19 of 20 runs; not a number without Newton steps. Where fronts decide gaps,
    /// how far it may change with the place of the molecule on the grid: estimatePoseError().
    double areaError = std::numeric_limits<double>::quiet_NaN();
    /// Share of the interface at which it is above a tenth of a voxel.
    double unsettledShare = 0.0;
    /// Energy of the final interface, by a quadrature that does not depend on the voxels [Å^2]; not
    /// a number if it was not asked for.
    double finalEnergy = std::numeric_limits<double>::quiet_NaN();
    /// Number of voxels at gaps of the final interface that are too narrow for the grid.
    std::size_t unresolvedGapVoxels = 0;
    /// Number of steps that the last fronts made alone, after those of the whole, and number of
    /// blocks of 8^3 voxels where one still moved at the end.
    int frontSteps = 0;
    std::size_t restlessFronts = 0;
    std::optional<Gaps> gaps{}; ///< none where voxels and fronts decide
    /// How thin walls and necks of the surface were decided: `closed` are those thicker than the
    /// least, `nearest` is a depth [Å]. None where voxels decide.
    std::optional<Gaps> walls{};
};

/// Rows of named values.
struct Table {
    /// A column of a table.
    struct Column {
        std::string name;
        /// One value a row; a number that is none is not known.
        std::variant<std::vector<std::string>, std::vector<std::int64_t>, std::vector<double>>
            values;
    };

    std::string name; ///< "atoms", "residues", "contacts", "interfaces", "pockets",
                      ///< "patches", "pore", "tunnels" or "forces"
    std::vector<Column> columns;
};

/// The whole report.
struct Report {
    /// The beads that stand for several atoms.
    struct Coarse {
        std::size_t beads = 0; ///< number of beads
        std::size_t atoms = 0; ///< number of atoms that they stand for
    };

    /// The atoms that have one resolution.
    struct Resolution {
        std::string select;      ///< the selection of the rule; empty: all
        double resolution = 0.0; ///< d [Å]
        std::size_t atoms = 0;   ///< number of balls that have it
        double level = 0.0;      ///< Decay::level; 0 where volumes are not matched
    };

    /// A group of atoms and its share of the surface.
    struct Group {
        std::string name;
        std::size_t atoms = 0; ///< number of its balls
        double area = 0.0;   ///< area of the surface nearest to its balls [Å^2]; the areas of all
                             ///< groups and of "other", the atoms without one, add up to the whole
        double volume = 0.0; ///< volume inside the surface nearest to its balls [Å^3]; adds up, too
        std::string color;   ///< "#rrggbb" if the surface is coloured by group, else empty
        std::optional<double> aloneArea{}; ///< area of the surface of the group alone [Å^2], if
                                           ///< the report has interfaces
    };

    /// The area that two groups of atoms bury between them.
    struct Interface {
        /// A ball whose surface another group buries.
        struct Buried {
            std::size_t ball = 0;  ///< its index in the caller's BallSet
            bool ofFirst = true;   ///< whether it belongs to the first of the groups
            double alone = 0.0;    ///< its area on the surface of its group alone [Å^2]
            double together = 0.0; ///< its area on the surface of both [Å^2]
        };
        /// How well the solvent-excluded surfaces of the groups fit, each alone, for a probe of 1.7
        /// Å. docs/complexes.md. Not a number where no part of them is buried deep enough.
        struct Fit {
            double shape = std::numeric_limits<double>::quiet_NaN(); ///< Sc, at most 1
            double distance =
                std::numeric_limits<double>::quiet_NaN(); ///< of the surfaces, median [Å]
            /// Contact molecular surface of each group: the area that the other buries, at every
            /// point times exp(-d^2/2), d Å being its distance from that of the other [Å^2].
            std::array<double, 2> contact = {};
            double gapVolume = 0.0; ///< between them, where no probe fits [Å^3]
            double gapIndex = std::numeric_limits<double>::quiet_NaN(); ///< gapVolume by the area
                                                                        ///< that each buries [Å]
        };

        std::string first, second; ///< names of the groups
        double area = 0.0;     ///< (A_first + A_second - A_both) / 2, each surfaced alone [Å^2]
        std::size_t count = 1; ///< how many such there are in a whole made by symmetry
        Fit fit{};
        /// The balls whose area changes, if areas of balls were asked for; half of what they lose
        /// adds up to `area`.
        std::vector<Buried> buried{};
    };

    /// The surface that a part of the atoms has of its own.
    struct Part {
        std::string name;
        std::size_t atoms = 0; ///< number of its balls
        SurfaceReport surface;
    };

    /// A copy of a part that is surfaced once.
    struct Copy {
        std::size_t part = 0; ///< index in Report::parts; 0 if there is one prototype
        std::string name;     ///< of the operator that places it
        /// x -> matrix x of points (x, y, z, 1) [Å], row by row; moved as the files are.
        std::array<std::array<double, 4>, 4> matrix;
    };

    /// How a whole was made from a unit of it, by symmetry.
    struct Symmetry {
        std::string pointGroup; ///< Schoenflies; "" if it is none of C, D, T, O and I
        std::size_t order = 1;  ///< number of units
        std::size_t copies = 1; ///< copies of the assembly in a unit
        double deviation = 0.0; ///< farthest that a copy lies from where a rotation brings it [Å]
        double gap = 0.0;       ///< largest gap between units that was closed [Å]
        std::size_t openVertices = 0; ///< edges of a unit's border that fit none of a neighbour's
    };

    /// The pockets, and what was asked for.
    struct Pockets {
        /// A pocket: space that a small probe reaches and a large one does not. docs/pockets.md.
        struct Pocket {
            /// Where a pocket ends because the large probe comes near.
            struct Mouth {
                double area = 0.0; ///< [Å^2]
                double radius =
                    0.0; ///< of the largest ball that gets out of the widest place there [Å]
                std::array<double, 3> place = {}; ///< where that just passes [Å]
            };
            /// A ball that has a part of the pocket's wall.
            struct Lining {
                std::size_t ball; ///< its index in the caller's BallSet
                double area;      ///< of its part [Å^2]
            };

            double volume = 0.0;               ///< [Å^3]
            double area = 0.0;                 ///< of the wall [Å^2]
            double depth = 0.0;                ///< of its deepest point [Å]
            double radius = 0.0;               ///< of the largest ball in it [Å]
            std::array<double, 3> centre = {}; ///< of its volume [Å]
            bool open = false;                 ///< whether a way leads out, perhaps by neighbours
            std::vector<Mouth> mouths{};       ///< the largest first
            std::size_t rank = 0; ///< among all pockets that were found, the largest 1; without
                                  ///< SelectOptions::pocketAt its place in the list
            std::vector<std::size_t> neighbours{}; ///< ranks of the pockets beyond necks, ascending
            std::vector<Lining> lining{};          ///< in ascending order of the balls
        };

        double probeIn = 0.0, probeOut = 0.0, cut = 0.0, neck = 0.0; ///< as PocketRule has them
        double voxel = 0.0;       ///< that they are found on [Å]
        std::vector<Pocket> list; ///< the largest first
        bool isChosen = false;    ///< whether it is only the one at atoms that were asked for

        /// A row for every pocket of the list: pocket (its number from 1), volume, area, depth_A,
        /// radius_A (of the largest ball in it), x_A, y_A, z_A (its middle), open (1: a way leads
        /// out), mouths, mouth_area (of all), mouth_radius_A (of the largest ball that gets out),
        /// mouth_x_A, mouth_y_A, mouth_z_A (where it just passes), rank (among all that were found,
        /// the largest 1), neighbours (ranks of pockets beyond necks), hydrophobicity (mean over
        /// the wall, of Kyte and Doolittle), charge (of side chains, +1 of Lys and Arg, -1 of Asp
        /// and Glu), atoms (how many line it), residues and atom_ids (which), and what was asked
        /// for: probe_in_A, probe_out_A, cut_A, neck and voxel_A. Without names of the atoms what
        /// needs these is empty.
        /// @param[in] atoms  that they are of
        Table table(const BallSet& atoms) const;
    };

    /// The patches, and what was asked for.
    struct Patches {
        /// A connected piece of the mesh where a value, linear on each triangle, is beyond a level.
        struct Patch {
            double area = 0.0;                            ///< of the triangles there [Å^2]
            double integral = 0.0;                        ///< of the value over it
            std::array<double, 3> centre = {};            ///< mean of its points [Å]
            std::vector<Pockets::Pocket::Lining> parts{}; ///< of its balls, ascending
        };

        std::string value;       ///< what it is: "hydrophobicity"
        bool above = true;       ///< whether patches are where it is above the level, or below
        double level = 0.0;      ///< in the unit of the value
        std::vector<Patch> list; ///< the largest first

        /// A row for every patch: patch (its number from 1), area, mean and integral_A2 of the
        /// value, x_A, y_A, z_A (mean of its points), atoms and residue_count (how many have a part
        /// of it), residues and atom_ids (which), and what was asked for: value, side of the level
        /// ("above" or "below") and level.
        /// Without names of the atoms what needs these is empty.
        /// @param[in] atoms  that they are of
        Table table(const BallSet& atoms) const;
    };

    /// A way through the molecule. docs/pores.md.
    struct Pore {
        /// The largest ball of a section.
        struct Station {
            std::array<double, 3> place = {};  ///< its centre [Å]
            std::array<double, 3> normal = {}; ///< of the section, a unit vector
            double distance = 0.0; ///< from the first section, along the normals: not along a way
                                   ///< that is at an angle to them [Å]
            double radius = 0.0;   ///< negative within atoms [Å]
            bool isBottleneck = false;         ///< whether it is the narrowest place nearby
            std::vector<std::size_t> lining{}; ///< indices of balls within 1 Å of it in the
                                               ///< caller's BallSet, the nearest first
        };

        std::array<double, 3> axis = {}; ///< from end to end, a unit vector
        std::vector<Station> stations{}; ///< from end to end
        double crossed = 0.0;            ///< share of the height of the molecule along the axis
        std::vector<Pore> bundle{};      ///< further ways along the axis that are as wide, within
                                         ///< 5 %: the other pores of an oligomer
        /// A way along the axis that is narrower.
        struct Way {
            double radius = 0.0;              ///< of its narrowest place [Å]
            std::array<double, 3> place = {}; ///< that [Å]
        };
        std::vector<Way> others{}; ///< those that water passes, the widest first

        double length() const { return stations.back().distance; }
        double narrowest() const; ///< the least radius [Å]
        /// Of a bath of bulkResistivity by Ohm's rule, with steps of Station::distance, without
        /// what leads to the ends [pS]; none where it is narrower than leastWater, since no water
        /// passes there.
        std::optional<double> conductance() const;
        /// A row for every section of it and of its bundle: distance_A, height_A (along the axis),
        /// x_A, y_A, z_A, radius_A, bottleneck (1 or 0), residues and atom_ids (within 1 Å, the
        /// nearest first), pore (its number from 1), and of that length_A, conductance_pS and
        /// resistivity_ohm_m.
        /// @param[in] atoms  that it is of
        Table table(const BallSet& atoms) const;

        /// Of 1 M KCl at 25 °C, the demal solution of Jones and Bradshaw, J. Am. Chem. Soc.
        /// 55:1780-1800, 1933: 0.11134 S/cm [Ω m].
        static constexpr double bulkResistivity = 0.0898;
        /// Radius of a water molecule: nothing narrower lets it pass, as in HOLE [Å].
        static constexpr double leastWater = 1.15;
    };

    /// The ways out of a place in the molecule. docs/pores.md.
    struct Tunnels {
        /// A way from the start to the outside.
        struct Tunnel {
            std::size_t number = 0;                ///< from 1; over frames one for each tunnel
            std::vector<Pore::Station> stations{}; ///< from the start on; their distances are along
                                                   ///< the way, and their balls touch three atoms
            double length() const { return stations.back().distance; }
            const Pore::Station& narrowest() const;
            double curvature() const; ///< its length over the distance of its ends
        };

        std::array<double, 3> start = {}; ///< the centre of the room where they begin [Å]
        double startRadius = 0.0;         ///< of the ball there [Å]
        double probe = 0.0;               ///< all are as wide as this at least [Å]
        double probeOut = 0.0;    ///< they end at what a ball of this reaches from outside [Å]
        std::vector<Tunnel> list; ///< the widest at their narrowest places first

        /// A row for every station: tunnel (its number), distance_A, x_A, y_A, z_A,
        /// radius_A, bottleneck (1 or 0), residues and atom_ids (within 1 Å, the nearest first),
        /// and of its tunnel bottleneck_A (the least radius), length_A, curvature, hydrophobicity
        /// (mean over the lining, of Kyte and Doolittle), charge (of side chains), and what was
        /// asked for: probe_A and probe_out_A.
        /// @param[in] atoms  that they are of
        Table table(const BallSet& atoms) const;
    };

    std::string program = "vdb_molsurf";
    std::string version;                         ///< of the program
    std::string commit;                          ///< that it was built of; empty if not from git
    std::string options;                         ///< SHA-256 of version and options; may be empty
    std::string command;                         ///< the command line
    std::string input;                           ///< path of the file with the atoms
    std::string inputSha256;                     ///< of its bytes; empty if they are not known
    std::size_t atoms = 0;                       ///< number of balls that the surface is made of
    double voxel = 0.0;                          ///< voxel edge h [Å]
    std::optional<std::array<double, 3>> center; ///< point of the input that is the origin of the
                                                 ///< files [Å], if the surface was moved
    SurfaceReport surface;
    std::optional<Coarse> coarse;        ///< present if there are beads
    std::vector<Resolution> resolutions; ///< one for each rule, in their order
    std::vector<Group> groups;
    std::vector<Interface> interfaces; ///< of groups that touch, if they were asked for
    std::vector<Part> parts;     ///< surfaces of their own, of which `surface` is the sum; empty
                                 ///< if there is only one
    std::vector<Copy> instances; ///< copies; `surface` has each distinct one once
    std::optional<Symmetry> symmetry;         ///< present if the whole follows from a unit
    std::optional<EvolutionReport> evolution; ///< absent for kinds without a flow
    std::size_t activeVoxels = 0;             ///< number of active voxels of the grid `surface`
    std::size_t gridBytes = 0;                ///< memory of the grid `surface` [byte]
    std::vector<std::pair<std::string, double>> seconds; ///< stages and their wall times [s]; the
                                                         ///< last one is "total"
    std::size_t peakMemoryBytes = 0;                     ///< of the process
    int threads = 0;                                     ///< number of threads that the run used
    std::vector<std::string> warnings;                   ///< one line each
    std::optional<Pockets> pockets;                      ///< if they were asked for
    std::optional<Patches> patches;                      ///< if they were asked for
    std::optional<Pore> pore;                            ///< if it was asked for
    std::optional<Tunnels> tunnels;                      ///< if they were asked for
    std::string areasOf; ///< kind of surface that interfaces and tables are of; empty if there are
                         ///< none
    std::optional<double> polarArea, apolarArea; ///< of polar and apolar atoms [Å^2], where areas
                                                 ///< of named atoms are known
    std::vector<std::pair<std::string, double>> measures; ///< numbers that were asked for, by name
    std::vector<Table> tables; ///< areas by atom, by residue and so on, if its caller adds them

    /// Adds to the time of a stage, which may run more than once.
    /// @param[in] more  wall time [s]
    void addSeconds(const std::string& stage, double more)
    {
        for (auto& [name, sum] : seconds) {
            if (name != stage) continue;
            sum += more;
            return;
        }
        seconds.emplace_back(stage, more);
    }
};

/// The report as JSON text, indented, with a final line feed. Numbers that are not finite are null;
/// bytes that are no UTF-8 become U+FFFD. `evolution` is null if the report has none.
std::string reportText(const Report& report);

} // namespace molsurf
