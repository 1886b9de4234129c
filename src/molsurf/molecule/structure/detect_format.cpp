// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/detect_format.h"

#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/binary_cif.h"
#include "molsurf/molecule/structure/element.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/readers.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <initializer_list>
#include <string_view>

namespace molsurf
{
namespace
{

using std::string_view;

std::string lowerExtension(const std::string& path)
{
    const std::filesystem::path name(path);
    const std::string extension = lowered(name.extension().string());
    const bool packed = extension == ".gz" || extension == ".bz2" || extension == ".xz";
    return packed ? lowered(name.stem().extension().string()) : extension;
}

bool startsWithNoCase(string_view text, string_view lowerPrefix)
{
    return text.size() >= lowerPrefix.size() &&
           std::equal(lowerPrefix.begin(), lowerPrefix.end(), text.begin(), [](char a, char b) {
               return a == std::tolower(static_cast<unsigned char>(b));
           });
}

bool isPdbRecord(string_view line)
{
    static constexpr std::array<string_view, 30> records{
        "ATOM  ", "HETATM", "HEADER", "OBSLTE", "TITLE ", "SPLIT ", "CAVEAT", "COMPND",
        "SOURCE", "KEYWDS", "EXPDTA", "AUTHOR", "REVDAT", "JRNL  ", "REMARK", "DBREF ",
        "SEQRES", "HET   ", "HETNAM", "CRYST1", "ORIGX1", "SCALE1", "MTRIX1", "MODEL ",
        "ENDMDL", "USER  ", "MDLTYP", "NUMMDL", "COMPND", "END   "};
    std::string record(line.substr(0, 6));
    record.resize(6, ' ');
    return std::find(records.begin(), records.end(), record) != records.end();
}

bool hasAtomRecord(string_view text)
{
    for (LineReader lines(text); lines.next();) {
        if (isAtomRecord(lines.line())) return true;
    }
    return false;
}

/// Number of digits after the decimal point.
std::size_t decimals(string_view number)
{
    const std::size_t point = number.find('.');
    return point == string_view::npos ? 0 : number.size() - point - 1;
}

/// True if the last two columns of the atoms can only be charge and radius. In a PDB file without
/// elements they are occupancy and B factor: two decimals, never negative occupancy.
bool looksLikePqr(string_view text)
{
    constexpr int enough = 200;
    bool certain = false;
    int atoms = 0;
    for (LineReader lines(text); lines.next() && atoms < enough;) {
        if (!isAtomRecord(lines.line())) continue;
        ++atoms;
        const Fields fields = splitFields(lines.line());
        double charge = 0, radius = 0;
        if (fields.size() < 8 || !parseNumber(fields[fields.size() - 2], charge) ||
            !parseNumber(fields.back(), radius)) {
            return false;
        }
        certain = certain || charge < 0 || decimals(fields[fields.size() - 2]) > 2;
    }
    return certain;
}

/// True for "x y z r" and for "chain number atom x y z r". A file that is named .xyzr may have
/// other leading columns; tables of numbers are too common to take them all for balls.
bool looksLikeBall(string_view line)
{
    const Fields fields = splitFields(line);
    double number = 0;
    int residue = 0;
    return (fields.size() == 4 || (fields.size() == 7 && parseInteger(fields[1], residue) &&
                                   !parseNumber(fields[2], number))) &&
           std::all_of(fields.end() - 4, fields.end(),
                       [&](string_view f) { return parseNumber(f, number); });
}

/// True for "x y z r number name", as MSMS's pdb_to_xyzrn writes, and for "x y z r name".
bool looksLikeNamedBall(string_view line)
{
    const Fields fields = splitFields(line);
    double number = 0;
    const auto isNumber = [&](string_view f) { return parseNumber(f, number); };
    return (fields.size() == 5 || fields.size() == 6) && !isNumber(fields.back()) &&
           std::all_of(fields.begin(), fields.end() - 1, isNumber);
}

} // namespace

/// The parts of a file that formats are told by.
struct StructureSample {
    StructureSample(const std::string& path, const std::string& all)
        : text(all), extension(lowerExtension(path)), stream(readsOnce(path)), binary(isBinary(all))
    {
        if (binary) return;
        for (LineReader lines(text); first.empty() && lines.next();) {
            const Fields fields = splitFields(lines.line());
            if (fields.empty() || fields[0][0] == '#') continue;
            first = lines.line();
            word = fields[0];
        }
        hasRecords = isPdbRecord(first) || hasAtomRecord(text);
    }

    static bool isBinary(string_view text)
    {
        return text.substr(0, 4096).find('\0') != string_view::npos;
    }

    const std::string& text;
    std::string extension;
    bool stream;             ///< whether it is not from a file
    bool binary;             ///< the rest is found of texts alone
    string_view first;       ///< line that is neither blank nor a comment
    string_view word;        ///< the first one in it
    bool hasRecords = false; ///< whether there is a record of a PDB file

    bool ends(string_view with) const { return extension == with; }
};

namespace
{

using Sample = StructureSample;

constexpr string_view cnsTopology = "data_cns_mtf";

bool isMmcif(const Sample& sample)
{
    if (sample.word == cnsTopology) return false;
    return startsWithNoCase(sample.word, "data_") || startsWithNoCase(sample.word, "global_") ||
           startsWithNoCase(sample.word, "loop_") || sample.word.substr(0, 1) == "_";
}

/// True if the fourth line is one of counts.
bool isSdf(const Sample& sample)
{
    LineReader lines(sample.text);
    while (lines.number() < 4 && lines.next()) {
    }
    const string_view line = lines.line();
    int atoms = 0;
    return lines.number() == 4 &&
           (line.find("V2000") != string_view::npos || line.find("V3000") != string_view::npos ||
            ((sample.ends(".sdf") || sample.ends(".mol")) &&
             parseInteger(trimmed(line.substr(0, 3)), atoms)));
}

/// True if the second line is a number alone, and the third one an atom in columns or, of no atoms,
/// a box.
bool isGro(const Sample& sample)
{
    LineReader lines(sample.text);
    int atoms = 0, residue = 0;
    if (!lines.next() || !lines.next() || !parseInteger(trimmed(lines.line()), atoms)) return false;
    if (sample.ends(".gro") || !lines.next()) return sample.ends(".gro");
    const string_view line = lines.line();
    return line.size() > 40 && parseInteger(trimmed(line.substr(0, 5)), residue) &&
           parseInteger(trimmed(line.substr(15, 5)), residue) &&
           line.substr(20).find('.') != string_view::npos;
}

/// True if the second line is an atom of Tinker: number, name, x, y, z and type, partners.
bool isTinker(const Sample& sample)
{
    LineReader lines(sample.text);
    int number = 0;
    double x = 0.0;
    if (!lines.next() || !parseInteger(sample.word, number) || !lines.next()) return false;
    const Fields fields = splitFields(lines.line());
    constexpr std::size_t first = 2, type = 5;
    return fields.size() > type && parseInteger(fields[0], number) && !parseNumber(fields[1], x) &&
           std::all_of(fields.begin() + first, fields.begin() + type,
                       [&](string_view f) { return parseNumber(f, x); }) &&
           parseInteger(fields[type], number);
}

/// True if the first line is a number alone and the third one a symbol and coordinates.
bool isXyz(const Sample& sample)
{
    if (isTinker(sample)) return false;
    LineReader lines(sample.text);
    int atoms = 0;
    if (!lines.next() || !parseInteger(trimmed(lines.line()), atoms) || atoms < 0) return false;
    if (sample.ends(".xyz") || !lines.next() || !lines.next()) return sample.ends(".xyz");
    const Fields fields = splitFields(lines.line());
    double number = 0.0;
    return fields.size() >= 4 && std::isalpha(static_cast<unsigned char>(fields[0][0])) &&
           elementNumber(std::string(fields[0])) != 0 &&
           std::all_of(fields.begin() + 1, fields.begin() + 4,
                       [&](string_view f) { return parseNumber(f, number); });
}

/// True for records that only files of AutoDock have.
bool isPdbqt(const Sample& sample)
{
    if (!sample.hasRecords) return false;
    if (sample.ends(".pdbqt")) return true;
    if (sample.ends(".pdb") || sample.ends(".ent") || sample.ends(".pqr")) return false;
    for (LineReader lines(sample.text); lines.next();) {
        const string_view line = trimmed(lines.line());
        if (line == "ROOT" || line == "ENDROOT" || line.substr(0, 8) == "TORSDOF ") return true;
    }
    return false;
}

bool isPdb(const Sample& sample)
{
    return sample.hasRecords;
}

bool isPqr(const Sample& sample)
{
    return sample.hasRecords && !sample.ends(".pdb") && !sample.ends(".ent") &&
           (sample.ends(".pqr") || looksLikePqr(sample.text));
}

/// Formats that this program does not read, and what to do instead.
struct Refusal {
    const char *name, *hint;
    bool (*matches)(const Sample& sample);
};

bool has(const Sample& sample, string_view word)
{
    return string_view(sample.text).substr(0, 4096).find(word) != string_view::npos;
}

/// Coordinates of CHARMM: lines of a title that begin with a star, and a number alone.
bool isCharmmCard(const Sample& sample)
{
    LineReader lines(sample.text);
    std::size_t titles = 0;
    while (lines.next() && lines.line().substr(0, 1) == "*") ++titles;
    const Fields fields = splitFields(lines.line());
    int atoms = 0;
    return titles > 0 && !fields.empty() && parseInteger(fields[0], atoms);
}

/// Whether a file begins with some bytes.
bool beginsAs(const Sample& sample, string_view bytes)
{
    return string_view(sample.text).substr(0, bytes.size()) == bytes;
}

bool endsWithOneOf(const Sample& sample, std::initializer_list<const char*> endings)
{
    return std::any_of(endings.begin(), endings.end(),
                       [&](const char* ending) { return sample.ends(ending); });
}

const Refusal refusals[] = {
    {"an OpenVDB file, which is not read from pipes", "",
     [](const Sample& s) { return s.stream && beginsAs(s, " BDV"); }},
    {"an OpenVDB file", "", [](const Sample& s) { return beginsAs(s, " BDV"); }},
    {"a mesh, which compare reads where its name ends in .ply", "",
     [](const Sample& s) { return beginsAs(s, "ply\n") || beginsAs(s, "ply\r"); }},
    {"MMTF, which the Protein Data Bank no longer has", " [hint: take .bcif.gz of the same entry]",
     [](const Sample& s) { return s.ends(".mmtf") || has(s, "mmtfVersion"); }},
    {"a session of PyMOL", " [hint: in PyMOL, save FILE.cif]",
     [](const Sample& s) { return s.ends(".pse") || s.ends(".psw"); }},
    {"a run input of GROMACS", " [hint: gmx editconf writes FILE.gro of it]",
     [](const Sample& s) { return s.ends(".tpr"); }},
    {"a trajectory, which has no names",
     " [hint: give the structure, and this file with `trajectory`; MDAnalysis and mdtraj turn "
     "other "
     "kinds into .dcd]",
     [](const Sample& s) {
         return endsWithOneOf(s, {".dcd", ".xtc", ".trr", ".nc", ".ncdf", ".netcdf", ".h5"});
     }},
    {"a topology of CNS, which has no coordinates", "",
     [](const Sample& s) { return s.word == cnsTopology; }},
    {"a file of coordinates of CHARMM, which has no elements",
     " [hint: MDAnalysis turns it into FILE.pdb]", isCharmmCard},
    {"a file of Tinker", " [hint: Open Babel turns it, as txyz, into FILE.pdb]", isTinker},
    {"a file of LAMMPS, which has no names",
     " [hint: ASE turns a data file with masses into FILE.xyz]",
     [](const Sample& s) { return has(s, " xlo xhi") || has(s, "ITEM: TIMESTEP"); }},
    {"a pointer of Git LFS in the place of the file", " [hint: git lfs pull]",
     [](const Sample& s) { return beginsAs(s, "version https://git-lfs"); }},
    {"a web page (HTML) in the place of the file", " [hint: download the file itself]",
     [](const Sample& s) {
         return startsWithNoCase(s.word, "<!doctype") || startsWithNoCase(s.word, "<html");
     }},
    {"PDBML", " [hint: take .cif.gz of the same entry]",
     [](const Sample& s) { return has(s, "<PDBx:datablock"); }},
    {"CML", " [hint: Open Babel turns it into FILE.sdf]",
     [](const Sample& s) {
         return s.ends(".cml") || has(s, "<cml") || has(s, "xml-cml.org/schema");
     }},
    {"a file of coordinates without names",
     " [hint: cpptraj or ambpdb makes FILE.pdb of it and of its topology]",
     [](const Sample& s) {
         return endsWithOneOf(s, {".crd", ".inpcrd", ".rst", ".rst7", ".rst74", ".ncrst", ".coor"});
     }},
    {"a file of Maestro", " [hint: Maestro, structconvert or RDKit write FILE.pdb or FILE.sdf]",
     [](const Sample& s) { return s.ends(".mae") || s.ends(".maegz") || s.ends(".cms"); }},
    {"a map of reflections, structure factors", " [hint: take the file of the coordinates]",
     [](const Sample& s) { return s.ends(".mtz") || beginsAs(s, "MTZ "); }},
    {"JSON", " [use .cif or .pdb]", [](const Sample& s) { return s.word.substr(0, 1) == "{"; }},
    {"a ZIP archive", " [hint: unzip it]",
     [](const Sample& s) { return beginsAs(s, "PK\x03\x04"); }},
    {"a tar archive", " [hint: tar -xf takes the files out]",
     [](const Sample& s) {
         constexpr std::size_t place = 257; // of the magic
         return s.text.size() > place && s.text.compare(place, 5, "ustar") == 0;
     }},
    {"packed by zstd", " [hint: unzstd unpacks it; .gz, .bz2 and .xz are read]",
     [](const Sample& s) { return beginsAs(s, "\x28\xB5\x2F\xFD"); }},
    {"packed by compress", " [hint: uncompress unpacks it; .gz, .bz2 and .xz are read]",
     [](const Sample& s) { return beginsAs(s, "\x1F\x9D"); }},
    {"a binary file", "", [](const Sample& s) { return s.binary; }}};

/// A reader that does not keep the text and is too fast to be ended.
template<Structure read(const std::string& text, const std::string& path)>
Structure readText(std::string text, const std::string& path, const Progress&)
{
    return read(text, path);
}

} // namespace

const std::vector<StructureFormatRow>& structureFormats()
{
    using F = StructureFormat;
    static const std::vector<StructureFormatRow> table = {
        {F::BinaryCif,
         "BinaryCIF",
         {".bcif"},
         [](const Sample& s) { return isBinaryCif(s.text); },
         readBinaryCif,
         130.0},
        {F::Mol2,
         "mol2",
         {".mol2"},
         [](const Sample& s) { return s.word.substr(0, 9) == "@<TRIPOS>"; },
         readText<readMol2>,
         6.5},
        {F::Sdf, "sdf", {".sdf", ".mol"}, isSdf, readText<readSdf>, 12.0},
        {F::Psf,
         "psf",
         {".psf"},
         [](const Sample& s) { return s.word == "PSF"; },
         readText<readPsf>,
         6.5},
        {F::Parm7,
         "parm7",
         {".parm7", ".prmtop"},
         [](const Sample& s) { return s.word == "%VERSION"; },
         readText<readParm7>,
         12.0},
        {F::Gro, "gro", {".gro"}, isGro, readText<readGro>, 7.5},
        {F::Mmcif,
         "mmCIF",
         {".cif", ".mmcif"},
         isMmcif,
         readMmcif,
         cifDocumentPerByte,
         bytesForMmcif},
        {F::Pdbqt, "PDBQT", {".pdbqt"}, isPdbqt, readPdbqt, 3.0},
        {F::Pqr, "PQR", {".pqr"}, isPqr, readText<readPqr>, 6.5},
        {F::Pdb, "PDB", {".pdb", ".ent"}, isPdb, readPdb, 3.0},
        {F::Xyzrn,
         "xyzrn",
         {".xyzrn"},
         [](const Sample& s) { return s.ends(".xyzrn") || looksLikeNamedBall(s.first); },
         readText<readXyzrn>,
         8.5},
        {F::Xyzr,
         "xyzr",
         {".xyzr"},
         [](const Sample& s) { return looksLikeBall(s.first); },
         readText<readXyzr>,
         8.5},
        {F::Xyz, "xyz", {".xyz"}, isXyz, readText<readXyz>, 13.5}};
    return table;
}

const StructureFormatRow& rowOf(StructureFormat format)
{
    const auto& rows = structureFormats();
    return *std::find_if(rows.begin(), rows.end(),
                         [=](const StructureFormatRow& row) { return row.format == format; });
}

std::string structureFormatNames()
{
    std::string all;
    for (const StructureFormatRow& row : structureFormats()) {
        const bool last = &row == &structureFormats().back();
        all += (all.empty() ? "" : last ? " or " : ", ") + std::string(row.name);
    }
    return all;
}

bool hasStructureEnding(const std::string& path)
{
    const std::string extension = lowerExtension(path);
    const auto& rows = structureFormats();
    return std::any_of(rows.begin(), rows.end(), [&](const StructureFormatRow& row) {
        return std::find(row.endings.begin(), row.endings.end(), extension) != row.endings.end();
    });
}

StructureFormat detectFormat(const std::string& path, const std::string& text)
{
    const Sample sample(path, text);
    for (const StructureFormatRow& row : structureFormats())
        if ((!sample.binary || row.format == StructureFormat::BinaryCif) && row.matches(sample))
            return row.format;
    for (const Refusal& refusal : refusals)
        if (refusal.matches(sample))
            failAt(path, std::string("is ") + refusal.name + ", expected a structure (" +
                             structureFormatNames() + ")" + refusal.hint);
    for (const StructureFormatRow& row : structureFormats())
        for (const std::string& ending : row.endings)
            if (sample.ends(ending)) return row.format;
    const std::string what =
        sample.ends(".vdb") ? "is not a .vdb file of OpenVDB, and no structure" : "is no structure";
    failAt(path, what + ": expected " + structureFormatNames() + ", got " + inQuotes(sample.first));
}

} // namespace molsurf
