// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/core/memory.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/read_structure.h"
#include "molsurf/molecule/structure/readers.h"
#include "molsurf/molecule/structure/residue_bonds.h"
#include "molsurf/molecule/structure/residue_kind.h"
#include "unit/structure/temp_file.h"

#include <algorithm>

namespace molsurf::test
{
namespace
{

Structure readMmcif(const std::string& text)
{
    return readStructure(TempFile("a.cif", text).path());
}

std::string mmcifError(const std::string& text)
{
    return errorOf(ErrorKind::Input, [&] { readMmcif(text); });
}

/// An atom_site loop with the given columns.
std::string atomSite(const std::string& columns, const std::string& rows)
{
    std::string text = "data_X\nloop_\n";
    for (std::size_t begin = 0; begin < columns.size();) {
        const std::size_t end = std::min(columns.find(' ', begin), columns.size());
        text += "_atom_site." + columns.substr(begin, end - begin) + "\n";
        begin = end + 1;
    }
    return text + rows + "#\n";
}

/// A text whose first row of atoms lies on two lines.
std::string withBrokenRow(std::string text)
{
    const std::size_t row = text.rfind("\n_atom_site.");
    text[text.find(' ', text.find('\n', row + 1))] = '\n';
    return text;
}

TEST(ReadMmcif, BondsOfComponentsAndConnections)
{
    const std::string atoms =
        atomSite("id type_symbol label_atom_id label_comp_id label_asym_id Cartn_x Cartn_y Cartn_z "
                 "auth_seq_id",
                 "1 C C1 XXX E 0 0 0 301\n2 N N2 XXX E 1.2 0 0 301\n");
    const std::string bonds =
        "loop_\n_chem_comp_bond.comp_id\n_chem_comp_bond.atom_id_1\n_chem_comp_bond.atom_id_2\n"
        "_chem_comp_bond.value_order\n_chem_comp_bond.pdbx_aromatic_flag\n"
        "XXX C1 N2 trip N\nXXX N2 \"C3'\" SING Y\nYYY A B doub N\n#\n"
        "loop_\n_struct_conn.id\n_struct_conn.conn_type_id\n_struct_conn.ptnr1_label_asym_id\n"
        "_struct_conn.ptnr1_auth_seq_id\n_struct_conn.ptnr1_label_atom_id\n"
        "_struct_conn.ptnr2_label_asym_id\n_struct_conn.ptnr2_auth_seq_id\n"
        "_struct_conn.ptnr2_label_atom_id\n_struct_conn.ptnr1_symmetry\n"
        "_struct_conn.ptnr2_symmetry\n"
        "1 covale A 12 SG E 301 C1 1_555 1_555\n2 hydrog A 13 N E 301 N2 1_555 1_555\n"
        "3 metalc A 14 ND1 E 301 N2 1_555 2_655\n#\n";
    for (const std::string& text : {atoms + bonds, withBrokenRow(atoms + bonds)}) {
        const Structure s = readMmcif(text);
        ASSERT_TRUE(s.bonds);
        EXPECT_EQ(s.bonds->residues.at("XXX").between("N2", "C1"), BondOrder::Triple);
        EXPECT_EQ(s.bonds->residues.at("XXX").between("N2", "C3'"), BondOrder::Aromatic);
        EXPECT_EQ(s.bonds->residues.at("XXX").between("C1", "C3'"), BondOrder::None);
        EXPECT_EQ(s.bonds->residues.at("YYY").between("A", "B"), BondOrder::Double);
        ASSERT_EQ(s.bonds->links.size(), 1u); // no hydrogen bond, and none to a copy
        EXPECT_EQ(s.bonds->links[0].a.atom, "SG");
        EXPECT_EQ(s.bonds->links[0].b.chain, "E");
        EXPECT_EQ(s.bonds->links[0].b.number, 301);
    }
    EXPECT_FALSE(readMmcif(atoms).bonds);
}

const std::string full = "group_PDB id type_symbol label_atom_id label_alt_id label_comp_id "
                         "label_asym_id label_seq_id Cartn_x Cartn_y Cartn_z occupancy "
                         "B_iso_or_equiv auth_seq_id auth_asym_id pdbx_PDB_model_num";

TEST(ReadMmcif, AgreesWithThePdbFileOfTheEntry)
{
    const Structure cif = readStructure(dataFile("1a8o.cif.gz"));
    const Structure pdb = readStructure(dataFile("1a8o.pdb.gz"));
    EXPECT_EQ(cif.format, "mmCIF");
    ASSERT_EQ(cif.atoms.size(), 644u);
    ASSERT_EQ(cif.residues.size(), pdb.residues.size());
    for (std::size_t i = 0; i < cif.atoms.size(); ++i) {
        EXPECT_EQ(cif.atoms[i].position, pdb.atoms[i].position) << i;
        EXPECT_EQ(cif.atoms[i].name, pdb.atoms[i].name) << i;
        EXPECT_EQ(cif.atoms[i].element, pdb.atoms[i].element) << i;
    }
    for (std::size_t i = 0; i < cif.residues.size(); ++i) {
        EXPECT_EQ(cif.residues[i].water(), pdb.residues[i].water()) << i;
        EXPECT_EQ(cif.residues[i].hetero(), pdb.residues[i].hetero()) << i;
        EXPECT_EQ(cif.residues[i].number, pdb.residues[i].number) << i;
    }
}

TEST(ReadMmcif, KeepsBothNamesOfAChain)
{
    const Structure s = readStructure(dataFile("1a8o.cif.gz"));
    EXPECT_EQ(s.chains, (std::vector<std::string>{"A"}));
    EXPECT_EQ(s.asyms, (std::vector<std::string>{"A", "B"})); // B: the waters of chain A
    ASSERT_EQ(s.assemblies.size(), 1u);
    ASSERT_EQ(s.assemblies[0].parts.size(), 1u);
    EXPECT_EQ(s.assemblies[0].parts[0].chains, s.asyms);
    EXPECT_EQ(s.assemblies[0].parts[0].operators.size(), 2u);
}

TEST(ReadMmcif, ReadsQuotedNamesAndComments)
{
    const Structure s =
        readMmcif(atomSite(full, "ATOM 1 O OP1 . DT C 1 7.7 19.9 88.4 0 20.4 107 B 1\n# a comment\n"
                                 "ATOM 2 H H2\" . DT C 1 8.1 19.1 84.1 0 29.0 107 B 1\n"
                                 "ATOM 3 O \"O3'\" . DT C 1 7.1 18.1 86.1 0 21.0 107 B 1\n"));
    ASSERT_EQ(s.atoms.size(), 3u);
    EXPECT_EQ(s.atoms[1].name, "H2\"");
    EXPECT_EQ(s.atoms[2].name, "O3'");
    EXPECT_EQ(s.chains[0], "B");
    EXPECT_EQ(s.asyms[0], "C");
    EXPECT_FALSE(s.residues[0].hetero());
}

TEST(ReadMmcif, MakesUpColumnsThatMayBeMissing)
{
    const Structure s =
        readMmcif(atomSite("id type_symbol label_atom_id label_comp_id label_asym_id "
                           "label_seq_id Cartn_x Cartn_y Cartn_z",
                           "1 C CA GLY A 5 1 2 3\n2 N N GLY A 6 1 2 4\n"));
    ASSERT_EQ(s.atoms.size(), 2u);
    EXPECT_EQ(s.residues[1].number, 6);
    EXPECT_EQ(s.atoms[0].altloc, '\0');
    EXPECT_EQ(s.atoms[0].occupancy, 1.0f);
}

TEST(ReadMmcif, ReadsModelsByNumber)
{
    const Structure s = readMmcif(atomSite(full, "ATOM 1 C CA . GLY A 1 1 2 3 1 0 1 A 3\n"
                                                 "ATOM 2 C CA . GLY A 1 1 2 3 1 0 1 A 8\n"));
    ASSERT_EQ(s.models.size(), 2u);
    EXPECT_EQ(s.models[0].number, 3);
    EXPECT_EQ(s.models[1].number, 8);
}

TEST(ReadMmcif, GuessesLigandsWithoutEntities)
{
    const Structure s = readMmcif(atomSite(full, "ATOM 1 C CA . GLY A 1 1 2 3 1 0 1 A 1\n"
                                                 "ATOM 2 C CA . ALA A 2 5 2 3 1 0 2 A 1\n"
                                                 "HETATM 3 ZN ZN . ZN A . 9 9 9 1 0 101 A 1\n"
                                                 "HETATM 4 O O . HOH A . 0 9 9 1 0 201 A 1\n"));
    ASSERT_EQ(s.residues.size(), 4u);
    EXPECT_FALSE(s.residues[1].hetero());
    EXPECT_TRUE(s.residues[2].hetero());
    EXPECT_TRUE(s.residues[3].water());
}

TEST(ReadMmcif, RefusesWhatHasNoAtoms)
{
    EXPECT_HAS(mmcifError("data_X\n_cell.length_a 10\n"), "no atoms: expected _atom_site.Cartn_x");
    EXPECT_HAS(mmcifError("data_X\nloop_\n_chem_comp_atom.atom_id\nC1\n"), "chemical component");
    EXPECT_HAS(mmcifError("data_X\nloop_\n_atom_site_label\n_atom_site_fract_x\nC1 0\n"),
               "expected the unit cell of the crystal");
    EXPECT_HAS(mmcifError(atomSite("id Cartn_x Cartn_y", "1 2 3\n")), "no column label_asym_id");
}

TEST(ReadMmcif, RefusesWhatIsCutShortOrBroken)
{
    const std::string rows = "ATOM 1 C CA . GLY A 1 1 2 3 1 0 1 A 1\nATOM 2 C CA . GLY A 2 1\n";
    const std::string message = mmcifError(atomSite(full, rows));
    EXPECT_HAS(message, "Wrong number of values in ");
    EXPECT_HAS(message, "a.cif: "); // the path, once
    EXPECT_EQ(message.find("a.cif"), message.rfind("a.cif"));
    EXPECT_HAS(mmcifError("loop_\n_atom_site.id\n1\n"),
               "a.cif: line 1, column 1: expected block header");
    EXPECT_HAS(mmcifError("data_x\n_a 1 2\n"), "a.cif: line 2, column 6: expected a tag, a value");
    const std::string two = "ATOM 1 C CA . GLY A 1 1 2 3 1 0 1 A 1\n"
                            "ATOM 2 C CB 'a0' GLY A 1 1 2 4 1 0 1 A 1\n";
    EXPECT_HAS(mmcifError(atomSite(full, two)),
               "label_alt_id of atom 2: expected one character, got \"a0\"");
}

TEST(ReadMmcif, RefusesCoordinatesThatAreNoNumbers)
{
    const std::string message =
        mmcifError(atomSite(full, "ATOM 1 C CA . GLY A 1 1 ? 3 1 0 1 A 1\n"));
    EXPECT_HAS(message, "atom 1 (CA of GLY 1): y: expected");
}

TEST(ReadMmcif, ReadsTheFirstBlockWithAtoms)
{
    const std::string block = atomSite(full, "ATOM 1 C CA . GLY A 1 1 2 3 1 0 1 A 1\n");
    const Structure s =
        readMmcif("data_head\n_cell.length_a 1\n" + block + "data_Y" + block.substr(6));
    EXPECT_EQ(s.atoms.size(), 1u);
    ASSERT_EQ(s.warnings.size(), 1u);
    EXPECT_HAS(s.warnings[0], "1 further data block");
}

TEST(ReadMmcif, AnAssemblyThatCannotBeBuiltIsNoErrorYet)
{
    const Structure s = readMmcif(atomSite(full, "ATOM 1 C CA . GLY A 1 1 2 3 1 0 1 A 1\n") +
                                  "_pdbx_struct_assembly_gen.assembly_id 1\n"
                                  "_pdbx_struct_assembly_gen.oper_expression (1-60)\n"
                                  "_pdbx_struct_assembly_gen.asym_id_list A\n");
    ASSERT_EQ(s.assemblies.size(), 1u);
    EXPECT_HAS(s.assemblies[0].problem, "operator \"1\" is not listed");
}

TEST(ReadMmcif, ReadsNonCrystallographicSymmetry)
{
    std::string columns = "loop_\n_struct_ncs_oper.id\n_struct_ncs_oper.code\n";
    for (const char* name : {"matrix[1][1]", "matrix[1][2]", "matrix[1][3]", "matrix[2][1]",
                             "matrix[2][2]", "matrix[2][3]", "matrix[3][1]", "matrix[3][2]",
                             "matrix[3][3]", "vector[1]", "vector[2]", "vector[3]"}) {
        columns += std::string("_struct_ncs_oper.") + name + "\n";
    }
    const std::string atoms = atomSite(full, "ATOM 1 C CA . GLY A 1 1 2 3 1 0 1 A 1\n");
    const std::string given = "1 given 1 0 0 0 1 0 0 0 1 0 0 0\n";
    EXPECT_TRUE(readMmcif(atoms + columns + given).assemblies.empty());
    const Structure s =
        readMmcif(atoms + columns + given + "2 generate 0 -1 0 1 0 0 0 0 1 100 -20.5 3\n");
    ASSERT_EQ(s.assemblies.size(), 1u);
    EXPECT_EQ(s.assemblies[0].name, "ncs");
    const auto& operators = s.assemblies[0].parts.at(0).operators;
    ASSERT_EQ(operators.size(), 2u);
    EXPECT_EQ(operators[0].rotation[0][0], 1);
    EXPECT_EQ(operators[1].name, "2");
    EXPECT_EQ(operators[1].rotation[0], (std::array<double, 3>{0, -1, 0}));
    EXPECT_EQ(operators[1].translation, openvdb::Vec3d(100, -20.5, 3));
}

/// The author's numbers of all residues.
std::vector<int> numbersOf(const Structure& s)
{
    std::vector<int> out;
    for (const Residue& residue : s.residues) out.push_back(residue.number);
    return out;
}

TEST(ReadMmcif, LabelsStandInForNumbersThatAreMissing)
{
    for (const char* null : {".", "?"}) {
        const std::string none(null);
        const Structure s =
            readMmcif(atomSite(full, "ATOM 1 C CA . GLY A 5 1 2 3 1 0 " + none + " A 1\n" +
                                         "ATOM 2 C CA . GLY A 6 4 2 3 1 0 " + none + " A 1\n" +
                                         "HETATM 3 O O . HOH B . 9 9 9 1 0 " + none + " A 1\n" +
                                         "HETATM 4 H H1 . HOH B . 9 9 8 1 0 " + none + " A 1\n" +
                                         "HETATM 5 O O . HOH B . 0 9 9 1 0 " + none + " A 1\n"));
        EXPECT_EQ(numbersOf(s), (std::vector<int>{5, 6, 1, 2}));
    }
}

TEST(ReadMmcif, GuessesElementsThatAreMissing)
{
    const std::string rows = "ATOM 1 ? CA . ALA A 1 1 2 3 1 0 1 A 1\n"
                             "HETATM 2 . CL1 . LIG B . 9 2 3 1 0 2 A 1\n"
                             "HETATM 3 ? M . HOH C . 5 2 3 1 0 3 A 1\n"
                             "HETATM 4 O O . HOH C . 5 2 3 1 0 3 A 1\n"
                             "HETATM 5 X UNK . UNX D . 0 9 3 1 0 4 A 1\n";
    const Structure s = readMmcif(atomSite(full, rows));
    const std::vector<int> elements{6, 17, 0, 8, 0};
    for (std::size_t i = 0; i < elements.size(); ++i)
        EXPECT_EQ(s.atoms[i].element, elements[i]) << i;
    EXPECT_EQ(s.guessed, 3u);
    EXPECT_EQ(s.atoms[2].role, AtomRole::Particle);
    EXPECT_EQ(readMmcif(atomSite("id label_atom_id label_comp_id label_asym_id label_seq_id "
                                 "Cartn_x Cartn_y Cartn_z",
                                 "1 SD MET A 5 1 2 3\n"))
                  .atoms[0]
                  .element,
              16);
}

TEST(ReadMmcif, PairsAreALoopOfOneRow)
{
    const Structure s = readMmcif("data_one\n_atom_site.id 1\n_atom_site.type_symbol ZN\n"
                                  "_atom_site.label_atom_id ZN\n_atom_site.label_comp_id ZN\n"
                                  "_atom_site.label_asym_id A\n_atom_site.Cartn_x 1.0\n"
                                  "_atom_site.Cartn_y 2.0\n_atom_site.Cartn_z 3.0\n"
                                  "_atom_site.auth_seq_id 5\n");
    ASSERT_EQ(s.atoms.size(), 1u);
    EXPECT_EQ(s.atoms[0].element, 30);
    EXPECT_EQ(s.residues[0].number, 5);
    EXPECT_EQ(s.residues[0].kind, ResidueKind::Ion);
}

/// Molecules without numbers, of one chain: each model counts from 1.
TEST(ReadMmcif, CountsMoleculesOfEachModel)
{
    std::string rows;
    for (const char* model : {"1", "1", "2", "2"})
        rows += std::string("HETATM 1 O O . HOH A . 1 2 3 1 0 . A ") + model + "\n";
    const Structure s = readMmcif(atomSite(full, rows));
    ASSERT_EQ(s.residues.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(s.residues[i].number, int(i % 2) + 1) << i;
}

TEST(ReadMmcif, KnowsStructureFactorsAndPredictions)
{
    EXPECT_HAS(mmcifError("data_sf\nloop_\n_refln.index_h\n_refln.index_k\n1 2\n"),
               "it has structure factors");
    const std::string site = atomSite(full, "ATOM 1 C CA . GLY A 5 1 2 3 1 0 5 A 1\n");
    EXPECT_FALSE(readMmcif(site).plddt);
    EXPECT_TRUE(readMmcif(site + "_ma_qa_metric.name pLDDT\n").plddt);
    EXPECT_FALSE(readMmcif(site + "_ma_qa_metric.name PAE\n").plddt);
}

/// Spheres of residues "1-10" in the given order, with radius 2, along x.
std::string spheres(const std::vector<std::pair<int, int>>& spans)
{
    std::string text = "data_X\nloop_\n";
    for (const char* column : {"id", "entity_id", "seq_id_begin", "seq_id_end", "asym_id",
                               "Cartn_x", "Cartn_y", "Cartn_z", "object_radius", "model_id"})
        text += std::string("_ihm_sphere_obj_site.") + column + "\n";
    int id = 0;
    for (const auto& [begin, end] : spans) {
        ++id;
        text += std::to_string(id) + " 1 " + std::to_string(begin) + " " + std::to_string(end) +
                " A " + std::to_string(9 * id) + " 0 0 2 1\n";
    }
    return text;
}

/// The spheres that are left out, from 1, and the warnings.
std::string coarser(const std::vector<std::pair<int, int>>& spans)
{
    const Structure s = readMmcif(spheres(spans));
    std::string out;
    for (std::size_t i = 0; i < s.atoms.size(); ++i)
        if (s.atoms[i].role == AtomRole::CoarserScale) out += std::to_string(i + 1) + " ";
    for (const std::string& warning : s.warnings) out += warning.substr(0, 22);
    return out;
}

TEST(ReadMmcif, OfTwoScalesTheFinerOneCounts)
{
    EXPECT_EQ(coarser({{1, 1}, {2, 2}, {3, 3}}), "");
    EXPECT_EQ(coarser({{1, 3}, {1, 1}, {2, 2}, {3, 3}}), "1 the model is there at ");
    EXPECT_EQ(coarser({{1, 5}, {6, 10}, {1, 10}, {11, 20}}), "3 the model is there at ");
    EXPECT_EQ(coarser({{1, 5}, {1, 10}}), "the model overlaps its");
    EXPECT_EQ(coarser({{1, 5}, {1, 5}}), ""); // two states
    EXPECT_EQ(coarser({{1, 2000000000}, {-2000000000, 2000000000}, {5, 4}}).substr(0, 2), "th");
}

void expectSame(const Structure& s, const Structure& whole)
{
    ASSERT_EQ(s.atoms.size(), whole.atoms.size());
    for (std::size_t i = 0; i < s.atoms.size(); ++i) {
        const Atom &a = s.atoms[i], &b = whole.atoms[i];
        EXPECT_EQ(a.position, b.position);
        EXPECT_EQ(a.name + a.altloc, b.name + b.altloc);
        EXPECT_EQ(a.residue, b.residue);
        EXPECT_EQ(a.element, b.element);
        EXPECT_EQ(a.bFactor, b.bFactor);
    }
    ASSERT_EQ(s.residues.size(), whole.residues.size());
    for (std::size_t i = 0; i < s.residues.size(); ++i) {
        const Residue &a = s.residues[i], &b = whole.residues[i];
        EXPECT_EQ(std::tie(a.name, a.chain, a.asym, a.number, a.insertionCode, a.hetatm, a.entity),
                  std::tie(b.name, b.chain, b.asym, b.number, b.insertionCode, b.hetatm, b.entity));
    }
    ASSERT_EQ(s.models.size(), whole.models.size());
    for (std::size_t i = 0; i < s.models.size(); ++i) {
        const Model &a = s.models[i], &b = whole.models[i];
        EXPECT_EQ(std::tie(a.number, a.begin, a.end), std::tie(b.number, b.begin, b.end));
    }
    EXPECT_EQ(s.chains, whole.chains);
    EXPECT_EQ(s.asyms, whole.asyms);
    EXPECT_EQ(s.guessed, whole.guessed);
    EXPECT_EQ(s.warnings, whole.warnings);
    EXPECT_EQ(s.assemblies.size(), whole.assemblies.size());
}

/// Expects that rows may begin and end anywhere on lines.
void expectSameOnTwoLines(const std::string& text)
{
    expectSame(readMmcif(text), readMmcif(withBrokenRow(text)));
}

TEST(ReadMmcif, RowsAreNoLines)
{
    expectSameOnTwoLines(loadText(dataFile("1a8o.cif.gz")));
    const std::string chains = "ATOM 1 C CA . GLY A 1 1 2 3 1 0 1 A 1\n"
                               "ATOM 2 C 'C A' . GLY A 1 1 2 4 1 0 . A 1\n"
                               "ATOM 3 C \"C'\" . GLY B 1 1 2 5 1 0 1 B 1\n"
                               "HETATM 4 X ZN . ZN C . 1 2 6 1 0 ? A 1\n"
                               "ATOM 5 C CA . GLY A 1 1 2 3 1 0 1 A 3\n"
                               "ATOM 6 C CA . GLY B 1 1 2 3 1 0 1 B 3\n";
    const std::string text = atomSite(full, chains);
    expectSameOnTwoLines(text);
    expectSameOnTwoLines(text + "loop_\n_entity.id\n_entity.type\n1 polymer\n");
}

/// Numbers of waters begin anew behind 9999, in one chain.
TEST(ReadMmcif, WatersWhoseNumbersComeAgain)
{
    std::string rows;
    double x = 0.0;
    const auto add = [&](const char* name, const char* residue, int number) {
        rows += std::string("HETATM 1 ") + name[0] + " " + name + " . " + residue + " W . " +
                std::to_string(x) + " 2 3 1 0 " + std::to_string(number) + " W 1\n";
        x += 0.9;
    };
    for (int n = 0; n < 5; ++n, x += 3.0)
        for (const char* name : {"H1", "O", "H2"}) add(name, "HOH", 9998 + n % 2);
    for (int n = 0; n < 3; ++n) add("NA", "NA", 9998);
    for (const char* name : {"C", "C", "O", "C"}) add(name, "UNL", 1);
    expectSameOnTwoLines(atomSite(full, rows));
    Structure s = readMmcif(atomSite(full, rows));
    ASSERT_EQ(s.residues.size(), 5u + 3u + 1u);
    for (std::size_t r = 0; r < 5; ++r) EXPECT_TRUE(s.residues[r].water()) << r;
    EXPECT_EQ(s.residues[8].name, "UNL") << "which Open Babel names by elements";
}

/// gemmi joins the residues of two chains of one name.
TEST(ReadMmcif, CopiesOfAChainByOneNameAreResiduesOfTheirOwn)
{
    std::string rows;
    int id = 0;
    for (const int x : {0, 60})
        for (const int number : {1, 2})
            for (const char* atom : {"N .", "CA .", "CB A", "CB B"}) {
                ++id;
                rows += "ATOM " + std::to_string(id) + " " + atom[0] + " " + atom + " SER A . " +
                        std::to_string(x + id % 8) + " 0 " + std::to_string(5 * number) + " 1 0 " +
                        std::to_string(number) + " A 1\n";
            }
    const Structure s = readMmcif(atomSite(full, rows));
    ASSERT_EQ(s.residues.size(), 4u);
    for (std::size_t i = 0; i < s.atoms.size(); ++i)
        EXPECT_EQ(s.atoms[i].residue, std::int32_t(i / 4)) << "in the order of the file";
    EXPECT_EQ(s.residues[2].number, 1);
    expectSameOnTwoLines(atomSite(full, rows));
}

/// One atom of each of many models, of which the last may be one of an earlier model again.
std::string manyModels(int count, int last)
{
    std::string rows;
    for (int n = 1; n <= count; ++n)
        rows += "ATOM " + std::to_string(n) + " C CA . GLY A 1 1 2 3 1 0 1 A " +
                std::to_string(n < count ? n : last) + "\n";
    return atomSite(full, rows);
}

TEST(ReadMmcif, ManyModelsAndOneThatComesBack)
{
    constexpr int count = 1000;
    expectSameOnTwoLines(manyModels(count, count));
    const Structure s = readMmcif(manyModels(count, count));
    ASSERT_EQ(s.models.size(), std::size_t(count));
    for (int n = 0; n < count; ++n) {
        EXPECT_EQ(s.models[std::size_t(n)].number, n + 1);
        EXPECT_EQ(s.models[std::size_t(n)].begin, std::size_t(n));
    }
    for (const int last : {1, 300, 999}) { // such a model has both of its atoms
        const Structure back = readMmcif(manyModels(count, last));
        ASSERT_EQ(back.models.size(), std::size_t(count - 1));
        const Model& model = back.models[std::size_t(last - 1)];
        EXPECT_EQ(model.number, last);
        EXPECT_EQ(model.end - model.begin, 2u);
    }
}

TEST(ReadMmcif, EntitiesAreOfTheirLabelChains)
{
    const std::string atoms = atomSite(full, "ATOM 1 C CA . GLY A 1 1 2 3 1 0 1 A 1\n"
                                             "HETATM 2 ZN ZN . ZN B . 9 9 9 1 0 101 A 1\n"
                                             "HETATM 3 O O . HOH C . 0 9 9 1 0 201 A 1\n"
                                             "ATOM 4 C CA . GLY D 1 5 2 3 1 0 1 D 1\n");
    const std::string types = "loop_\n_entity.id\n_entity.type\n1 polymer\n2 non-polymer\n3 ?\n#\n";
    const auto found = [](const std::string& text) {
        std::vector<EntityHint> out;
        for (const Residue& residue : readMmcif(text).residues) out.push_back(residue.entity);
        return out;
    };
    using E = EntityHint;
    const std::string chains =
        "loop_\n_struct_asym.id\n_struct_asym.entity_id\nA 1\nB 1\nC 3\nD 2\n#\n";
    EXPECT_EQ(found(atoms + types + chains),
              (std::vector<E>{E::Polymer, E::None, E::None, E::Other})); // ZN is in no sequence
    EXPECT_EQ(found(atoms + types),                                      // which no atom names
              (std::vector<E>{E::None, E::None, E::None, E::None}));
    EXPECT_EQ(found(atoms), (std::vector<E>{E::None, E::None, E::None, E::None}));
    const std::string named =
        atomSite(full + " label_entity_id", "ATOM 1 C CA . GLY A 1 1 2 3 1 0 1 A 1 1\n"
                                            "ATOM 2 C CA . GLY D 1 5 2 3 1 0 1 D 1 2\n");
    EXPECT_EQ(found(named + types), (std::vector<E>{E::Polymer, E::Other}));
}

/// Glycans are polymers in files of before July 2020; a ligand may have the chain of a polymer.
TEST(ReadMmcif, EntitiesMakeNoLinksOfSugarsAndLigands)
{
    const std::string types = "loop_\n_entity.id\n_entity.type\n1 polymer\n2 polymer\n#\n"
                              "loop_\n_struct_asym.id\n_struct_asym.entity_id\nA 1\nB 2\n#\n";
    const Structure s = readMmcif(atomSite(full, "ATOM 1 C CA . GLY A 1 1 2 3 1 0 1 A 1\n"
                                                 "ATOM 2 C C1 . XYZ A 2 5 2 3 1 0 2 A 1\n"
                                                 "HETATM 3 C C1 . NAG B 1 9 9 9 1 0 3 A 1\n"
                                                 "HETATM 4 C C1 . LIG A . 9 9 19 1 0 4 A 1\n") +
                                  types);
    std::string kinds;
    for (const Residue& residue : s.residues) kinds += " " + std::string(kindWord(residue.kind));
    EXPECT_EQ(kinds, " protein modified sugar ligand");
}

TEST(ReadMmcif, AuthorsChainsAloneAreEnough)
{
    const Structure s = readMmcif(atomSite("label_atom_id label_comp_id auth_asym_id auth_seq_id "
                                           "Cartn_x Cartn_y Cartn_z",
                                           "CA GLY A 7 1 2 3(1)\nN GLY B 8 1 2 4\n"));
    EXPECT_EQ(s.chains, (std::vector<std::string>{"A", "B"}));
    EXPECT_EQ(s.asyms, s.chains);
    EXPECT_EQ(s.residues[1].number, 8);
    EXPECT_EQ(s.atoms[0].position.z(), 3.0);
}

TEST(ReadMmcif, ComponentsHaveIdealCoordinatesOrThoseOfAModel)
{
    const auto component = [](const std::string& rows) {
        std::string text = "data_XYZ\nloop_\n";
        for (const char* tag : {"comp_id", "atom_id", "type_symbol", "pdbx_model_Cartn_x_ideal",
                                "pdbx_model_Cartn_y_ideal", "pdbx_model_Cartn_z_ideal",
                                "model_Cartn_x", "model_Cartn_y", "model_Cartn_z"})
            text += std::string("_chem_comp_atom.") + tag + "\n";
        return text + rows;
    };
    const Structure ideal =
        readMmcif(component("XYZ C1 C 1 2 3 7 8 9\nXYZ \"O1'\" O 2 2 3 8 8 9\n"));
    ASSERT_EQ(ideal.atoms.size(), 2u);
    EXPECT_EQ(ideal.atoms[1].name, "O1'");
    EXPECT_EQ(ideal.atoms[1].element, 8);
    EXPECT_EQ(ideal.atoms[0].position, openvdb::Vec3d(1, 2, 3));
    EXPECT_EQ(ideal.residues[0].name, "XYZ");
    EXPECT_EQ(
        readMmcif(component("XYZ C1 C 1 2 3 7 8 9\nXYZ O1 O ? ? ? 8 8 9\n")).atoms[0].position,
        openvdb::Vec3d(7, 8, 9));
    EXPECT_HAS(mmcifError(component("XYZ C1 C ? ? ? 7 8 ?\n")), "has no coordinates of all atoms");
}

TEST(ReadMmcif, CrystalsOfSmallMolecules)
{
    const auto crystal = [](const std::string& rows) {
        return "data_I\n_cell_length_a 10.0(1)\n_cell_length_b 20\n_cell_length_c 30\n"
               "_cell_angle_alpha 90\n_cell_angle_beta 90\n_cell_angle_gamma 90\n"
               "_symmetry_space_group_name_H-M 'P -1'\n"
               "loop_\n_atom_site_label\n_atom_site_type_symbol\n_atom_site_fract_x\n"
               "_atom_site_fract_y\n_atom_site_fract_z\n_atom_site_disorder_group\n" +
               rows;
    };
    const Structure s = readMmcif(crystal("C1 C 0.3(2) 0.25 0.5 .\nCl1 Cl 0.4 0.25 0.4 2\n"));
    ASSERT_EQ(s.atoms.size(), 2u);
    EXPECT_NEAR((s.atoms[0].position - openvdb::Vec3d(3, 5, 15)).length(), 0.0, 1e-9);
    EXPECT_EQ(s.atoms[1].element, 17);
    EXPECT_EQ(s.atoms[1].altloc, 'B');
    EXPECT_TRUE(s.warnings.empty());
    // Beside the centre of inversion a bond leads to the copy.
    const Structure half = readMmcif(crystal("C1 C 0.07 0 0 .\n"));
    ASSERT_EQ(half.warnings.size(), 1u);
    EXPECT_HAS(half.warnings[0], "the asymmetric unit is read alone");
    // On the centre it is its own copy; 2.4 Å from that no carbon is bonded to another.
    EXPECT_TRUE(readMmcif(crystal("C1 C 0 0 0 .\n")).warnings.empty());
    EXPECT_TRUE(readMmcif(crystal("C1 C 0.12 0 0 .\n")).warnings.empty());
}

// B = 8 pi^2 U.
TEST(ReadMmcif, CrystalsHaveTemperatureFactors)
{
    const Structure s = readMmcif(
        "data_I\n_cell_length_a 10\n_cell_length_b 20\n_cell_length_c 30\n_cell_angle_alpha 90\n"
        "_cell_angle_beta 90\n_cell_angle_gamma 90\n_symmetry_space_group_name_H-M 'P 1'\nloop_\n"
        "_atom_site_label\n_atom_site_type_symbol\n_atom_site_fract_x\n_atom_site_fract_y\n"
        "_atom_site_fract_z\n_atom_site_U_iso_or_equiv\n_atom_site_occupancy\n"
        "C1 C 0.3 0.25 0.5 0.05 0.75\n");
    EXPECT_NEAR(s.atoms[0].bFactor, 3.9478, 1e-3);
    EXPECT_EQ(s.atoms[0].occupancy, 0.75f);
}

TEST(ReadMmcif, CommentsAndModelsMayStandBetweenRows)
{
    const std::string first = "ATOM 1 C CA . GLY A 1 1 2 3 1 0 1 A 1\n";
    const std::string second = "ATOM 2 C CA . GLY B 1 1 2 4 1 0 1 B 1\n";
    const std::string broken = "ATOM 2 C CA . GLY B 1 1 2\n4 1 0 1 B 1\n";
    const std::string model = "ATOM 3 C CA . GLY A 1 1 2 4 1 0 1 A 2\n";
    const std::string note = "# a comment\n";
    for (const std::string& rows : {first + broken, first + note + second, first + model + second,
                                    "\n" + first + "\n" + second}) {
        const Structure s = readMmcif(atomSite(full, rows));
        EXPECT_EQ(s.chains, (std::vector<std::string>{"A", "B"}));
        EXPECT_EQ(s.atoms.size(),
                  rows.find(" 2\n") == std::string::npos || rows == first + broken ? 2u : 3u);
    }
    const std::string quoted = "data_X\n_struct.title\n;\nloop_\n_atom_site.label_asym_id\nA\n;\n";
    expectSameOnTwoLines(quoted + atomSite(full, first + second).substr(7));
}

/// Rows of atoms are no document, those of other tables are.
TEST(ReadMmcif, TakesLittleMoreMemoryThanItsAtoms)
{
    std::string rows, values = "loop_\n_b.c\n";
    for (int i = 0; i < 100000; ++i) rows += "ATOM 1 C CA . GLY A0 1 1 2 3 1 0 1 A0 1\n";
    const std::string atoms = atomSite(full, rows);
    while (values.size() < atoms.size()) values += "ATOM0 1 C CA . GLY A0 1 1 2 3 1 0 1 A0 1\n";
    const std::string table = atomSite(full, rows.substr(0, rows.find('\n') + 1)) + values;
    EXPECT_LT(bytesForMmcif(atoms), 20e6);
    EXPECT_GT(bytesForMmcif(table), 50e6);

    std::size_t memory = 1 << 20; // that leaves what lies between the two
    while (!hasMemory(40e6, memory)) memory += 1 << 20;
    EXPECT_EQ(parseStructure(atoms, "a.cif", 0, Progress(), memory).atoms.size(), 100000u);
    EXPECT_HAS(
        errorOf(ErrorKind::Input, [&] { parseStructure(table, "a.cif", 0, Progress(), memory); }),
        "a.cif: reading it takes about");
}

/// A document of its values takes 40 times its memory.
TEST(ReadMmcif, RefusesALineOfMoreThanAMillionCharacters)
{
    std::string ids, kept;
    for (int i = 0; i < 500001; ++i) ids += "1 ";
    const std::string atom = atomSite(full, "ATOM 1 C CA . ALA A 1 0 0 0 1 1 1 A 1\n");
    kept = ids.substr(0, 1000000);
    EXPECT_EQ(readMmcif(atom + "loop_\n_b.c\n" + kept + "\n").atoms.size(), 1u);
    EXPECT_HAS(mmcifError(atom + "loop_\n_b.c\n" + ids + "\n"),
               "expected at most 1000000 characters, got 1000002");
}

TEST(ReadMmcif, RefusesNamesThatStandTwice)
{
    const std::string atom = atomSite(full, "ATOM 1 C CA . ALA A 1 0 0 0 1 1 1 A 1\n");
    EXPECT_EQ(readMmcif(atom + "data_a\n_b.c 1\ndata_d\n_b.c 1\n").atoms.size(), 1u);
    EXPECT_HAS(mmcifError(atom + "data_a\n_b.c 1\ndata_A\n_b.c 1\n"), "duplicate block name: A");
    EXPECT_HAS(mmcifError(atom + "data_a\n_b.c 1\n_B.C 1\n"), "duplicate tag _B.C");
    EXPECT_HAS(mmcifError(atom + "data_a\nloop_\n_b.c\n_b.C\n1 2\n"), "duplicate tag _b.C");
}

} // namespace
} // namespace molsurf::test
