// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/match_volume.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/quiet_progress.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/surface/run.h"
#include "molsurf/surface/whole_run.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace molsurf
{

namespace
{

constexpr double closeEnough = 0.002; // relative
constexpr int mostRuns = 12;

double volumeOf(const BallSet& atoms, const SurfaceSpec& spec, const Progress& progress)
{
    QuietProgress quiet(progress);
    try {
        return makeUnitSurface(atoms, {spec, measuresOfWhole()}, &quiet).report.surface.outerVolume;
    } catch (const Error& e) {
        if (e.kind() != ErrorKind::Numeric) throw;
        return 0.0; // nothing is left
    }
}

/// The level at which some balls of one rate enclose a volume: a bracket by doubling, then regula
/// falsi, kept off the ends of the bracket. The zero is that of the cube root of the volume's ratio
/// less 1, since radii follow the level evenly; three times that is the error of the volume.
double findLevel(BallSet atoms, double wanted, const SurfaceSpec& spec, const Progress& progress)
{
    const auto excess = [&](double level) {
        for (Decay& decay : atoms.decays) decay.level = float(level);
        return std::cbrt(volumeOf(atoms, spec, progress) / wanted) - 1.0;
    };
    // Kept between a level that is too low and one that is too high.
    double low = -1.0, high = 0.0, atLow = excess(low), atHigh = excess(high);
    int runs = 2;
    for (; atLow > 0.0 && runs < mostRuns; ++runs) {
        high = low;
        atHigh = atLow;
        atLow = excess(low *= 2.0);
    }
    for (; atHigh < 0.0 && runs < mostRuns; ++runs) {
        low = high;
        atLow = atHigh;
        atHigh = excess(high = 2.0 * high + 1.0);
    }
    for (; runs < mostRuns; ++runs) {
        if (3.0 * std::abs(atLow) < closeEnough) return low;
        if (3.0 * std::abs(atHigh) < closeEnough) return high;
        const double share = std::clamp(atLow / (atLow - atHigh), 0.05, 0.95);
        const double level = low + share * (high - low), at = excess(level);
        (at < 0.0 ? low : high) = level;
        (at < 0.0 ? atLow : atHigh) = at;
    }
    const double worst = 3.0 * std::min(std::abs(atLow), std::abs(atHigh));
    if (worst > 5.0 * closeEnough) {
        throw Error(ErrorKind::Numeric,
                    "`matchVolume`: no level gives the volume " + std::to_string(wanted) + " Å^3");
    }
    return std::abs(atLow) < std::abs(atHigh) ? low : high;
}

} // namespace

void matchVolumes(BallSet& atoms, const SurfaceSpec& spec, const Progress& progress)
{
    SurfaceSpec plain = withVoxel(spec, std::max(spec.voxel, 1.0));
    plain.fillCavities = false;
    for (std::size_t r = 0; r < atoms.resolutions.size(); ++r) {
        BallSet part;
        for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
            if (atoms.resolutionOf[i] != std::int32_t(r)) continue;
            part.balls.push_back(atoms.balls[i]);
        }
        if (part.balls.empty()) continue;
        const double wanted = volumeOf(part, plain, progress);
        if (wanted <= 0.0) continue;
        for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
            if (atoms.resolutionOf[i] == std::int32_t(r)) part.decays.push_back(atoms.decays[i]);
        }
        const double level = findLevel(part, wanted, plain, progress);
        atoms.resolutions[r].level = level;
        for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
            if (atoms.resolutionOf[i] == std::int32_t(r)) atoms.decays[i].level = float(level);
        }
    }
}

} // namespace molsurf
