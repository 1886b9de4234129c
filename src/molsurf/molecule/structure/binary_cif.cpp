// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/binary_cif.h"

#include "molsurf/error.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <nlohmann/json.hpp>

#include <charconv>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace molsurf
{
namespace
{

using nlohmann::json;

[[noreturn]] void damaged(const std::string& what)
{
    throw std::runtime_error(what);
}

/// An error in words of BinaryCIF, and not of the library that reads it.
std::string reasonOf(const std::exception& error)
{
    const bool ofLibrary = dynamic_cast<const json::exception*>(&error) != nullptr;
    return ofLibrary ? "a part is missing, or of another type than it should be" : error.what();
}

/// Makes a tree of what the reader of MessagePack finds; it refuses what is nested deeper than any
/// BinaryCIF file, for the reader calls itself for each level, and what has more parts, for each
/// takes far more memory than its byte.
class TreeBuilder : public nlohmann::json_sax<json>
{
public:
    bool null() override { return add(nullptr); }
    bool boolean(bool v) override { return add(v); }
    bool number_integer(json::number_integer_t v) override { return add(v); }
    bool number_unsigned(json::number_unsigned_t v) override { return add(v); }
    bool number_float(json::number_float_t v, const json::string_t&) override { return add(v); }
    bool string(json::string_t& v) override { return add(std::move(v)); }
    bool binary(json::binary_t& v) override { return add(std::move(v)); }
    bool start_object(std::size_t) override { return open(json::object()); }
    bool start_array(std::size_t) override { return open(json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(json::string_t& v) override
    {
        key_ = std::move(v);
        return true;
    }
    bool parse_error(std::size_t position, const std::string&, const json::exception& e) override
    {
        constexpr int atEnd = 110; // of the library's errors
        damaged((e.id == atEnd ? "its data end too early, at byte "
                               : "expected MessagePack, got something else at byte ") +
                std::to_string(position));
    }

    json root;

private:
    json& put(json&& value)
    {
        constexpr std::size_t most = 5000000; // 1A8O with 574 columns has 16,021
        if (++parts_ == most) damaged("it has more parts than any such file");
        if (open_.empty()) return root = std::move(value);
        json& parent = *open_.back();
        if (parent.is_object()) return parent[key_] = std::move(value);
        parent.push_back(std::move(value));
        return parent.back();
    }
    bool add(json&& value)
    {
        put(std::move(value));
        return true;
    }
    bool open(json&& value)
    {
        constexpr std::size_t deepest = 32;
        if (open_.size() == deepest) damaged("it is nested deeper than any such file");
        open_.push_back(&put(std::move(value)));
        return true;
    }
    bool close()
    {
        open_.pop_back();
        return true;
    }

    std::vector<json*> open_;
    std::string key_;
    std::size_t parts_ = 0;
};

/// A column on its way from bytes to texts: one of the lists.
struct Values {
    enum class Kind { Bytes, Integers, Floats, Doubles, Texts } kind = Kind::Bytes;
    std::string bytes;
    std::vector<std::int64_t> integers;
    std::vector<double> numbers; ///< of Floats, too, which have the digits of single precision
    std::vector<std::string> texts;

    std::size_t size() const
    {
        return kind == Kind::Integers ? integers.size()
               : kind == Kind::Texts  ? texts.size()
                                      : numbers.size();
    }
};

/// The number of values that all columns of a file may still decode to.
struct Allowance {
    std::size_t left;

    void take(std::size_t count)
    {
        if (count > left) damaged("it would decode to more than a file of its size can hold");
        left -= count;
    }
};

template<typename T>
void readBytes(const std::string& bytes, Values& to)
{
    if (bytes.size() % sizeof(T) != 0) damaged("an array of numbers is cut short");
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(T)) {
        T value;
        std::memcpy(&value, &bytes[at], sizeof(T)); // little-endian, as this machine is
        if constexpr (std::is_integral_v<T>)
            to.integers.push_back(value);
        else
            to.numbers.push_back(value);
    }
}

void decodeByteArray(const json& encoding, Values& values)
{
    if (values.kind != Values::Kind::Bytes) damaged("ByteArray: expected bytes");
    using Kind = Values::Kind;
    struct Type {
        int code;
        Kind kind;
        void (*read)(const std::string&, Values&);
    };
    static const Type types[] = {{1, Kind::Integers, readBytes<std::int8_t>},
                                 {2, Kind::Integers, readBytes<std::int16_t>},
                                 {3, Kind::Integers, readBytes<std::int32_t>},
                                 {4, Kind::Integers, readBytes<std::uint8_t>},
                                 {5, Kind::Integers, readBytes<std::uint16_t>},
                                 {6, Kind::Integers, readBytes<std::uint32_t>},
                                 {32, Kind::Floats, readBytes<float>},
                                 {33, Kind::Doubles, readBytes<double>}};
    const int code = encoding.at("type").get<int>();
    for (const Type& type : types) {
        if (type.code != code) continue;
        type.read(values.bytes, values);
        values.bytes.clear();
        values.kind = type.kind;
        return;
    }
    damaged("ByteArray: unknown type " + std::to_string(code));
}

void expectIntegers(const Values& values, const char* encoding)
{
    if (values.kind != Values::Kind::Integers)
        damaged(std::string(encoding) + ": expected integers");
}

/// Integers to numbers by a function.
template<typename Function>
void toNumbers(const char* name, Values& values, Function function)
{
    expectIntegers(values, name);
    values.numbers.reserve(values.integers.size());
    for (const std::int64_t i : values.integers) values.numbers.push_back(function(double(i)));
    values.integers.clear();
    values.kind = Values::Kind::Doubles;
}

void decodeFixedPoint(const json& encoding, Values& values)
{
    const double factor = encoding.at("factor").get<double>();
    if (!(factor != 0.0)) damaged("FixedPoint: the factor is 0");
    toNumbers("FixedPoint", values, [=](double i) { return i / factor; });
}

void decodeIntervalQuantization(const json& encoding, Values& values)
{
    const double low = encoding.at("min").get<double>(), high = encoding.at("max").get<double>();
    const double steps = encoding.at("numSteps").get<double>();
    if (!(steps > 1.0)) damaged("IntervalQuantization: expected at least 2 steps");
    toNumbers("IntervalQuantization", values,
              [=](double i) { return low + i * (high - low) / (steps - 1.0); });
    for (double& number : values.numbers) number = double(float(number));
    values.kind = Values::Kind::Floats;
}

void decodeRunLength(Values& values, Allowance& allowance)
{
    expectIntegers(values, "RunLength");
    if (values.integers.size() % 2 != 0) damaged("RunLength: expected pairs of value and length");
    std::vector<std::int64_t> out;
    for (std::size_t i = 0; i < values.integers.size(); i += 2) {
        const std::int64_t length = values.integers[i + 1];
        if (length < 0) damaged("RunLength: a length is negative");
        allowance.take(std::size_t(length));
        out.insert(out.end(), std::size_t(length), values.integers[i]);
    }
    values.integers = std::move(out);
}

void decodeDelta(const json& encoding, Values& values)
{
    expectIntegers(values, "Delta");
    auto sum = std::uint64_t(encoding.at("origin").get<std::int64_t>()); // wraps if it is damaged
    for (std::int64_t& value : values.integers) value = std::int64_t(sum += std::uint64_t(value));
}

/// Sums up runs of small integers: all but the last of a run are the largest or least that fits.
void decodeIntegerPacking(const json& encoding, Values& values)
{
    expectIntegers(values, "IntegerPacking");
    const int bytes = encoding.at("byteCount").get<int>();
    if (bytes != 1 && bytes != 2) damaged("IntegerPacking: expected 1 or 2 bytes");
    const bool isUnsigned = encoding.at("isUnsigned").get<bool>();
    const std::int64_t top = (std::int64_t(1) << (8 * bytes - !isUnsigned)) - 1;
    const std::int64_t bottom = isUnsigned ? -1 : -top - 1; // none is -1 of those without a sign
    std::vector<std::int64_t> out;
    std::uint64_t sum = 0; // wraps if it is damaged
    bool open = false;
    for (const std::int64_t value : values.integers) {
        sum += std::uint64_t(value);
        open = value == top || value == bottom;
        if (open) continue;
        out.push_back(std::int64_t(sum));
        sum = 0;
    }
    if (open) damaged("IntegerPacking: the last integer is cut short");
    values.integers = std::move(out);
}

Values decode(const json& data, Allowance& allowance);

std::vector<std::int64_t> integersOf(const json& bytes, const json& encodings, Allowance& allowance)
{
    Values values = decode(json{{"data", bytes}, {"encoding", encodings}}, allowance);
    expectIntegers(values, "StringArray");
    return std::move(values.integers);
}

/// Texts by an index each: they lie one after the other in one text, between offsets.
void decodeStringArray(const json& encoding, Values& values, Allowance& allowance)
{
    if (values.kind != Values::Kind::Bytes) damaged("StringArray: expected bytes");
    const std::string text = encoding.at("stringData").get<std::string>();
    const std::vector<std::int64_t> offsets =
        integersOf(encoding.at("offsets"), encoding.at("offsetEncoding"), allowance);
    const json::binary_t bytes(
        json::binary_t::container_type(values.bytes.begin(), values.bytes.end()));
    const std::vector<std::int64_t> indices =
        integersOf(bytes, encoding.at("dataEncoding"), allowance);
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const std::int64_t least = i == 0 ? 0 : offsets[i - 1];
        if (offsets[i] < least || offsets[i] > std::int64_t(text.size()))
            damaged("StringArray: an offset is outside of the texts");
    }
    values.texts.reserve(indices.size());
    for (const std::int64_t index : indices) {
        if (index < 0) { // no value
            values.texts.emplace_back();
            continue;
        }
        if (index + 1 >= std::int64_t(offsets.size()))
            damaged("StringArray: an index is outside of the texts");
        const std::size_t begin = std::size_t(offsets[std::size_t(index)]);
        values.texts.push_back(
            text.substr(begin, std::size_t(offsets[std::size_t(index) + 1]) - begin));
    }
    values.bytes.clear();
    values.kind = Values::Kind::Texts;
}

/// Undoes the encodings of an array, the last one first.
Values decode(const json& data, Allowance& allowance)
{
    Values values;
    const json::binary_t& bytes = data.at("data").get_binary();
    values.bytes.assign(bytes.begin(), bytes.end());
    const json& encodings = data.at("encoding");
    for (auto at = encodings.rbegin(); at != encodings.rend(); ++at) {
        const std::string kind = at->at("kind").get<std::string>();
        if (kind == "ByteArray")
            decodeByteArray(*at, values);
        else if (kind == "FixedPoint")
            decodeFixedPoint(*at, values);
        else if (kind == "IntervalQuantization")
            decodeIntervalQuantization(*at, values);
        else if (kind == "RunLength")
            decodeRunLength(values, allowance);
        else if (kind == "Delta")
            decodeDelta(*at, values);
        else if (kind == "IntegerPacking")
            decodeIntegerPacking(*at, values);
        else if (kind == "StringArray")
            decodeStringArray(*at, values, allowance);
        else
            damaged("unknown encoding " + inQuotes(kind));
    }
    if (values.kind == Values::Kind::Bytes) damaged("an array has no encoding");
    return values;
}

/// A number with the fewest digits that give it back in its precision.
template<typename Number>
std::string fewestDigits(Number number)
{
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

/// A column as the texts that stand in an mmCIF file.
std::vector<std::string> textsOf(const json& column, std::size_t rows, Allowance& allowance)
{
    allowance.take(rows);
    const Values values = decode(column.at("data"), allowance);
    std::vector<std::int64_t> mask; // 0: a value, 1: "." (not applicable), 2: "?" (unknown)
    if (column.contains("mask") && !column["mask"].is_null())
        mask = integersOf(column["mask"].at("data"), column["mask"].at("encoding"), allowance);
    if (values.size() != rows || (!mask.empty() && mask.size() != rows))
        damaged("expected " + std::to_string(rows) + " rows, got " + std::to_string(values.size()));
    std::vector<std::string> out;
    out.reserve(rows);
    for (std::size_t i = 0; i < rows; ++i) {
        if (!mask.empty() && mask[i] != 0)
            out.emplace_back(mask[i] == 1 ? "." : "?");
        else if (values.kind == Values::Kind::Texts)
            out.push_back(gemmi::cif::quote(values.texts[i]));
        else if (values.kind == Values::Kind::Integers)
            out.push_back(std::to_string(values.integers[i]));
        else if (values.kind == Values::Kind::Floats)
            out.push_back(fewestDigits(float(values.numbers[i])));
        else
            out.push_back(fewestDigits(values.numbers[i]));
    }
    return out;
}

void addCategory(const json& category, gemmi::cif::Block& block, Allowance& allowance)
{
    const auto rows = category.at("rowCount").get<std::size_t>();
    const json& columns = category.at("columns");
    if (rows == 0 || columns.empty()) return;
    block.items.emplace_back(gemmi::cif::LoopArg{});
    gemmi::cif::Loop& loop = block.items.back().loop;
    std::vector<std::vector<std::string>> texts;
    for (const json& column : columns) {
        loop.tags.push_back(category.at("name").get<std::string>() + "." +
                            column.at("name").get<std::string>());
        try {
            texts.push_back(textsOf(column, rows, allowance));
        } catch (const std::exception& error) {
            damaged(loop.tags.back() + ": " + reasonOf(error));
        }
    }
    loop.values.reserve(rows * texts.size());
    for (std::size_t row = 0; row < rows; ++row)
        for (auto& column : texts) loop.values.push_back(std::move(column[row]));
}

} // namespace

bool isBinaryCif(const std::string& bytes)
{
    if (bytes.empty() || (static_cast<unsigned char>(bytes[0]) & 0xf0) != 0x80) return false;
    const std::string_view head = std::string_view(bytes).substr(0, 4096);
    return head.find("encoder") != std::string_view::npos ||
           head.find("dataBlocks") != std::string_view::npos;
}

gemmi::cif::Document decodeBinaryCif(const std::string& bytes, const std::string& path,
                                     const std::function<bool(const std::string&)>& isWanted)
{
    constexpr std::size_t valuesOfAByte = 16; // files of the Protein Data Bank have 1 to 3
    Allowance allowance{valuesOfAByte * bytes.size()};
    gemmi::cif::Document document;
    try {
        TreeBuilder tree;
        json::sax_parse(bytes, &tree, json::input_format_t::msgpack);
        for (const json& from : tree.root.at("dataBlocks")) {
            document.blocks.emplace_back(from.at("header").get<std::string>());
            for (const json& category : from.at("categories"))
                if (isWanted(category.at("name").get<std::string>()))
                    addCategory(category, document.blocks.back(), allowance);
        }
    } catch (const std::exception& error) {
        failAt(path, "is damaged BinaryCIF: " + reasonOf(error) + " [copy or download it again]");
    }
    return document;
}

} // namespace molsurf
