// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Reads the values of options.

#include "molsurf/core/error.h"

#include <boost/program_options/variables_map.hpp>

#include <charconv>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

namespace molsurf::tool
{

/// @throws Error(ErrorKind::Usage)
[[noreturn]] inline void misuse(const std::string& message)
{
    throw Error(ErrorKind::Usage, message);
}

inline std::string join(const std::vector<std::string>& words, const char* between)
{
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : between) + word;
    return all;
}

/// The values of the options, by name. Numbers are read strictly: all of the word, and finite.
class Values
{
public:
    Values(const boost::program_options::variables_map& map, std::vector<std::string> order)
        : map_(map), order_(std::move(order))
    {
    }

    // Where the command line has the n-th value of an option; 0 if it came from elsewhere.
    std::size_t position(const std::string& name, std::size_t n = 0) const
    {
        for (std::size_t i = 0; i < order_.size(); ++i) {
            if (order_[i] == name && n-- == 0) return i + 1;
        }
        return 0;
    }

    bool on(const char* name) const { return map_.count(name) && map_[name].as<bool>(); }
    bool given(const char* name) const { return map_.count(name) && !map_[name].defaulted(); }

    // Leaves `value` alone if the option was not given.
    void get(const char* name, std::string& value) const
    {
        if (!map_.count(name)) return;
        value = map_[name].as<std::string>();
        if (value.empty()) misuse("--" + std::string(name) + ": expected a value, got none");
    }

    void get(const char* name, double& value) const
    {
        if (map_.count(name)) value = number<double>(name, "a number");
    }

    void get(const char* name, int& value, int least, int most) const
    {
        if (!map_.count(name)) return;
        const std::string range =
            "a whole number from " + std::to_string(least) + " to " + std::to_string(most);
        value = number<int>(name, range);
        if (value < least || value > most) wrong(name, range);
    }

    // One of a few words.
    template<typename Enum>
    void get(const char* name, Enum& value, std::initializer_list<Enum> choices) const
    {
        pick(name, value, choices);
    }

    template<typename Enum, std::size_t n>
    void get(const char* name, Enum& value, const Enum (&choices)[n]) const
    {
        pick(name, value, choices);
    }

    std::vector<std::string> list(const char* name) const
    {
        if (!map_.count(name)) return {};
        return map_[name].as<std::vector<std::string>>();
    }

    [[noreturn]] void wrong(const char* name, const std::string& expected) const
    {
        misuse("--" + std::string(name) + ": expected " + expected + ", got '" +
               map_[name].as<std::string>() + "'");
    }

private:
    template<typename Enum, typename Choices>
    void pick(const char* name, Enum& value, const Choices& choices) const
    {
        if (!map_.count(name)) return;
        const std::string word = map_[name].as<std::string>();
        std::vector<std::string> words;
        for (Enum choice : choices) {
            if (word == nameOf(choice)) {
                value = choice;
                return;
            }
            words.push_back(nameOf(choice));
        }
        wrong(name, join(words, " or "));
    }

    template<typename T>
    T number(const char* name, const std::string& expected) const
    {
        const std::string& word = map_[name].as<std::string>();
        T value{};
        const char* end = word.data() + word.size();
        const auto [stop, failure] = std::from_chars(word.data(), end, value);
        if (failure != std::errc() || stop != end || !std::isfinite(double(value)))
            wrong(name, expected);
        return value;
    }

    const boost::program_options::variables_map& map_;
    std::vector<std::string> order_; // names of the options on the command line
};

} // namespace molsurf::tool
