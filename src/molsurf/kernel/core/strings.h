// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Words that people type: lists, numbers and near misses.

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace molsurf
{

/// The text in small letters of ASCII.
std::string lowered(std::string text);

/// The words between commas.
std::vector<std::string> splitWords(const std::string& list);

std::string joinWords(const std::vector<std::string>& words, const char* between);

/// Words with commas between, in lines for a help text.
std::string inLines(const std::vector<std::string>& words);

/// TextCursor in a line of the help text of an option.
constexpr std::size_t helpWidth = 58;

/// Text in lines of at most `width` letters; lines that it has already stay.
std::string wrapped(const std::string& text, std::size_t width);

/// Reads a number that is the whole of a text.
/// @param[out] value  undefined if it is none
template<typename T>
bool parseWhole(std::string_view text, T& value)
{
    const char* end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data(), end, value);
    return problem == std::errc() && stop == end;
}

/// A number with the fewest digits that give it back.
std::string shortest(double number);

/// Whether a JSON text is one of those that take their parser no more than a few times their
/// memory: no deeper than 64, no text or number above 1 MiB, and beyond 1 MiB less than a comma for
/// each 4 bytes. Whether it is valid is not asked.
bool isModestJson(std::string_view text);

/// "1 atom", "2 atoms".
std::string counted(std::size_t count, const std::string& one, const std::string& many);

/// A size of memory or of a file in its unit, three digits: "57.3 MiB", "1.21 GiB".
std::string sizeText(double bytes);

/// Text by a form as of printf().
__attribute__((format(printf, 1, 2))) std::string formatted(const char* form, ...);

/// " [hint: did you mean WORDS?]".
std::string meant(const std::string& words);

/// meant() for the word nearest to what was typed; empty if none is near.
std::string didYouMean(const std::string& typed, const std::vector<std::string>& words);

/// Words of other programs, with blanks between, and what is meant by them here.
struct Synonyms {
    const char* words;
    const char* meant;
};

/// What is meant by a word of another program; empty: it is not known.
std::string meaningOf(const std::string& typed, const std::vector<Synonyms>& known);

/// As above; what is meant by a word of another program comes before the nearest word.
std::string didYouMean(const std::string& typed, const std::vector<std::string>& words,
                       const std::vector<Synonyms>& known);

} // namespace molsurf
