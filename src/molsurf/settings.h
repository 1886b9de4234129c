// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The options of atoms and surfaces by name, a row each: command lines, help texts and keywords of
/// other languages are made of these rows.

#include "molsurf/atoms.h"
#include "molsurf/options.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace molsurf
{

/// The options that the rows set.
struct Settings {
    SelectOptions atoms;
    LabelOptions labels;
    PlaceOptions places; ///< Molecule::places() makes those of `options` of them
    SurfaceOptions options;
    std::optional<GroupBy> colorGroups; ///< what has colours that are no ColorBy: those of groups
                                        ///< that are made for them
    std::string colorGroupsFile; ///< of the groups that ColorBy::FileGroup shows; resolveGroups()
                                 ///< reads it

    /// Whether copies of an assembly, which nodes place, have colours.
    bool colorsCopies() const
    {
        return colorGroups && colorGroups->kind == GroupBy::Kind::Copy && atoms.assembly.repeats();
    }
};

/// The value of a setting, as it is written into files.
using SettingValue = std::variant<bool, std::int64_t, double, std::string>;

/// Type of the value of a setting, written as text.
enum class SettingType {
    Switch, ///< There is none: it is on or off.
    Whole,  ///< a whole number
    Number, ///< a number
    Text,   ///< any text
    Word,   ///< one of Setting::words
    List,   ///< words or numbers with commas between
    Rules   ///< a text each of several values
};

/// The part of Settings that a setting changes.
enum class SettingOf {
    Balls,    ///< SelectOptions: which atoms are used, or how large their balls are
    Molecule, ///< LabelOptions and PlaceOptions: questions to the molecule
    Surface   ///< SurfaceOptions
};

/// An option that sets something of a `To`. The options of a base are those of what derives from
/// it, too. Its name is that of the command line: "fill-cavities".
template<typename To>
struct OptionRow {
    const char* name;
    SettingType type;
    const char* value;  ///< what stands for its value in a help text; null for a switch
    std::string text;   ///< what it does; names others in backticks, as Error does; '\n' starts a
                        ///< new line
    std::string preset; ///< the default for people; empty for none
    std::vector<std::string> words = {}; ///< values that are words, or the beginnings of values
    /// Sets it; several values are for SettingType::Rules alone, and none is for a switch.
    /// @throws Error(ErrorKind::Usage) for a value that it cannot have
    std::function<void(To&, const std::vector<std::string>& values)> set = nullptr;
    /// Its value as metadata of a file; null: it is not stored.
    std::function<SettingValue(const To&)> get = nullptr;
    double low = std::numeric_limits<double>::quiet_NaN();  ///< least and largest number; not a
    double high = std::numeric_limits<double>::quiet_NaN(); ///< number: see the text
    SettingOf of = SettingOf::Surface;
    std::vector<SurfaceKind> kinds = {}; ///< the surfaces that it changes; empty: all
    unsigned shownIn = 0; ///< the formats that show it, a set of holds::Content; 0: it is no matter
                          ///< of formats
    /// The part of a value that is the path of a file to read; empty: the value names none. Null:
    /// no value does.
    std::function<std::string_view(const std::string& value)> file = nullptr;
    const char* former = nullptr; ///< a name that it had before, which is taken as well; null: none
    char letter = 0;              ///< of the command line, 'o'; 0: none
    unsigned verbs = 0;           ///< of the command line that take it

    bool isNamed(const std::string& word) const
    {
        return word == name || (former && word == former);
    }

    bool repeats() const { return type == SettingType::Rules; }

    /// The same option of what derives from `To`.
    template<typename Derived, typename = std::enable_if_t<std::is_base_of_v<To, Derived> &&
                                                           !std::is_same_v<To, Derived>>>
    operator OptionRow<Derived>() const
    {
        return {name, type, value, text,    preset, words,  set,    get,  low,
                high, of,   kinds, shownIn, file,   former, letter, verbs};
    }
};

/// An option of atoms, labels, places or surfaces.
using Setting = OptionRow<Settings>;

/// All of them.
const std::vector<Setting>& settingTable();

} // namespace molsurf
