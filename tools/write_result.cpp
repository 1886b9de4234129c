// SPDX-License-Identifier: MPL-2.0
#include "write_result.h"

#include "cli/option_table.h"
#include "terminal.h"

#include "molsurf/molecule/structure/sha256.h"
#include "molsurf/request/format_table.h"
#include "molsurf/request/run_metadata.h"

namespace molsurf::tool
{

openvdb::MetaMap vdbMetadata(const CommandLine& call, const Report& report)
{
    openvdb::MetaMap map = runMetadata(call, report);
    addOptions(call, map);
    return map;
}

std::string optionsDigest(const CommandLine& call)
{
    openvdb::MetaMap map;
    addOptions(call, map);
    std::string all = call.trajectory + "\n" + shortest(call.scene.scale) +
                      sha256OfInput(call.input, call.atoms.limits.maxInput);
    for (auto meta = map.beginMeta(); meta != map.endMeta(); ++meta)
        if (meta->first.rfind("option.", 0) == 0 && meta->first != "option.model")
            all += "\n" + meta->first + "=" + meta->second->str();
    return sha256OfText(all).substr(0, 16);
}

void writeOutput(const CommandLine& call, const BallSet& atoms, const MolecularSurface& result,
                 const Output& output, const Progress& progress, OutputFile& file,
                 const ShownMeshes& shown)
{
    if (output.holds(Pixels) && output.turn == 0.0 && !call.quiet) {
        const std::string cut =
            clipWarning(drawnSurface(call, atoms, result.mesh, shown), progress);
        if (!cut.empty()) printLine("warning: " + withOptionNames(cut));
    }
    writeFile({call, atoms, result, result.mesh, shown, result.report,
               [&] { return vdbMetadata(call, result.report); }, progress},
              output, file);
}

} // namespace molsurf::tool
