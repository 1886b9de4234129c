// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/point_charges.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>

namespace molsurf
{

openvdb::BBoxd PointCharges::box(bool withRadii) const
{
    openvdb::BBoxd out;
    for (const PointCharge& atom : atoms) {
        const openvdb::Vec3d reach(withRadii ? atom.radius : 0.0);
        out.expand(atom.position - reach);
        out.expand(atom.position + reach);
    }
    return out;
}

PointCharges pointCharges(const Structure& structure, const std::vector<std::int32_t>& atoms)
{
    if (structure.charges.empty() || !structure.hasRadii)
        throw Error(ErrorKind::Input, displayName(structure.source) + " (" + structure.format +
                                          "): it has no charges and radii, expected those of a "
                                          ".pqr file [hint: the program pdb2pqr makes one]");
    PointCharges out;
    for (const std::int32_t i : atoms) {
        const Atom& atom = structure.atoms[std::size_t(i)];
        const Residue& residue = residueOf(structure, atom);
        out.atoms.push_back({atom.position, double(structure.charges[std::size_t(i)]),
                             std::max(0.0, atom.radius), atom.name, residue.name,
                             structure.chains[std::size_t(residue.chain)], residue.number});
    }
    return out;
}

} // namespace molsurf
