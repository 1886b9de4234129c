// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Areas by atom and by residue, contacts and interfaces, as tables. Lengths are in Å, areas in
/// Å^2.

#include "molsurf/surface.h"

namespace molsurf
{

/// A row for every ball: chain, residue, number, insertion_code, label_chain, atom, altloc,
/// element, atom_id (its place in the file, from 0), radius_A, area.
/// @param[in] atoms   with names
/// @param[in] result  with ballAreas
Table atomTable(const BallSet& atoms, const MolecularSurface& result);

/// A row for every residue: chain, residue, number, insertion_code, label_chain, atoms (how many
/// balls), area, and for solvent-accessible surfaces relative_accessibility, the area's share of
/// largestAccessibleArea(), not a number where there is none. With ballValues mean_NAME: the mean
/// of the value on the residue's part of the surface.
/// @param[in] probe  radius [Å]; accessibilities are relative at 1.4 alone
Table residueTable(const BallSet& atoms, double probe, const MolecularSurface& result);

/// What the rows of contactTable() are between.
enum class ContactLevel { Atom, Residue, Chain };

/// Returns the word of the command line for a level: atom, residue, chain.
const char* nameOf(ContactLevel level);

/// A row for every two atoms, residues or chains that touch: the names of both, of atoms the
/// distance_A of their centres, and the area of the contact. Contacts within a residue or a chain
/// do not count for these.
/// @param[in] result  with contacts
Table contactTable(const BallSet& atoms, ContactLevel level, const MolecularSurface& result);

/// A row for every residue that an interface buries: group_1 and group_2, the group that it belongs
/// to, its name, area_alone and area_together on the surfaces of its group alone and of both,
/// buried_area, their difference, and area, half of that: its part of the interface. The areas
/// of an interface's rows add up to InterfaceReport::area.
/// @param[in] report  with InterfaceReport::buried
Table interfaceTable(const BallSet& atoms, const Report& report);

/// Adds columns that say what the areas of a table are of: surface, its kind; probe_A; radii, the
/// name of their set or file, or "input".
/// @param[in] probe  radius [Å]
void addOrigin(const BallSet& atoms, const std::string& kind, double probe, Table& table);

/// The area of each ball's residue [Å^2].
std::vector<double> residueAreasOfBalls(const BallSet& atoms, const std::vector<double>& ballAreas);

} // namespace molsurf
