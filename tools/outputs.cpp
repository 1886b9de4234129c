// SPDX-License-Identifier: MPL-2.0
#include "outputs.h"

#include "commit_hash.h"
#include "identity.h"
#include "input_files.h"
#include "pocket_files.h"
#include "sidecar.h"
#include "stop.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/flow/evolve.h"
#include "molsurf/molecule/structure/archive.h"
#include "molsurf/molecule/structure/sha256.h"
#include "molsurf/request/identity.h"
#include "molsurf/request/run_outputs.h"
#include "molsurf/show/io/commit.h"
#include "molsurf/show/io/temporary_file.h"
#include "molsurf/show/io/write_3mf.h"
#include "molsurf/show/picture/film.h"
#include "molsurf/show/picture/write_html.h"

#include <sys/resource.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <set>

namespace molsurf::tool
{

double secondsSince(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::size_t peakMemory()
{
    // getrusage() would count the process that started this one, too.
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        std::size_t kilobytes = 0;
        if (word == "VmHWM:" && status >> kilobytes) return kilobytes * 1024;
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::size_t(usage.ru_maxrss) * 1024;
}

void stopIfAsked()
{
    if (stopRequested()) throw Cancelled();
}

void beginReport(const CommandLine& call, Report& report)
{
    report.version = MOLSURF_VERSION;
    report.commit = commitHash;
    report.command = call.command;
    report.input = call.input;
    if (call.writes(Numbers | Grids)) {
        if (call.verb & (Build | Batch))
            report.options = call.identity.empty() ? identityOf(optionsLine(call)) : call.identity;
        report.inputSha256 = call.inputSha256.empty()
                                 ? sha256OfInput(call.input, call.atoms.limits.maxInput)
                                 : call.inputSha256;
    }
    report.threads =
        int(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

void warnOfPaint(const CommandLine& call, const Mesh& mesh, Report& report)
{
    if (!call.writes(Paint)) return;
    const std::size_t colors = colorsIn(mesh);
    if (colors > mostPaints)
        report.warnings.push_back("colours: slicers paint with at most " +
                                  std::to_string(mostPaints) + ", got " + std::to_string(colors) +
                                  "; the .3mf has them without paint");
}

void addReading(const Report& read, Report& report)
{
    report.warnings.insert(report.warnings.begin(), read.warnings.begin(), read.warnings.end());
    report.seconds.insert(report.seconds.begin(), read.seconds.begin(), read.seconds.end());
    for (std::string& warning : report.warnings) warning = withOptionNames(warning);
}

namespace
{

/// Whether the area still goes one way: from the second to the last third of the steps it changed
/// by more than half of what it does within the last one. Fewer than nine steps count as such.
bool stillTravels(const std::vector<double>& areas)
{
    const auto third = std::ptrdiff_t(areas.size() / 3);
    if (third < 3) return true;
    const auto mean = [&](std::vector<double>::const_iterator from) {
        return std::accumulate(from, from + third, 0.0) / double(third);
    };
    const auto last = areas.end() - third;
    const auto [low, high] = std::minmax_element(last, areas.end());
    return std::abs(mean(last) - mean(last - third)) > 0.5 * (*high - *low);
}

} // namespace

std::string unrestText(const EvolutionReport& evolution, double voxel, const std::string& more)
{
    if (evolution.steps == 0 && evolution.energy.empty()) // in closed form
        return formatted(
            "not at rest: %.3g %% of the surface lies more than %.2g Å from it; the files "
            "are written [hint: --flow newton makes steps, a smaller --voxel resolves "
            "it, --tolerance %.2g accepts it]",
            100.0 * evolution.unsettledShare, 0.1 * voxel, 1.1 * evolution.toleranceMet);
    if (evolution.steps == 0) return "not converged: no step was made [hint: more " + more + "]";
    const std::string steps = counted(std::size_t(evolution.steps), "step", "steps");
    if (evolution.displacementTail == 0.0) // the paper's flow solves for no displacement
        return "not converged after " + steps +
               ": the paper's rule asks for no speed above 0.001 [hint: --flow newton]";
    const double tolerance = evolution.toleranceMet;
    // 5 % above it, rounded up to two digits.
    const double unit = std::pow(10.0, std::floor(std::log10(tolerance)) - 1.0);
    const double accepted = unit * std::ceil(1.05 * tolerance / unit);
    const std::string hint =
        stillTravels(evolution.area)
            ? formatted("[hint: %s %d goes on, --tolerance %g accepts that]", more.c_str(),
                        4 * evolution.steps, accepted)
            : formatted("[hint: --tolerance %g accepts that, a smaller --voxel resolves it]",
                        accepted);
    return formatted(
        "not converged after %s: %.3g %% of the surface moved by more than %.2g Å in the "
        "last one; the files are written %s",
        steps.c_str(), 100.0 * evolution.unsettledShare, 0.1 * voxel, hint.c_str());
}

std::string heldText(const EvolutionReport& evolution, const SurfaceSpec& spec)
{
    const bool inClosedForm = evolution.steps == 0 && evolution.energy.empty();
    if (!inClosedForm || !evolution.converged || evolution.toleranceMet < spec.evolution.tolerance)
        return {};
    return formatted("at rest as far as voxels of %g Å hold it: %.3g %% of the surface lies more "
                     "than %.2g Å from rest [hint: a smaller --voxel]",
                     spec.voxel, 100.0 * evolution.unsettledShare, 0.1 * spec.voxel);
}

void checkOutput(const CommandLine& call, const Output& output)
{
    const bool first = output.holds(Numbered) && output.pocket == 0; // their number is not known
    const std::string path = first ? numberedPath(output, 1) : output.path;
    InputFiles(call).refuse(path);
    checkWritable(path, mayReplace(call, output));
    if (output.format == findFormat("html")) needViewer();
    if (output.holds(Moving)) checkFilm(output.path);
}

void prepareOutputs(const CommandLine& call, const std::vector<std::string>& more)
{
    std::vector<std::string> temporaries = more;
    for (const Output& output : call.outputs) {
        checkOutput(call, output);
        if (!isStream(output.path)) temporaries.push_back(temporaryName(output.path));
    }
    handleSignals(temporaries);
}

void commitUndisturbed(const OutputFiles& files)
{
    std::vector<OutputFile*> all;
    for (const auto& file : files) {
        file->finish();
        all.push_back(file.get());
    }
    stopIfAsked();
    ignoreSignals();
    commit(all);
}

void recoverOutputs(const CommandLine& call)
{
    if (call.dryRun) return;
    std::set<std::string> folders;
    if (call.verb == Batch) folders.insert(call.folder);
    if (call.verb == BricksRun) folders.insert(folderOf(call.input));
    for (const Output& output : call.outputs)
        if (call.verb != Batch && !isStream(output.path)) folders.insert(folderOf(output.path));
    for (const std::string& folder : folders) recover(folder);
}

void writeOutputs(const CommandLine& call, Terminal& terminal,
                  const std::function<void(const Output&, OutputFile&)>& writeOne,
                  const std::function<void(double)>& timed, bool sideBySide,
                  const std::function<void(OutputFiles&)>& addMore)
{
    std::vector<Output> outputs, films;
    for (const Output& output : call.outputs) (output.film ? films : outputs).push_back(output);
    std::stable_sort(outputs.begin(), outputs.end(), [](const Output& a, const Output& b) {
        const auto turn = [](const Output& o) { return 2 * o.holds(Numbers) + isStream(o.path); };
        return turn(a) < turn(b);
    });

    const Clock::time_point start = Clock::now();
    OutputFiles files;
    bool done = false;
    const auto timeIt = [&] {
        if (!done) timed(secondsSince(start));
        done = true;
    };
    // Files are written side by side; streams and the report, which has the time of the
    // others, after them.
    const auto apart = [&](const Output& o) {
        return sideBySide && !o.holds(Numbers) && !isStream(o.path);
    };
    terminal.update("write", 0.0);
    for (const Output& output : films) writeOne(output, output.film->file());
    for (const Output& output : outputs) {
        if (!apart(output)) break;
        files.push_back(std::make_unique<OutputFile>(output.path, mayReplace(call, output)));
    }
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, files.size()),
        [&](const auto& range) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                writeOne(outputs[i], *files[i]);
                files[i]->finish();
            }
        },
        tbb::simple_partitioner());
    stopIfAsked();
    for (std::size_t i = files.size(); i < outputs.size(); ++i) {
        if (outputs[i].holds(Numbers)) timeIt();
        files.push_back(
            std::make_unique<OutputFile>(outputs[i].path, mayReplace(call, outputs[i])));
        writeOne(outputs[i], *files.back());
        stopIfAsked();
    }
    timeIt();
    if (addMore) addMore(files);
    commitUndisturbed(files);
}

} // namespace molsurf::tool
