// SPDX-License-Identifier: MPL-2.0
#include "identity.h"

#include "cli/option_table.h"
#include "exit_status.h"

#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/sha256.h"
#include "molsurf/request/identity.h"
#include "molsurf/show/io/output_file.h"
#include "molsurf/show/io/read_report.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <vector>

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
    std::vector<GivenOption> given;
    for (const OptionGroup& group : optionTable())
        for (const Option& option : group.options)
            if (changesResults(option, call.verb) && call.has(option.name))
                given.push_back(givenOption(option, call.given.at(option.name)));
    return molsurf::optionsLine(given);
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
    if (whole && !input.empty() && known->input == input &&
        known->options == identityOf(optionsLine(call)))
        return known->converged ? doneStatus : notConvergedStatus;
    call.force = true;
    return std::nullopt;
}

} // namespace molsurf::tool
