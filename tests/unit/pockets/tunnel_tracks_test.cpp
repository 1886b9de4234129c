// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/tunnel_tracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;
using Tunnel = Report::Tunnels::Tunnel;

/// Two rings of atoms, about (0, 0, 0) and (20, 0, 0), perhaps turned and moved.
struct Rings {
    openvdb::Mat3d turn = openvdb::Mat3d::identity();
    Vec3d away = Vec3d(0.0);

    Vec3d at(const Vec3d& x) const { return turn * x + away; }
    BallSet atoms() const
    {
        BallSet out;
        out.names.emplace();
        for (int i = 0; i < 12; ++i) {
            const double angle = i * 1.1, height = i % 3;
            const Vec3d x(3.0 * std::cos(angle) + (i < 6 ? 0.0 : 20.0), 3.0 * std::sin(angle),
                          height);
            out.balls.push_back({at(x), 1.5, i});
            out.names->residues.push_back({"A", "A", "ALA", i + 1, ' ', false});
            out.names->residueOf.push_back(i);
            out.names->atoms.push_back({"CA", '\0', 6, 1.0f});
        }
        return out;
    }
    /// A tunnel of two stations that ends in a ring, at a place beside its middle.
    Tunnel tunnel(std::size_t ring, const Vec3d& beside = Vec3d(0.0), double radius = 2.0) const
    {
        Tunnel out;
        out.stations.resize(2);
        const Vec3d end = at(Vec3d(20.0 * double(ring), 0.0, 0.0) + beside),
                    begin = at(Vec3d(10.0, 0.0, 0.0));
        out.stations[0].place = {begin[0], begin[1], begin[2]};
        out.stations[0].radius = 1.25;
        out.stations[1].place = {end[0], end[1], end[2]};
        out.stations[1].radius = radius;
        out.stations[1].distance = 10.0;
        for (auto& station : out.stations) {
            station.lining.resize(6);
            std::iota(station.lining.begin(), station.lining.end(), 6 * ring);
        }
        return out;
    }
};

std::vector<std::size_t> numbersOf(TunnelTracks& tracks, const BallSet& atoms, int frame,
                                   const std::vector<Tunnel>& list)
{
    Report::Tunnels tunnels;
    tunnels.list = list;
    tracks.add(atoms, frame, tunnels);
    std::vector<std::size_t> out;
    for (const Tunnel& tunnel : tunnels.list) out.push_back(tunnel.number);
    return out;
}

using Numbers = std::vector<std::size_t>;

// The molecule tumbles: its mouths go with it.
TEST(TunnelTracks, MouthsGoWithTheirAtoms)
{
    const Rings first;
    Rings second;
    second.turn = openvdb::math::rotation<openvdb::Mat3d>(Vec3d(0.6, 0.0, 0.8), 2.0);
    second.away = Vec3d(5.0, -40.0, 12.0);
    TunnelTracks tracks;
    EXPECT_EQ(numbersOf(tracks, first.atoms(), 1, {first.tunnel(0), first.tunnel(1)}),
              (Numbers{1, 2}));
    EXPECT_EQ(numbersOf(tracks, second.atoms(), 2, {second.tunnel(1), second.tunnel(0)}),
              (Numbers{2, 1}));
    EXPECT_EQ(numbersOf(tracks, first.atoms(), 3, {first.tunnel(1)}), (Numbers{2}));
}

// The balls at the ends have 2 and 1 Å.
TEST(TunnelTracks, BallsThatOverlapAreOneMouth)
{
    const Rings rings;
    for (const double apart : {2.999, 3.001}) {
        TunnelTracks tracks;
        numbersOf(tracks, rings.atoms(), 1, {rings.tunnel(0)});
        const Tunnel other = rings.tunnel(0, Vec3d(0.0, 0.0, apart), 1.0);
        EXPECT_EQ(numbersOf(tracks, rings.atoms(), 2, {other}), (Numbers{apart < 3.0 ? 1u : 2u}));
    }
}

TEST(TunnelTracks, TheNearestOfTwoIsTheSame)
{
    const Rings rings;
    TunnelTracks tracks;
    numbersOf(tracks, rings.atoms(), 1, {rings.tunnel(0)});
    const Tunnel far = rings.tunnel(0, Vec3d(0.0, 0.0, 3.0)),
                 near = rings.tunnel(0, Vec3d(0.0, 0.0, -1.0));
    EXPECT_EQ(numbersOf(tracks, rings.atoms(), 2, {far, near}), (Numbers{2, 1}));
    // it is followed from where it was last: 3.5 Å from there, 4.5 Å from where it was first
    EXPECT_EQ(numbersOf(tracks, rings.atoms(), 3, {rings.tunnel(0, Vec3d(0.0, 0.0, -4.5))}),
              (Numbers{1}));
}

// Selections by distance may have other atoms in another frame.
TEST(TunnelTracks, AtomsAreKnownByTheirNames)
{
    const Rings rings;
    TunnelTracks tracks;
    numbersOf(tracks, rings.atoms(), 1, {rings.tunnel(0), rings.tunnel(1)});
    Rings moved;
    moved.away = Vec3d(30.0, 0.0, 0.0);
    BallSet fewer = moved.atoms();
    fewer.balls.erase(fewer.balls.begin(), fewer.balls.begin() + 2);
    fewer.names->residueOf.erase(fewer.names->residueOf.begin(),
                                 fewer.names->residueOf.begin() + 2);
    fewer.names->atoms.resize(10);
    std::vector<Tunnel> list = {moved.tunnel(1)};
    for (auto& station : list[0].stations)
        for (std::size_t& ball : station.lining) ball -= 2;
    EXPECT_EQ(numbersOf(tracks, fewer, 2, list), (Numbers{2}));
}

TEST(TunnelTracks, TheTableHasEachTunnelInEachFrame)
{
    const Rings rings;
    TunnelTracks tracks;
    numbersOf(tracks, rings.atoms(), 1, {rings.tunnel(0)});
    numbersOf(tracks, rings.atoms(), 4, {});
    numbersOf(tracks, rings.atoms(), 7, {rings.tunnel(1), rings.tunnel(0)});
    const Table table = tracks.table();
    const auto column = [&](const std::string& name) {
        return std::find_if(table.columns.begin(), table.columns.end(),
                            [&](const auto& c) { return c.name == name; })
            ->values;
    };
    using Whole = std::vector<std::int64_t>;
    EXPECT_EQ(std::get<Whole>(column("tunnel")), (Whole{1, 1, 1, 2, 2, 2}));
    EXPECT_EQ(std::get<Whole>(column("frame")), (Whole{1, 4, 7, 1, 4, 7}));
    EXPECT_EQ(std::get<Whole>(column("open")), (Whole{1, 0, 1, 0, 0, 1}));
    const auto radii = std::get<std::vector<double>>(column("radius_A")),
               shares = std::get<std::vector<double>>(column("open_share")),
               lengths = std::get<std::vector<double>>(column("length_A"));
    EXPECT_EQ(radii[2], 1.25);
    EXPECT_EQ(lengths[5], 10.0);
    EXPECT_TRUE(std::isnan(radii[1]) && std::isnan(radii[3]) && std::isnan(lengths[4]));
    EXPECT_EQ(shares[0], 2.0 / 3.0);
    EXPECT_EQ(shares[5], 1.0 / 3.0);
    EXPECT_EQ(std::get<std::vector<std::string>>(column("residues"))[5],
              "A/ALA7 A/ALA8 A/ALA9 A/ALA10 A/ALA11 A/ALA12");
    EXPECT_EQ(tracks.frames(), 3u);
    EXPECT_EQ(tracks.tracks()[0].meanRadius(), 1.25);
}

} // namespace
} // namespace molsurf
