// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/write_vdb.h"

#include "molsurf/error.h"
#include "molsurf/show/io/read_vdb.h"
#include "support/folder.h"
#include "support/surfaces.h"

#include <openvdb/io/Stream.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

namespace molsurf
{
namespace
{

// Same values, same active voxels.
void expectSame(const openvdb::FloatGrid& a, const openvdb::FloatGrid& b)
{
    EXPECT_EQ(a.background(), b.background());
    EXPECT_TRUE(a.tree().hasSameTopology(b.tree()));
    EXPECT_EQ(a.transform(), b.transform());
    for (auto voxel = a.cbeginValueOn(); voxel; ++voxel)
        ASSERT_EQ(*voxel, b.tree().getValue(voxel.getCoord()));
}

TEST(WriteVdb, ReadsBackAsItWas)
{
    const test::Folder folder;
    const auto grid = test::ballGrid();
    openvdb::MetaMap metadata;
    metadata.insertMeta("program", openvdb::StringMetadata("test"));
    metadata.insertMeta("area", openvdb::DoubleMetadata(1.0 / 3.0));
    OutputFile file(folder / "a.vdb", false);
    writeVdb({grid}, metadata, file);
    file.commit();

    const VdbFile back = readVdb(folder / "a.vdb");
    ASSERT_EQ(back.grids.size(), 1u);
    const auto read = openvdb::gridPtrCast<openvdb::FloatGrid>(back.grids[0]);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->getName(), "surface");
    EXPECT_EQ(read->getGridClass(), openvdb::GRID_LEVEL_SET);
    expectSame(*grid, *read);
    EXPECT_EQ(read->tree().getValue(openvdb::Coord(0, 3, -2)), -read->background()); // deep inside
    EXPECT_EQ(back.metadata.metaValue<std::string>("program"), "test");
    EXPECT_EQ(back.metadata.metaValue<double>("area"), 1.0 / 3.0);
    EXPECT_EQ(read->metaValue<std::string>("file_compression"), "active values");
}

// Labels and colours become small by it, distances do not.
TEST(WriteVdb, CompressesFilesWithLabels)
{
    const test::Folder folder;
    const auto grid = test::ballGrid();
    const auto labels = openvdb::Int32Grid::create(-1);
    labels->setName("atom_id");
    labels->tree().topologyUnion(grid->tree());
    OutputFile file(folder / "a.vdb", false);
    writeVdb({grid, labels}, openvdb::MetaMap(), file);
    file.commit();
    const VdbFile back = readVdb(folder / "a.vdb");
    ASSERT_EQ(back.grids.size(), 2u);
    expectSame(*grid, *openvdb::gridPtrCast<openvdb::FloatGrid>(back.grids[0]));
    for (const auto& read : back.grids)
        EXPECT_EQ(read->metaValue<std::string>("file_compression"), "blosc + active values");
}

// Half floats have 11 significant bits, and signs stay what they are.
TEST(WriteVdb, HalfFloatsAreWithinTheirRounding)
{
    const test::Folder folder;
    const auto grid = test::ballGrid();
    const auto write = [&](const std::string& name) {
        OutputFile file(folder / name, false);
        writeVdb({grid}, openvdb::MetaMap(), file);
        file.commit();
        return double(std::filesystem::file_size(folder / name));
    };
    const double whole = write("whole.vdb");
    grid->setSaveFloatAsHalf(true);
    const double active = double(grid->activeVoxelCount());
    EXPECT_NEAR(whole - write("half.vdb"), 2.0 * active, 0.05 * active);
    const VdbFile back = readVdb(folder / "half.vdb");
    const auto& read = *openvdb::gridPtrCast<openvdb::FloatGrid>(back.grids.at(0));
    EXPECT_TRUE(read.saveFloatAsHalf());
    ASSERT_TRUE(grid->tree().hasSameTopology(read.tree()));
    float worst = 0.0f;
    for (auto voxel = grid->cbeginValueOn(); voxel; ++voxel) {
        const float value = read.tree().getValue(voxel.getCoord());
        ASSERT_EQ(value < 0.0f, *voxel < 0.0f);
        if (*voxel != 0.0f) worst = std::max(worst, std::abs(value / *voxel - 1.0f));
    }
    EXPECT_LE(worst, 0.0005f);
    EXPECT_GT(worst, 0.0f);
}

TEST(WriteVdb, ErrorIfTheDiskIsFull)
{
    OutputFile file("-", false);
    std::ofstream full("/dev/full");
    if (!full) GTEST_SKIP() << "no /dev/full";
    std::streambuf* before = file.stream().rdbuf(full.rdbuf());
    try {
        writeVdb({test::ballGrid()}, openvdb::MetaMap(), file);
        ADD_FAILURE() << "expected an Error";
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Output);
        EXPECT_NE(std::string(e.what()).find("No space left"), std::string::npos) << e.what();
    }
    file.stream().exceptions(std::ios_base::goodbit);
    file.stream().rdbuf(before);
    file.stream().clear();
}

// The head is read in two parts, and a text may lie in both.
TEST(VdbText, IsFoundWhereverItLiesInTheHead)
{
    const test::Folder folder;
    const auto counted = [](const std::string& text) {
        const auto size = std::uint32_t(text.size());
        return std::string(reinterpret_cast<const char*>(&size), sizeof size) + text;
    };
    constexpr std::size_t firstPart = 1 << 14;
    const std::string value(64, 'v');
    const std::string entry = counted("frames.options") + counted("string") + counted(value);
    for (const std::size_t before : {std::size_t(0), firstPart - entry.size(), firstPart - 50,
                                     firstPart - 20, firstPart - 1, firstPart, 3 * firstPart}) {
        std::ofstream(folder / "a.vdb", std::ios::binary)
            << std::string(before, '.') << entry << std::string(100, '.');
        EXPECT_EQ(vdbText(folder / "a.vdb", "frames.options"), value) << before;
        EXPECT_EQ(vdbText(folder / "a.vdb", "options"), "") << before;
    }
}

TEST(ReadVdb, RefusesWhatIsNoVdbFile)
{
    const test::Folder folder;
    std::ofstream(folder / "text.vdb") << "hello";
    std::ofstream(folder / "empty.vdb");
    {
        OutputFile file(folder / "good.vdb", false);
        writeVdb({test::ballGrid()}, openvdb::MetaMap(), file);
        file.commit();
    }
    const std::string good = test::contentOf(folder / "good.vdb");
    std::ofstream(folder / "cut.vdb") << good.substr(0, good.size() / 2);
    for (const char* name : {"none.vdb", ".", "text.vdb", "empty.vdb", "cut.vdb"}) {
        try {
            readVdb(folder / name);
            ADD_FAILURE() << name << ": expected an Error";
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::Input);
            EXPECT_NE(std::string(e.what()).find(folder / name), std::string::npos) << e.what();
        }
    }
}

/// A file of a ball, with packed values.
std::string packedFile(const test::Folder& folder)
{
    std::ofstream file(folder / "packed.vdb", std::ios::binary);
    openvdb::io::Stream stream(file);
    stream.setCompression(openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK);
    const openvdb::GridBase::Ptr ball = test::ballGrid()->deepCopyGrid();
    ball->setGridClass(openvdb::GRID_UNKNOWN); // level sets are not packed
    stream.write(openvdb::GridCPtrVec{ball});
    file.close();
    return test::contentOf(folder / "packed.vdb");
}

void expectDamaged(const test::Folder& folder, const std::string& bytes, const char* why)
{
    std::ofstream(folder / "damaged.vdb", std::ios::binary) << bytes;
    try {
        readVdb(folder / "damaged.vdb");
        ADD_FAILURE() << "expected an Error: " << why;
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Input);
        EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
    }
}

// OpenVDB would read as many bytes into the array of a leaf as stand before its values.
TEST(ReadVdb, RefusesValuesThatAreTooManyForTheirLeaf)
{
    const test::Folder folder;
    std::string bytes = packedFile(folder);
    std::int64_t size = 1; // of the last leaf's values, before which it stands
    for (std::int64_t found = 0;; ++size) {
        std::memcpy(&found, &bytes[bytes.size() - std::size_t(size) - sizeof found], sizeof found);
        if (std::abs(found) == size) break; // below 0 if they are few and not packed
    }
    const std::int64_t much = -1'000'000;
    std::memcpy(&bytes[bytes.size() - std::size_t(size) - sizeof much], &much, sizeof much);
    bytes.resize(bytes.size() + 1'000'000);
    expectDamaged(folder, bytes, "values of another length");
}

// A text of 4 GB would be made before the file is found too short.
TEST(ReadVdb, RefusesLengthsBeyondTheFile)
{
    const test::Folder folder;
    const std::string good = packedFile(folder);
    for (const char* word : {"surface", "Tree_float_5_4_3", "class", "UniformScaleMap"}) {
        std::string bytes = good;
        const std::uint32_t much = 0xf0000000;
        std::memcpy(&bytes[bytes.find(word) - sizeof much], &much, sizeof much);
        expectDamaged(folder, bytes, "a length in it is wrong");
    }
}

TEST(ReadVdb, DamagedBytesDoNoHarm)
{
    const test::Folder folder;
    const std::string good = packedFile(folder);
    std::mt19937 random(5);
    for (int i = 0; i < 300; ++i) {
        std::string bytes = good;
        bytes[random() % bytes.size()] = char(random());
        std::ofstream(folder / "damaged.vdb", std::ios::binary) << bytes;
        try {
            readVdb(folder / "damaged.vdb");
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::Input);
        }
    }
}

} // namespace
} // namespace molsurf
