// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/read_report.h"

#include <nlohmann/json.hpp>

#include <fstream>

namespace molsurf
{

std::optional<KnownRun> readReport(const std::string& path)
{
    try {
        std::ifstream file(path);
        const auto json = nlohmann::json::parse(file);
        if (json.at("program") != "vdb_molsurf") return std::nullopt;
        KnownRun run;
        if (json.at("options_sha256").is_string()) run.options = json["options_sha256"];
        if (json.at("input_sha256").is_string()) run.input = json["input_sha256"];
        const auto& evolution = json.at("evolution");
        run.converged = evolution.is_null() || evolution.at("converged");
        return run;
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    }
}

} // namespace molsurf
