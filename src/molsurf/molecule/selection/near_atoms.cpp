// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/near_atoms.h"

#include "molsurf/error.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/core/parallel.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace molsurf
{
namespace
{

constexpr double farthest = 1e6; // [Å], of BallIndex

/// The marked atoms of a model as balls without radius.
std::vector<Ball> centresOf(const Structure& structure, const Model& model,
                            const std::vector<char>& marked)
{
    std::vector<Ball> out;
    for (std::size_t i = model.begin; i < model.end; ++i) {
        const openvdb::Vec3d& at = structure.atoms[i].position;
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(at[axis]) <= farthest))
                throw Error(ErrorKind::Input,
                            displayName(structure.source) +
                                ": expected atoms within 1e6 Å of the origin for a selection by "
                                "distance, got one at " +
                                std::to_string(at[axis]) + " Å along " + "xyz"[axis]);
        if (marked[i]) out.push_back({at, 0.0, std::int32_t(i)});
    }
    return out;
}

} // namespace

std::vector<char> nearAtoms(const Structure& structure, const std::vector<char>& marked,
                            double distance)
{
    std::vector<char> near = marked;
    const double reach = std::min(distance, 4.0 * farthest);
    for (const Model& model : structure.models) {
        const std::vector<Ball> centres = centresOf(structure, model, marked);
        if (centres.empty()) continue;
        const BallIndex index(centres, {0.5, reach, 2.0});
        parallelFor(model.end - model.begin, Progress(), [&](std::size_t k) {
            const std::size_t i = model.begin + k;
            const openvdb::Vec3d& at = structure.atoms[i].position;
            near[i] = marked[i] || index.anyNear(at, at, reach, [&](const Ball& ball) {
                return (openvdb::Vec3d(ball.center) - at).lengthSqr() <= distance * distance;
            });
        });
    }
    return near;
}

std::vector<std::int32_t> heavyAtoms(const std::vector<AtomSite>& atoms, std::size_t residues)
{
    std::vector<std::int32_t> out(atoms.size());
    std::vector<std::vector<std::int32_t>> heavy(residues);
    for (std::size_t i = 0; i < atoms.size(); ++i)
        if (atoms[i].isHeavy) heavy[std::size_t(atoms[i].residue)].push_back(std::int32_t(i));
    for (std::size_t i = 0; i < atoms.size(); ++i) {
        out[i] = std::int32_t(i);
        if (atoms[i].isHeavy) continue;
        double least = std::numeric_limits<double>::max();
        for (const std::int32_t k : heavy[std::size_t(atoms[i].residue)]) {
            const double square = (atoms[std::size_t(k)].position - atoms[i].position).lengthSqr();
            if (square >= least) continue;
            least = square;
            out[i] = k;
        }
    }
    return out;
}

} // namespace molsurf
