// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/text_fields.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/core/transient_error.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>

namespace molsurf
{
namespace
{

constexpr std::size_t mostFields = std::size_t{1} << 18; // 4 MiB of them

bool isBlank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/// Levenshtein distance: the number of letters to change, to add or to leave out.
std::size_t editDistance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t corner = row[0]++;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t swapped = corner + (a[i] != b[j]);
            corner = row[j + 1];
            row[j + 1] = std::min({corner + 1, row[j] + 1, swapped});
        }
    }
    return row.back();
}

template<typename Number>
bool parse(std::string_view field, Number& value)
{
    if (!field.empty() && field.front() == '+') field.remove_prefix(1);
    Number number{};
    const bool good = parseWhole(field, number);
    if (good) value = number;
    return good;
}

} // namespace

bool LineReader::next()
{
    if (rest_.empty()) return false;
    const void* const newline = std::memchr(rest_.data(), '\n', rest_.size());
    const std::size_t length =
        newline ? std::size_t(static_cast<const char*>(newline) - rest_.data()) : rest_.size();
    line_ = rest_.substr(0, length);
    rest_.remove_prefix(newline ? length + 1 : length);
    if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
    ++number_;
    return true;
}

Fields splitFields(std::string_view line)
{
    Fields fields;
    splitFields(line, fields);
    return fields;
}

void splitFields(std::string_view line, Fields& fields)
{
    fields.clear();
    std::size_t begin = 0;
    while (begin < line.size()) {
        while (begin < line.size() && isBlank(line[begin])) ++begin;
        std::size_t end = begin;
        while (end < line.size() && !isBlank(line[end])) ++end;
        if (fields.size() + 1 == mostFields) end = line.size();
        if (end > begin) fields.push_back(line.substr(begin, end - begin));
        begin = end;
    }
}

bool parseNumber(std::string_view field, double& value)
{
    if (parse(field, value)) return true;
    const std::size_t exponent = field.find_first_of("dD"); // 1.5D+01 of Fortran
    if (exponent == std::string_view::npos || exponent == 0) return false;
    std::string text(field);
    text[exponent] = 'e';
    return parse(std::string_view(text), value);
}

bool parseInteger(std::string_view field, int& value)
{
    return parse(field, value);
}

bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

bool isLetter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::string_view trimmed(std::string_view text)
{
    while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
    while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
    return text;
}

bool isAtomRecord(std::string_view line)
{
    if (line.substr(0, 6) == "HETATM") return true;
    return line.substr(0, 4) == "ATOM" && line.size() > 4 &&
           (isBlank(line[4]) || std::isdigit(static_cast<unsigned char>(line[4])));
}

void refuseMisspeltAtom(const std::string& path, const LineReader& lines)
{
    const std::string_view line = lines.line();
    constexpr std::size_t shortest = 3, longest = 7; // of the words
    std::string word;
    for (const char c : line) {
        if (!std::isalpha(static_cast<unsigned char>(c)) || word.size() > longest) break;
        word += char(std::toupper(static_cast<unsigned char>(c)));
    }
    if (word.size() < shortest || word.size() > longest) return;
    std::string sorted = word;
    std::sort(sorted.begin(), sorted.end());
    const bool turned = sorted == "AMOT"; // "ATMO"
    if (!turned && editDistance(word, "ATOM") > 1 && editDistance(word, "HETATM") > 2) return;
    std::size_t numbers = 0;
    for (const std::string_view field : splitFields(line)) {
        double value = 0.0;
        numbers += field.find('.') != std::string_view::npos && parseNumber(field, value);
    }
    if (numbers >= 3)
        failAtLine(path, lines,
                   "expected ATOM or HETATM before coordinates, got " + inQuotes(line));
}

std::string inQuotes(std::string_view text)
{
    constexpr std::size_t longest = 60;
    std::string shown;
    for (const char c : trimmed(text).substr(0, longest)) {
        shown += static_cast<unsigned char>(c) < ' ' ? '?' : c;
    }
    return "\"" + shown + (trimmed(text).size() > longest ? "...\"" : "\"");
}

std::string joined(const std::vector<std::string>& names, std::size_t longest)
{
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) text += ", ";
        if (i == longest) return text + "...";
        text += names[i];
    }
    return text;
}

std::string displayName(const std::string& path)
{
    return path == "-" ? "standard input" : path;
}

void failAt(const std::string& path, const std::string& what)
{
    throw Error(ErrorKind::Input, displayName(path) + ": " + what);
}

void failBySystem(const std::string& path, const std::string& what)
{
    const int reason = errno;
    throw Error(ErrorKind::Input, displayName(path) + ": " + what + ": " + std::strerror(reason),
                mayPass(reason));
}

void failAtLine(const std::string& path, const LineReader& lines, const std::string& what)
{
    failAt(path, "line " + std::to_string(lines.number()) + ": " + what);
}

} // namespace molsurf
