// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Which tunnels of frames are one tunnel.

#include "molsurf/atoms.h"
#include "molsurf/report.h"

#include <openvdb/Types.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

/// The tunnels of the frames of a trajectory. Those of two frames are one tunnel if they have one
/// mouth: the ball at the end of the earlier one, carried along by the atoms that line it, overlaps
/// the ball at the end of the later one. Of several the one whose middle is nearest counts.
class TunnelTracks
{
public:
    /// Gives the tunnels of the next frame their numbers: that of the tunnel of an earlier frame
    /// that they are, or the next free one.
    /// @param[in] atoms    that they are of, the same in all frames or with the same names
    /// @param[in] frame    its number
    /// @param[in,out] tunnels  empty: the frame has none
    void add(const BallSet& atoms, int frame, Report::Tunnels& tunnels);

    /// A tunnel in a frame where it is open.
    struct Opening {
        std::size_t frame; ///< index of the frame, in the order in which they were added
        double radius, length, curvature;
        std::array<double, 3> place; ///< the narrowest [Å]
        std::string residues;        ///< that line this
    };
    struct Track {
        std::vector<Opening> open; ///< at least one, by frame
        double meanRadius() const; ///< of where it is open [Å]
    };

    /// By their numbers, from 1.
    const std::vector<Track>& tracks() const { return tracks_; }
    std::size_t frames() const { return frames_.size(); }

    /// A row for each tunnel and frame: tunnel, frame, open (1 or 0), radius_A, length_A,
    /// curvature, x_A, y_A, z_A (the narrowest place) and residues (that line it), which are empty
    /// where it is closed, and open_share, the share of frames in which it is open.
    Table table() const;

private:
    /// Names an atom in all frames: by its residue and name, and how many of this name are before.
    using AtomName = std::pair<std::string, std::size_t>;
    /// The end of a tunnel, with the atoms that line it, as they are in the frame where it was open
    /// last.
    struct Mouth {
        std::vector<AtomName> lining;
        std::vector<openvdb::Vec3d> places; ///< [Å]
        openvdb::Vec3d end;                 ///< [Å]
        double radius;                      ///< [Å]
    };
    class Atoms;

    std::vector<Track> tracks_;
    std::vector<Mouth> mouths_; ///< of the tracks
    std::vector<int> frames_;   ///< their numbers
};

} // namespace molsurf
