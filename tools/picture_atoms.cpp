// SPDX-License-Identifier: MPL-2.0
#include "picture_atoms.h"

#include "molsurf/color/palette.h"
#include "molsurf/core/words.h"
#include "molsurf/error.h"
#include "molsurf/picture/view_file.h"
#include "molsurf/selection/ball_names.h"
#include "molsurf/surface/check_balls.h"

#include <cstdint>
#include <map>
#include <memory>
#include <utility>

namespace molsurf::tool
{

namespace
{

openvdb::Vec3d middleOf(const BallSet& atoms)
{
    openvdb::Vec3d sum(0.0);
    for (const Ball& ball : atoms.balls) sum += ball.center;
    return sum / double(atoms.balls.size());
}

/// The colours of chains by their names: those of the surface, and for others their own.
std::vector<Color> colorsOfChains(const BallSet& atoms,
                                  const std::map<std::string, Color>& ofSurface,
                                  const Progress& progress)
{
    std::vector<Color> colors = chainColors(atoms, progress);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const auto known = ofSurface.find(atoms.labels->chains[i]);
        if (known != ofSurface.end()) colors[i] = known->second;
    }
    return colors;
}

} // namespace

SelectOptions picturedAtoms(const Call& call, const std::string& select)
{
    SelectOptions options;
    options.select = select;
    options.model = call.atoms.model;
    options.assembly = call.atoms.assembly;
    options.copies = call.atoms.copies;
    options.altloc = call.atoms.altloc;
    options.hydrogens = call.atoms.hydrogens;
    options.waters = call.atoms.waters;
    options.radii = call.atoms.radii;
    options.maxInput = call.atoms.maxInput;
    options.hetero = Hetero::All;
    options.ions = true;
    return options;
}

void showAtoms(const std::vector<ShowRule>& rules, std::vector<BallSet> atoms,
               const std::shared_ptr<const FileBonds>& bonds, const BallSet& surface,
               const Progress& progress, DrawOptions& picture)
{
    if (atoms.empty()) return;
    std::map<std::string, Color> ofSurface;
    const std::vector<Color> own = chainColors(surface, progress);
    for (std::size_t i = 0; i < own.size(); ++i) ofSurface[surface.labels->chains[i]] = own[i];
    std::vector<ShownAtoms> shown;
    for (std::size_t k = 0; k < atoms.size(); ++k) {
        atoms[k].labels->chainColors = colorsOfChains(atoms[k], ofSurface, progress);
        shown.push_back({std::move(atoms[k]), rules[k], bonds});
    }
    const double bytes = bytesOfModel(shown), available = double(availableMemory());
    if (bytes > available)
        throw Error(ErrorKind::Input,
                    "--show: these atoms take about " + sizeText(bytes) +
                        " of memory, and there are " + sizeText(available) +
                        ", expected fewer atoms",
                    true);
    picture.model = std::make_shared<AtomModel>(atomModel(shown, progress));
}

void addNotes(const std::vector<NoteRule>& rules,
              const std::function<BallSet(const std::string& select)>& atomsOf,
              DrawOptions& picture)
{
    for (const NoteRule& rule : rules) {
        const BallSet atoms = atomsOf(rule.selects[0]);
        PictureNote note{middleOf(atoms), {}, rule.text};
        if (rule.selects.size() > 1) {
            note.to = middleOf(atomsOf(rule.selects[1]));
            if (*note.to == note.from)
                throw Error(ErrorKind::Input, "--ruler " + rule.selects[0] + ".." +
                                                  rule.selects[1] +
                                                  ": expected two places, got one");
        } else if (note.text.empty()) {
            const BallNames::Residue& residue = atoms.names->residues[0];
            note.text = residue.chain + " " + residue.name + " " + numberText(residue);
        }
        picture.notes.push_back(std::move(note));
    }
}

void lookAt(const Call& call, const BallSet& atoms, const BallSet& surface, DrawOptions& picture)
{
    constexpr double least = 0.1; // [Å]
    const openvdb::Vec3d way = middleOf(atoms) - middleOf(surface);
    if (way.length() < least)
        throw Error(ErrorKind::Input,
                    "--view " + call.viewed +
                        ": these atoms lie about the middle, expected some on one side [hint: "
                        "--view X,Y,Z is a direction]");
    lookFrom(way, picture);
}

} // namespace molsurf::tool
