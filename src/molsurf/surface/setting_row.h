// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// A row of the tables of options of pictures and files.

#include "molsurf/kernel/core/strings.h"
#include "molsurf/settings.h"
#include "molsurf/surface/set_value.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

/// An option of files that sets a member of `To`.
template<typename To>
struct SettingRow {
    const char* name;
    const char* value; ///< its name in help texts; null: the option is a switch
    std::string text;  ///< of help, with names of options in backticks
    std::string preset;
    unsigned shownIn;               ///< files that show it, a set of holds::Content
    std::vector<std::string> words; ///< that it takes; empty: others
    /// @param[in] values  at least one, but for a switch
    /// @throws Error(ErrorKind::Usage) if it is wrong
    std::function<void(To& to, const std::vector<std::string>& values)> set;
    /// Its value as metadata of a file; null: it is not stored.
    std::function<SettingValue(const To& of)> get = nullptr;
};

/// The texts of a row.
struct RowTexts {
    const char *name, *value;
    std::string text, preset;
};

/// The numbers that a row takes, also in words.
struct NumberRange {
    double low, high;
    const char* words;
};

/// The row of a number.
template<typename To, typename Of>
SettingRow<To> numberRow(RowTexts texts, unsigned shownIn, const NumberRange& range, const Of& of)
{
    return {texts.name,
            texts.value,
            std::move(texts.text),
            std::move(texts.preset),
            shownIn,
            {},
            numberSetter(texts.name, range.low, range.high, range.words, of)};
}

/// The row of a switch.
template<typename To, typename Of>
SettingRow<To> switchRow(const char* name, std::string text, unsigned shownIn, const Of& of)
{
    return {name,
            nullptr,
            std::move(text),
            "",
            shownIn,
            {},
            [of](To& to, const std::vector<std::string>&) { of(to) = true; }};
}

/// The row with its value stored in files.
template<typename To, typename Of>
SettingRow<To> stored(SettingRow<To> row, const Of& of)
{
    row.get = [of](const To& from) { return SettingValue(of(from)); };
    return row;
}

/// The row of one of a few values that nameOf() names, the first of them the default.
template<typename To, typename Of, typename Enum>
SettingRow<To> wordRow(const char* name, std::string text, unsigned shownIn,
                       const std::vector<Enum>& choices, const Of& of,
                       const std::vector<Synonyms>& others = {})
{
    SettingRow<To> row{name,
                       "WORD",
                       std::move(text),
                       nameOf(choices.front()),
                       shownIn,
                       {},
                       wordSetter(name, choices, of, others)};
    for (const Enum choice : choices) row.words.push_back(nameOf(choice));
    return row;
}

/// The row of a name; null: there is none.
template<typename To>
const SettingRow<To>* findRow(const std::vector<SettingRow<To>>& rows, const std::string& name)
{
    for (const SettingRow<To>& row : rows)
        if (row.name == name) return &row;
    return nullptr;
}

} // namespace molsurf
