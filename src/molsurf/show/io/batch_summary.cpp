// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/batch_summary.h"

#include "molsurf/error.h"
#include "molsurf/show/io/json_number.h"
#include "molsurf/show/io/write_table.h"

#include <nlohmann/json.hpp>

#include <stdexcept>

namespace molsurf
{

namespace
{

using Json = nlohmann::ordered_json;

Json jsonOf(const BatchEntry& e)
{
    Json entry = {{"input", e.input}, {"sha256", e.sha256}, {"status", e.status}};
    if (e.status == "failed") {
        entry["message"] = e.message;
    } else if (e.status != "begun") {
        entry.update(Json{
            {"atoms", e.atoms},
            {"area", e.area},
            {"volume", e.volume},
            {"euler_characteristic", e.eulerCharacteristic ? Json(*e.eulerCharacteristic) : Json()},
            {"components", e.components},
            {"cavities", e.cavities},
            {"seconds", e.seconds}});
    }
    return entry;
}

std::string textOf(const Json& json, int indent)
{
    return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace

void writeSummaryJson(const BatchSummary& summary, OutputFile& file)
{
    Json structures = Json::array();
    for (const BatchEntry& entry : summary.entries) structures.push_back(jsonOf(entry));
    file.write(
        textOf({{"version", summary.version},
                {"options", summary.options},
                {"options_sha256", summary.optionsSha256},
                {"units", {{"area", "Angstrom^2"}, {"volume", "Angstrom^3"}, {"seconds", "s"}}},
                {"structures", std::move(structures)}},
               2));
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
    return textOf({{"version", summary.version}, {"options", summary.options}}, -1);
}

std::string journalLine(const BatchEntry& entry)
{
    Json json = {{"name", entry.name}};
    json.update(jsonOf(entry));
    return textOf(json, -1);
}

BatchSummary readJournalHeader(const std::string& line, const std::string& path)
{
    try {
        const Json json = Json::parse(line);
        return {json.at("version"), json.at("options"), {}, {}};
    } catch (const Json::exception&) {
        throw Error(ErrorKind::Input, path + ": is no journal of a batch");
    }
}

std::optional<BatchEntry> readJournalLine(const std::string& line)
{
    try {
        const Json e = Json::parse(line);
        BatchEntry entry;
        entry.name = e.at("name");
        entry.input = e.at("input");
        entry.sha256 = e.at("sha256");
        entry.status = e.at("status");
        if (entry.status == "failed") {
            entry.message = e.at("message");
        } else if (entry.status != "begun") {
            entry.atoms = jsonNumber<std::size_t>(e.at("atoms"));
            entry.area = jsonNumber<double>(e.at("area"));
            entry.volume = jsonNumber<double>(e.at("volume"));
            if (const Json& euler = e.at("euler_characteristic"); !euler.is_null())
                entry.eulerCharacteristic = jsonNumber<int>(euler);
            entry.components = jsonNumber<int>(e.at("components"));
            entry.cavities = jsonNumber<std::size_t>(e.at("cavities"));
            entry.seconds = jsonNumber<double>(e.at("seconds"));
        }
        return entry;
    } catch (const Json::exception&) {
    } catch (const std::range_error&) {
    }
    return {};
}

} // namespace molsurf
