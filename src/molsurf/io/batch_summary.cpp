// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/batch_summary.h"

#include "molsurf/error.h"
#include "molsurf/io/json_number.h"
#include "molsurf/io/write_table.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace molsurf
{

namespace
{

using Json = nlohmann::ordered_json;

} // namespace

void writeSummaryJson(const BatchSummary& summary, OutputFile& file)
{
    Json structures = Json::array();
    for (const BatchEntry& e : summary.entries) {
        Json entry = {{"input", e.input}, {"status", e.status}};
        if (e.status == "failed") {
            entry["message"] = e.message;
        } else {
            entry.update(Json{{"atoms", e.atoms},
                              {"area", e.area},
                              {"volume", e.volume},
                              {"euler_characteristic",
                               e.eulerCharacteristic ? Json(*e.eulerCharacteristic) : Json()},
                              {"components", e.components},
                              {"cavities", e.cavities},
                              {"seconds", e.seconds}});
        }
        structures.push_back(std::move(entry));
    }
    const Json json = {{"options", summary.options}, {"structures", std::move(structures)}};
    file.write(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    file.finish();
}

void writeSummaryCsv(const BatchSummary& summary, OutputFile& file)
{
    std::string text = "input,status,atoms,area,volume,euler_characteristic,components,cavities,"
                       "message\n";
    for (const BatchEntry& e : summary.entries) {
        text += csvCell(e.input) + "," + e.status;
        if (e.status == "failed") {
            text += ",,,,,,," + csvCell(e.message) + "\n";
            continue;
        }
        text += "," + digits(e.atoms) + "," + digits(e.area) + "," + digits(e.volume) + "," +
                (e.eulerCharacteristic ? digits(*e.eulerCharacteristic) : "") + "," +
                digits(e.components) + "," + digits(e.cavities) + ",\n";
    }
    file.write(text);
    file.finish();
}

std::optional<BatchSummary> readSummary(const std::string& path)
{
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return {};
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    try {
        const Json json = Json::parse(text);
        BatchSummary summary{json.at("options"), {}};
        for (const Json& e : json.at("structures")) {
            BatchEntry entry;
            entry.input = e.at("input");
            entry.status = e.at("status");
            if (entry.status == "failed") {
                entry.message = e.at("message");
            } else {
                entry.atoms = jsonNumber<std::size_t>(e.at("atoms"));
                entry.area = jsonNumber<double>(e.at("area"));
                entry.volume = jsonNumber<double>(e.at("volume"));
                if (const Json& euler = e.at("euler_characteristic"); !euler.is_null())
                    entry.eulerCharacteristic = jsonNumber<int>(euler);
                entry.components = jsonNumber<int>(e.at("components"));
                entry.cavities = jsonNumber<std::size_t>(e.at("cavities"));
                entry.seconds = jsonNumber<double>(e.at("seconds"));
            }
            summary.entries.push_back(std::move(entry));
        }
        return summary;
    } catch (const Json::exception&) {
    } catch (const std::range_error&) {
    }
    throw Error(ErrorKind::Input, path + ": is no summary of a batch");
}

} // namespace molsurf
