// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// JSON that is written and read by one list of the members of a type:
///
///     template<typename Rows>
///     void members(Rows& rows, PlanInput& file)
///     {
///         rows("path", file.path);
///         rows("bytes", file.bytes);
///     }
///
/// makes an object; rows(file.path) without a name makes the next element of an array. Numbers that
/// are read are checked by jsonNumber().

#include "molsurf/show/io/json_number.h"

#include <nlohmann/json.hpp>
#include <openvdb/openvdb.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace molsurf
{

/// Elements of small vectors, and of pairs.
template<typename Rows>
void members(Rows& rows, openvdb::Vec3d& v)
{
    for (int k = 0; k < 3; ++k) rows(v[k]);
}

template<typename Rows>
void members(Rows& rows, openvdb::Coord& c)
{
    for (int k = 0; k < 3; ++k) rows(c[k]);
}

template<typename Rows, typename A, typename B>
void members(Rows& rows, std::pair<A, B>& pair)
{
    rows(pair.first);
    rows(pair.second);
}

/// The parts of what members() lists, as they are written.
class JsonWriter
{
public:
    using Json = nlohmann::ordered_json;

    template<typename T>
    void operator()(const char* name, const T& value)
    {
        json_[name] = jsonOf(value);
    }
    template<typename T>
    void operator()(const T& value)
    {
        json_.push_back(jsonOf(value));
    }
    /// Whether there is a part: here, if the value has it.
    bool has(const char*, bool there) const { return there; }

    template<typename T>
    static Json jsonOf(const T& value)
    {
        if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
            return value;
        } else {
            JsonWriter writer;
            writer.put(value);
            return std::move(writer.json_);
        }
    }

private:
    template<typename T>
    void put(const std::optional<T>& value)
    {
        if (value) json_ = jsonOf(*value);
    }
    template<typename T>
    void put(const std::vector<T>& values)
    {
        json_ = Json::array();
        for (const auto& value : values) (*this)(value);
    }
    template<typename T, std::size_t count>
    void put(const std::array<T, count>& values)
    {
        for (const T& value : values) (*this)(value);
    }
    template<typename T>
    void put(const std::map<std::string, T>& values)
    {
        json_ = Json::object();
        for (const auto& [name, value] : values) (*this)(name.c_str(), value);
    }
    template<typename T>
    void put(const T& value)
    {
        members(*this, const_cast<T&>(value)); // nothing here writes to it
    }

    Json json_; ///< null as long as it has no part
};

/// The parts of what members() lists, as they are read.
class JsonReader
{
public:
    using Json = nlohmann::json; // finds a key of many soon

    explicit JsonReader(const Json& json) : json_(json) {}

    /// @throws std::range_error for a number that does not fit
    /// @throws nlohmann::json::exception if there is no such part, or it is of another kind
    template<typename T>
    void operator()(const char* name, T& value)
    {
        get(json_.at(name), value);
    }
    template<typename T>
    void operator()(T& value)
    {
        get(json_.at(next_++), value);
    }
    /// Whether there is a part: here, if the text has it.
    bool has(const char* name, bool) const { return json_.contains(name); }

    template<typename T>
    static T valueOf(const Json& json)
    {
        T value{};
        get(json, value);
        return value;
    }

private:
    template<typename T>
    static void get(const Json& json, std::optional<T>& value)
    {
        if (json.is_null())
            value.reset();
        else
            get(json, value.emplace());
    }
    template<typename T>
    static void get(const Json& json, std::vector<T>& values)
    {
        values.clear();
        for (const auto& [key, element] : json.items()) values.push_back(valueOf<T>(element));
    }
    template<typename T, std::size_t count>
    static void get(const Json& json, std::array<T, count>& values)
    {
        JsonReader elements(json);
        for (T& value : values) elements(value);
    }
    template<typename T>
    static void get(const Json& json, std::map<std::string, T>& values)
    {
        values.clear();
        for (const auto& [name, value] : json.get_ref<const Json::object_t&>())
            get(value, values[name]);
    }
    template<typename T>
    static void get(const Json& json, T& value)
    {
        if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string>) {
            value = json.get<T>();
        } else if constexpr (std::is_arithmetic_v<T>) {
            value = jsonNumber<T>(json);
        } else {
            JsonReader reader(json);
            members(reader, value);
        }
    }

    const Json& json_;
    std::size_t next_ = 0;
};

/// The text of a value.
/// @param[in] indent  spaces a level; below 0: one line
template<typename T>
std::string jsonText(const T& value, int indent)
{
    return JsonWriter::jsonOf(value).dump(indent, ' ', false,
                                          nlohmann::ordered_json::error_handler_t::replace);
}

} // namespace molsurf
