// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/read_xtc.h"

#include "molsurf/molecule/structure/read_structure.h"
#include "unit/structure/temp_file.h"

#include <cmath>

namespace molsurf::test
{
namespace
{

constexpr double rounding = 0.00501; // Å, of the usual precision of 1000 for a nanometre

using Positions = std::vector<openvdb::Vec3d>;

double farthest(const std::vector<openvdb::Vec3f>& found, const Positions& expected)
{
    double worst = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        for (int a = 0; a < 3; ++a) worst = std::max(worst, std::abs(found[i][a] - expected[i][a]));
    return worst;
}

std::string unhex(const std::string& digits)
{
    std::string out;
    for (std::size_t i = 0; i < digits.size(); i += 2)
        out += char(std::stoi(digits.substr(i, 2), nullptr, 16));
    return out;
}

std::string bigEndian(std::uint64_t value, int bytes)
{
    std::string out;
    while (bytes-- > 0) out += char(value >> 8 * bytes & 255);
    return out;
}

/// 12 atoms at 1e-6 Å, too far apart for coordinates of 24 bits, written by GROMACS 2022.5.
const std::string apart = unhex("000007cb0000000c000000000000000000000000000000000000000000000000"
                                "00000000000000000000000000000000000000000000000c4b18968002623ea8"
                                "faa27700fed8d96803b835a0fbe8ca1000a9bd22000000480000007462a5ea00"
                                "0000351f9c1096ccea081e9d0d6a9208e209b94a2d6ed63309231fb30345288a"
                                "7cd0842e591880d2d0c2f795205ae58408378420a27e0bea0c87af0a8270a240"
                                "d4f788a329885ddc52155f6f84dcfec5e47be0bbd9d83b95e87438ee87533e44"
                                "dbe582e53600d731d487681000000000");
const Positions apartPositions = {
    {52.923, -90.016, 8.509},  {39.993, -81.846, 1.354},  {45.970, -85.759, -5.275},
    {58.408, -86.587, 2.651},  {55.038, -88.289, -6.898}, {45.950, -88.939, -10.788},
    {52.486, -73.902, -9.109}, {53.950, -68.630, 5.262},  {62.404, -79.817, 5.372},
    {52.304, -82.206, 11.124}, {47.674, -79.826, -7.199}, {54.096, -72.268, -19.343}};
constexpr std::size_t lengthAt = 88; // of the packed coordinates, in a frame

/// The models of the PDB file that GROMACS made the trajectory from.
TEST(ReadXtc, FramesAreTheModels)
{
    const Structure models = readStructure(dataFile("1d3z.pdb.gz"));
    const auto file = openTrajectory(dataFile("1d3z.xtc"));
    ASSERT_EQ(file->frames(), 3u);
    ASSERT_EQ(file->atoms(), 1231u);
    for (std::size_t frame : {2u, 0u, 1u}) {
        const Model& model = models.models[frame];
        ASSERT_EQ(model.end - model.begin, file->atoms());
        Positions expected;
        for (std::size_t i = model.begin; i < model.end; ++i)
            expected.push_back(models.atoms[i].position);
        EXPECT_LT(farthest(file->read(frame), expected), rounding) << "frame " << frame;
    }
}

TEST(ReadXtc, FineCoordinates)
{
    const TempFile file("t.xtc", apart);
    EXPECT_LT(farthest(XtcFile(file.path()).read(0), apartPositions), 6e-6);
}

/// GROMACS writes this kind for more than 298 million atoms.
TEST(ReadXtc, LengthOfEightBytes)
{
    const std::string wide = bigEndian(2023, 4) + apart.substr(4, lengthAt - 4) + bigEndian(0, 4) +
                             apart.substr(lengthAt);
    const TempFile file("t.xtc", wide + wide);
    const auto opened = openTrajectory(file.path());
    EXPECT_EQ(opened->frames(), 2u);
    EXPECT_LT(farthest(opened->read(1), apartPositions), 6e-6);
}

/// Up to nine atoms are stored as they are.
TEST(ReadXtc, FewAtoms)
{
    const std::string header =
        bigEndian(1995, 4) + bigEndian(2, 4) + std::string(44, '\0') + bigEndian(2, 4);
    // 0.25, -1.5, 3 and 1, 2, -0.125 nm
    const TempFile file("t.xtc", header + unhex("3e800000bfc0000040400000"
                                                "3f80000040000000be000000"));
    XtcFile opened(file.path());
    EXPECT_EQ(opened.frames(), 1u);
    EXPECT_LT(farthest(opened.read(0), {{2.5, -15.0, 30.0}, {10.0, 20.0, -1.25}}), 1e-9);
    const TempFile notNumbers("t.xtc", header + unhex("7fc00000bfc0000040400000"
                                                      "3f80000040000000be000000"));
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { XtcFile(notNumbers.path()).read(0); }),
               "frame 1: atom 1: expected coordinates");
}

TEST(ReadXtc, WrongFiles)
{
    const std::string whole = contentOf(dataFile("1d3z.xtc"));
    const auto refused = [](const std::string& content) {
        const TempFile file("t.xtc", content);
        return errorOf(ErrorKind::Input, [&] {
            const auto opened = openTrajectory(file.path());
            for (std::size_t i = 0; i < opened->frames(); ++i) opened->read(i);
        });
    };
    for (std::size_t less : {1u, 100u, 4000u})
        EXPECT_HAS(refused(whole.substr(0, whole.size() - less)), "cut short within frame 3");
    for (std::size_t size : {4u, 10u, 60u, 90u, 95u})
        EXPECT_HAS(refused(whole.substr(0, size)), "cut short within frame 1");
    EXPECT_HAS(refused(apart + whole), "frame 2: expected the 12 atoms of the first, got 1231");
    EXPECT_HAS(refused(apart + "nothing" + std::string(100, ' ')), "frame 2: expected the mark");
    EXPECT_HAS(refused(bigEndian(1995, 4) + std::string(96, '\0')), "expected a number of atoms");
    EXPECT_HAS(refused(""), "expected a trajectory");
    EXPECT_HAS(refused("nothing at all"), "expected a trajectory");
    std::string damaged = apart;
    damaged.replace(60, 12, apart.substr(72, 12)); // the least are the greatest, and the other
    damaged.replace(72, 12, apart.substr(60, 12)); // way round
    EXPECT_HAS(refused(damaged), "frame 1: is damaged");
    // The packed coordinates are fewer than the atoms.
    damaged = apart.substr(0, lengthAt) + bigEndian(40, 4) + apart.substr(lengthAt + 4, 40);
    EXPECT_HAS(refused(damaged), "frame 1: is damaged");
}

/// Whatever byte is wrong, there is an answer or an error.
/// The number of atoms would take 10 GB.
TEST(ReadXtc, MoreAtomsThanTheFileCanHold)
{
    std::string many = apart;
    const std::string count = bigEndian(1u << 28, 4);
    many.replace(4, 4, count).replace(52, 4, count);
    const TempFile file("a.xtc", many);
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { openTrajectory(file.path()); }),
               "coordinates of 268435456 atoms");
}

TEST(ReadXtc, DamagedFilesDoNoHarm)
{
    const std::string frames = contentOf(dataFile("1d3z.xtc"));
    const std::string first = frames.substr(0, frames.find(frames.substr(0, 8), 8));
    int errors = 0, answers = 0;
    for (const std::string& content : {first, apart})
        for (std::size_t at = 0; at < std::min<std::size_t>(content.size(), 400); ++at)
            for (char flip : {'\x01', '\x10', '\x80', '\xff'}) {
                std::string other = content;
                other[at] = char(other[at] ^ flip);
                const TempFile file("t.xtc", other);
                try {
                    const auto opened = openTrajectory(file.path());
                    EXPECT_EQ(opened->read(0).size(), opened->atoms());
                    ++answers;
                } catch (const Error& error) {
                    EXPECT_EQ(error.kind(), ErrorKind::Input);
                    ++errors;
                }
            }
    EXPECT_GT(errors, 100);
    EXPECT_GT(answers, 100);
}

} // namespace
} // namespace molsurf::test
