// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/core/strings.h"

#include <algorithm>
#include <charconv>
#include <cstdarg>
#include <cstdio>
#include <numeric>

namespace molsurf
{

std::string shortest(double number)
{
    char digits[32];
    return std::string(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

std::string formatted(const char* form, ...)
{
    va_list values, again;
    va_start(values, form);
    va_copy(again, values);
    std::string text(std::size_t(std::vsnprintf(nullptr, 0, form, values)), ' ');
    std::vsnprintf(text.data(), text.size() + 1, form, again);
    va_end(again);
    va_end(values);
    return text;
}

std::string sizeText(double bytes)
{
    constexpr double mebi = 1 << 20, gibi = 1 << 30, few = 999.5; // of three digits
    return bytes < few * mebi ? formatted("%.3g MiB", bytes / mebi)
                              : formatted("%.3g GiB", bytes / gibi);
}

std::string lowered(std::string text)
{
    for (char& letter : text)
        if (letter >= 'A' && letter <= 'Z') letter = char(letter - 'A' + 'a');
    return text;
}

std::vector<std::string> splitWords(const std::string& list)
{
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        words.push_back(list.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

std::string joinWords(const std::vector<std::string>& words, const char* between)
{
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : between) + word;
    return all;
}

std::string counted(std::size_t count, const std::string& one, const std::string& many)
{
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string inLines(const std::vector<std::string>& words)
{
    constexpr std::size_t width = 62;
    std::string all, line;
    for (const std::string& word : words) {
        if (!line.empty() && line.size() + word.size() > width) {
            all += line + "\n";
            line.clear();
        }
        line += word + ",";
    }
    all += line;
    all.pop_back();
    return all;
}

std::string wrapped(const std::string& text, std::size_t width)
{
    std::string out;
    std::size_t column = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
        if (column > 0) {
            const bool fits = column + 1 + end - begin <= width;
            out += fits ? ' ' : '\n';
            column = fits ? column + 1 : 0;
        }
        out.append(text, begin, end - begin);
        column += end - begin;
        if (end < text.size() && text[end] == '\n') {
            out += '\n';
            column = 0;
        }
        begin = end + 1;
    }
    return out;
}

std::string didYouMean(const std::string& typed, const std::vector<std::string>& words)
{
    const auto distance = [](const std::string& a, const std::string& b) { // Levenshtein's
        std::vector<std::size_t> row(b.size() + 1);
        std::iota(row.begin(), row.end(), std::size_t(0));
        for (std::size_t i = 1; i <= a.size(); ++i) {
            std::size_t diagonal = row[0]++;
            for (std::size_t j = 1; j <= b.size(); ++j) {
                const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
                diagonal = row[j];
                row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
            }
        }
        return row.back();
    };
    std::string best;
    std::size_t least = std::max<std::size_t>(1, typed.size() / 3) + 1;
    for (const std::string& word : words) {
        const std::size_t d = distance(lowered(typed), lowered(word));
        const bool begins = typed.size() >= 3 && word.rfind(lowered(typed), 0) == 0;
        if (d < least || (begins && best.empty())) {
            least = std::min(least, d);
            best = word;
        }
    }
    return best.empty() ? "" : meant(best);
}

std::string meant(const std::string& words)
{
    return " [hint: did you mean " + words + "?]";
}

std::string meaningOf(const std::string& typed, const std::vector<Synonyms>& known)
{
    const std::string word = ' ' + lowered(typed) + ' ';
    for (const Synonyms& row : known)
        if ((' ' + std::string(row.words) + ' ').find(word) != std::string::npos) return row.meant;
    return "";
}

std::string didYouMean(const std::string& typed, const std::vector<std::string>& words,
                       const std::vector<Synonyms>& known)
{
    const std::string meaning = meaningOf(typed, known);
    return meaning.empty() ? didYouMean(typed, words) : meant(meaning);
}

bool isModestJson(std::string_view text)
{
    constexpr int deepest = 64;
    constexpr std::size_t longest = 1 << 20, perComma = 4;
    int depth = 0;
    bool quoted = false;
    std::size_t begin = 0, commas = 0; // of the text, or of what is between two signs
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (i - begin > longest) return false;
        const char c = text[i];
        if (quoted && c == '\\') ++i;
        if (c == '"') quoted = !quoted;
        if (quoted && c != '"') continue;
        if (c == '[' || c == '{') ++depth;
        if (c == ']' || c == '}') --depth;
        if (depth > deepest) return false;
        if (c == ',') ++commas;
        if (std::string_view(" \t\r\n[]{},:\"").find(c) != std::string_view::npos) begin = i;
    }
    return text.size() - begin <= longest &&
           (text.size() <= longest || commas * perComma < text.size());
}

} // namespace molsurf
