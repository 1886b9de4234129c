// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/membrane.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/molecule/structure/read_structure.h"

#include <gtest/gtest.h>
#include <openvdb/math/Quat.h>

#include <cmath>
#include <string>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

/// Lines of a PDB file.
class Lines
{
public:
    explicit Lines(double angle = 0.0)
        : turn_(openvdb::math::Quat<double>(Vec3d(0.6, 0.8, 0.0), angle))
    {
    }

    void add(const char* name, const char* residue, int number, const Vec3d& place)
    {
        const Vec3d x = turn_ * place;
        text_ += formatted("HETATM%5d  %-3s %3s A%4d    %8.3f%8.3f%8.3f  1.00  0.00           %c\n",
                           ++serial_ % 100000, name, residue, number, x[0], x[1], x[2], name[0]);
    }

    BallSet read() const
    {
        SelectOptions options;
        options.hetero = Hetero::All;
        return selectBalls(parseStructure(text_ + "END\n", "a.pdb"), options);
    }

    Vec3d turned(const Vec3d& x) const { return turn_ * x; }

private:
    openvdb::Mat3d turn_;
    std::string text_;
    int serial_ = 0;
};

double degreesBetween(const Vec3d& a, const Vec3d& b)
{
    return std::acos(std::min(1.0, a.dot(b))) * 180.0 / M_PI;
}

TEST(Membrane, IsThatOfDummies)
{
    Lines lines(0.9);
    lines.add("CA", "ALA", 1, {0, 0, 0});
    int number = 1;
    for (int i = -3; i <= 3; ++i)
        for (int j = -1; j <= 1; ++j)
            for (const double z : {-15.4, 15.4})
                lines.add(z < 0.0 ? "N" : "O", "DUM", ++number, {4.0 * i, 4.0 * j, z});
    const BallSet atoms = lines.read();
    EXPECT_EQ(atoms.balls.size(), 1u);
    ASSERT_TRUE(atoms.record.membrane);
    EXPECT_LT(degreesBetween(*atoms.record.membrane, lines.turned({0, 0, 1})), 0.1);
}

/// Two leaves of lipids, or lipids that lie in all directions.
Lines lipids(double angle, bool flat, bool twoHeads = false, int count = 40)
{
    Lines lines(angle);
    for (int n = 0; n < count; ++n) {
        const double z = 1.0 - (2.0 * n + 1.0) / 40.0, across = std::sqrt(1.0 - z * z);
        Vec3d way(across * std::cos(2.4 * n), across * std::sin(2.4 * n), z); // from the middle
        if (flat) way = Vec3d(0.2 * way[0], 0.2 * way[1], n % 2 ? 1.0 : -1.0).unit();
        const Vec3d middle = flat ? Vec3d(8.0 * (n / 2 % 5), 8.0 * (n / 10), 0.0) : Vec3d(0.0);
        lines.add("P", "POP", n + 1, middle + 20.0 * way);
        if (twoHeads) lines.add("P", "POP", n + 1, middle + 19.0 * way);
        for (int k = 1; k < 8; ++k) lines.add("C1", "POP", n + 1, middle + (20.0 - 2.0 * k) * way);
    }
    return lines;
}

TEST(Membrane, IsThatOfLipids)
{
    const Lines lines = lipids(0.4, true);
    const BallSet atoms = lines.read();
    ASSERT_TRUE(atoms.record.membrane);
    EXPECT_LT(degreesBetween(*atoms.record.membrane, lines.turned({0, 0, 1})), 3.0);
    EXPECT_FALSE(lipids(0.4, false).read().record.membrane);
}

TEST(Membrane, NeedsLipidsOfOneHead)
{
    EXPECT_FALSE(lipids(0.4, true, true).read().record.membrane);
}

TEST(Membrane, NeedsSixteenLipids)
{
    EXPECT_FALSE(lipids(0.4, true, false, 15).read().record.membrane);
    const Lines lines = lipids(0.4, true, false, 16);
    ASSERT_TRUE(lines.read().record.membrane);
    EXPECT_LT(degreesBetween(*lines.read().record.membrane, lines.turned({0, 0, 1})), 5.0);
}

// Planes of dummies that are nearer to each other than 10 Å are of no membrane.
TEST(Membrane, OfDummiesIsTenAngstromThick)
{
    for (const double half : {4.9, 5.1}) {
        Lines lines;
        lines.add("CA", "ALA", 1, {0, 0, 0});
        int number = 1;
        for (const double z : {-half, half})
            for (int i = 0; i < 4; ++i)
                lines.add(z < 0.0 ? "N" : "O", "DUM", ++number, {4.0 * i, 3.0 * (i % 2), z});
        EXPECT_EQ(bool(lines.read().record.membrane), half > 5.0) << half;
    }
}

TEST(Membrane, OfAProteinIsNone)
{
    EXPECT_FALSE(readAtoms(std::string(MOLSURF_TEST_DATA) + "/1crn.pdb").record.membrane);
}

} // namespace
} // namespace molsurf
