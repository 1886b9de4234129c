// SPDX-License-Identifier: MPL-2.0
#include "bricks.h"
#include "stop.h"
#include "verbs.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/core/transient_error.h"
#include "molsurf/kernel/grid/paged_array.h"
#include "molsurf/kernel/pipeline/check_balls.h"
#include "molsurf/scale/bricks/atoms_file.h"
#include "molsurf/scale/bricks/plan_bricks.h"
#include "molsurf/show/io/commit.h"
#include "molsurf/show/io/temporary_file.h"
#include "molsurf/surface/product_table.h"

#include <malloc.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <utility>

namespace molsurf::tool
{

namespace
{

// A hidden folder beside the first output, where the bricks wait for the merge. It goes when the
// program ends; if that is killed, with the next one that writes there.
class BrickFolder
{
public:
    explicit BrickFolder(const std::string& output)
        : beside_(isStream(output) ? std::filesystem::temp_directory_path().string()
                                   : folderOf(output)),
          path_(temporaryName(beside_ + "/bricks", ownMaker()))
    {
    }
    ~BrickFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
        if (lock_ >= 0) close(lock_);
    }
    BrickFolder(const BrickFolder&) = delete;
    BrickFolder& operator=(const BrickFolder&) = delete;

    void make()
    {
        recover(beside_);
        lock_ = makeLockedFolder(path_);
        if (lock_ < 0)
            throw Error(ErrorKind::Output, "cannot make " + path_ + ": " + std::strerror(errno),
                        mayPass(errno));
    }
    std::string brick(std::size_t number) const
    {
        return path_ + "/" + std::to_string(number) + ".brick";
    }
    std::string atoms() const { return path_ + "/all.atoms"; }
    // The folder and all that may lie in it, in the order in which it can be removed.
    std::vector<std::string> content(std::size_t bricks) const
    {
        std::vector<std::string> names = {atoms(), temporaryName(atoms())};
        for (std::size_t k = 1; k <= bricks; ++k) {
            names.push_back(brick(k));
            names.push_back(temporaryName(brick(k)));
        }
        names.push_back(path_);
        return names;
    }

private:
    std::string beside_, path_;
    int lock_ = -1;
};

void writeAtomsTo(const std::string& path, const BallSet& atoms, const BrickPlan& plan,
                  const Progress& progress)
{
    OutputFile file(path, true);
    writeAtoms(atoms, extentOf(plan), file, progress);
    file.commit();
}

void checkOutputs(const CommandLine& call)
{
    if (call.scene.known() || call.scene.form.changes() || call.center)
        throw Error(ErrorKind::Usage, "--for and --center need the whole molecule at once [hint: "
                                      "without --memory]");
    for (const Output& output : call.outputs)
        if ((output.format->verbs & BricksMerge) == 0)
            throw Error(ErrorKind::Usage, "-o " + output.path + ": with bricks expected " +
                                              endingsOf(~0u, BricksMerge, " or "));
}

/// Refuses bricks where something that is asked for is of the whole, with what that takes.
void checkBricks(const CommandLine& call, const PlannedBrick& whole)
{
    const std::string what = missingIn(InBricks, call.options);
    if (what.empty()) return checkOutputs(call);
    const double bytes = double(memoryFor(whole));
    throw Error(ErrorKind::Usage,
                formatted("%s needs the whole molecule at once, which takes about %s of memory, "
                          "and `memory` is %s [hint: `memory` %.0fM]",
                          what.c_str(), sizeText(bytes).c_str(),
                          sizeText(double(call.memory)).c_str(),
                          std::ceil(1.01 * bytes / double(1 << 20))));
}

} // namespace

bool goesInBricks(const CommandLine& call)
{
    if (call.verb != Build || call.atoms.assembly.repeats() || !call.frames.empty()) return false;
    try {
        checkWay(InBricks, call.options);
        checkOutputs(call);
    } catch (const Error&) {
        return false;
    }
    return true;
}

int buildInBricks(CommandLine call, Clock::time_point start)
{
    prepareOutputs(call);

    Terminal terminal(call.progress);
    Report report;
    BallSet atoms = readBalls(call, terminal, report);
    const std::size_t reading = peakMemory();
    if (call.memory > 0 && reading > call.memory)
        throw Error(ErrorKind::Input, "reading took " + sizeText(double(reading)) +
                                          " of memory, --memory is " +
                                          sizeText(double(call.memory)) + " [hint: --memory " +
                                          std::to_string(reading / 1000000 * 12 / 10) + "M]");
    if (call.memory == 0) checkBalls(atoms.balls, call.options, Pieces::One, availableMemory());
    call.options.closedForm = needsClosedForm(call);
    BrickPlan one = call.options.grid ? planWhole(atoms, call.options, terminal)
                                      : planWithoutGrid(atoms, call.options);
    RunLimits limits = limitsOf(call, atoms);
    limits.memory = std::numeric_limits<std::size_t>::max(); // bricks take less
    if (!call.dryRun) checkCost(one.bricks[0], limits);
    one.bricks[0].bytes += limits.besides.bytes;
    one.bricks[0].seconds += limits.besides.seconds;
    const std::size_t whole = one.bricks[0].bytes;
    if (call.memory == 0 || memoryFor(one.bricks[0]) <= call.memory) {
        if (!call.dryRun)
            return endOf(buildSurface(call, atoms, report, terminal, start), moreSteps(call));
        terminal.erase();
        for (const std::string& line : describePlan(one)) printLine(line);
        return 0;
    }
    checkBricks(call, one.bricks[0]);
    atoms.names.reset(); // bricks use none
    // As many bricks as it takes, all in this process, their atoms on disk.
    const BrickPlan plan = planBricks(atoms, call.options, {0, call.memory, true, true}, terminal);
    terminal.erase();
    if (call.dryRun || !call.quiet) {
        printLine("the whole takes about " + sizeText(double(whole)) + "; in bricks:");
        for (const std::string& line : describePlan(plan)) printLine(line);
    }
    if (call.dryRun) return 0;

    BrickFolder folder(call.outputs[0].path);
    prepareOutputs(call, folder.content(plan.bricks.size()));
    folder.make();
    colorBalls(call.options, terminal, atoms);
    writeAtomsTo(folder.atoms(), std::exchange(atoms, BallSet()), plan, terminal);
    const AtomsFile onDisk(folder.atoms());
    const auto near = [&](const openvdb::BBoxd& space) { return onDisk.within(space); };
    const bool meshed = call.writes(Triangles);
    std::vector<std::string> paths;
    std::shared_ptr<const SparseField> coarse;
    for (std::size_t k = 1; k <= plan.bricks.size(); ++k) {
        stopIfAsked();
        paths.push_back(folder.brick(k));
        computeBrick(near, call.options, plan, k, "one process", paths.back(), meshed, coarse,
                     terminal);
        if (!plan.keepsMemory) malloc_trim(0);
        if (!call.verbose) continue;
        terminal.erase();
        printLine(formatted("brick %zu of %zu, %.2f s, %s at most", k, plan.bricks.size(),
                            secondsSince(start), sizeText(double(peakMemory())).c_str()));
    }
    releasePages();
    malloc_trim(0);
    mergeBricks(call, plan, paths, "one process", meshed, terminal, start, report);
    if (!call.quiet) printLine(summary(report));
    return endOf(report, "--steps");
}

} // namespace molsurf::tool
