// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/frame_table.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/show/io/write_table.h"

#include <filesystem>
#include <fstream>
#include <vector>

namespace molsurf
{

namespace
{

constexpr const char* title = "file,frame,converged,steps,atoms,area,volume,"
                              "euler_characteristic,components,cavities,seconds,options";

// Parses one line, with the cells of `title`; false if it is none of a table.
bool parse(const std::string& line, FrameTable& table)
{
    const std::vector<std::string> cells = splitWords(line);
    std::size_t file = 0;
    FrameRow row;
    if (cells.size() != 12 || !parseWhole(cells[0], file) || !parseWhole(cells[1], row.frame) ||
        !parseWhole(cells[7], row.euler))
        return false;
    row.rests = cells[2] != "no";
    row.options = cells[11];
    row.line = line;
    table[file] = row;
    return true;
}

} // namespace

FrameRow frameRow(std::size_t file, int frame, const std::string& options, const Report& report)
{
    const SurfaceReport& s = report.surface;
    FrameRow row{frame, s.eulerCharacteristic.value_or(0),
                 !report.evolution || report.evolution->converged, options, ""};
    row.line = digits(file) + "," + digits(frame) + "," + (row.rests ? "yes" : "no") + "," +
               digits(report.evolution ? report.evolution->steps : 0) + "," + digits(report.atoms) +
               "," + digits(s.area) + "," + digits(s.volume) + "," + digits(row.euler) + "," +
               digits(s.components) + "," + digits(s.cavities.size()) + "," +
               digits(report.seconds.back().second) + "," + options;
    return row;
}

FrameTable readFrameTable(const std::string& path)
{
    FrameTable table;
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return table;
    std::ifstream file(path);
    std::string line;
    bool known = bool(std::getline(file, line)) && line == title;
    while (known && std::getline(file, line)) known = parse(line, table);
    if (!known)
        throw Error(ErrorKind::Output,
                    path + ": exists, and is no table of frames [hint: `force`]");
    return table;
}

void writeFrameTable(const FrameTable& table, OutputFile& file)
{
    std::string text = std::string(title) + "\n";
    for (const auto& [number, row] : table) text += row.line + "\n";
    file.write(text);
}

} // namespace molsurf
