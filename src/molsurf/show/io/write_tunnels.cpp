// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_tunnels.h"

#include "molsurf/analysis/measures/lining.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/show/color/pore_color.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

namespace
{

/// The place of a station in a file, with a letter between the numbers.
std::string placeIn(const Report::Pore::Station& s, const openvdb::Vec3d& origin, const char* mark)
{
    std::string out;
    for (std::size_t i = 0; i < 3; ++i)
        out += (i > 0 ? mark : "") + formatted("%.3f", s.place[i] - origin[int(i)]);
    return out;
}

/// A number, or "?" if it is none.
std::string known(const char* format, double number)
{
    return std::isfinite(number) ? formatted(format, number) : "?";
}

std::string loopOf(const std::string& category, const std::string& items)
{
    std::string out = "loop_\n";
    for (const std::string& item : splitWords(items)) out += category + "." + item + "\n";
    return out;
}

std::string profileRow(const BallSet& atoms, const Report::Tunnels::Tunnel& tunnel,
                       const Report::Pore::Station& s, const openvdb::Vec3d& origin)
{
    std::vector<std::pair<std::size_t, double>> parts;
    for (const std::size_t ball : s.lining) parts.emplace_back(ball, 1.0);
    return formatted("%zu %.4f ? %.4f %.6f ", tunnel.number, s.radius, s.distance,
                     s.distance / tunnel.length()) +
           placeIn(s, origin, " ") + " " + known("%.0f", liningOf(atoms, parts).charge) + "\n";
}

} // namespace

void writeTunnelsCif(const BallSet& atoms, const Report::Tunnels& tunnels,
                     const openvdb::Vec3d& origin, OutputFile& file)
{
    std::string text = "data_tunnels\n_audit_conform.dict_name mmcif_tunnels.dic\n"
                       "_audit_conform.dict_version 1.0\n"
                       "_audit_conform.dict_location "
                       "https://sb-ncbr.github.io/tunnels-schema/mmcif_tunnels_v10.dic\n" +
                       loopOf("_sb_ncbr_channel", "id,type,method,software,auto,cavity");
    for (const Report::Tunnels::Tunnel& tunnel : tunnels.list)
        text += formatted("%zu Tunnel void_graph vdb_molsurf False ?\n", tunnel.number);
    text += loopOf("_sb_ncbr_channel_props",
                   "channel_id,charge,hydropathy,hydrophobicity,mutability,numNegatives,"
                   "numPositives,polarity,logD,logP,logS,ionizable,bRadius");
    for (const Report::Tunnels::Tunnel& tunnel : tunnels.list) {
        const Lining lining = liningOfTunnel(atoms, tunnel);
        text += std::to_string(tunnel.number) + " " + known("%.0f", lining.charge) + " " +
                known("%.3f", lining.hydrophobicity) + " ? ? ? ? ? ? ? ? ? ?\n";
    }
    text +=
        loopOf("_sb_ncbr_channel_profile", "channel_id,radius,free_radius,distance,T,x,y,z,charge");
    for (const Report::Tunnels::Tunnel& tunnel : tunnels.list)
        for (const Report::Pore::Station& s : tunnel.stations)
            text += profileRow(atoms, tunnel, s, origin);
    file.write(text);
}

void writeTunnelsChimeraX(const Report::Tunnels& tunnels, const openvdb::Vec3d& origin,
                          OutputFile& file)
{
    constexpr std::size_t before = 1000; // others have low numbers
    for (const Report::Tunnels::Tunnel& tunnel : tunnels.list) {
        for (const Report::Pore::Station& s : tunnel.stations) {
            const Color c = poreColor(s.radius);
            file.write(formatted("marker #%zu position ", before + tunnel.number) +
                       placeIn(s, origin, ",") +
                       formatted(" radius %.3f color #%02x%02x%02x\n", s.radius, c[0], c[1], c[2]));
        }
        file.write(
            formatted("rename #%zu \"tunnel %zu\"\n", before + tunnel.number, tunnel.number));
    }
}

void writeTunnelsPymol(const Report::Tunnels& tunnels, const openvdb::Vec3d& origin,
                       OutputFile& file)
{
    const auto colorAt = [](double radius) {
        const Color c = poreColor(radius);
        return formatted("0x%02x%02x%02x", c[0], c[1], c[2]);
    };
    for (const Report::Tunnels::Tunnel& tunnel : tunnels.list) {
        const std::string name = formatted("tunnel_%zu", tunnel.number);
        std::size_t number = 0;
        for (const Report::Pore::Station& s : tunnel.stations)
            file.write(formatted("pseudoatom %s, resi=%zu, b=%.3f, vdw=%.3f, pos=[", name.c_str(),
                                 ++number, s.radius, s.radius) +
                       placeIn(s, origin, ", ") + "]\n");
        file.write("hide everything, " + name + "\nshow spheres, " + name + "\n");
        file.write("color " + colorAt(poreSteps[1]) + ", " + name + "\n");
        for (const std::size_t k : {1u, 0u})
            file.write("color " + colorAt(k == 1 ? poreSteps[0] : 0.0) + ", " + name +
                       formatted(" and b < %g\n", poreSteps[k]));
    }
}

} // namespace molsurf
