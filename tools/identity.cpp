// SPDX-License-Identifier: MPL-2.0
#include "identity.h"

#include "cli/option_table.h"
#include "exit_status.h"
#include "sha256.h"

#include "molsurf/error.h"
#include "molsurf/molecule/structure/archive.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/show/io/output_file.h"
#include "molsurf/show/io/read_report.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

namespace molsurf::tool
{

namespace fs = std::filesystem;

namespace
{

/// Options that change no result: where it goes, and what a run may take.
constexpr const char* besides[] = {"output",  "format", "folder",    "force",  "skip-existing",
                                   "verbose", "memory", "max-hours", "dry-run"};

bool changesResults(const Option& option, Verb verb)
{
    const bool process = option.verbs & ~(Build | Batch | Compare | Convert | BricksPlan);
    return !process && (option.verbs & verb) &&
           std::find(std::begin(besides), std::end(besides), std::string(option.name)) ==
               std::end(besides);
}

} // namespace

std::string optionsLine(const CommandLine& call)
{
    std::string line;
    for (const OptionGroup& group : optionTable()) {
        for (const Option& option : group.options) {
            if (!changesResults(option, call.verb) || !call.has(option.name)) continue;
            line += (line.empty() ? "--" : " --") + std::string(option.name);
            for (const std::string& value : call.given.at(option.name)) line += " " + value;
        }
    }
    for (const OptionFile& file : filesOf(call.verb, call.given))
        if (file.option->get && !readsOnce(file.path))
            line += " (" + file.path + ": " + sha256OfFile(file.path).substr(0, 16) + ")";
    return line;
}

std::string identityOf(const CommandLine& call)
{
    return sha256OfText(MOLSURF_VERSION "\n" + optionsLine(call));
}

std::string sha256OfInput(const std::string& path, std::size_t maxBytes)
{
    std::error_code ignored;
    try {
        if (memberOf(path)) return sha256OfText(loadBytes(path, maxBytes));
        return fs::is_regular_file(path, ignored) ? sha256OfFile(path) : "";
    } catch (const Error&) {
        return "";
    }
}

std::optional<int> statusOfExisting(CommandLine& call)
{
    std::error_code missing;
    const auto report = std::find_if(call.outputs.begin(), call.outputs.end(),
                                     [](const Output& o) { return o.holds(Numbers); });
    const fs::file_time_type made = fs::last_write_time(report->path, missing);
    const std::optional<KnownRun> known = missing ? std::nullopt : readReport(report->path);
    if (!known) return std::nullopt;
    // writeOutputs() finishes the report last: a newer file was changed by someone else.
    const bool whole = std::all_of(call.outputs.begin(), call.outputs.end(), [&](const Output& o) {
        const fs::file_time_type time = fs::last_write_time(o.path, missing);
        return !missing && time <= made && !isStream(o.path);
    });
    const std::vector<OptionFile> read = filesOf(call.verb, call.given);
    const bool hashed = std::none_of(read.begin(), read.end(), [](const OptionFile& file) {
        return file.option->get && readsOnce(file.path);
    });
    const std::string input = hashed ? sha256OfInput(call.input, call.atoms.limits.maxInput) : "";
    if (whole && !input.empty() && known->input == input && known->options == identityOf(call))
        return known->converged ? doneStatus : notConvergedStatus;
    call.force = true;
    return std::nullopt;
}

} // namespace molsurf::tool
