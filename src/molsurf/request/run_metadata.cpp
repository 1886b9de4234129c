// SPDX-License-Identifier: MPL-2.0
#include "molsurf/request/run_metadata.h"

#include "molsurf/request/request_table.h"
#include "molsurf/show/io/scene.h"

#include <cmath>
#include <string>

namespace molsurf
{

openvdb::Metadata::Ptr metadataOf(const SettingValue& value)
{
    if (const auto* on = std::get_if<bool>(&value)) return openvdb::BoolMetadata(*on).copy();
    if (const auto* whole = std::get_if<std::int64_t>(&value))
        return openvdb::Int64Metadata(*whole).copy();
    if (const auto* number = std::get_if<double>(&value))
        return openvdb::DoubleMetadata(*number).copy();
    return openvdb::StringMetadata(std::get<std::string>(value)).copy();
}

openvdb::MetaMap runMetadata(const Request& request, const Report& report)
{
    openvdb::MetaMap map;
    const auto add = [&](const char* name, const SettingValue& value) {
        map.insertMeta(name, *metadataOf(value));
    };
    add("program", report.program);
    add("version", report.version);
    if (!report.command.empty()) add("command", report.command);
    add("input", report.input);
    if (!report.commit.empty()) add("commit", report.commit);
    if (!report.inputSha256.empty()) add("input_sha256", report.inputSha256);
    add("atoms", std::int64_t(report.atoms));
    if (!std::isnan(report.surface.area)) {
        add("area", report.surface.area);
        add("volume", report.surface.volume);
    }
    if (request.frame > 0) {
        add("frame", std::int64_t(request.frame));
        add("trajectory", request.trajectory.empty() ? request.input : request.trajectory);
        add("frames.options", request.frameDigest);
    }
    for (const OptionRow<Request>& row : requestTable())
        if (row.get && (request.knowsAtoms || row.of == SettingOf::Surface))
            add(("option." + std::string(row.name)).c_str(), row.get(request));
    describeScene(request.scene, map);
    return map;
}

} // namespace molsurf
