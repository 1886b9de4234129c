// SPDX-License-Identifier: MPL-2.0
#include "molsurf/analysis/measures/tunnel_tracks.h"

#include "molsurf/analysis/measures/lining.h"
#include "molsurf/analysis/pockets/find_pore.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/core/superposition.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <unordered_map>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;

/// How a place moves with some points: by the rotation and shift that lay them on their new places,
/// or by their mean shift where these determine no rotation.
/// @param[in] from  at least one
Vec3d carried(const Vec3d& x, const std::vector<Vec3d>& from, const std::vector<Vec3d>& to)
{
    if (const auto motion = superposition(from, to)) return motion->placed(x);
    Vec3d shift(0.0);
    for (std::size_t i = 0; i < from.size(); ++i) shift += to[i] - from[i];
    return x + shift / double(from.size());
}

/// The name of a ball in its residue.
std::string nameOf(const BallSet& atoms, std::size_t ball)
{
    if (!atoms.names) return "";
    const BallNames::Residue& residue =
        atoms.names->residues[std::size_t(atoms.names->residueOf[ball])];
    const BallNames::Atom& atom = atoms.names->atoms[ball];
    return residue.chain + "/" + std::to_string(residue.number) + residue.insertionCode + "/" +
           atom.name + atom.altloc;
}

} // namespace

/// The atoms of a frame by their names.
class TunnelTracks::Atoms
{
public:
    explicit Atoms(const BallSet& atoms) : atoms_(atoms)
    {
        std::unordered_map<std::string, std::size_t> counts;
        for (std::size_t i = 0; i < atoms.balls.size(); ++i) {
            std::string name = nameOf(atoms, i);
            const std::size_t before = counts[name]++;
            names_.emplace_back(std::move(name), before);
            index_.emplace(names_.back(), i);
        }
    }

    Mouth mouthOf(const Report::Tunnels::Tunnel& tunnel) const
    {
        const Report::Pore::Station& end = tunnel.stations.back();
        Mouth out{{}, {}, placeOf(end), end.radius};
        for (const std::size_t ball : end.lining) {
            out.lining.push_back(names_[ball]);
            out.places.push_back(atoms_.balls[ball].center);
        }
        return out;
    }

    /// Where the atoms of a mouth carry it; none: they are not there.
    std::optional<Vec3d> carriedEnd(const Mouth& mouth) const
    {
        std::vector<Vec3d> from, to;
        for (std::size_t i = 0; i < mouth.lining.size(); ++i) {
            const auto found = index_.find(mouth.lining[i]);
            if (found == index_.end()) continue;
            from.push_back(mouth.places[i]);
            to.push_back(atoms_.balls[found->second].center);
        }
        if (from.empty()) return {};
        return carried(mouth.end, from, to);
    }

private:
    const BallSet& atoms_;
    std::vector<AtomName> names_;
    std::map<AtomName, std::size_t> index_;
};

void TunnelTracks::add(const BallSet& balls, int frame, Report::Tunnels& tunnels)
{
    const std::size_t index = frames_.size();
    frames_.push_back(frame);
    if (tunnels.list.empty()) return;
    const Atoms atoms(balls);
    struct Pair {
        double distance;
        std::size_t track, tunnel;
    };
    std::vector<Pair> pairs;
    for (std::size_t k = 0; k < mouths_.size(); ++k) {
        const auto place = atoms.carriedEnd(mouths_[k]);
        for (std::size_t t = 0; place && t < tunnels.list.size(); ++t) {
            const Report::Pore::Station& end = tunnels.list[t].stations.back();
            const double distance = (placeOf(end) - *place).length();
            if (distance < end.radius + mouths_[k].radius) pairs.push_back({distance, k, t});
        }
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
    std::vector<char> taken(mouths_.size(), 0);
    for (Report::Tunnels::Tunnel& tunnel : tunnels.list) tunnel.number = 0;
    for (const Pair& pair : pairs) {
        if (taken[pair.track] || tunnels.list[pair.tunnel].number > 0) continue;
        taken[pair.track] = 1;
        tunnels.list[pair.tunnel].number = pair.track + 1;
    }
    for (Report::Tunnels::Tunnel& tunnel : tunnels.list) {
        if (tunnel.number == 0) {
            tracks_.emplace_back();
            mouths_.emplace_back();
            tunnel.number = tracks_.size();
        }
        mouths_[tunnel.number - 1] = atoms.mouthOf(tunnel);
        const Report::Pore::Station& least = tunnel.narrowest();
        tracks_[tunnel.number - 1].open.push_back({index, least.radius, tunnel.length(),
                                                   tunnel.curvature(), least.place,
                                                   namesOf(balls, least.lining).residues});
    }
}

double TunnelTracks::Track::meanRadius() const
{
    double sum = 0.0;
    for (const Opening& one : open) sum += one.radius;
    return sum / double(open.size());
}

Table TunnelTracks::table() const
{
    std::vector<std::int64_t> numbers, frames, opens;
    std::array<std::vector<double>, 6> values;
    std::vector<std::string> residues;
    std::vector<double> shares;
    for (std::size_t k = 0; k < tracks_.size(); ++k) {
        const std::vector<Opening>& open = tracks_[k].open;
        auto next = open.begin();
        for (std::size_t f = 0; f < frames_.size(); ++f) {
            const bool isOpen = next != open.end() && next->frame == f;
            constexpr double none = std::numeric_limits<double>::quiet_NaN();
            const Opening one =
                isOpen ? *next++ : Opening{f, none, none, none, {none, none, none}, ""};
            numbers.push_back(std::int64_t(k) + 1);
            frames.push_back(frames_[f]);
            opens.push_back(isOpen);
            const std::array<double, 6> row = {one.radius,   one.length,   one.curvature,
                                               one.place[0], one.place[1], one.place[2]};
            for (std::size_t i = 0; i < row.size(); ++i) values[i].push_back(row[i]);
            residues.push_back(one.residues);
            shares.push_back(double(open.size()) / double(frames_.size()));
        }
    }
    Table out{"tunnel_frames", {}};
    out.columns.push_back({"tunnel", std::move(numbers)});
    out.columns.push_back({"frame", std::move(frames)});
    out.columns.push_back({"open", std::move(opens)});
    constexpr std::array<const char*, 6> names = {"radius_A", "length_A", "curvature",
                                                  "x_A",      "y_A",      "z_A"};
    for (std::size_t i = 0; i < names.size(); ++i)
        out.columns.push_back({names[i], std::move(values[i])});
    out.columns.push_back({"residues", std::move(residues)});
    out.columns.push_back({"open_share", std::move(shares)});
    return out;
}

} // namespace molsurf
