// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Makes the molecular surface of atoms, finds where points lie to it, and makes its tables.

#include "molsurf/atoms.h"
#include "molsurf/mesh.h"
#include "molsurf/options.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"

#include <openvdb/openvdb.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

/// Two balls that touch.
struct ContactArea {
    std::array<std::size_t, 2> balls; ///< their indices, ascending
    double area;                      ///< [Å^2], at least 1e-6
    double distance;                  ///< of their centres [Å]
};

/// The surface of a molecule. `surface` is null if parts have surfaces of their own, whose level
/// sets are then among `fields`, and for a unit of a whole. `mesh` is of the whole: units are
/// joined, and copies of prototypes are parts. `ballAreas` of a symmetric unit are of its own balls
/// alone.
struct MolecularSurface : LevelSetSurface {
    /// A vertex on the border of a symmetric unit (Placement::unit): in unit k it is the vertex
    /// `other` of the unit that motion k after `motion` makes.
    struct SharedVertex {
        std::uint32_t vertex;
        std::int32_t motion;
        std::uint32_t other;
    };

    /// How a surface changes when a ball moves, in the order of the balls.
    struct Gradients {
        std::vector<openvdb::Vec3d> volume; ///< derivatives of the volume by the centre [Å^2]
        std::vector<openvdb::Vec3d> area;   ///< those of the area [Å]
        /// Of the variational surface: 1 for a ball beside a gap that was decided, where the change
        /// of rounded ridges is left out. Its derivatives can be wrong by their own size there.
        std::vector<char> besideGap{};
        /// Of the variational surface: 1 for a ball of whose derivatives a part that counts is of
        /// ridges that were rounded. How the rounding follows the balls is left out, too.
        std::vector<char> besideRidge{};
    };

    MolecularSurface() = default;
    MolecularSurface(LevelSetSurface made) : LevelSetSurface(std::move(made)) {}

    std::vector<SharedVertex> shared; ///< used by the library alone
    /// Used by the library alone: the grid of the curvature that colours show, if `fields` lack it.
    openvdb::GridPtrVec shown;
    /// Beside `ballAreas`, if the balls have values, the mean of the value on each ball's part of
    /// the surface; not a number where it has none.
    std::vector<double> ballValues;
    /// If the field "depth" was asked for, how deep the centre of each ball lies below the outer
    /// solvent-excluded surface of the probe, or without one below the balls themselves [Å].
    std::vector<double> ballDepths;
    /// If they were asked for, what contactAreas() gives with the probe of the surface.
    std::vector<ContactArea> contacts;
    /// If they were asked for, the space of each pocket as a closed part, in the order of the
    /// report and named as in legends, with normals out of it and the colours of pockets.
    Mesh pocketBodies;
};

/// The active voxels of a grid, in the order of its tree. The centre of voxel ijk lies at
/// `origin` + ijk `edge` [Å].
struct Voxels {
    std::vector<std::array<std::int32_t, 3>> coordinates; ///< ijk
    std::vector<float> values;                            ///< one a voxel
    double edge = 0.0;                                    ///< [Å]
    openvdb::Vec3d origin{0.0};                           ///< [Å]
};

/// Lists the active voxels of a grid whose voxels are cubes along the axes.
/// @throws Error(ErrorKind::Input) if they are not
Voxels voxelsOf(const openvdb::FloatGrid& grid);

/// How far around a symmetric unit balls have an influence on its surface, for
/// AssemblyChoice::surroundings [Å].
double surroundingsOf(const SurfaceOptions& options);

/// Makes the surface of balls and uses their resolutions, groups and colours.
///
/// One build of the library gives the same bits for every number of threads.
///
/// @param[in] balls     at least one; positions and radii are finite
/// @param[in] options   every option in its range, see checkOptions()
/// @param[in] progress  follows the run and may end it; null: nobody does
/// @throws Error(ErrorKind::Usage) if an option is out of its range, or the balls lack the labels,
///         groups or values that SurfaceOptions::color shows
/// @throws Error(ErrorKind::Input) if a ball cannot be used; the message has its index
/// @throws Error(ErrorKind::Numeric) if there is no surface at this resolution
/// @throws Error(ErrorKind::Check) if the result contradicts itself
/// @throws Cancelled if the progress object says so
MolecularSurface makeSurface(const BallSet& balls, const SurfaceOptions& options = {},
                             Progress* progress = nullptr);

/// Makes the surface of balls without labels, resolutions or colours; otherwise as above.
MolecularSurface makeSurface(const std::vector<Ball>& balls, const SurfaceOptions& options = {},
                             Progress* progress = nullptr);

/// The area of every ball's sphere that no other ball covers, of balls of radius r_i + probe: with
/// the radius of a probe the solvent-accessible area, with 0 the van der Waals area [Å^2]. They add
/// up to the area of the union, cavities included. Of equal balls the first has the area.
///
/// @param[in] balls  any number; every coordinate within 1e6 Å, radii > 0, both finite
/// @param[in] probe  added to every radius [Å]
/// @return one area a ball, exact but for rounding and moves of 1e-9 Å
/// @throws Error(ErrorKind::Input) that names the first ball at fault, by its index
/// @throws Error(ErrorKind::Check) if the result contradicts itself
/// @throws Cancelled if the progress object says so
std::vector<double> exposedAreas(const std::vector<Ball>& balls, double probe,
                                 const Progress& progress = Progress());

/// The contacts between balls of radius r_i + probe. A contact is the facet that the cells of two
/// balls share in the power diagram, as far as it lies in the balls: for two balls alone the disk
/// in which their spheres meet.
///
/// @param[in] balls  as above
/// @param[in] probe  added to every radius [Å]
/// @return in ascending order of the balls, exact but for rounding
/// @throws Error(ErrorKind::Input) that names the first ball at fault, by its index
/// @throws Cancelled if the progress object says so
std::vector<ContactArea> contactAreas(const std::vector<Ball>& balls, double probe,
                                      const Progress& progress = Progress());

/// The derivatives of volume and area by the centres of the balls: of ses, sas and vdw in closed
/// form, of the others by the motion of a mesh (docs/math.md, section 10). They are those of all
/// walls, cavities included; of equal balls the first has them. A force of surface tension gamma
/// and pressure p on ball i is -(gamma area[i] + p volume[i]).
///
/// @param[in] atoms  as for exposedAreas(); without units and copies
/// @param[in] spec   not Gaussian, whose creases voxels do not resolve, and without minThickness
/// and
///                   fillCavities; with a flow at rest in closed form
/// @param[in] mesh   of that surface, with normals; not used for ses, sas and vdw
/// @return in closed form exact but for rounding, where no arc or corner is about to come or go
/// @throws Error(ErrorKind::Usage) for another surface
/// @throws Error as exposedAreas()
MolecularSurface::Gradients surfaceGradients(const BallSet& atoms, const SurfaceSpec& spec,
                                             const Mesh& mesh,
                                             const Progress& progress = Progress());

/// Where a point lies to a surface.
struct PointDistance {
    double distance = 0.0;       ///< from the surface, negative inside [Å]
    openvdb::Vec3d closest{0.0}; ///< the point of the surface that is nearest [Å]
    openvdb::Vec3d normal{0.0};  ///< of the surface there, unit, outward
    std::int32_t ball = -1;      ///< the ball whose own surface |x - x_i| = r_i is nearest to the
                                 ///< point; of equals the first
};

/// Finds where points lie to a surface, near or far.
///
/// Solvent-accessible and van der Waals surfaces are those of the balls themselves, exact to 1e-5
/// Å. Of other surfaces, and of those that parts, filled cavities or thickened walls changed, it is
/// the zero set of the spline where that reaches, and the mesh elsewhere; an open mesh has no
/// inside. The spline is that of the mesh if the fields have it, and else one through the level
/// set, some thousandths of an Å from it.
///
/// Immutable once made; safe to use from all threads.
class SurfaceDistance
{
public:
    /// @param[in] atoms    that the surface was made of
    /// @param[in] options  that it was made with
    /// @param[in] surface  what makeSurface() gave; it may be changed or go afterwards
    /// @throws Error(ErrorKind::Input) if there are no balls, or neither mesh nor closed form
    /// @throws Cancelled if the progress object says so
    SurfaceDistance(const BallSet& atoms, const SurfaceOptions& options,
                    const MolecularSurface& surface, const Progress& progress = Progress());
    ~SurfaceDistance();
    SurfaceDistance(SurfaceDistance&& other) noexcept;
    SurfaceDistance& operator=(SurfaceDistance&& other) noexcept;

    /// @param[in] points  within 1e6 Å of the origin
    /// @return one a point
    /// @throws Error(ErrorKind::Input) that names the first point at fault, by its index
    /// @throws Cancelled if the progress object says so
    std::vector<PointDistance> at(const std::vector<openvdb::Vec3d>& points,
                                  const Progress& progress = Progress()) const;

private:
    struct Parts;
    std::unique_ptr<const Parts> parts_;
};

/// A row for every ball: chain, residue, number, insertion_code, label_chain, atom, altloc,
/// element, atom_id (its place in the file, from 0), radius_A, area, polar_area and apolar_area
/// (one of them the area, the other 0; both 0 for a bead), and of a result with depths depth_A.
/// Apolar are C, P, S, Se and halogens, polar all others; a hydrogen is as the heavy atom beside
/// it.
/// @throws Error(ErrorKind::Usage) if the atoms have no names or the result has no areas of balls,
///         or of others; the message names the option that makes them
Table atomTable(const BallSet& atoms, const MolecularSurface& result);

/// A row for every residue: chain, residue, number, insertion_code, label_chain, atoms (how many
/// balls), area, polar_area and apolar_area, and for solvent-accessible surfaces
/// relative_accessibility, the area's share of the largest that such a residue has between two
/// glycines, not a number where that is not known. Of a result with depths depth_A is the mean of
/// its balls', and ca_depth_A that of its CA. If the balls have values mean_NAME: the mean of the
/// value on the residue's part of the surface, and integral_NAME_A2: its integral there, in the
/// value's unit times Å^2.
/// @param[in] probe  radius that the surface is made with [Å]; accessibilities are relative at 1.4
///                   alone
/// @throws as atomTable()
Table residueTable(const BallSet& atoms, double probe, const MolecularSurface& result);

/// The area that relative_accessibility is a share of: the largest solvent-accessible area of a
/// residue of this name between two glycines, at a probe of 1.4 Å [Å^2]; none for what is no amino
/// acid.
std::optional<double> largestArea(const std::string& residue);

/// The partners in the rows of contactTable().
enum class ContactLevel { Atom, Residue, Chain };

/// Returns the word of the command line for a level: atom, residue, chain.
const char* nameOf(ContactLevel level);

/// A row for every two atoms, residues or chains that touch: the names of both, of atoms the
/// distance_A of their centres, and the area of the contact. Contacts within a residue or a chain
/// do not count for these.
/// @throws Error(ErrorKind::Usage) if the atoms have no names, or the result no contacts
Table contactTable(const BallSet& atoms, ContactLevel level, const MolecularSurface& result);

/// A row for every residue that an interface buries: group_1 and group_2, the group that it belongs
/// to, its name, area_alone and area_together on the surfaces of its group alone and of both,
/// buried_area, their difference, and area, half of that: its part of the interface. The areas
/// of an interface's rows add up to Report::Interface::area. buried_polar_area and
/// buried_apolar_area are the parts of buried_area by the class of atoms, as of atomTable(). Each
/// row has the fit of the pair, too: shape_complementarity, median_distance_A, gap_volume,
/// gap_index_A, contact_area_1 and contact_area_2.
/// @throws Error(ErrorKind::Usage) if the atoms have no names, or the report no interfaces with
///         the balls that they bury
Table interfaceTable(const BallSet& atoms, const Report& report);

} // namespace molsurf
