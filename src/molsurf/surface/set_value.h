// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Setters of values from words that a person typed: functions of a target and its values, for
/// tables of options. `of` gives the variable of a target that is set.

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/options.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace molsurf
{

/// Gives the variable of a target: MOLSURF_OF(options.voxel).
#define MOLSURF_OF(variable)                                                                       \
    [](auto& target) -> auto&                                                                      \
    {                                                                                              \
        return target.variable;                                                                    \
    }

/// The name of an option as errors have it: "max-input" is `maxInput`.
std::string memberName(const std::string& option);

/// @throws Error(ErrorKind::Usage)
[[noreturn]] void wrongValue(const std::string& option, const std::string& expected,
                             const std::string& got, const std::string& hint = "");

/// A number that is the whole of a word.
/// @throws Error(ErrorKind::Usage) if the word is none
template<typename T>
T parsedValue(const std::string& option, const std::string& expected, const std::string& word)
{
    T value{};
    if (!parseWhole(word, value) || !std::isfinite(double(value)))
        wrongValue(option, expected, word);
    return value;
}

/// The colour of a word.
/// @param[in] more  what else the option takes
/// @throws Error(ErrorKind::Usage) if the word is none
std::array<std::uint8_t, 3> colorValue(const std::string& option, const std::string& more,
                                       const std::string& word);

/// The colours whose word is enough to ask for them.
std::vector<ColorBy> completeColors();

/// Their words for a help text, but that of none, with what it adds to them.
std::vector<std::string> colorHelp();

/// "4G", "500M": bytes. K, M, G and T are powers of 1024.
/// @throws Error(ErrorKind::Usage) if the text is no size
std::size_t sizeValue(const std::string& option, const std::string& text);

/// A whole number in a range.
template<typename Of>
auto countSetter(const std::string& option, int low, int high, const Of& of)
{
    return [=](auto& target, const std::vector<std::string>& values) {
        const std::string range =
            "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
        of(target) = parsedValue<int>(option, range, values.back());
        if (of(target) < low || of(target) > high) wrongValue(option, range, values.back());
    };
}

/// A number in a range.
/// @param[in] range  in words: "0.05 to 10 Å"
template<typename Of>
auto numberSetter(const std::string& option, double low, double high, const std::string& range,
                  const Of& of)
{
    return [=](auto& target, const std::vector<std::string>& values) {
        const double given = parsedValue<double>(option, range, values.back());
        if (!(given >= low && given <= high)) wrongValue(option, range, values.back());
        of(target) = given;
    };
}

/// One of a few values that nameOf() names.
/// @param[in] hint  for the error, of the word that was typed and of those that may be
template<typename Of, typename Enum, typename Hint>
auto hintedWordSetter(const std::string& option, const std::vector<Enum>& choices, const Of& of,
                      const Hint& hint)
{
    return [=](auto& target, const std::vector<std::string>& values) {
        std::vector<std::string> words;
        for (const Enum choice : choices) {
            words.push_back(nameOf(choice));
            if (lowered(values.back()) != words.back()) continue;
            of(target) = choice;
            return;
        }
        wrongValue(option, joinWords(words, " or "), values.back(), hint(values.back(), words));
    };
}

/// One of a few values that nameOf() names.
/// @param[in] others  further words and what is meant by them, for the hint of an error
template<typename Of, typename Enum>
auto wordSetter(const std::string& option, const std::vector<Enum>& choices, const Of& of,
                const std::vector<Synonyms>& others = {})
{
    return hintedWordSetter(option, choices, of,
                            [=](const std::string& typed, const std::vector<std::string>& words) {
                                return didYouMean(typed, words, others);
                            });
}

} // namespace molsurf
