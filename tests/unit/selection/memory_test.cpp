// SPDX-License-Identifier: MPL-2.0
// Atoms of files that are in memory.

#include "molsurf/atoms.h"
#include "unit/structure/temp_file.h"

namespace molsurf::test
{
namespace
{

TEST(Memory, GivesTheAtomsOfTheFile)
{
    for (const char* file : {"1crn.pdb", "1a8o.cif.gz"}) {
        const BallSet fromFile = readAtoms(dataFile(file));
        const BallSet fromMemory = readAtoms(FileContent{"text", contentOf(dataFile(file))});
        ASSERT_EQ(fromFile.balls.size(), fromMemory.balls.size());
        for (std::size_t i = 0; i < fromFile.balls.size(); ++i) {
            EXPECT_EQ(fromFile.balls[i].center, fromMemory.balls[i].center);
            EXPECT_EQ(fromFile.balls[i].radius, fromMemory.balls[i].radius);
        }
    }
}

TEST(Memory, ErrorsNameWhatTheyAreGiven)
{
    const auto message = [](FileContent file, std::size_t most) {
        SelectOptions select;
        select.limits.maxInput = most;
        try {
            readAtoms(std::move(file), select);
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::Input);
            return std::string(e.what());
        }
        return std::string("taken");
    };
    EXPECT_EQ(message({"my text", " \n"}, 0), "my text: is empty");
    EXPECT_EQ(message({"my text", contentOf(dataFile("1a8o.cif.gz")).substr(0, 99)}, 0)
                  .find("my text: is cut"),
              0u);
    EXPECT_EQ(message({"my text", contentOf(dataFile("1crn.pdb"))}, 99)
                  .find("my text: expected at most 99"),
              0u);
}

} // namespace
} // namespace molsurf::test
