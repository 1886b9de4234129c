// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Areas by atom and by residue, contacts and interfaces, as tables. Lengths are in Å,
/// areas in Å^2.

#include "molsurf/surface.h"

#include <optional>
#include <string>

namespace molsurf
{

/// A row for every ball: chain, residue, number, insertion_code, label_chain, atom, altloc,
/// element, atom_id (its place in the file, from 0), radius_A, area, and depth_A: how deep its
/// centre lies below the outer solvent-excluded surface.
/// @param[in] probe  radius that the surface is made with [Å]; 0: depth below the balls themselves
/// @throws Error(ErrorKind::Usage) if the atoms have no names or the result has no areas of balls,
///         or of others; the message names the option that makes them
Table atomTable(const BallSet& atoms, double probe, const MolecularSurface& result);

/// A row for every residue: chain, residue, number, insertion_code, label_chain, atoms (how many
/// balls), area, and for solvent-accessible surfaces relative_accessibility, the area's share of
/// the largest that such a residue has between two glycines, not a number where that is not known.
/// depth_A is the mean of its balls' depths, and ca_depth_A that of its CA.
/// If the balls have values mean_NAME: the mean of the value on the residue's part of the surface,
/// and integral_NAME_A2: its integral there, in the value's unit times Å^2.
/// @param[in] probe  as for atomTable(); accessibilities are relative at 1.4 alone
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
/// of an interface's rows add up to InterfaceReport::area. Each row has the fit of the pair, too:
/// shape_complementarity, median_distance_A, gap_volume and gap_index_A.
/// @throws Error(ErrorKind::Usage) if the atoms have no names, or the report no interfaces with
///         the balls that they bury
Table interfaceTable(const BallSet& atoms, const Report& report);

} // namespace molsurf
