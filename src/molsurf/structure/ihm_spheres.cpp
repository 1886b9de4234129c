// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/ihm_spheres.h"

#include "molsurf/structure/name_table.h"
#include "molsurf/structure/text_fields.h"

#include <gemmi/numb.hpp>

#include <map>
#include <utility>
#include <vector>

namespace molsurf
{
namespace
{

const std::string spheres = "_ihm_sphere_obj_site.";

/// The names of residues by entity and number.
using Sequences = std::map<std::pair<std::string, std::string>, std::string>;

Sequences sequencesIn(gemmi::cif::Block& block)
{
    Sequences out;
    for (auto row : block.find("_entity_poly_seq.", {"entity_id", "num", "mon_id"}))
        out[{row.str(0), row.str(1)}] = row.str(2);
    return out;
}

/// Puts further atoms behind those of their models.
void mergeByModel(std::map<int, std::vector<Atom>> further, Structure& structure)
{
    std::map<int, std::vector<Atom>> atomsOf;
    std::vector<int> order;
    for (const Model& model : structure.models) {
        const auto begin = structure.atoms.begin() + std::ptrdiff_t(model.begin);
        const auto end = structure.atoms.begin() + std::ptrdiff_t(model.end);
        if (atomsOf.emplace(model.number, std::vector<Atom>(begin, end)).second)
            order.push_back(model.number);
    }
    for (auto& [number, atoms] : further) {
        std::vector<Atom>& to = atomsOf[number];
        if (to.empty()) order.push_back(number);
        to.insert(to.end(), std::make_move_iterator(atoms.begin()),
                  std::make_move_iterator(atoms.end()));
    }
    structure.atoms.clear();
    structure.models.clear();
    for (const int number : order) {
        const std::size_t begin = structure.atoms.size();
        for (Atom& atom : atomsOf[number]) structure.atoms.push_back(std::move(atom));
        structure.models.push_back({number, begin, structure.atoms.size()});
    }
}

} // namespace

bool hasSpheres(const gemmi::cif::Block& block)
{
    return block.has_tag(spheres + "Cartn_x");
}

void addSpheres(gemmi::cif::Block& block, const std::string& path, Structure& structure)
{
    enum Column { X, Y, Z, Radius, Asym, Entity, Begin, End, ModelId };
    const std::vector<std::string> columns{"Cartn_x",       "Cartn_y",     "Cartn_z",
                                           "object_radius", "asym_id",     "?entity_id",
                                           "?seq_id_begin", "?seq_id_end", "?model_id"};
    for (const std::string& column : columns)
        if (column[0] != '?' && !block.has_tag(spheres + column))
            failAt(path, "_ihm_sphere_obj_site has no column " + column);
    const Sequences sequences = sequencesIn(block);
    NameTable chains, asyms;
    for (const std::string& name : structure.chains) chains.index(name, structure.chains);
    std::map<int, std::vector<Atom>> further;
    std::size_t rows = 0;
    for (auto row : block.find(spheres, columns)) {
        ++rows;
        const auto text = [&](Column c) { return row.has(c) ? row.str(c) : std::string(); };
        const double radius = gemmi::cif::as_number(row[Radius]);
        if (!(radius >= 0.0 && radius <= 1e6))
            failAt(path, "_ihm_sphere_obj_site, row " + std::to_string(rows) +
                             ": object_radius: expected 0 to 1e6 Å, got " + inQuotes(row[Radius]));
        int model = 1;
        parseInteger(text(ModelId), model);
        const std::string first = text(Begin), last = text(End);
        Residue residue{};
        parseInteger(first, residue.number);
        residue.insertionCode = ' ';
        residue.chain = chains.index(text(Asym), structure.chains);
        residue.asym = asyms.index(text(Asym), structure.asyms);
        const auto known = sequences.find({text(Entity), first});
        if (first == last && known != sequences.end()) residue.name = known->second;
        const openvdb::Vec3d at(gemmi::cif::as_number(row[X]), gemmi::cif::as_number(row[Y]),
                                gemmi::cif::as_number(row[Z]));
        further[model].push_back({at, first == last ? first : first + "-" + last,
                                  std::int32_t(structure.residues.size()), 0, '\0', 1.0f, 0.0f,
                                  radius});
        structure.residues.push_back(std::move(residue));
    }
    structure.hasRadii = structure.atoms.empty();
    mergeByModel(std::move(further), structure);
}

} // namespace molsurf
