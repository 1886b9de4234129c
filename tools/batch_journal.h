// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The journal of a folder of surfaces, which several runs may share.

#include "molsurf/kernel/core/file_descriptor.h"
#include "molsurf/show/io/batch_summary.h"

#include <chrono>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace molsurf::tool
{

/// FOLDER/summary.jsonl: a line of options, then one for each structure that a run has begun or
/// ended, of which the last one counts. Each line is appended at once, under a lock, so that runs
/// of several lists share a folder and a killed run loses nothing. summary.json and summary.csv are
/// made of it.
class BatchJournal
{
public:
    /// Opens the journal, or makes one.
    /// @param[in] own    version and options of this run
    /// @param[in] anew   a journal with others is begun anew instead of refused
    /// @throws Error(ErrorKind::Output) if the folder holds surfaces with others
    BatchJournal(const std::string& folder, const BatchSummary& own, bool anew);

    /// All files that it writes in a folder.
    static std::vector<std::string> paths(const std::string& folder);

    /// The last line of a structure, also by another run; none if there is none.
    const BatchEntry* find(const std::string& name);

    /// Whether a run has begun a structure, so that its files are not somebody else's.
    bool hasBegun(const std::string& name) const { return begun_.count(name) > 0; }

    /// Appends a line, and writes the tables now and then: that takes a twentieth of the time.
    void append(const BatchEntry& entry);

    /// Writes the tables, whatever signals come then.
    void writeTables();

private:
    void refresh();
    void enter(const BatchEntry& entry);

    std::string folder_, path_;
    FileDescriptor file_;
    std::size_t read_ = 0; // bytes
    std::string rest_;     // of a line that is not complete
    BatchSummary summary_; // in the order in which they were begun first
    std::map<std::string, std::size_t> places_;
    std::set<std::string> begun_;
    std::chrono::steady_clock::time_point written_;
    std::chrono::duration<double> tableSeconds_{0.0};
};

} // namespace molsurf::tool
