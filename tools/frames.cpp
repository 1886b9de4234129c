// SPDX-License-Identifier: MPL-2.0
#include "verbs.h"

#include "frame_source.h"
#include "frame_table.h"
#include "outputs.h"
#include "sidecar.h"
#include "write_result.h"

#include "molsurf/error.h"
#include "molsurf/io/read_vdb.h"
#include "molsurf/surface/extra_grids.h"
#include "molsurf/surface/velocity.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

namespace molsurf::tool
{

namespace
{

// The call of one frame: "name.vdb" becomes "name.0001.vdb".
Call callOf(const Call& call, std::size_t file, int frame)
{
    Call one = call;
    one.frame = frame;
    one.quiet = true;
    one.outputs.clear();
    char number[24];
    std::snprintf(number, sizeof number, ".%04zu", file);
    const auto numbered = [&](const std::string& path) {
        const std::filesystem::path whole = path;
        return (whole.parent_path() / (whole.stem().string() + number)).string() +
               whole.extension().string();
    };
    for (Output output : call.outputs) {
        if (output.format == Format::Csv) continue;
        if (output.format == Format::Usda)
            output.of = numbered(output.of); // one file for all frames
        else
            output.path = numbered(output.path);
        one.outputs.push_back(std::move(output));
    }
    return one;
}

std::string tableOf(const Call& call)
{
    for (const Output& output : call.outputs)
        if (output.format == Format::Csv) return output.path;
    return "";
}

[[noreturn]] void foreign(const std::string& path)
{
    throw Error(ErrorKind::Output, path + ": exists, of another frame or with other options "
                                          "[hint: another name, or --force]");
}

// Whether the files of a frame are there, whole, and those that this call would write.
bool isDone(const Call& one, const std::string& options, const FrameTable& table,
            const std::string& tableName, std::size_t file)
{
    std::size_t files = 0, there = 0;
    bool known = false;
    for (const Output& output : one.outputs) {
        if (output.format == Format::Usda) continue;
        ++files;
        std::error_code ignored;
        if (!std::filesystem::exists(output.path, ignored)) continue;
        ++there;
        if (output.format != Format::Vdb) continue;
        const VdbFile stored = readVdb(output.path);
        const auto made = stored.metadata.getMetadata<openvdb::StringMetadata>("frames.options");
        const auto frame = stored.metadata.getMetadata<openvdb::Int64Metadata>("frame");
        if (!made || !frame || made->value() != options || frame->value() != one.frame)
            foreign(output.path);
        known = true;
    }
    const auto row = table.find(file);
    if (!tableName.empty()) {
        if (row == table.end()) return false;
        if (there > 0 && (row->second.frame != one.frame || row->second.options != options))
            foreign(tableName);
        known = true;
    }
    return known && files == there;
}

openvdb::Vec3d centerOf(const std::vector<Ball>& balls)
{
    openvdb::BBoxd box;
    for (const Ball& ball : balls) box.expand(openvdb::Vec3d(ball.center));
    return box.getCenter();
}

std::string describe(const FrameRow& row, const Report& report, bool warm)
{
    char text[200];
    std::snprintf(text, sizeof text, "frame %d: area %.1f Å^2, volume %.1f Å^3, Euler %d",
                  row.frame, report.surface.area, report.surface.volume, row.euler);
    std::string line = text;
    if (report.evolution)
        line += ", " + counted(std::size_t(report.evolution->steps), "step", "steps") +
                (warm ? " (warm)" : "") + (row.rests ? "" : ", not converged");
    std::snprintf(text, sizeof text, ", %.2f s", report.seconds.back().second);
    return line + text;
}

void addVelocity(const Call& call, const BallSet& selection,
                 std::vector<openvdb::Vec3f> displacement, const Progress& progress,
                 MolecularSurface& result)
{
    if (!result.surface) return;
    for (openvdb::Vec3f& d : displacement) d *= float(call.scene.scale);
    result.fields.push_back(
        velocityGrid(*result.surface, selection, displacement, call.options, progress));
}

} // namespace

int frames(const Call& asked, Clock::time_point start)
{
    Call call = asked;
    openvdb::initialize();
    const auto limit = limitThreads(call);
    Terminal terminal(call.progress);
    terminal.update("read", 0.0);
    FrameSource source(call, terminal);
    terminal.erase();
    const BallSet& first = source.balls(0);
    if (call.center) call.scene.center = centerOf(first.balls);
    const std::string options = optionsDigest(call), tableName = tableOf(call);
    if (!tableName.empty()) checkWritable(tableName, true);
    FrameTable table;
    if (!tableName.empty() && !call.force) table = readTable(tableName);

    const bool moves = hasField(call.options.fields, "v");
    std::vector<Call> calls;
    std::vector<bool> done;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < source.size(); ++i) {
        calls.push_back(callOf(call, i + 1, source.number(i)));
        done.push_back(!call.force && isDone(calls[i], options, table, tableName, i + 1));
        kept += done[i];
        if (done[i]) continue;
        for (const Output& output : calls[i].outputs) checkOutput(call, output);
    }
    if (!call.quiet) {
        say(source.description());
        std::vector<std::string> warnings = call.warnings;
        warnings.insert(warnings.end(), first.warnings.begin(), first.warnings.end());
        const bool parts = call.options.split || !call.options.surfaceOf.empty();
        if (moves && parts) warnings.push_back("no grid v: groups have surfaces of their own");
        for (const std::string& warning : warnings) say("warning: " + warning);
        say(counted(source.size(), "frame", "frames") +
            (kept > 0 ? ", " + std::to_string(kept) + " done before" : ""));
    }

    WarmStart warm;
    std::size_t creeping = 0;
    std::optional<int> euler; // of the frame before
    std::string changes;
    for (std::size_t i = 0; i < source.size(); ++i) {
        const auto known = table.find(i + 1);
        if (done[i]) {
            warm = WarmStart();
            if (known != table.end()) creeping += !known->second.rests;
            euler = known != table.end() ? std::optional<int>(known->second.euler) : std::nullopt;
            continue;
        }
        const Clock::time_point frameStart = Clock::now();
        prepareOutputs(calls[i]);
        terminal.setPrefix("frame " + std::to_string(i + 1) + "/" + std::to_string(source.size()) +
                           ": ");
        std::vector<openvdb::Vec3f> displacement;
        if (moves) displacement = source.displacement(i);
        const BallSet& selection = source.balls(i);
        const bool begun = call.warm && !warm.empty();
        Report read;
        read.warnings = call.warnings;
        read.seconds = {{"read", secondsSince(frameStart)}};
        const Report report =
            surfaceOf(calls[i], selection, read, terminal, frameStart, call.warm ? &warm : nullptr,
                      [&](MolecularSurface& result) {
                          if (moves) addVelocity(call, selection, displacement, terminal, result);
                      });
        const FrameRow row = rowOf(i + 1, source.number(i), begun, options, report);
        table[i + 1] = row;
        if (!tableName.empty()) saveTable(table, tableName);
        creeping += !row.rests;
        if (euler && *euler != row.euler)
            changes += (changes.empty() ? "" : ", ") + std::to_string(row.frame);
        euler = row.euler;
        if (!call.quiet) say(describe(row, report, begun));
    }
    if (!call.quiet) {
        if (!changes.empty()) say("the topology is another than that before in frames " + changes);
        char text[32];
        std::snprintf(text, sizeof text, ", %.2f s", secondsSince(start));
        say(counted(source.size(), "frame", "frames") + text);
    }
    if (creeping == 0) return 0;
    say("not converged: " + counted(creeping, "frame", "frames") +
        "; the files are written [hint: --max-steps or --tolerance]");
    return notConvergedStatus;
}

} // namespace molsurf::tool
