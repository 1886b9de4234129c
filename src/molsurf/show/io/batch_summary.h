// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The results of runs over many structures, as tables in JSON and CSV, and as the journal that
/// these are made of: a line of JSON for the options, then one for each structure that is begun or
/// ended.

#include "molsurf/show/io/output_file.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// One structure.
struct BatchEntry {
    std::string name;     ///< of its files, without extension
    std::string input;    ///< the structure file
    std::string sha256;   ///< of that file; empty if it could not be read
    std::string status;   ///< "done", "not converged" or "failed"; in a journal also "begun"
    std::string message;  ///< why it failed
    bool mayPass = false; ///< whether that may go well later; tables do not hold it
    std::size_t atoms = 0;
    double area = 0.0;   ///< [Å^2]
    double volume = 0.0; ///< [Å^3]
    std::optional<int> eulerCharacteristic;
    int components = 0;
    std::size_t cavities = 0;
    double seconds = 0.0;
};

/// All of them.
struct BatchSummary {
    std::string version; ///< of the program
    std::string options; ///< those that the surfaces depend on
    std::vector<BatchEntry> entries;
    std::string optionsSha256; ///< of version and options, as in reports; journals do not hold it
};

/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeSummaryJson(const BatchSummary& summary, OutputFile& file);

/// A line of names, then a line an entry, by RFC 4180; the numbers of failed ones are empty.
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeSummaryCsv(const BatchSummary& summary, OutputFile& file);

/// The first line of a journal: version and options.
std::string journalHeader(const BatchSummary& summary);

/// Another line of it.
std::string journalLine(const BatchEntry& entry);

/// Reads the first line of a journal.
/// @param[in] path  for the message
/// @throws Error(ErrorKind::Input) if it is another file
BatchSummary readJournalHeader(const std::string& line, const std::string& path);

/// Reads another line of it; nothing if it is damaged, as of a run that was killed while it wrote.
std::optional<BatchEntry> readJournalLine(const std::string& line);

} // namespace molsurf
