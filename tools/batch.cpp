// SPDX-License-Identifier: MPL-2.0
#include "verbs.h"

#include "cli/option_table.h"
#include "input_files.h"
#include "outputs.h"
#include "sha256.h"
#include "terminal.h"

#include "molsurf/core/words.h"
#include "molsurf/error.h"
#include "molsurf/io/batch_summary.h"
#include "molsurf/io/temporary_file.h"
#include "molsurf/structure/structure_list.h"

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
    std::string input;
    std::vector<Output> outputs;
};

// The files that tell what was done.
std::vector<std::string> summaryPaths(const Call& call)
{
    const fs::path folder = call.folder;
    return {(folder / "summary.json").string(), (folder / "summary.csv").string()};
}

// Refuses to write what is read, and the files of a structure that is called summary.
void checkNames(const Call& call, const std::vector<Task>& tasks)
{
    const std::vector<std::string> own = summaryPaths(call);
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

[[noreturn]] void failTwice(const Call& call, const std::string& one, const std::string& other,
                            const std::string& outputs)
{
    throw Error(ErrorKind::Input,
                call.input + ": " + one + " and " + other + " would both be written to " + outputs);
}

std::vector<Task> tasksOf(const Call& call)
{
    std::vector<Task> tasks;
    std::map<std::string, std::string> taken; // by stem
    for (const std::string& input : readStructureList(call.input, call.atoms.maxInput)) {
        const std::string stem = inputStem(input);
        const auto [other, fresh] = taken.emplace(stem, input);
        if (stem.empty() || !fresh) failTwice(call, input, other->second, stem + ".*");
        Task task{input, {}};
        for (const Output& kind : call.outputs)
            task.outputs.push_back(
                {(fs::path(call.folder) / stem).string() + kind.path, kind.format});
        tasks.push_back(std::move(task));
    }
    checkNames(call, tasks);
    return tasks;
}

bool allExist(const std::vector<Output>& outputs)
{
    return std::all_of(outputs.begin(), outputs.end(), [](const Output& output) {
        std::error_code ignored;
        return fs::exists(output.path, ignored);
    });
}

// What is known of each task.
using Entries = std::vector<std::optional<BatchEntry>>;

void addSummary(const Call& call, const std::string& options, const Entries& table,
                OutputFiles& files)
{
    BatchSummary summary{options, {}};
    for (const auto& entry : table)
        if (entry) summary.entries.push_back(*entry);
    for (const std::string& path : summaryPaths(call))
        files.push_back(std::make_unique<OutputFile>(path, true));
    writeSummaryJson(summary, *files[files.size() - 2]);
    writeSummaryCsv(summary, *files.back());
}

void save(const Call& call, const std::string& options, const Entries& table)
{
    OutputFiles files;
    addSummary(call, options, table, files);
    commitUndisturbed(files);
}

BatchEntry doneEntry(const Task& task, const Report& report)
{
    BatchEntry entry;
    entry.input = task.input;
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

// Does one task. Its files and its line of the summary appear together, so that a run that is
// killed can go on. A failure has a line only.
void perform(const Call& call, const std::string& options, const Task& task,
             std::optional<BatchEntry>& entry, const Entries& table)
{
    Call one = call;
    one.input = task.input;
    one.outputs = task.outputs;
    one.warnings.clear();
    one.quiet = !call.verbose;
    Companions summary;
    for (const std::string& path : summaryPaths(call))
        summary.temporaries.push_back(temporaryName(path));
    summary.add = [&](const Report& report, OutputFiles& files) {
        entry = doneEntry(task, report);
        addSummary(call, options, table, files);
    };
    std::string problem;
    try {
        buildSurface(one, Clock::now(), summary);
        return;
    } catch (const Error& e) {
        problem = withOptionNames(e.what());
    } catch (const std::bad_alloc&) {
        problem = "out of memory";
    }
    entry = BatchEntry();
    entry->input = task.input;
    entry->status = "failed";
    entry->message = problem;
    save(call, options, table);
}

// Fills in what an earlier call has done.
void takeOver(const BatchSummary& before, const std::vector<Task>& tasks, Entries& table)
{
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        if (!allExist(tasks[i].outputs)) continue;
        for (const BatchEntry& entry : before.entries)
            if (entry.input == tasks[i].input && entry.status != "failed") table[i] = entry;
    }
}

std::string describe(const BatchEntry& entry)
{
    if (entry.status == "failed") return "failed: " + entry.message;
    return formatted("%s, area %.1f Å^2, volume %.1f Å^3, %.2f s", entry.status.c_str(), entry.area,
                     entry.volume, entry.seconds);
}

// All that the surfaces depend on, as a line for the summary.
std::string optionsLine(const Call& call)
{
    std::string line;
    for (const OptionGroup& group : optionTable()) {
        for (const Option& option : group.options) {
            const bool process = option.verbs & ~(Build | Batch | Compare | Convert | BricksPlan);
            if (process || !(option.verbs & Batch) || !call.has(option.name)) continue;
            const std::string name = option.name;
            if (name == "folder" || name == "force" || name == "verbose") continue;
            line += (line.empty() ? "--" : " --") + name;
            for (const std::string& value : call.given.at(name)) line += " " + value;
        }
    }
    for (const OptionFile& file : filesOf(call.verb, call.given))
        if (file.option->stored)
            line += " (" + file.path + ": " + sha256OfFile(file.path).substr(0, 16) + ")";
    return line;
}

} // namespace

int batch(const Call& call)
{
    const std::string options = optionsLine(call);
    const std::vector<Task> tasks = tasksOf(call);
    std::error_code problem;
    fs::create_directories(call.folder, problem);
    if (problem)
        throw Error(ErrorKind::Output, "cannot make " + call.folder + ": " + problem.message());
    for (const std::string& path : summaryPaths(call)) checkWritable(path, true);
    const fs::path folder = call.folder;
    const std::optional<BatchSummary> before = readSummary((folder / "summary.json").string());
    if (before && before->options != options && !call.force)
        throw Error(ErrorKind::Output, call.folder + " holds surfaces with other options (" +
                                           before->options +
                                           ") [hint: another folder, or --force]");
    if (!call.quiet)
        for (const std::string& warning : call.warnings) say("warning: " + warning);

    Entries table(tasks.size());
    if (before && !call.force) takeOver(*before, tasks, table);
    const auto kept = std::size_t(
        std::count_if(table.begin(), table.end(), [](const auto& entry) { return bool(entry); }));
    std::size_t failed = 0, creeping = 0;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        const bool fresh = !table[i];
        if (fresh) perform(call, options, tasks[i], table[i], table);
        failed += table[i]->status == "failed";
        creeping += table[i]->status == "not converged";
        if (fresh && !call.quiet)
            say(std::to_string(i + 1) + "/" + std::to_string(tasks.size()) + " " + tasks[i].input +
                ": " + describe(*table[i]));
    }
    save(call, options, table);
    if (call.quiet && failed > 0)
        say("error: " + std::to_string(failed) + " of " +
            counted(tasks.size(), "structure", "structures") + " failed; the table is " +
            (folder / "summary.csv").string());
    if (!call.quiet) {
        std::string line = counted(tasks.size(), "structure", "structures");
        if (kept > 0) line += ", " + std::to_string(kept) + " done before";
        if (creeping > 0) line += ", " + std::to_string(creeping) + " not converged";
        say(line + ", " + std::to_string(failed) + " failed; the table is " +
            (folder / "summary.csv").string());
    }
    return failed > 0 ? 1 : creeping > 0 ? notConvergedStatus : 0;
}

} // namespace molsurf::tool
