// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/binary_cif.h"

#include "molsurf/molecule/structure/read_structure.h"
#include "unit/structure/temp_file.h"

#include <nlohmann/json.hpp>

#include <cstring>
#include <set>
#include <string>

namespace molsurf::test
{
namespace
{

using nlohmann::json;

template<typename T>
json bytesOf(const std::vector<T>& values)
{
    std::vector<std::uint8_t> bytes(values.size() * sizeof(T));
    if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return json::binary(std::move(bytes));
}

json byteArray(int type)
{
    return {{"kind", "ByteArray"}, {"type", type}};
}

json column(const std::string& name, json data, json encodings, json mask = nullptr)
{
    return {{"name", name},
            {"data", {{"data", std::move(data)}, {"encoding", std::move(encodings)}}},
            {"mask", std::move(mask)}};
}

/// A file of one category.
std::string fileOf(std::size_t rows, json columns)
{
    const json category{{"name", "_a"}, {"rowCount", rows}, {"columns", std::move(columns)}};
    const json tree{
        {"encoder", "test"},
        {"version", "0.3.0"},
        {"dataBlocks", json::array({{{"header", "X"}, {"categories", json::array({category})}}})}};
    const std::vector<std::uint8_t> bytes = json::to_msgpack(tree);
    return {bytes.begin(), bytes.end()};
}

std::vector<std::string> decoded(std::size_t rows, const json& only)
{
    auto document = decodeBinaryCif(fileOf(rows, json::array({only})), "a.bcif",
                                    [](const std::string&) { return true; });
    return document.blocks.at(0).items.at(0).loop.values;
}

std::string decodeError(std::size_t rows, const json& only)
{
    return errorOf(ErrorKind::Input, [&] { decoded(rows, only); });
}

using Texts = std::vector<std::string>;
const json packedBytes = {
    {"kind", "IntegerPacking"}, {"byteCount", 1}, {"isUnsigned", false}, {"srcSize", 3}};

TEST(BinaryCif, AgreesWithTheMmcifFileOfTheEntry)
{
    const Structure binary = readStructure(dataFile("1a8o.bcif.gz"));
    const Structure text = readStructure(dataFile("1a8o.cif.gz"));
    EXPECT_EQ(binary.format, "BinaryCIF");
    ASSERT_EQ(binary.atoms.size(), text.atoms.size());
    for (std::size_t i = 0; i < text.atoms.size(); ++i) {
        const Atom &a = binary.atoms[i], &b = text.atoms[i];
        EXPECT_EQ(a.position, b.position) << i;
        EXPECT_EQ(a.name, b.name) << i;
        EXPECT_EQ(a.element, b.element) << i;
        EXPECT_EQ(a.residue, b.residue) << i;
        EXPECT_EQ(a.occupancy, b.occupancy) << i;
        EXPECT_EQ(a.bFactor, b.bFactor) << i;
    }
    ASSERT_EQ(binary.residues.size(), text.residues.size());
    for (std::size_t i = 0; i < text.residues.size(); ++i) {
        const Residue &a = binary.residues[i], &b = text.residues[i];
        EXPECT_EQ(a.name, b.name) << i;
        EXPECT_EQ(a.number, b.number) << i;
        EXPECT_EQ(a.hetero(), b.hetero()) << i;
        EXPECT_EQ(a.water(), b.water()) << i;
    }
    EXPECT_EQ(binary.chains, text.chains);
    EXPECT_EQ(binary.asyms, text.asyms);
    ASSERT_EQ(binary.assemblies.size(), 1u);
    ASSERT_EQ(binary.assemblies[0].parts.size(), 1u);
    EXPECT_EQ(binary.assemblies[0].parts[0].chains, text.assemblies[0].parts[0].chains);
    const auto &a = binary.assemblies[0].parts[0].operators[1],
               &b = text.assemblies[0].parts[0].operators[1];
    EXPECT_EQ(a.rotation, b.rotation);
    EXPECT_EQ(a.translation, b.translation);
}

TEST(BinaryCif, DecodesNumbers)
{
    const auto signedBytes = bytesOf<std::int8_t>({127, 127, 3, -128, -1, 5});
    EXPECT_EQ(decoded(3, column("n", signedBytes, {packedBytes, byteArray(1)})),
              (Texts{"257", "-129", "5"}));
    json fixed{{"kind", "FixedPoint"}, {"factor", 1000}, {"srcType", 32}};
    json delta{{"kind", "Delta"}, {"origin", 1000}, {"srcType", 3}};
    EXPECT_EQ(decoded(3, column("n", signedBytes, {fixed, delta, packedBytes, byteArray(1)})),
              (Texts{"1.257", "1.128", "1.133"}));
    const json runs{{"kind", "RunLength"}, {"srcType", 3}, {"srcSize", 3}};
    EXPECT_EQ(decoded(3, column("n", bytesOf<std::int32_t>({-7, 2, 9, 1}), {runs, byteArray(3)})),
              (Texts{"-7", "-7", "9"}));
    const json steps{{"kind", "IntervalQuantization"},
                     {"min", -1.0},
                     {"max", 2.0},
                     {"numSteps", 4},
                     {"srcType", 32}};
    EXPECT_EQ(decoded(3, column("n", bytesOf<std::uint8_t>({0, 1, 3}), {steps, byteArray(4)})),
              (Texts{"-1", "0", "2"}));
    EXPECT_EQ(decoded(2, column("n", bytesOf<float>({0.1f, -2.5f}), json::array({byteArray(32)}))),
              (Texts{"0.1", "-2.5"}));
    EXPECT_EQ(decoded(2, column("n", bytesOf<double>({0.1, 1e300}), json::array({byteArray(33)}))),
              (Texts{"0.1", "1e+300"}));
    EXPECT_EQ(
        decoded(2, column("n", bytesOf<std::uint16_t>({7, 65535}), json::array({byteArray(5)}))),
        (Texts{"7", "65535"}));
}

TEST(BinaryCif, UnsignedIntegersArePackedWithoutALeastOne)
{
    json packing = packedBytes;
    packing["isUnsigned"] = true;
    EXPECT_EQ(decoded(2, column("n", bytesOf<std::uint8_t>({255, 1, 0}), {packing, byteArray(4)})),
              (Texts{"256", "0"}));
}

json texts(const std::vector<std::int32_t>& offsets, const std::vector<std::int8_t>& indices,
           json mask = nullptr)
{
    const json strings{{"kind", "StringArray"},
                       {"stringData", "CAO5'."},
                       {"offsets", bytesOf(offsets)},
                       {"offsetEncoding", json::array({byteArray(3)})},
                       {"dataEncoding", json::array({byteArray(1)})}};
    return column("n", bytesOf(indices), json::array({strings}), std::move(mask));
}

TEST(BinaryCif, DecodesTextsAndMasks)
{
    const json mask{{"data", bytesOf<std::uint8_t>({0, 0, 0, 1, 2})},
                    {"encoding", json::array({byteArray(4)})}};
    EXPECT_EQ(decoded(5, texts({0, 2, 5, 6}, {1, 0, 2, 0, 0}, mask)),
              (Texts{"\"O5'\"", "CA", "'.'", ".", "?"}));
}

TEST(BinaryCif, NamesWhatIsDamaged)
{
    EXPECT_HAS(decodeError(3, texts({0, 2, 5, 6}, {0, 1})), "_a.n: expected 3 rows, got 2");
    EXPECT_HAS(decodeError(1, texts({0, 2, 5, 6}, {3})), "an index is outside");
    EXPECT_HAS(decodeError(1, texts({0, 2, 9, 6}, {1})), "an offset is outside");
    EXPECT_HAS(decodeError(1, texts({0, 2, 1, 6}, {1})), "an offset is outside");
    EXPECT_HAS(
        decodeError(1, column("n", bytesOf<std::int8_t>({127}), {packedBytes, byteArray(1)})),
        "cut short");
    EXPECT_HAS(
        decodeError(1, column("n", bytesOf<std::int8_t>({1, 2, 3}), json::array({byteArray(3)}))),
        "cut short");
    EXPECT_HAS(decodeError(1, column("n", bytesOf<std::int8_t>({1}), json::array({byteArray(9)}))),
               "unknown type 9");
    EXPECT_HAS(decodeError(1, column("n", bytesOf<std::int8_t>({1}), json::array())),
               "no encoding");
    EXPECT_HAS(
        decodeError(1, column("n", bytesOf<std::int8_t>({1}), {{{"kind", "Magic"}}, byteArray(1)})),
        "unknown encoding \"Magic\"");
}

TEST(BinaryCif, RefusesToDecodeToMoreThanItsSizeCanHold)
{
    const json runs{{"kind", "RunLength"}, {"srcType", 3}, {"srcSize", 2000000000}};
    const json bomb = column("n", bytesOf<std::int32_t>({1, 2000000000}), {runs, byteArray(3)});
    EXPECT_HAS(decodeError(2000000000, bomb), "more than a file of its size");
    EXPECT_HAS(decodeError(1, bomb), "more than a file of its size");
}

/// A part of one byte takes sixteen and more as a tree, and a level one of the reader's own calls.
TEST(BinaryCif, RefusesAFileOfTooManyParts)
{
    const auto errorOfBlocks = [](const std::string& blocks) {
        const std::string bytes = "\x81\xaa"
                                  "dataBlocks" +
                                  blocks;
        return errorOf(ErrorKind::Input, [&] {
            decodeBinaryCif(bytes, "a.bcif", [](const std::string&) { return true; });
        });
    };
    EXPECT_HAS(errorOfBlocks(std::string(100000, '\x91')), "nested deeper");
    EXPECT_HAS(errorOfBlocks("\xdd\xff\xff\xff\xff" + std::string(5000001, '\xc0')),
               "more parts than any such file");
}

TEST(BinaryCif, IsReadWholeOrNotAtAll)
{
    std::string whole = fileOf(1, json::array({texts({0, 2, 5, 6}, {0})}));
    ASSERT_TRUE(isBinaryCif(whole));
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const std::string part = whole.substr(0, size);
        EXPECT_HAS(errorOf(ErrorKind::Input,
                           [&] { decodeBinaryCif(part, "a.bcif", [](auto&) { return true; }); }),
                   "a.bcif: is damaged BinaryCIF: its data end too early, at byte ")
            << size;
    }
}

// The words of the library that reads JSON help nobody.
TEST(BinaryCif, SaysWhatIsDamagedInItsOwnWords)
{
    const std::string whole = fileOf(1, json::array({texts({0, 2, 5, 6}, {0})}));
    std::set<std::string> said;
    for (std::size_t place = 0; place < whole.size(); ++place)
        for (const char byte : {'\xc1', '\xc0', '\x00', '\x93'}) {
            std::string changed = whole;
            changed[place] = byte;
            try {
                decodeBinaryCif(changed, "a.bcif", [](auto&) { return true; });
            } catch (const Error& e) {
                said.insert(e.what());
            }
        }
    EXPECT_GT(said.size(), 5u);
    for (const std::string& text : said) EXPECT_EQ(text.find("json"), std::string::npos) << text;
}

} // namespace
} // namespace molsurf::test
