// SPDX-License-Identifier: MPL-2.0
#include "picture_atoms.h"

#include "molsurf/color/palette.h"
#include "molsurf/core/words.h"
#include "molsurf/error.h"
#include "molsurf/picture/view_file.h"
#include "molsurf/surface/check_balls.h"

#include <algorithm>
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

/// Colours of chains by their names: those of the surface, and others for others.
class ChainColors
{
public:
    ChainColors(const BallSet& surface, const Progress& progress)
        : free_(distinctColors(std::vector<std::vector<std::int32_t>>(mostDistinct)))
    {
        if (!surface.labels) return;
        const std::vector<Color> own = chainColors(surface, progress);
        for (std::size_t i = 0; i < own.size(); ++i) take(surface.labels->chains[i], own[i]);
    }

    Color of(const std::string& chain)
    {
        const auto known = colors_.find(chain);
        if (known != colors_.end()) return known->second;
        return take(chain, free_.empty() ? neutralColor : free_.front());
    }

private:
    Color take(const std::string& chain, const Color& color)
    {
        free_.erase(std::remove(free_.begin(), free_.end(), color), free_.end());
        return colors_[chain] = color;
    }

    std::vector<Color> free_;
    std::map<std::string, Color> colors_;
};

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

void showAtoms(const Call& call, std::vector<BallSet> atoms, const BallSet& surface,
               const Progress& progress, DrawOptions& picture)
{
    if (atoms.empty()) return;
    ChainColors colors(surface, progress);
    std::vector<ShownAtoms> shown;
    for (std::size_t k = 0; k < atoms.size(); ++k) {
        BallLabels& labels = *atoms[k].labels;
        for (const std::string& chain : labels.chains)
            labels.chainColors.push_back(colors.of(chain));
        shown.push_back({std::move(atoms[k]), call.shows[k]});
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
