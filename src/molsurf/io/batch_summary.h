// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The results of a run over many structures, as a table in JSON and CSV.

#include "molsurf/io/output_file.h"

#include <optional>
#include <string>
#include <vector>

namespace molsurf
{

/// One structure.
struct BatchEntry {
    std::string input;
    std::string status;  ///< "done", "not converged" or "failed"
    std::string message; ///< why it failed
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
    std::string options; ///< those that the surfaces depend on
    std::vector<BatchEntry> entries;
};

/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeSummaryJson(const BatchSummary& summary, OutputFile& file);

/// A line of names, then a line an entry, by RFC 4180; the numbers of failed ones are empty.
/// @throws Error(ErrorKind::Output) if the file cannot be written
void writeSummaryCsv(const BatchSummary& summary, OutputFile& file);

/// Reads what writeSummaryJson() wrote; nothing if there is no such file.
/// @throws Error(ErrorKind::Input) if it is another file
std::optional<BatchSummary> readSummary(const std::string& path);

} // namespace molsurf
