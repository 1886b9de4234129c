// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/ihm_spheres.h"

#include "molsurf/molecule/structure/atom_tree.h"
#include "molsurf/molecule/structure/name_table.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <gemmi/numb.hpp>

#include <algorithm>
#include <cstdint>
#include <iterator>
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

/// A sphere and the residues that it stands for.
struct Span {
    int model, begin, end;
    std::int32_t asym;
    std::size_t index; ///< in the rows
};

/// Numbers of residues, as ranges that do not touch each other.
class Ranges
{
public:
    void add(int begin, int end)
    {
        auto at = ends_.upper_bound(begin);
        if (at != ends_.begin() && std::prev(at)->second >= std::int64_t(begin) - 1) {
            --at;
            begin = at->first;
        }
        while (at != ends_.end() && std::int64_t(at->first) - 1 <= end) {
            end = std::max(end, at->second);
            at = ends_.erase(at);
        }
        ends_[begin] = end;
    }

    bool hasAll(int begin, int end) const
    {
        const auto at = ends_.upper_bound(begin);
        return at != ends_.begin() && std::prev(at)->second >= end;
    }

    bool hasSome(int begin, int end) const
    {
        const auto at = ends_.upper_bound(end);
        return at != ends_.begin() && std::prev(at)->second >= begin;
    }

private:
    std::map<int, int> ends_; ///< by their begins
};

using RangesByChain = std::map<std::pair<int, std::int32_t>, Ranges>; ///< by model and asym

struct ScaleCounts {
    std::size_t coarser = 0; ///< spheres that are marked
    std::size_t partly = 0;  ///< spheres of residues for some of which there are finer ones
};

/// Marks the spheres of residues for all of which the model has finer ones, or atoms.
/// @param[in] covered  residues that atoms stand for
ScaleCounts markCoarser(std::vector<Span> spans, RangesByChain covered,
                        std::vector<AtomRole>& roles)
{
    const auto lengthOf = [](const Span& span) { return std::int64_t(span.end) - span.begin; };
    std::stable_sort(spans.begin(), spans.end(),
                     [&](const Span& a, const Span& b) { return lengthOf(a) < lengthOf(b); });
    ScaleCounts counts;
    for (std::size_t i = 0; i < spans.size();) {
        std::size_t next = i; // spheres of one scale do not hide each other
        for (; next < spans.size() && lengthOf(spans[next]) == lengthOf(spans[i]); ++next) {
            const Span& span = spans[next];
            const Ranges& known = covered[{span.model, span.asym}];
            const bool all = known.hasAll(span.begin, span.end);
            if (all) roles[span.index] = AtomRole::CoarserScale;
            counts.coarser += all;
            counts.partly += !all && known.hasSome(span.begin, span.end);
        }
        for (; i < next; ++i)
            covered[{spans[i].model, spans[i].asym}].add(spans[i].begin, spans[i].end);
    }
    return counts;
}

/// The residues that the atoms of a structure stand for.
RangesByChain residuesOfAtoms(const Structure& structure)
{
    RangesByChain out;
    for (const Model& model : structure.models)
        for (std::size_t i = model.begin; i < model.end; ++i) {
            const Residue& residue = residueOf(structure, structure.atoms[i]);
            out[{model.number, residue.asym}].add(residue.number, residue.number);
        }
    return out;
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
    for (const std::string& name : structure.asyms) asyms.index(name, structure.asyms);
    std::vector<Atom> atoms;
    std::vector<Span> spans;
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
        residue.kind = ResidueKind::Bead;
        residue.chain = chains.index(text(Asym), structure.chains);
        residue.asym = asyms.index(text(Asym), structure.asyms);
        const auto known = sequences.find({text(Entity), first});
        if (first == last && known != sequences.end()) residue.name = known->second;
        const openvdb::Vec3d at(gemmi::cif::as_number(row[X]), gemmi::cif::as_number(row[Y]),
                                gemmi::cif::as_number(row[Z]));
        int end = residue.number;
        parseInteger(last, end);
        spans.push_back(
            {model, residue.number, std::max(end, residue.number), residue.asym, rows - 1});
        atoms.push_back({at, first == last ? first : first + "-" + last,
                         std::int32_t(structure.residues.size()), 0, '\0', AtomRole::Atom, 1.0f,
                         0.0f, radius});
        structure.residues.push_back(std::move(residue));
    }
    std::vector<AtomRole> roles(rows, AtomRole::Atom);
    const ScaleCounts scales = markCoarser(spans, residuesOfAtoms(structure), roles);
    if (scales.coarser > 0)
        structure.warnings.push_back(
            "the model is there at more than one scale: " + std::to_string(scales.coarser) +
            " spheres are of residues that finer ones stand for, and are "
            "left out");
    if (scales.partly > 0)
        structure.warnings.push_back("the model overlaps itself: " + std::to_string(scales.partly) +
                                     " spheres are of residues for some of which there are finer "
                                     "ones");
    structure.hasRadii = structure.atoms.empty();
    structure.serials.clear();
    std::map<int, std::vector<std::size_t>> byModel;
    for (std::size_t i = 0; i < rows; ++i) byModel[spans[i].model].push_back(i);
    for (const auto& [model, indices] : byModel) {
        structure.models.push_back({model, structure.atoms.size(), 0});
        for (const std::size_t i : indices) {
            atoms[i].role = roles[i];
            structure.atoms.push_back(std::move(atoms[i]));
        }
        structure.models.back().end = structure.atoms.size();
    }
    joinModels(structure);
}

} // namespace molsurf
