// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The part of a sphere of radius 1 that caps leave free: its area, its loops, its faces.

#include <openvdb/Types.h>

#include <vector>

namespace molsurf
{

/// A part of a sphere: the directions u with u.axis > cosine.
struct SphereCap {
    openvdb::Vec3d axis; ///< unit vector
    double cosine;       ///< in (-1, 1)
};

/// A part of the rim of a cap that no other cap covers, anticlockwise about the cap's axis.
struct RimArc {
    int cap;
    int before, after; ///< the caps that cover the rim before and after it; -1: the whole rim
    openvdb::Vec3d begin, middle, end; ///< directions
    double angle;                      ///< about the axis, in (0, 2 pi]
    int loop;                          ///< that it belongs to
};

/// A connected part of the sphere that no cap covers.
struct RegionFace {
    double area = 0.0;                           ///< [sr]
    openvdb::Vec3d normal = openvdb::Vec3d(0.0); ///< integral of the direction [sr]
    int characteristic = 2;                      ///< 2 - loops
};

/// The part of the sphere that no cap covers.
struct SphereRegion {
    std::vector<RimArc> arcs;
    std::vector<RegionFace> faces;
    std::vector<int> faceOf; ///< of each loop
    double area = 0.0;       ///< [sr]

    /// How far the areas by two formulas are from differing by 2 pi times the Euler number of the
    /// faces [sr]. Large: the arcs do not form loops, since caps hardly meet.
    double mismatch = 0.0;
};

/// Room that findRegion() needs, kept from call to call by a thread.
struct RegionScratch {
    struct Cover {
        double begin, end;
        int cap;
    };
    std::vector<Cover> covers;
    std::vector<RimArc> arcs;
    std::vector<int> next; // after each arc, along the loop
    std::vector<RegionFace> loops;
};

/// Finds what caps leave of the sphere. The area within a loop is summed over its arcs, each with
/// the point `inside` as a fan: it changes as little as the arcs do, so a wrong decision between
/// rims that nearly meet moves it by no more than these are apart. A second formula, that of Gauss
/// and Bonnet, which takes angles at vertices instead, has to differ by a multiple of 2 pi.
///
/// @param[in] caps    no two are the same
/// @param[in] inside  a unit vector; caps cover all that is more than 90 degrees away from it
void findRegion(const std::vector<SphereCap>& caps, const openvdb::Vec3d& inside,
                RegionScratch& scratch, SphereRegion& region);

/// The area alone of what findRegion() finds, to the same bits [sr].
double regionArea(const std::vector<SphereCap>& caps, const openvdb::Vec3d& inside,
                  RegionScratch& scratch);

} // namespace molsurf
