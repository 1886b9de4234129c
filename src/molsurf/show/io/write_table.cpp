// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_table.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace molsurf
{

namespace
{

std::string cellOf(const std::string& text)
{
    return csvCell(text);
}

std::string cellOf(double number)
{
    return std::isfinite(number) ? digits(number) : "";
}

std::string cellOf(std::int64_t number)
{
    return digits(number);
}

/// @param[in] title  what comes before the names of the columns; @a lead before each row
void writeRows(const Table& table, const char* title, const std::string& lead, OutputFile& file)
{
    std::string text;
    if (title) {
        text += title;
        for (const Table::Column& column : table.columns)
            text += (&column == &table.columns.front() ? "" : ",") + csvCell(column.name);
        text += "\n";
    }
    const std::size_t rows =
        table.columns.empty()
            ? 0
            : std::visit([](const auto& v) { return v.size(); }, table.columns[0].values);
    constexpr std::size_t enough = 1 << 20; // bytes to write at once
    for (std::size_t row = 0; row < rows; ++row) {
        text += lead;
        for (const Table::Column& column : table.columns) {
            if (&column != &table.columns.front()) text += ",";
            text += std::visit([&](const auto& v) { return cellOf(v[row]); }, column.values);
        }
        text += "\n";
        if (text.size() < enough) continue;
        file.write(text);
        text.clear();
    }
    file.write(text);
}

} // namespace

std::string csvCell(const std::string& name)
{
    const bool formula = !name.empty() && std::strchr("=+-@\t\r", name[0]);
    const std::string text = formula ? "'" + name : name;
    // Readers take these for a value that is missing: sodium is a residue, an atom and an element.
    constexpr const char* missing[] = {"NA", "N/A", "NaN", "nan", "NULL", "null", "None", "none"};
    const auto same = [&](const char* word) { return text == word; };
    if (text.find_first_of(",\"\r\n") == std::string::npos &&
        std::none_of(std::begin(missing), std::end(missing), same))
        return text;
    std::string out = "\"";
    for (const char letter : text) out += letter == '"' ? "\"\"" : std::string(1, letter);
    return out + "\"";
}

void writeCsv(const Table& table, OutputFile& file)
{
    writeRows(table, "", "", file);
}

void appendCsv(const Table& table, int frame, bool titled, OutputFile& file)
{
    writeRows(table, titled ? "frame," : nullptr, digits(frame) + ",", file);
}

} // namespace molsurf
