// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Files for a calculation of APBS with a given surface: maps of the dielectric, a map of where
/// ions may be, charges, and its input file. docs/electrostatics.md.

#include "molsurf/ball.h"
#include "molsurf/kernel/spline/spline.h"
#include "molsurf/molecule/selection/point_charges.h"
#include "molsurf/show/io/output_file.h"

#include <openvdb/openvdb.h>

#include <array>
#include <string>
#include <vector>

namespace molsurf
{

/// The lattice on which APBS solves: words dime, glen and gcent of its input.
struct ApbsGrid {
    std::array<int, 3> points{}; ///< along each axis, c 2^(l + 1) + 1 of them
    openvdb::Vec3d lengths{0.0}; ///< [Å]
    openvdb::Vec3d center{0.0};  ///< [Å]

    openvdb::Vec3d spacing() const
    {
        return lengths / openvdb::Vec3d(points[0] - 1, points[1] - 1, points[2] - 1);
    }
    openvdb::Vec3d node(int i, int j, int k) const
    {
        return center - 0.5 * lengths + spacing() * openvdb::Vec3d(i, j, k);
    }
};

/// Gives the fine lattice of the rule psize of pdb2pqr: 10 Å beyond the atoms, but at most 1.7
/// times their box, points 0.5 Å apart or a little less or more, 32 c + 1 of them, and fewer where
/// they would take APBS more than 400 MB, of the finest axis first.
ApbsGrid gridAround(const PointCharges& charges);

/// Reads dime, glen (or fglen) and gcent (or fgcent) of the first calculation in an input file of
/// APBS; the last one of each counts, as APBS takes it.
/// @throws Error(ErrorKind::Input) with the line, if one is missing or wrong, or if the file has
///         more than 1 MiB
ApbsGrid readApbsGrid(const std::string& path, const PointCharges& charges);

/// Checks that a lattice covers the balls.
/// @throws Error(ErrorKind::Input) if it does not; names the lengths that would
void checkCovers(const ApbsGrid& grid, const std::vector<Ball>& balls);

/// Constants of the two sides of the surface, and the ions outside.
struct Dielectric {
    double inside = 2.0;    ///< relative permittivity of the molecule, > 0
    double outside = 78.54; ///< of the solvent, > 0
    double salt = 0.0;      ///< concentration of a 1:1 salt [mol/L], >= 0
    double ionRadius = 2.0; ///< [Å]
};

/// A surface as maps need it: its level set, and the spline through it [Å].
struct MapSurface {
    const openvdb::FloatGrid& levelSet;
    const Spline& spline;
};

/// Writes the map of the dielectric on the edges of a lattice along an axis, at their middles, as
/// OpenDX. An edge that the surface cuts has 1/(f/inside + (1 - f)/outside), f being the share of
/// its length that lies inside.
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeDielectricMap(const MapSurface& surface, const ApbsGrid& grid, int axis,
                        const Dielectric& constants, OutputFile& file);

/// Writes the map of where ions may be: 0 at nodes within the radius of an ion of a ball, else 1.
void writeIonMap(const std::vector<Ball>& balls, const ApbsGrid& grid, double ionRadius,
                 OutputFile& file);

/// Writes charged atoms as a PQR file, in the order in which they are given.
void writePqr(const PointCharges& charges, OutputFile& file);

/// Names of the files that an input of APBS reads.
struct ApbsFiles {
    std::string charges, kappa;
    std::array<std::string, 3> dielectric;
};

/// Writes an input file of APBS: the energy of the molecule in the solvent less that of the same
/// charges on the same lattice with the permittivity of the molecule everywhere.
/// @param[in] title  a line of comment
void writeApbsInput(const std::string& title, const ApbsFiles& files, const ApbsGrid& grid,
                    const Dielectric& constants, OutputFile& file);

} // namespace molsurf
