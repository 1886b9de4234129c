// SPDX-License-Identifier: MPL-2.0
#include "pocket_files.h"

#include "outputs.h"

#include "molsurf/error.h"
#include "molsurf/surface/field_table.h"
#include "molsurf/surface/pocket_meshes.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace molsurf::tool
{

namespace
{

constexpr std::array<const char*, 2> bodyFields = {"pocket_id", "pocket_room"};

} // namespace

bool wantsBodies(const CommandLine& call)
{
    return call.showsPockets() || call.writes(Numbered);
}

SurfaceOptions withBodies(const CommandLine& call)
{
    SurfaceOptions options = call.options;
    if (!wantsBodies(call) || !options.grid) return options; // without grids it has both
    for (const char* field : bodyFields)
        if (!hasField(options.fields, field)) options.fields.push_back(field);
    return options;
}

Mesh takeBodies(const CommandLine& call, const Progress& progress, MolecularSurface& result)
{
    if (!wantsBodies(call)) return {};
    Mesh bodies = pocketBodies(result, progress);
    const auto alone = [&](const auto& grid) {
        const std::string name = grid->getName();
        return std::count(bodyFields.begin(), bodyFields.end(), name) > 0 &&
               !hasField(call.options.fields, name);
    };
    auto& fields = result.fields;
    fields.erase(std::remove_if(fields.begin(), fields.end(), alone), fields.end());
    return bodies;
}

std::string numberedPath(const Output& output, std::size_t number)
{
    const std::size_t plural =
        output.path.size() - std::strlen(output.format->word) + std::strlen("pocket");
    std::string path = output.path;
    return path.replace(plural, 1, std::to_string(number));
}

void numberOutputs(std::size_t count, CommandLine& call)
{
    std::vector<Output> outputs;
    for (const Output& output : call.outputs) {
        if (!output.holds(Numbered)) {
            outputs.push_back(output);
            continue;
        }
        for (std::size_t number = 1; number <= count; ++number) {
            Output one = output;
            one.path = numberedPath(output, number);
            one.pocket = number;
            for (const Output& other : call.outputs)
                if (other.path == one.path)
                    throw Error(ErrorKind::Output, "-o " + one.path + " is given twice");
            outputs.push_back(std::move(one));
        }
    }
    call.outputs = std::move(outputs);
    prepareOutputs(call);
}

} // namespace molsurf::tool
