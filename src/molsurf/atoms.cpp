// SPDX-License-Identifier: MPL-2.0
#include "molsurf/atoms.h"

#include "molsurf/molecule/selection/match_atoms.h"
#include "molsurf/molecule/selection/search_places.h"
#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/read_structure.h"

#include <numeric>
#include <utility>

namespace molsurf
{

Molecule::Molecule(std::shared_ptr<const Structure> structure, std::string input)
    : structure_(std::move(structure)), input_(std::move(input))
{
}

Molecule::Molecule(const std::string& path, const Progress& progress, const ReadLimits& limits)
    : structure_(std::make_shared<const Structure>(
          readStructure(path, limits.maxInput, progress, limits.memory))),
      input_(path), isFile_(!readsOnce(path))
{
}

Molecule::Molecule(FileContent file, const Progress& progress, const ReadLimits& limits)
    : structure_(std::make_shared<const Structure>(parseStructure(
          std::move(file.bytes), file.name, limits.maxInput, progress, limits.memory))),
      input_(file.name)
{
}

BallSet Molecule::balls(const SelectOptions& options, const LabelOptions& labels, double probe,
                        const Progress& progress) const
{
    checkOptions(options);
    checkOptions(labels);
    BallSet balls = selectBalls(*structure_, options, labels, probe, progress);
    balls.record.input = input_;
    balls.record.isFile = isFile_;
    balls.record.asked = {options, labels, {}};
    return balls;
}

SearchPlaces Molecule::places(const PlaceOptions& options, BallSet& atoms) const
{
    checkOptions(options);
    if (atoms.record.asked) atoms.record.asked->places = options;
    return findPlaces(*structure_, options, atoms);
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
    return {std::shared_ptr<const Structure>(std::move(structure)), input_};
}

BallSet readAtoms(const std::string& path, const SelectOptions& options, double probe,
                  const Progress& progress)
{
    checkOptions(options);
    return Molecule(path, progress, options.limits).balls(options, {}, probe, progress);
}

BallSet readAtoms(FileContent file, const SelectOptions& options, double probe,
                  const Progress& progress)
{
    checkOptions(options);
    return Molecule(std::move(file), progress, options.limits).balls(options, {}, probe, progress);
}

} // namespace molsurf
