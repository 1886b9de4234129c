// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/detect_format.h"
#include "unit/structure/temp_file.h"

namespace molsurf::test
{
namespace
{

const std::string pdbAtom =
    "ATOM      1  N   PRO     1      -7.107  15.915   5.611  1.00  1.00      PROA    \n";
const std::string bareAtom = "ATOM      1  N   PRO A   1      -7.107  15.915   5.611  1.00  1.00\n";
const std::string pqrAtom = "ATOM   8280  N   NTE   544     -13.336   3.045  35.885  0.185 1.824\n";

TEST(DetectFormat, ContentDecidesBeforeTheName)
{
    EXPECT_EQ(detectFormat("a.pdb", "# c\n\ndata_1ABC\n"), StructureFormat::Mmcif);
    EXPECT_EQ(detectFormat("a.cif", "HEADER    X\n" + pdbAtom), StructureFormat::Pdb);
    EXPECT_EQ(detectFormat("1abc_full.vdb", "HEADER    X\n" + pdbAtom), StructureFormat::Pdb);
    EXPECT_EQ(detectFormat("a.txt", "1.0 2.0 3.0 1.7\n"), StructureFormat::Xyzr);
    EXPECT_EQ(detectFormat("-", "A 1 N 22.4 56.2 12.4 1.7\n"), StructureFormat::Xyzr);
    EXPECT_EQ(detectFormat("a.xyzr", "1.0 2.0 3.0 1.7 1 N_ALA_1\n"), StructureFormat::Xyzrn);
    EXPECT_EQ(detectFormat("-", "1.0 2.0 3.0 1.7 N_ALA_1\n"), StructureFormat::Xyzrn);
    EXPECT_EQ(detectFormat("a.xyzrn.gz", "1.0 2.0 3.0 1.7 1 17\n"), StructureFormat::Xyzrn);
}

TEST(DetectFormat, TellsPqrFromPdb)
{
    EXPECT_EQ(detectFormat("-", pqrAtom), StructureFormat::Pqr);
    EXPECT_EQ(detectFormat("-", "ATOM 1 N NTE 544 -13.3 3.0 35.8 -0.10 1.80\n"),
              StructureFormat::Pqr);
    EXPECT_EQ(detectFormat("-", pdbAtom), StructureFormat::Pdb);
    EXPECT_EQ(detectFormat("-", bareAtom), StructureFormat::Pdb);
    EXPECT_EQ(detectFormat("a.PQR.gz", bareAtom), StructureFormat::Pqr);
    EXPECT_EQ(detectFormat("a.ent", pqrAtom), StructureFormat::Pdb);
}

TEST(DetectFormat, OtherColumnsAreBallsOnlyInXyzr)
{
    const std::string vertex = "-19.183 20.964 10.129 -0.425 0.166 -0.890 1 2 3\n";
    EXPECT_EQ(detectFormat("a.xyzr", vertex), StructureFormat::Xyzr);
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { detectFormat("a.vert", vertex); }),
               "a.vert: is no structure");
}

TEST(DetectFormat, NamesWhatItRefuses)
{
    auto message = [](const std::string& text) {
        return errorOf(ErrorKind::Input, [&] { detectFormat("-", text); });
    };
    EXPECT_HAS(message(std::string(" BDV\0\0\0\0", 8)), "is an OpenVDB file");
    EXPECT_HAS(message(std::string("ab\0cd", 5)), "is a binary file");
    EXPECT_HAS(message("{\"data_1ABC\": {}}"), "JSON");
    EXPECT_HAS(message("Dear Sir,\n"), "standard input: is no structure");
}

TEST(DetectFormat, KnowsFormatsByWhatTheyBeginWith)
{
    EXPECT_EQ(detectFormat("-", std::string("\x83\xa7"
                                            "encoder\0",
                                            10)),
              StructureFormat::BinaryCif);
    EXPECT_EQ(detectFormat("-", "# c\n@<TRIPOS>MOLECULE\n"), StructureFormat::Mol2);
    EXPECT_EQ(detectFormat("-", "PSF EXT\n"), StructureFormat::Psf);
    const std::string counts = "  1  0  0  0  0  0            999 V2000\n";
    EXPECT_EQ(detectFormat("-", "data_name\n\n\n" + counts), StructureFormat::Sdf);
    const std::string atom = "    1ALA      N    1   1.234  -0.500   2.000\n";
    EXPECT_EQ(detectFormat("-", "ATOM of a title\n    1\n" + atom), StructureFormat::Gro);
    EXPECT_EQ(detectFormat("a.gro", "no atoms\n 0\n 1.0 1.0 1.0\n"), StructureFormat::Gro);
    EXPECT_EQ(detectFormat("-", "title\n3\n" + pdbAtom), StructureFormat::Pdb);
}

} // namespace
} // namespace molsurf::test
