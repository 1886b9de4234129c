// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_structure.h"

#include "molsurf/error.h"

#define GEMMI_WRITE_IMPLEMENTATION
#include <gemmi/to_cif.hpp>
#include <gemmi/to_mmcif.hpp>
#include <gemmi/to_pdb.hpp>

#include <algorithm>
#include <cmath>
#include <ios>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

namespace
{

/// The number of a gemmi::Model, which is text up to gemmi 0.6 and a number from 0.7 on.
struct ModelNumber {
    int value;
    operator int() const { return value; }
    operator std::string() const { return std::to_string(value); }
};

/// A coordinate with the three decimals that files have.
double decimal(double x)
{
    return std::round(1000.0 * x) / 1000.0;
}

gemmi::Structure structureOf(const BallSet& atoms, const std::vector<double>& values,
                             const openvdb::Vec3d& origin)
{
    gemmi::Structure out;
    gemmi::Model& model = out.models.emplace_back(ModelNumber{1});
    const BallNames& names = *atoms.names;
    std::map<std::string, std::size_t> chains;
    std::map<std::string, std::string> entities;
    std::vector<std::pair<gemmi::Chain*, std::size_t>> places(names.residues.size());
    std::set<std::string> all;
    for (const BallNames::Residue& name : names.residues) all.insert(name.chain);
    model.chains.reserve(all.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        auto& [chain, residue] = places[std::size_t(names.residueOf[i])];
        if (!chain) {
            const BallNames::Residue& name = names.residues[std::size_t(names.residueOf[i])];
            const auto [place, isNew] = chains.emplace(name.chain, model.chains.size());
            if (isNew) model.chains.emplace_back(name.chain);
            chain = &model.chains[place->second];
            residue = chain->residues.size();
            gemmi::Residue& added = chain->residues.emplace_back();
            added.name = name.name;
            added.seqid = gemmi::SeqId(name.number, name.insertionCode);
            added.subchain = name.labelChain;
            added.het_flag = name.hetatm ? 'H' : 'A';
            added.entity_type =
                name.hetatm ? gemmi::EntityType::NonPolymer : gemmi::EntityType::Polymer;
        }
        const BallNames::Atom& name = names.atoms[i];
        gemmi::Atom& atom = chain->residues[residue].atoms.emplace_back();
        atom.name = name.name;
        atom.altloc = name.altloc;
        const bool deuterium = name.element == 1 && name.name.rfind('D', 0) == 0;
        atom.element = deuterium ? gemmi::Element(gemmi::El::D)
                                 : gemmi::Element(static_cast<gemmi::El>(name.element));
        const openvdb::Vec3d p = openvdb::Vec3d(atoms.balls[i].center) - origin;
        atom.pos = gemmi::Position(decimal(p.x()), decimal(p.y()), decimal(p.z()));
        atom.occ = name.occupancy;
        atom.b_iso = float(values[i]);
    }
    return out;
}

[[noreturn]] void noRoom(const OutputFile& file, const std::string& what)
{
    throw Error(ErrorKind::Output,
                file.path() + ": a .pdb has no room for " + what + " [hint: -o FILE.cif]");
}

/// Refuses what the columns of the format do not hold. (Chains of two letters and numbers in base
/// 36 are in use, but many programs read neither.)
void checkPdb(const BallSet& atoms, const std::vector<double>& values, const openvdb::Vec3d& origin,
              const OutputFile& file)
{
    constexpr std::size_t mostRecords = 99999;
    const BallNames& names = *atoms.names;
    std::set<std::string> chains;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const BallNames::Residue& residue = names.residues[std::size_t(names.residueOf[i])];
        chains.insert(residue.chain);
        if (residue.chain.size() > 1) noRoom(file, "the chain name " + residue.chain);
        if (residue.name.size() > 3) noRoom(file, "the residue name " + residue.name);
        if (residue.number > 9999 || residue.number < -999)
            noRoom(file, "the residue number " + std::to_string(residue.number));
        if (names.atoms[i].name.size() > 4) noRoom(file, "the atom name " + names.atoms[i].name);
        for (int axis = 0; axis < 3; ++axis) {
            const double x = double(atoms.balls[i].center[axis]) - origin[axis];
            if (x <= -999.9995 || x >= 9999.9995)
                noRoom(file, "the coordinate " + std::to_string(x) + " Å");
        }
        if (values[i] >= 999.995)
            noRoom(file, "the area " + std::to_string(values[i]) + " Å^2 as a B factor");
    }
    if (values.size() + chains.size() > mostRecords)
        noRoom(file, std::to_string(values.size()) + " atoms");
}

/// Refuses atoms that have no names, as those of .xyzr.
void checkNames(const BallSet& atoms, const OutputFile& file)
{
    const bool named = std::any_of(atoms.names->atoms.begin(), atoms.names->atoms.end(),
                                   [](const BallNames::Atom& atom) { return !atom.name.empty(); });
    for (const BallNames::Residue& residue : atoms.names->residues)
        if (residue.name.empty())
            throw Error(ErrorKind::Output,
                        file.path() + ": the " + (named ? "residues" : "atoms") +
                            " of the input have no names [hint: -o FILE.atoms.csv]");
}

/// @param[in] write  writes to a stream
template<typename Write>
void writeTo(OutputFile& file, const Write& write)
{
    errno = 0;
    try {
        write(file.stream());
    } catch (const std::ios_base::failure&) {
        file.fail("cannot write");
    }
}

} // namespace

void writePdb(const BallSet& atoms, const std::vector<double>& values, const openvdb::Vec3d& origin,
              OutputFile& file)
{
    checkNames(atoms, file);
    checkPdb(atoms, values, origin, file);
    gemmi::PdbWriteOptions options;
    options.cryst1_record = false;
    const gemmi::Structure structure = structureOf(atoms, values, origin);
    writeTo(file, [&](std::ostream& out) { gemmi::write_pdb(structure, out, options); });
}

void writeMmcif(const BallSet& atoms, const std::vector<double>& values,
                const openvdb::Vec3d& origin, OutputFile& file)
{
    checkNames(atoms, file);
    gemmi::MmcifOutputGroups groups(false);
    groups.atoms = groups.group_pdb = true;
    gemmi::cif::Block block("surface");
    gemmi::update_mmcif_block(structureOf(atoms, values, origin), block, groups);
    writeTo(file, [&](std::ostream& out) {
        gemmi::cif::write_cif_block_to_stream(out, block, gemmi::cif::Style::Pdbx);
    });
}

} // namespace molsurf
