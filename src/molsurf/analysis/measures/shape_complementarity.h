// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// How well the surfaces of two groups of atoms fit each other.

#include "molsurf/ball.h"
#include "molsurf/kernel/balls/ball_index.h"
#include "molsurf/kernel/balls/excluded_points.h"
#include "molsurf/progress.h"
#include "molsurf/report.h"

#include <vector>

namespace molsurf
{

/// How far apart the surfaces of two balls may be if one is to matter for the other's fit [Å]. A
/// buried point and one of the rim beside it are 1.5 Å apart, and each is 1.7 Å from the centre of
/// its probe.
constexpr double fitReach = 8.3;

/// The solvent-excluded surface of a group alone, for a probe of 1.7 Å.
class FitSurface
{
public:
    /// @param[in] balls  every one finite
    FitSurface(std::vector<Ball> balls, const Progress& progress);

    const std::vector<Ball>& balls() const { return balls_; }
    const BallIndex& index() const { return index_; }
    const BallBoundary& boundary() const { return boundary_; }
    double volume() const { return volume_; } ///< of what no probe reaches [Å^3]

private:
    std::vector<Ball> balls_;
    BallIndex index_;
    BallBoundary boundary_; // of the balls grown by the probe
    double volume_;
};

/// Measures fits of two groups: their solvent-excluded surfaces, each alone, for a probe of 1.7
/// Å, where the probe of a point would run into the other group, more than 1.5 Å from where none
/// does. A point has the value (n.-n') exp(-0.5 d^2), n' being the normal of the other's nearest
/// such point, d Å away; Sc is the mean of both sides' medians. Contact areas have the rim, too,
/// and sum exp(-0.5 d^2) over the area of a side.
/// @see M. C. Lawrence and P. M. Colman, Shape complementarity at protein/protein interfaces, J.
///      Mol. Biol. 234:946-950, 1993, doi:10.1006/jmbi.1993.1648
class FitMeasure
{
public:
    FitMeasure();

    /// One thread at a time.
    /// @param[in] first, second  Balls farther than fitReach from the other side change nothing but
    ///                           the time.
    Report::Interface::Fit of(const FitSurface& first, const FitSurface& second,
                              const Progress& progress);

private:
    /// The part of a surface that the other group buries.
    struct Side {
        double buriedArea = 0.0; ///< [Å^2]
        ExcludedPoints buried;
        ExcludedPoints trimmed; ///< buried ones, less those of the rim
    };

    Side sideOf(const FitSurface& own, const FitSurface& other, const Progress& progress);

    /// Sets contact, and shape and distance where both sides have points.
    /// @return the area that each side buries, their mean [Å^2]
    double sidesOf(const FitSurface& first, const FitSurface& second, const Progress& progress,
                   Report::Interface::Fit& fit);

    ExcludedSampler sampler_;
};

} // namespace molsurf
