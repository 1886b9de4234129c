// SPDX-License-Identifier: MPL-2.0
#include "molsurf/atoms.h"

#include "molsurf/molecule/selection/match_atoms.h"
#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/molecule/structure/read_structure.h"

#include <numeric>
#include <utility>

namespace molsurf
{

Molecule::Molecule(std::shared_ptr<const Structure> structure) : structure_(std::move(structure)) {}

Molecule::Molecule(const std::string& path, const Progress& progress, std::size_t maxInput,
                   std::size_t memory)
    : structure_(std::make_shared<const Structure>(readStructure(path, maxInput, progress, memory)))
{
}

Molecule::Molecule(FileContent file, const Progress& progress, std::size_t maxInput,
                   std::size_t memory)
    : structure_(std::make_shared<const Structure>(
          parseStructure(std::move(file.bytes), file.name, maxInput, progress, memory)))
{
}

BallSet Molecule::balls(const SelectOptions& options, double probe, const Progress& progress) const
{
    checkOptions(options);
    return selectBalls(*structure_, options, probe, progress);
}

std::vector<std::size_t> Molecule::select(const std::string& selection) const
{
    std::vector<std::size_t> out;
    if (selection.empty()) {
        out.resize(structure_->atoms.size());
        std::iota(out.begin(), out.end(), std::size_t(0));
        return out;
    }
    const AtomMatch match = matchAtoms(*structure_, selection);
    for (std::size_t i = 0; i < match.atoms.size(); ++i)
        if (match.atoms[i]) out.push_back(i);
    return out;
}

Molecule Molecule::moved(const std::vector<std::int32_t>& atoms,
                         const std::vector<openvdb::Vec3d>& places) const
{
    auto structure = std::make_shared<Structure>(*structure_);
    for (std::size_t i = 0; i < atoms.size(); ++i)
        structure->atoms[std::size_t(atoms[i])].position = places[i];
    return Molecule(std::shared_ptr<const Structure>(std::move(structure)));
}

BallSet readAtoms(const std::string& path, const SelectOptions& options, double probe,
                  const Progress& progress)
{
    checkOptions(options);
    return Molecule(path, progress, options.maxInput, options.memory)
        .balls(options, probe, progress);
}

BallSet readAtoms(FileContent file, const SelectOptions& options, double probe,
                  const Progress& progress)
{
    checkOptions(options);
    return Molecule(std::move(file), progress, options.maxInput, options.memory)
        .balls(options, probe, progress);
}

} // namespace molsurf
