// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/polarity.h"

#include "molsurf/molecule/selection/ball_names.h"
#include "molsurf/molecule/selection/near_atoms.h"

#include <algorithm>
#include <iterator>

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
    std::vector<AtomSite> sites;
    for (std::size_t i = 0; i < names.atoms.size(); ++i)
        sites.push_back(
            {atoms.balls[i].center, names.residueOf[i], names.atoms[i].element > hydrogen});
    const std::vector<std::int32_t> heavy = heavyAtoms(sites, names.residues.size());
    std::vector<Polarity> out;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const std::uint8_t element = names.atoms[i].element;
        out.push_back(
            ofElement(element == hydrogen ? names.atoms[std::size_t(heavy[i])].element : element));
    }
    return out;
}

std::pair<double, double> areasByPolarity(const BallSet& atoms, const std::vector<double>& areas)
{
    const std::vector<Polarity> classes = polarityOf(atoms);
    double polar = 0.0, apolar = 0.0;
    for (std::size_t i = 0; i < areas.size(); ++i) {
        if (classes[i] == Polarity::Polar) polar += areas[i];
        if (classes[i] == Polarity::Apolar) apolar += areas[i];
    }
    return {polar, apolar};
}

} // namespace molsurf
