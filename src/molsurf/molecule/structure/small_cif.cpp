// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/small_cif.h"

#include "molsurf/molecule/structure/atom_tree.h"
#include "molsurf/molecule/structure/element.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <gemmi/smcif.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace molsurf
{
namespace
{

const std::string componentAtom = "_chem_comp_atom.", label = "_atom_site_label",
                  fraction = "_atom_site_fract_x";

/// The columns of the coordinates, the best ones first: ideal, of a model, of a library.
constexpr std::array<std::array<const char*, 3>, 3> coordinates{
    {{"pdbx_model_Cartn_x_ideal", "pdbx_model_Cartn_y_ideal", "pdbx_model_Cartn_z_ideal"},
     {"model_Cartn_x", "model_Cartn_y", "model_Cartn_z"},
     {"x", "y", "z"}}};

Structure readComponent(gemmi::cif::Block& block, const std::string& path)
{
    for (const auto& [x, y, z] : coordinates) {
        auto rows = block.find(componentAtom, {"atom_id", "type_symbol", x, y, z, "?comp_id"});
        AtomTree tree;
        std::size_t placed = 0;
        for (auto row : rows) {
            const std::string name = row.str(0), symbol = row.str(1);
            const std::string residue = row.has2(5) ? row.str(5) : block.name;
            AtomLine atom =
                unknownLigandAtom({gemmi::cif::as_number(row[2]), gemmi::cif::as_number(row[3]),
                                   gemmi::cif::as_number(row[4])});
            atom.name = name;
            atom.residue = residue;
            atom.element = elementNumber(symbol);
            placed += std::isfinite(atom.position.lengthSqr());
            tree.add(atom);
        }
        if (placed > 0 && placed == rows.length()) return tree.finish();
    }
    failAt(path, "the component has no coordinates of all atoms, expected ideal ones or those of a "
                 "model");
}

/// Whether a bond leads from the asymmetric unit to a copy by symmetry: two atoms are at most 0.45
/// Å farther apart than their covalent radii.
bool goesOn(const gemmi::SmallStructure& crystal)
{
    constexpr double tolerance = 0.45; // [Å]
    constexpr std::size_t most = 1000; // atoms: a larger one takes too long
    const auto& sites = crystal.sites;
    for (std::size_t i = 0; i < sites.size() && sites.size() <= most; ++i)
        for (std::size_t k = i; k < sites.size(); ++k) {
            const double longest = covalentRadius(std::uint8_t(sites[i].element.atomic_number())) +
                                   covalentRadius(std::uint8_t(sites[k].element.atomic_number())) +
                                   tolerance;
            constexpr double itself = 0.5; // [Å], of an atom on an element of symmetry
            const double distance =
                crystal.cell
                    .find_nearest_image(sites[i].orth(crystal.cell), sites[k].orth(crystal.cell),
                                        gemmi::Asu::Different)
                    .dist();
            if (distance > itself && distance < longest) return true;
        }
    return false;
}

Structure readCrystal(gemmi::cif::Block& block, const std::string& path)
{
    const gemmi::SmallStructure crystal = gemmi::make_small_structure_from_block(block);
    if (!crystal.cell.is_crystal()) failAt(path, "expected the unit cell of the crystal, got none");
    AtomTree tree;
    for (const gemmi::SmallStructure::Site& site : crystal.sites) {
        const gemmi::Position at = site.orth(crystal.cell);
        if (!std::isfinite(at.length_sq())) continue; // hydrogens that are only counted
        AtomLine atom = unknownLigandAtom({at.x, at.y, at.z});
        atom.name = site.label;
        atom.element = site.element.atomic_number();
        atom.occupancy = float(site.occ);
        atom.bFactor = float(site.u_iso * 8.0 * M_PI * M_PI);
        const int group = std::abs(site.disorder_group);
        if (group > 0 && group <= 26) atom.altloc = char('A' + group - 1);
        tree.add(atom);
    }
    Structure out = tree.finish();
    if (goesOn(crystal))
        out.warnings.push_back(
            "the molecule goes on in copies by the crystal's symmetry, which are "
            "not made: the asymmetric unit is read alone");
    return out;
}

} // namespace

bool hasSmallMolecule(const gemmi::cif::Block& block)
{
    const auto has = [&](const char* x) { return block.has_tag(componentAtom + x); };
    return (block.has_tag(label) && block.has_tag(fraction)) ||
           std::any_of(coordinates.begin(), coordinates.end(),
                       [&](const auto& xyz) { return has(xyz[0]); });
}

Structure readSmallMolecule(gemmi::cif::Block& block, const std::string& path)
{
    return block.has_tag(fraction) ? readCrystal(block, path) : readComponent(block, path);
}

} // namespace molsurf
