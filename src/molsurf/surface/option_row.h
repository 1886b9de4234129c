// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Rows of options by the type of their value. `of` gives the variable of a target that a row sets:
/// MOLSURF_OF(options.voxel).

#include "molsurf/kernel/core/strings.h"
#include "molsurf/settings.h"
#include "molsurf/surface/set_value.h"

#include <string>
#include <utility>
#include <vector>

namespace molsurf
{

/// The texts of a row.
struct RowTexts {
    const char *name, *value;
    std::string text, preset = "";
};

/// The numbers that a row takes, also in words.
struct NumberRange {
    double low, high;
    const char* words;
};

/// The row of a value that a setter reads.
/// @param[in] set  of a target and its values
template<typename To, typename Set>
OptionRow<To> valueRow(RowTexts texts, SettingType type, const Set& set)
{
    return {texts.name, type, texts.value, std::move(texts.text), std::move(texts.preset), {}, set};
}

/// The row of a number in a range.
template<typename To, typename Of>
OptionRow<To> numberRow(RowTexts texts, const NumberRange& range, const Of& of)
{
    const auto set = numberSetter(texts.name, range.low, range.high, range.words, of);
    return valueRow<To>(std::move(texts), SettingType::Number, set);
}

/// The row of a whole number in a range.
template<typename To, typename Of>
OptionRow<To> countRow(RowTexts texts, int low, int high, const Of& of)
{
    const auto set = countSetter(texts.name, low, high, of);
    return valueRow<To>(std::move(texts), SettingType::Whole, set);
}

/// The row of a switch.
/// @param[in] on  what it sets
template<typename To, typename Of, typename T = bool>
OptionRow<To> switchRow(const char* name, std::string text, const Of& of, T on = T(true))
{
    return valueRow<To>({name, nullptr, std::move(text)}, SettingType::Switch,
                        [of, on](To& to, const std::vector<std::string>&) { of(to) = on; });
}

/// The row of any text.
template<typename To, typename Of>
OptionRow<To> textRow(RowTexts texts, const Of& of)
{
    return valueRow<To>(
        std::move(texts), SettingType::Text,
        [of](To& to, const std::vector<std::string>& values) { of(to) = values.back(); });
}

/// The row of one of a few values that nameOf() names, the first of them the default.
template<typename To, typename Of, typename Enum>
OptionRow<To> wordRow(const char* name, std::string text, const std::vector<Enum>& choices,
                      const Of& of, const std::vector<Synonyms>& others = {})
{
    auto row = valueRow<To>({name, "WORD", std::move(text), nameOf(choices.front())},
                            SettingType::Word, wordSetter(name, choices, of, others));
    for (const Enum choice : choices) row.words.push_back(nameOf(choice));
    return row;
}

/// The row of values that a parser reads one by one.
/// @param[in] parse  changes the target by one of them
template<typename To, typename Parse>
OptionRow<To> rulesRow(RowTexts texts, const Parse& parse)
{
    return valueRow<To>(std::move(texts), SettingType::Rules,
                        [parse](To& to, const std::vector<std::string>& values) {
                            for (const std::string& value : values) parse(to, value);
                        });
}

/// The row with the formats that show it.
template<typename Row>
Row shownIn(unsigned formats, Row row)
{
    row.shownIn = formats;
    return row;
}

/// The row with its value stored in files.
template<typename To, typename Of>
OptionRow<To> stored(OptionRow<To> row, const Of& of)
{
    row.get = [of](const To& from) { return SettingValue(of(from)); };
    return row;
}

/// The row with more than its type says.
template<typename Row, typename Change>
Row with(Row row, const Change& change)
{
    change(row);
    return row;
}

/// The row of a file that is read, whose path is its value.
template<typename Row>
Row ofFile(Row row)
{
    row.file = [](const std::string& value) { return std::string_view(value); };
    return row;
}

/// The row of what had another name before.
template<typename Row>
Row renamed(const char* former, Row row)
{
    row.former = former;
    return row;
}

/// The row of a name, or of one of before; null: there is none.
template<typename To>
const OptionRow<To>* findRow(const std::vector<OptionRow<To>>& rows, const std::string& name)
{
    for (const OptionRow<To>& row : rows)
        if (row.isNamed(name)) return &row;
    return nullptr;
}

} // namespace molsurf
