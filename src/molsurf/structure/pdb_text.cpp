// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/pdb_text.h"

#include "molsurf/error.h"
#include "molsurf/structure/assembly_operators.h"
#include "molsurf/structure/element.h"
#include "molsurf/structure/text_fields.h"

#include <algorithm>
#include <cctype>

namespace molsurf
{
namespace
{

using std::string_view;

constexpr std::size_t lastColumn = 80;

void checkCoordinates(string_view line, std::size_t number, const std::string& path)
{
    constexpr std::size_t firstColumn = 30, width = 8;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t begin = firstColumn + axis * width;
        const string_view field =
            begin < line.size() ? trimmed(line.substr(begin, width)) : string_view();
        double value = 0;
        if (parseNumber(field, value)) continue;
        throw Error(ErrorKind::Input, displayName(path) + ": line " + std::to_string(number) +
                                          ": " + "xyz"[axis] + ": expected a number in columns " +
                                          std::to_string(begin + 1) + "-" +
                                          std::to_string(begin + width) + ", got " +
                                          inQuotes(field) + " in the line " + inQuotes(line));
    }
}

bool isLetterOrBlank(char c)
{
    return c == ' ' || std::isalpha(static_cast<unsigned char>(c));
}

/// Blanks what is not segment, element and charge in columns 73-80.
void cleanTail(char* line, std::size_t size)
{
    constexpr std::size_t tailBegin = 72, elementBegin = 76, chargeBegin = 78, tailEnd = 80;
    if (size <= elementBegin) return;
    std::string tail(line + tailBegin, std::min(size, tailEnd) - tailBegin);
    tail.resize(tailEnd - tailBegin, ' ');
    const char* const element = &tail[elementBegin - tailBegin];
    const char* const charge = &tail[chargeBegin - tailBegin];
    auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
    auto isSign = [](char c) { return c == '+' || c == '-'; };
    const bool goodElement = isLetterOrBlank(element[0]) && isLetterOrBlank(element[1]);
    const bool goodCharge = (charge[0] == ' ' && charge[1] == ' ') ||
                            (isDigit(charge[0]) && isSign(charge[1])) ||
                            (isSign(charge[0]) && isDigit(charge[1]));
    if (goodElement && goodCharge) return;
    const bool keepElement = goodElement && element[1] != ' ' && !isDigit(charge[1]);
    std::fill(line + (keepElement ? chargeBegin : tailBegin), line + std::min(size, tailEnd), ' ');
}

int modelNumber(string_view line, int previous)
{
    const Fields fields = splitFields(line);
    int number = previous + 1;
    if (fields.size() > 1) parseInteger(fields[1], number);
    return number;
}

} // namespace

PdbRecords preparePdb(std::string& text, const std::string& path)
{
    PdbRecords records;
    std::vector<string_view> remarks, matrices;
    int next = 1; // number of the model that the next atom starts
    bool inModel = false, ended = false;
    for (LineReader lines(text); lines.next();) {
        const string_view line = lines.line();
        char* const begin = &text[std::size_t(line.data() - text.data())];
        const string_view record = line.substr(0, 6);
        // Behind column 120 gemmi takes what follows a byte beyond ASCII for another line.
        if (line.size() > lastColumn) std::fill(begin + lastColumn, begin + line.size(), ' ');
        if (isAtomRecord(line)) {
            if (ended) {
                records.warnings.push_back("the atoms after END in line " +
                                           std::to_string(lines.number()) + " were ignored");
                break;
            }
            checkCoordinates(line, lines.number(), path);
            cleanTail(begin, line.size());
            if (!inModel) records.models.push_back(next);
            inModel = true;
        } else if (record.substr(0, 5) == "MODEL") {
            next = modelNumber(line, records.models.empty() ? 0 : records.models.back());
            inModel = false;
            std::copy_n("ENDMD", 5, begin);
        } else if (record == "ENDMDL") {
            next = records.models.empty() ? 1 : records.models.back() + 1;
            inModel = false;
        } else if (trimmed(record) == "END") {
            ended = true;
        } else if (record.substr(0, 3) != "TER") {
            if (line.substr(0, 10) == "REMARK 350") remarks.push_back(line);
            if (line.substr(0, 5) == "MTRIX") matrices.push_back(line);
            std::fill_n(begin, std::min<std::size_t>(line.size(), 4), ' ');
        }
    }
    records.assemblies = parseRemark350(remarks);
    auto ncs = parseMtrix(matrices, records.warnings);
    if (ncs) records.assemblies.push_back(std::move(*ncs));
    return records;
}

} // namespace molsurf
