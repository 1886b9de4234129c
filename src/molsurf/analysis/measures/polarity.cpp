// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/polarity.h"

#include "molsurf/molecule/selection/ball_names.h"

#include <algorithm>
#include <limits>

namespace molsurf
{

namespace
{

constexpr std::uint8_t hydrogen = 1;
constexpr std::uint8_t apolar[] = {6, 9, 15, 16, 17, 34, 35, 53, 85}; // C F P S Cl Se Br I At

Polarity ofElement(std::uint8_t element)
{
    if (element == 0) return Polarity::Unknown;
    const bool isApolar =
        std::find(std::begin(apolar), std::end(apolar), element) != std::end(apolar);
    return isApolar ? Polarity::Apolar : Polarity::Polar;
}

} // namespace

std::vector<Polarity> polarityOf(const BallSet& atoms)
{
    const BallNames& names = *atoms.names;
    std::vector<std::vector<std::size_t>> heavy(names.residues.size());
    std::vector<Polarity> out;
    for (std::size_t i = 0; i < names.atoms.size(); ++i) {
        const std::uint8_t element = names.atoms[i].element;
        out.push_back(ofElement(element));
        if (element > hydrogen) heavy[std::size_t(names.residueOf[i])].push_back(i);
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (names.atoms[i].element != hydrogen) continue;
        double least = std::numeric_limits<double>::infinity();
        for (const std::size_t k : heavy[std::size_t(names.residueOf[i])]) {
            const double square = (atoms.balls[k].center - atoms.balls[i].center).lengthSqr();
            if (square >= least) continue;
            least = square;
            out[i] = out[k];
        }
    }
    return out;
}

} // namespace molsurf
