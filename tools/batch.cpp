// SPDX-License-Identifier: MPL-2.0
#include "verbs.h"

#include "batch_journal.h"
#include "cli/option_table.h"
#include "identity.h"
#include "input_files.h"
#include "outputs.h"
#include "terminal.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/sha256.h"
#include "molsurf/molecule/structure/structure_list.h"
#include "molsurf/request/identity.h"
#include "molsurf/show/io/output_file.h"
#include "molsurf/show/io/output_folders.h"
#include "molsurf/show/io/read_report.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <new>
#include <optional>

namespace molsurf::tool
{

namespace fs = std::filesystem;

namespace
{

// One structure of the list and the files that it gets.
struct Task {
    std::string input, name;
    std::vector<Output> outputs;
};

// Refuses to write what is read, and the files of a structure that is called summary.
void checkNames(const CommandLine& call, const std::vector<Task>& tasks)
{
    const std::vector<std::string> own = BatchJournal::paths(call.folder);
    InputFiles inputs(call);
    for (const Task& task : tasks) inputs.add(task.input);
    for (const std::string& path : own) inputs.refuse(path);
    for (const Task& task : tasks) {
        for (const Output& output : task.outputs) {
            inputs.refuse(output.path);
            if (std::count(own.begin(), own.end(), output.path) > 0)
                throw Error(ErrorKind::Input, call.input + ": " + task.input +
                                                  " and the summary would both be written to " +
                                                  output.path + " [hint: another name]");
        }
    }
}

[[noreturn]] void failTwice(const CommandLine& call, const std::string& one,
                            const std::string& other, const std::string& outputs)
{
    throw Error(ErrorKind::Input,
                call.input + ": " + one + " and " + other + " would both be written to " + outputs);
}

// The structures of the list, each with its files: the call's outputs have extensions for paths.
std::vector<Task> tasksOf(const CommandLine& call)
{
    std::vector<Task> tasks;
    std::map<std::string, std::string> taken; // by stem
    for (const std::string& input : readStructureList(call.input, call.atoms.limits.maxInput)) {
        const std::string stem = inputStem(input);
        const auto [other, fresh] = taken.emplace(stem, input);
        if (stem.empty() || !fresh) failTwice(call, input, other->second, stem + ".*");
        Task task{input, stem, {}};
        for (const Output& kind : call.outputs) {
            Output output = kind;
            output.path = (fs::path(call.folder) / stem).string() + kind.path;
            task.outputs.push_back(std::move(output));
        }
        tasks.push_back(std::move(task));
    }
    checkNames(call, tasks);
    return tasks;
}

std::size_t existing(const std::vector<Output>& outputs)
{
    return std::size_t(std::count_if(outputs.begin(), outputs.end(), [](const Output& output) {
        std::error_code ignored;
        return fs::exists(output.path, ignored);
    }));
}

BatchEntry beginEntry(const CommandLine& call, const Task& task)
{
    BatchEntry entry;
    entry.name = task.name;
    entry.input = task.input;
    entry.status = "begun";
    entry.sha256 = sha256OfInput(task.input, call.atoms.limits.maxInput);
    return entry;
}

BatchEntry doneEntry(BatchEntry entry, const Report& report)
{
    const bool rests = !report.evolution || report.evolution->converged;
    entry.status = rests ? "done" : "not converged";
    entry.atoms = report.atoms;
    entry.area = report.surface.area;
    entry.volume = report.surface.volume;
    entry.eulerCharacteristic = report.surface.eulerCharacteristic;
    entry.components = report.surface.components;
    entry.cavities = report.surface.cavities.size();
    entry.seconds = report.seconds.back().second;
    return entry;
}

// Whether the report among its files says that they are of this call and input, though the journal
// has lost its line.
bool areOwn(const CommandLine& call, const Task& task, const std::string& sha256)
{
    for (const Output& output : task.outputs) {
        const auto known = output.holds(Numbers) ? readReport(output.path) : std::nullopt;
        if (known) return known->input == sha256 && known->options == call.identity;
    }
    return false;
}

// Does one task, unless this run or another has done it with the same content of its input. Files
// that a run has begun may be replaced, others only with --force. An error of the structure becomes
// the status of its entry, so that the others go on.
// @param[out] kept  done before
BatchEntry perform(const CommandLine& call, const Task& task, BatchJournal& journal, bool& kept)
{
    BatchEntry entry = beginEntry(call, task);
    const BatchEntry* before = journal.find(task.name);
    const bool same = before && before->sha256 == entry.sha256 && !entry.sha256.empty();
    kept = !call.force && same && before->status != "failed" && before->status != "begun" &&
           existing(task.outputs) == task.outputs.size();
    if (kept) return *before;
    if (before && !same && before->input != task.input && before->status != "failed" &&
        !call.force) {
        entry.status = "failed";
        entry.message = task.name + ".* are of " + before->input +
                        ", which has another content [hint: another folder, or --force]";
        return entry;
    }
    CommandLine one = call;
    one.input = task.input;
    one.inputSha256 = entry.sha256;
    one.outputs = task.outputs;
    one.warnings.clear();
    one.quiet = !call.verbose;
    one.force = call.force || journal.hasBegun(task.name) || existing(task.outputs) == 0 ||
                areOwn(call, task, entry.sha256);
    try {
        if (one.force) journal.append(entry);
        entry = doneEntry(entry, buildSurface(one, Clock::now()));
    } catch (const Error& e) {
        entry.status = "failed";
        entry.message = withOptionNames(e.what());
        entry.mayPass = e.mayPass();
    } catch (const std::bad_alloc&) {
        entry.status = "failed";
        entry.message = "out of memory";
        entry.mayPass = true;
    } catch (const Cancelled&) {
        journal.writeTables();
        throw;
    }
    journal.append(entry);
    return entry;
}

std::string describe(const BatchEntry& entry)
{
    if (entry.status == "failed") return "failed: " + entry.message;
    return formatted("%s, area %.1f Å^2, volume %.1f Å^3, %.2f s", entry.status.c_str(), entry.area,
                     entry.volume, entry.seconds);
}

} // namespace

int batch(CommandLine call)
{
    for (const OptionFile& file : filesOf(call.verb, call.given))
        if (file.option->get) failIfStream(file.path, "a file, which each structure needs again");
    const std::string options = optionsLine(call); // of all
    call.identity = identityOf(options);
    const std::vector<Task> tasks = tasksOf(call);
    MadeFolders folders;
    folders.make(call.folder);
    for (const std::string& path : BatchJournal::paths(call.folder)) checkWritable(path, true);
    BatchJournal journal(call.folder, {MOLSURF_VERSION, options, {}, call.identity}, call.force);
    if (!call.quiet)
        for (const std::string& warning : call.warnings) printLine("warning: " + warning);

    std::size_t kept = 0, failed = 0, passing = 0, creeping = 0;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        bool before = false;
        const BatchEntry entry = perform(call, tasks[i], journal, before);
        kept += before;
        failed += entry.status == "failed";
        passing += entry.mayPass;
        creeping += entry.status == "not converged";
        if (!before && !call.quiet)
            printLine(std::to_string(i + 1) + "/" + std::to_string(tasks.size()) + " " +
                      tasks[i].input + ": " + describe(entry));
    }
    journal.writeTables();
    const fs::path folder = call.folder;
    if (call.quiet && failed > 0)
        printLine("error: " + std::to_string(failed) + " of " +
                  counted(tasks.size(), "structure", "structures") + " failed; the table is " +
                  (folder / "summary.csv").string());
    if (!call.quiet) {
        std::string line = counted(tasks.size(), "structure", "structures");
        if (kept > 0) line += ", " + std::to_string(kept) + " done before";
        if (creeping > 0) line += ", " + std::to_string(creeping) + " not converged";
        printLine(line + ", " + std::to_string(failed) + " failed; the table is " +
                  (folder / "summary.csv").string());
    }
    if (failed > 0) return passing > 0 ? laterStatus : failedStatus;
    return creeping > 0 ? notConvergedStatus : doneStatus;
}

} // namespace molsurf::tool
