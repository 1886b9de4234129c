// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/batch_summary.h"

#include "molsurf/error.h"
#include "molsurf/show/io/json_members.h"
#include "molsurf/show/io/write_table.h"

#include <stdexcept>

namespace molsurf
{

/// What tables and journals have of a structure, by its status.
template<typename Rows>
void members(Rows& rows, BatchEntry& entry)
{
    rows("input", entry.input);
    rows("sha256", entry.sha256);
    rows("status", entry.status);
    if (entry.status == "failed") {
        rows("message", entry.message);
    } else if (entry.status != "begun") {
        rows("atoms", entry.atoms);
        rows("area", entry.area);
        rows("volume", entry.volume);
        rows("euler_characteristic", entry.eulerCharacteristic);
        rows("components", entry.components);
        rows("cavities", entry.cavities);
        rows("seconds", entry.seconds);
    }
}

/// Units of the tables.
struct SummaryUnits {
    std::string area = "Angstrom^2", volume = "Angstrom^3", seconds = "s";
};

template<typename Rows>
void members(Rows& rows, SummaryUnits& units)
{
    rows("area", units.area);
    rows("volume", units.volume);
    rows("seconds", units.seconds);
}

template<typename Rows>
void members(Rows& rows, BatchSummary& summary)
{
    SummaryUnits units;
    rows("version", summary.version);
    rows("options", summary.options);
    rows("options_sha256", summary.optionsSha256);
    rows("units", units);
    rows("structures", summary.entries);
}

/// The first line of a journal, and another.
struct JournalHeader {
    std::string version, options;
};
struct JournalLine {
    BatchEntry entry;
};

template<typename Rows>
void members(Rows& rows, JournalHeader& header)
{
    rows("version", header.version);
    rows("options", header.options);
}

template<typename Rows>
void members(Rows& rows, JournalLine& line)
{
    rows("name", line.entry.name);
    members(rows, line.entry);
}

void writeSummaryJson(const BatchSummary& summary, OutputFile& file)
{
    file.write(jsonText(summary, 2) + "\n");
    file.finish();
}

void writeSummaryCsv(const BatchSummary& summary, OutputFile& file)
{
    std::string text = "input,status,atoms,area,volume,euler_characteristic,components,cavities,"
                       "message,sha256,version,options,units\n";
    for (const BatchEntry& e : summary.entries) {
        text += csvCell(e.input) + "," + e.status;
        if (e.status == "failed") {
            text += ",,,,,,," + csvCell(e.message);
        } else {
            text += "," + digits(e.atoms) + "," + digits(e.area) + "," + digits(e.volume) + "," +
                    (e.eulerCharacteristic ? digits(*e.eulerCharacteristic) : "") + "," +
                    digits(e.components) + "," + digits(e.cavities) + ",";
        }
        text += "," + e.sha256 + "," + summary.version + "," + summary.optionsSha256 +
                ",\"area Å², volume Å³\"\n";
    }
    file.write(text);
    file.finish();
}

std::string journalHeader(const BatchSummary& summary)
{
    return jsonText(JournalHeader{summary.version, summary.options}, -1) + "\n";
}

std::string journalLine(const BatchEntry& entry)
{
    return jsonText(JournalLine{entry}, -1) + "\n";
}

BatchSummary readJournalHeader(const std::string& line, const std::string& path)
{
    try {
        const auto header = JsonReader::valueOf<JournalHeader>(nlohmann::json::parse(line));
        return {header.version, header.options, {}, {}};
    } catch (const nlohmann::json::exception&) {
        throw Error(ErrorKind::Input, path + ": is no journal of a batch");
    }
}

std::optional<BatchEntry> readJournalLine(const std::string& line)
{
    try {
        return JsonReader::valueOf<JournalLine>(nlohmann::json::parse(line)).entry;
    } catch (const nlohmann::json::exception&) {
    } catch (const std::range_error&) {
    }
    return {};
}

} // namespace molsurf
