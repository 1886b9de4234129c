// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/coarse_grain.h"

#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/molecule/structure/read_structure.h"
#include "unit/structure/temp_file.h"

#include <algorithm>
#include <map>

namespace molsurf::test
{
namespace
{

/// The balls of every bead.
struct Recorder {
    std::vector<std::vector<std::size_t>> members;
};

BallSet beadsOf(const Structure& s, const std::vector<std::string>& rules,
                SelectOptions options = {}, Recorder* recorder = nullptr,
                const LabelOptions& labels = {})
{
    const BallSet atoms = selectBalls(s, options);
    for (const std::string& rule : rules) options.coarse.push_back(parseCoarse(rule));
    if (recorder) recorder->members = coarseGrain(s, atoms.balls, options.coarse, 0.0, {}).members;
    return selectBalls(s, options, labels);
}

const Atom& atomOf(const Structure& s, const Ball& ball)
{
    return s.atoms[std::size_t(ball.atom)];
}

TEST(ParseCoarse, ReadsItsWords)
{
    for (const std::string text : {"atom", "residue", "4", "1000000", "A/1-20=residue",
                                   "(ALA,GLY)=7", "A;b<5=atom", "A;q=1=3"}) {
        EXPECT_EQ(nameOf(parseCoarse(text)), text);
    }
    EXPECT_EQ(parseCoarse("1").level, CoarseRule::Level::Atom);
    EXPECT_EQ(parseCoarse("A;q=1=3").select, "A;q=1");
    for (const std::string text :
         {"", "=", "=4", "atoms", "0", "-1", "1.5", "4 ,", "1000001", "A=", "A=b", "99999999999"}) {
        EXPECT_EQ(errorOf(ErrorKind::Usage, [&] { parseCoarse(text); }).find("`coarse`: expected"),
                  0u)
            << text;
    }
}

TEST(CoarseGrain, BackboneAndSideChainOfEveryResidue)
{
    const Structure s = readStructure(dataFile("1crn.pdb"));
    Recorder recorder;
    const BallSet beads = beadsOf(s, {"residue"}, {}, &recorder);
    // 46 residues, 4 glycines without a side chain.
    ASSERT_EQ(beads.balls.size(), 88u);
    EXPECT_EQ(beads.record.beads, 88u);
    EXPECT_EQ(beads.record.beadAtoms, 327u);
    std::vector<int> seen(327, 0);
    for (std::size_t b = 0; b < beads.balls.size(); ++b) {
        std::map<bool, int> backbone;
        for (const std::size_t i : recorder.members[b]) {
            ++seen[i];
            const std::string& name = s.atoms[i].name;
            ++backbone[name == "N" || name == "CA" || name == "C" || name == "O" || name == "OXT"];
            EXPECT_EQ(s.atoms[i].residue, atomOf(s, beads.balls[b]).residue);
        }
        EXPECT_EQ(backbone.size(), 1u);
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 327);
    EXPECT_EQ(describeSelection(s, beads), "1crn.pdb: PDB, 1 model, 327 atoms; used 88 balls, of "
                                           "them 88 beads for 327 atoms");
}

TEST(CoarseGrain, ABeadStandsAtTheCentreOfItsVolumeForTheNearestAtom)
{
    const Structure s = readStructure(dataFile("1crn.pdb"));
    Recorder recorder;
    const BallSet atoms = selectBalls(s, {}), beads = beadsOf(s, {"10"}, {}, &recorder);
    for (std::size_t b = 0; b < beads.balls.size(); ++b) {
        openvdb::Vec3d sum(0.0);
        double volume = 0.0, nearest = 1e9;
        for (const std::size_t i : recorder.members[b]) {
            const double v = std::pow(double(atoms.balls[i].radius), 3);
            sum += v * s.atoms[i].position;
            volume += v;
        }
        const openvdb::Vec3d centre(beads.balls[b].center);
        EXPECT_LT((centre - sum / volume).length(), 1e-5);
        for (const std::size_t i : recorder.members[b])
            nearest = std::min(nearest, (s.atoms[i].position - centre).length());
        EXPECT_NEAR((atomOf(s, beads.balls[b]).position - centre).length(), nearest, 1e-5);
    }
}

TEST(CoarseGrain, ClustersHaveAboutAsManyAtomsAsAsked)
{
    const Structure s = readStructure(dataFile("1a8o.cif.gz"));
    for (const int n : {2, 4, 10, 50, 1000}) {
        Recorder recorder;
        const BallSet beads = beadsOf(s, {std::to_string(n)}, {}, &recorder);
        EXPECT_EQ(beads.record.beads,
                  std::max<std::size_t>(1, (2 * 556 + std::size_t(n)) / (2 * n)));
        std::size_t least = 1000, most = 0;
        for (const auto& members : recorder.members) {
            least = std::min(least, members.size());
            most = std::max(most, members.size());
        }
        EXPECT_GE(4 * least, std::size_t(std::min(n, 556))) << n;
        EXPECT_LE(most, 2 * std::size_t(n)) << n;
    }
}

TEST(CoarseGrain, LaterRulesWinAndAtomsStay)
{
    const Structure s = readStructure(dataFile("1crn.pdb"));
    const BallSet beads = beadsOf(s, {"residue", "A/1-10=5", "A/5-20=atom"});
    std::size_t atoms = 0;
    for (const Ball& ball : beads.balls) {
        const int number = s.residues[std::size_t(atomOf(s, ball).residue)].number;
        if (number < 5 || number > 20) continue;
        EXPECT_EQ(ball.center, atomOf(s, ball).position);
        ++atoms;
    }
    EXPECT_EQ(atoms, beads.balls.size() - beads.record.beads);
    EXPECT_EQ(beads.record.beadAtoms + atoms, 327u);
    EXPECT_EQ(beadsOf(s, {"residue", "atom"}).record.beads, 0u);
}

TEST(CoarseGrain, HydrogensGoWithTheirAtom)
{
    const Structure s = readStructure(dataFile("1d3z.pdb.gz"));
    Recorder recorder;
    const BallSet beads = beadsOf(s, {"residue"}, {}, &recorder);
    EXPECT_EQ(beads.record.beadAtoms, 1231u);
    EXPECT_EQ(beads.record.beads, 146u); // 76 backbones, 6 glycines without side chain
    for (const auto& members : recorder.members) {
        bool ca = false, ha = false, hb = false;
        for (const std::size_t i : members) {
            ca = ca || s.atoms[i].name == "CA";
            ha = ha || s.atoms[i].name == "HA";
            hb = hb || s.atoms[i].name == "HB2";
        }
        EXPECT_FALSE(ca && hb);
        EXPECT_FALSE(ha && !ca);
    }
}

TEST(CoarseGrain, AssembliesAndGroupsTakeBeads)
{
    const Structure s = readStructure(dataFile("1a8o.cif.gz"));
    SelectOptions options;
    options.assembly.name = "1";
    LabelOptions labels;
    labels.groups = {{"head", "A/151-180", {}}, {"tail", "A/181-230", {}}};
    const BallSet beads = beadsOf(s, {"residue"}, options, nullptr, labels);
    ASSERT_EQ(beads.balls.size(), 272u);
    EXPECT_EQ(beads.record.beads, 272u);
    EXPECT_EQ(beads.record.beadAtoms, 1112u);
    EXPECT_EQ(beads.labels->groups[0].balls + beads.labels->groups[1].balls, 272u);
    const BallSet unit = beadsOf(s, {"residue"});
    for (std::size_t i = 0; i < 136; ++i) {
        EXPECT_LT((beads.balls[i].center - unit.balls[i].center).length(), 1e-4); // the identity
        const Ball &a = beads.balls[i], &b = beads.balls[136 + i];
        EXPECT_EQ(a.atom, b.atom);
        EXPECT_EQ(a.radius, b.radius);
        const int number = s.residues[std::size_t(atomOf(s, a).residue)].number;
        EXPECT_EQ(beads.labels->groupOf[i], number > 180);
        EXPECT_EQ(beads.labels->groupOf[136 + i], number > 180);
        // A rigid motion keeps distances of beads.
        const Ball &c = beads.balls[0], &d = beads.balls[136];
        EXPECT_NEAR((a.center - c.center).length(), (b.center - d.center).length(), 1e-4);
    }
}

TEST(CoarseGrain, NucleotidesHaveThreeBeads)
{
    std::string text;
    int serial = 0;
    for (const char* name : {"P  ", "OP1", "OP2", "O5'", "C5'", "C4'", "O4'", "C3'", "O3'", "C2'",
                             "C1'", "N1 ", "C2 ", "O2 ", "N3 ", "C4 ", "N4 ", "C5 ", "C6 "}) {
        char line[96];
        ++serial;
        std::snprintf(line, sizeof line,
                      "ATOM  %5d  %s  DC A   1    %8.3f%8.3f%8.3f  1.00  0.00           %c\n",
                      serial, name, 1.3 * serial, 0.2 * serial, 0.0, name[0]);
        text += line;
    }
    const Structure s = readStructure(TempFile("dc.pdb", text).path());
    Recorder recorder;
    beadsOf(s, {"residue"}, {}, &recorder);
    ASSERT_EQ(recorder.members.size(), 3u);
    EXPECT_EQ(recorder.members[0].size(), 4u);
    EXPECT_EQ(recorder.members[1].size(), 7u);
    EXPECT_EQ(recorder.members[2].size(), 8u);
}

TEST(CoarseGrain, WatersIonsAndLigands)
{
    const Structure s = readStructure(dataFile("4at1.ent.gz"));
    SelectOptions options;
    options.select = "*;!polymer";
    const BallSet ligands = selectBalls(s, options);
    const BallSet beads = beadsOf(s, {"residue"}, options);
    EXPECT_EQ(beads.record.beadAtoms, ligands.balls.size());
    // Two zinc ions, and two ATP of 31 atoms in clusters of about four.
    EXPECT_EQ(ligands.balls.size(), 64u);
    EXPECT_EQ(beads.balls.size(), 2u + 2u * 8u);
    options = {};
    options.waters = true;
    const Structure wet = readStructure(dataFile("1ubq.pdb"));
    const BallSet all = beadsOf(wet, {"100"}, options);
    std::size_t waters = 0;
    for (const Ball& b : all.balls) {
        waters += wet.residues[std::size_t(atomOf(wet, b).residue)].water();
    }
    EXPECT_EQ(waters, 58u);
}

TEST(CoarseGrain, AtomsWithoutResiduesAreClustered)
{
    std::string text;
    for (int i = 0; i < 40; ++i) text += std::to_string(1.5 * i) + " 0 0 1.7\n";
    const Structure s = readStructure(TempFile("row.xyzr", text).path());
    EXPECT_EQ(beadsOf(s, {"residue"}).balls.size(), 10u);
}

TEST(CoarseGrain, ASelectionThatMatchesNothingIsAnError)
{
    const Structure s = readStructure(dataFile("1crn.pdb"));
    EXPECT_NE(errorOf(ErrorKind::Input, [&] { beadsOf(s, {"B=residue"}); }).find("\"B\""),
              std::string::npos);
    EXPECT_NE(errorOf(ErrorKind::Usage, [&] { beadsOf(s, {"A;;=residue"}); }), "");
}

} // namespace
} // namespace molsurf::test
