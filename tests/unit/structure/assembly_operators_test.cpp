// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/assembly_operators.h"
#include "unit/structure/temp_file.h"

namespace molsurf::test
{
namespace
{

using Lists = std::vector<std::vector<std::string>>;

Operator translation(double x, double y, double z)
{
    Operator op{};
    for (std::size_t i = 0; i < 3; ++i) op.rotation[i][i] = 1;
    op.translation = openvdb::Vec3d(x, y, z);
    return op;
}

/// Quarter turn about z: (x, y, z) -> (-y, x, z).
Operator quarterTurn()
{
    Operator op{};
    op.rotation[0][1] = -1;
    op.rotation[1][0] = 1;
    op.rotation[2][2] = 1;
    return op;
}

TEST(OperatorExpression, ParsesListsRangesAndProducts)
{
    EXPECT_EQ(parseOperatorExpression("1"), (Lists{{"1"}}));
    EXPECT_EQ(parseOperatorExpression("1,2,5-9"), (Lists{{"1", "2", "5", "6", "7", "8", "9"}}));
    EXPECT_EQ(parseOperatorExpression("(X0)(1-3)"), (Lists{{"X0"}, {"1", "2", "3"}}));
    EXPECT_EQ(parseOperatorExpression(" ( P , 2 ) (4) "), (Lists{{"P", "2"}, {"4"}}));
    EXPECT_EQ(parseOperatorExpression("(1-60)(61-88)")[1].size(), 28u);
    EXPECT_EQ(parseOperatorExpression("helix-1"), (Lists{{"helix-1"}}));
}

TEST(OperatorExpression, RefusesWhatDoesNotParse)
{
    for (const char* text :
         {"", "1,", "(1-3", "(1)2", "()", "9-5", "1-99999999", "-2147483648-2147483647"}) {
        EXPECT_HAS(errorOf(ErrorKind::Input, [&] { parseOperatorExpression(text); }),
                   "operator expression");
    }
}

TEST(OperatorExpression, TheRightFactorActsFirst)
{
    const std::map<std::string, Operator> list{{"T", translation(1, 0, 0)}, {"R", quarterTurn()}};
    const std::vector<Operator> turnThenShift = expandOperators("(T)(R)", list);
    const std::vector<Operator> shiftThenTurn = expandOperators("(R)(T)", list);
    ASSERT_EQ(turnThenShift.size(), 1u);
    EXPECT_EQ(turnThenShift[0].translation, openvdb::Vec3d(1, 0, 0));
    EXPECT_EQ(shiftThenTurn[0].translation, openvdb::Vec3d(0, 1, 0));
    EXPECT_EQ(shiftThenTurn[0].rotation[0][1], -1);
}

TEST(OperatorExpression, LastFactorVariesFastest)
{
    std::map<std::string, Operator> list;
    for (int i = 1; i <= 3; ++i) list[std::to_string(i)] = translation(i, 0, 0);
    for (int i = 4; i <= 5; ++i) list[std::to_string(i)] = translation(0, i, 0);
    const std::vector<Operator> all = expandOperators("(1-3)(4,5)", list);
    ASSERT_EQ(all.size(), 6u);
    EXPECT_EQ(all[1].translation, openvdb::Vec3d(1, 5, 0));
    EXPECT_EQ(all[4].translation, openvdb::Vec3d(3, 4, 0));
}

TEST(OperatorExpression, RefusesUnknownOperatorsAndTooManyProducts)
{
    std::map<std::string, Operator> list;
    for (int i = 1; i <= 1001; ++i) list[std::to_string(i)] = translation(0, 0, 0);
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { expandOperators("(1)(X)", list); }),
               "operator \"X\" is not listed");
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { expandOperators("(1-1001)(1-1001)", list); }),
               "more than 100000 products");
    std::string repeated = "1-99999"; // 6 KB that would become 32 GB of names
    for (int i = 0; i < 1000; ++i) repeated += ",1-99999";
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { parseOperatorExpression(repeated); }),
               "more than 100000 operators");
}

TEST(Remark350, ReadsSeveralBlocksOfChains)
{
    const std::vector<Assembly> assemblies = parseRemark350({
        "REMARK 350 BIOMOLECULE: 1",
        "REMARK 350 APPLY THE FOLLOWING TO CHAINS: A, B,",
        "REMARK 350                    AND CHAINS: C",
        "REMARK 350   BIOMT1   1  1.000000  0.000000  0.000000        0.00000",
        "REMARK 350   BIOMT2   1  0.000000  1.000000  0.000000        0.00000",
        "REMARK 350   BIOMT3   1  0.000000  0.000000  1.000000        0.00000",
        "REMARK 350 APPLY THE FOLLOWING TO CHAINS: NULL",
        "REMARK 350   BIOMT1   1  0.000000 -1.000000  0.000000       10.00000",
        "REMARK 350   BIOMT2   1  1.000000  0.000000  0.000000       20.00000",
        "REMARK 350   BIOMT3   1  0.000000  0.000000  1.000000      -30.00000",
        "REMARK 350 BIOMOLECULE: 2",
        "REMARK 350 APPLY THE FOLLOWING TO CHAINS: A",
        "REMARK 350   BIOMT1   1  1.000000  0.000000  zero            0.00000",
    });
    ASSERT_EQ(assemblies.size(), 2u);
    EXPECT_EQ(assemblies[0].name, "1");
    ASSERT_EQ(assemblies[0].parts.size(), 2u);
    EXPECT_EQ(assemblies[0].parts[0].chains, (std::vector<std::string>{"A", "B", "C"}));
    EXPECT_EQ(assemblies[0].parts[1].chains, (std::vector<std::string>{""}));
    EXPECT_EQ(assemblies[0].parts[1].operators[0].rotation[0][1], -1);
    EXPECT_EQ(assemblies[0].parts[1].operators[0].translation, openvdb::Vec3d(10, 20, -30));
    EXPECT_TRUE(assemblies[0].problem.empty());
    EXPECT_HAS(assemblies[1].problem, "BIOMT");
}

TEST(Remark350, WithoutAListOfChainsAppliesToAll)
{
    const std::vector<Assembly> assemblies = parseRemark350({
        "REMARK 350   BIOMT1   1  1.000000  0.000000  0.000000        0.00000",
        "REMARK 350   BIOMT2   1  0.000000  1.000000  0.000000        0.00000",
        "REMARK 350   BIOMT3   1  0.000000  0.000000  1.000000        0.00000",
    });
    ASSERT_EQ(assemblies.size(), 1u);
    EXPECT_EQ(assemblies[0].name, "1");
    EXPECT_TRUE(assemblies[0].parts[0].chains.empty());
}

TEST(AssemblyOperators, ProductsAreNamedAsTheFileNamesThem)
{
    Operator a{}, b{};
    a.name = "X0";
    b.name = "61";
    EXPECT_EQ(multiplied(a, b).name, "(X0)(61)");
    EXPECT_EQ(multiplied(multiplied(a, b), b).name, "(X0)(61)(61)");
    EXPECT_EQ(expandOperators("(1)(2)", {{"1", a}, {"2", b}}).at(0).name, "(X0)(61)");
    EXPECT_EQ(expandOperators("2", {{"2", b}}).at(0).name, "61");
}

} // namespace
} // namespace molsurf::test
