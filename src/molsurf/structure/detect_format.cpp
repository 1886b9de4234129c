// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/detect_format.h"

#include "molsurf/error.h"
#include "molsurf/structure/text_fields.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

namespace molsurf
{
namespace
{

using std::string_view;

std::string lowerExtension(const std::string& path)
{
    std::filesystem::path name(path);
    auto lower = [](std::string text) {
        for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        return text;
    };
    std::string extension = lower(name.extension().string());
    if (extension == ".gz") extension = lower(name.stem().extension().string());
    return extension;
}

void refuseBinary(const std::string& path, const std::string& text)
{
    const string_view head = string_view(text).substr(0, 4096);
    if (head.find('\0') == string_view::npos && head.substr(0, 1) != "\x83") return;
    if (head.substr(0, 4) == " BDV") {
        failAt(path, "is an OpenVDB file, expected a structure (PDB, mmCIF, PQR, xyzr or xyzrn)");
    }
    if (head.find("encoder") != string_view::npos || head.find("dataBlocks") != string_view::npos) {
        failAt(path, "is BinaryCIF, which is not supported [use the .cif.gz of the same entry]");
    }
    failAt(path, "is a binary file, expected a structure (PDB, mmCIF, PQR, xyzr or xyzrn)");
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

const char* formatName(StructureFormat format)
{
    static constexpr std::array<const char*, 5> names{"PDB", "mmCIF", "PQR", "xyzr", "xyzrn"};
    return names[std::size_t(format)];
}

StructureFormat detectFormat(const std::string& path, const std::string& text)
{
    refuseBinary(path, text);
    string_view first; // line that is neither blank nor a comment
    for (LineReader lines(text); first.empty() && lines.next();) {
        const Fields fields = splitFields(lines.line());
        if (!fields.empty() && fields[0][0] != '#') first = lines.line();
    }
    const string_view word = splitFields(first).empty() ? first : splitFields(first)[0];
    const std::string extension = lowerExtension(path);
    if (startsWithNoCase(word, "data_") || startsWithNoCase(word, "global_") ||
        startsWithNoCase(word, "loop_") || word.substr(0, 1) == "_") {
        return StructureFormat::Mmcif;
    }
    if (word.substr(0, 1) == "{")
        failAt(path, "is JSON, which is not supported [use .cif or .pdb]");
    if (isPdbRecord(first) || hasAtomRecord(text)) {
        if (extension == ".pdb" || extension == ".ent") return StructureFormat::Pdb;
        const bool pqr = extension == ".pqr" || looksLikePqr(text);
        return pqr ? StructureFormat::Pqr : StructureFormat::Pdb;
    }
    if (extension == ".xyzrn" || looksLikeNamedBall(first)) return StructureFormat::Xyzrn;
    if (looksLikeBall(first)) return StructureFormat::Xyzr;
    if (extension == ".pdb" || extension == ".ent") return StructureFormat::Pdb;
    if (extension == ".cif" || extension == ".mmcif") return StructureFormat::Mmcif;
    if (extension == ".pqr") return StructureFormat::Pqr;
    if (extension == ".xyzr") return StructureFormat::Xyzr;
    const std::string what =
        extension == ".vdb" ? "is not a .vdb file of OpenVDB, and no structure" : "is no structure";
    failAt(path, what + ": expected PDB, mmCIF, PQR, xyzr or xyzrn, got " + inQuotes(first));
}

} // namespace molsurf
