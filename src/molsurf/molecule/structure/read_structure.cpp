// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/read_structure.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/cancel.h"
#include "molsurf/kernel/core/memory.h"
#include "molsurf/molecule/structure/beads.h"
#include "molsurf/molecule/structure/detect_format.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/residue_kind.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <cmath>
#include <filesystem>
#include <set>

namespace molsurf
{
namespace
{

constexpr double largestCoordinate = 1e6; // [Å]

void checkCoordinates(const Structure& structure, const std::string& path)
{
    for (std::size_t i = 0; i < structure.atoms.size(); ++i) {
        const openvdb::Vec3d& x = structure.atoms[i].position;
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(x[axis]) <= largestCoordinate) continue; // false for NaN
            throw Error(ErrorKind::Input,
                        displayName(path) + ": " + describeAtom(structure, i) + ": " + "xyz"[axis] +
                            ": expected -1e6 to 1e6 Å, got " + std::to_string(x[axis]));
        }
    }
}

/// Models are asked for by number. Where a number is below 1 or stands twice, they are counted.
void numberModels(Structure& structure)
{
    std::set<int> numbers;
    for (const Model& model : structure.models)
        if (model.number > 0) numbers.insert(model.number);
    if (numbers.size() == structure.models.size()) return;
    int count = 0;
    for (Model& model : structure.models) model.number = ++count;
    if (count > 1)
        structure.warnings.push_back("a number of a model is below 1 or stands twice: the models "
                                     "are counted from 1 to " +
                                     std::to_string(count));
}

/// Reads a text of a known format, unless it would take more than the memory there is.
Structure parseAndCheck(StructureFormat format, std::string text, const std::string& path,
                        std::size_t memory, const Progress& progress)
{
    stopIfCancelled(progress);
    const StructureFormatRow& row = rowOf(format);
    constexpr std::size_t small = 100000; // bytes of a text that needs no estimate
    const double bytes = row.bytesPerByte * double(text.size());
    if (text.size() > small && !hasMemory(bytes, memory))
        needMemory(displayName(path) + ": reading it takes",
                   row.bytesFor ? row.bytesFor(text) : bytes, memory);
    Structure structure = row.read(std::move(text), path, progress);
    stopIfCancelled(progress);
    structure.source = path == "-" ? path : std::filesystem::path(path).filename().string();
    structure.format = row.name;
    if (structure.atoms.empty()) {
        const bool records = format == StructureFormat::Pdb || format == StructureFormat::Pdbqt ||
                             format == StructureFormat::Pqr;
        throw Error(ErrorKind::Input,
                    displayName(path) + ": no atoms: read as " + structure.format + ", expected " +
                        (records ? "ATOM or HETATM records" : "coordinates") + ", got none");
    }
    checkCoordinates(structure, path);
    numberModels(structure);
    classifyResidues(structure);
    if (!structure.hasRadii) markBeads(structure);
    return structure;
}

} // namespace

std::string describeAtom(const Structure& structure, std::size_t index)
{
    const Atom& atom = structure.atoms[index];
    const Residue& residue = structure.residues[std::size_t(atom.residue)];
    std::string text = "atom " + std::to_string(index + 1);
    if (!atom.name.empty()) text += " (" + atom.name;
    if (!atom.name.empty() && !residue.name.empty()) {
        text += " of " + residue.name + " " + std::to_string(residue.number);
    }
    return atom.name.empty() ? text : text + ")";
}

Structure readStructure(const std::string& path, std::size_t maxBytes, const Progress& progress,
                        std::size_t memory)
{
    std::string text = loadText(path, maxBytes);
    const StructureFormat format = detectFormat(path, text);
    return parseAndCheck(format, std::move(text), path, memory, progress);
}

Structure parseStructure(std::string bytes, const std::string& path, std::size_t maxBytes,
                         const Progress& progress, std::size_t memory)
{
    std::string text = unpackedText(std::move(bytes), path, maxBytes);
    const StructureFormat format = detectFormat(path, text);
    return parseAndCheck(format, std::move(text), path, memory, progress);
}

Structure readStructureAs(StructureFormat format, const std::string& path, std::size_t maxBytes)
{
    return parseAndCheck(format, loadText(path, maxBytes), path, 0, Progress());
}

} // namespace molsurf
