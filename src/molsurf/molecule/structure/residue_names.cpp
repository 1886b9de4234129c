// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/residue_names.h"

#include "molsurf/molecule/structure/element.h"

#include <gemmi/resinfo.hpp>

#include <algorithm>
#include <cctype>
#include <string>
#include <unordered_map>

namespace molsurf
{
namespace
{

using std::string_view;

struct NameList {
    NameClass kind;
    const char* names; ///< separated by blanks
};

/// Of two rows that have a name the first one counts.
constexpr NameList nameLists[] = {
    // The Protein Data Bank; histidine and the charged forms of CHARMM, Amber, GROMACS and OPLS.
    {NameClass::AminoAcid,
     "ALA ARG ASN ASP ASX CYS GLN GLU GLX GLY HIS ILE LEU LYS MET PHE PRO SER THR TRP TYR VAL SEC "
     "PYL UNK HSD HSE HSP HID HIE HIP HIN CYX CYM ASH GLH LYN ARN TYM HISA HISB HISD HISE HISH "
     "HISP HIS1 HIS2 HISN ARGN ARG0 ASPH ASPP GLUH GLUP LYSH LYP LSN CYSH CYS1 CYS2 CYSM CYN QLN "
     "TYRM TYRU ALAD"},
    {NameClass::ModifiedAminoAcid, "DALA DARG DASN DASP DCYS DGLN DGLU DHSD DHSE DHSP DHIS DILE "
                                   "DLEU DLYS DMET DPHE DPRO DSER DTHR DTRP DTYR DVAL HYP"},
    {NameClass::Cap, "ACE NME NMA NH2 FOR CT1 CT2 CT3 ACEX NMEX"},
    // The Protein Data Bank; Amber with its ends 5 and 3 and lone N; CHARMM; GROMACS.
    {NameClass::Nucleotide,
     "A C G T U I DA DC DG DT DU DI N DN RA RC RG RU A5 A3 AN C5 C3 CN G5 G3 GN U5 U3 UN DA5 DA3 "
     "DAN "
     "DC5 DC3 DCN DG5 DG3 DGN DT5 DT3 DTN RA5 RA3 RAN RC5 RC3 RCN RG5 RG3 RGN RU5 RU3 RUN ADE CYT "
     "GUA THY URA DADE DCYT DGUA DTHY RADE RCYT RGUA RURA"},
    {NameClass::Water,
     "HOH WAT DOD H2O HHO OHH OH2 WTR TWAT HOH2 SOL SPC SPCE SPCF SPCH TIP TIP2 "
     "TIP3 TIP4 TIP5 TIP6 TIP7 TP2 TP3 TP4 TP5 TP6 T3P T4P T5P T3H T4E T4H TP3M "
     "TP3F TP4E T4EW TIP3P TIP4P TIP5P TIPS TIPS3 TIP3S TIP3F TP4EW OPC OPC3 OPC4 "
     "SWM SWM4 SWM5 SWM6 SWMD"},
    {NameClass::Ion, "SOD CLA POT CAL CES LIT RUB CAD BAR MAG ION IOD CIO IB IP IM"},
    // Names that the Protein Data Bank gives to what is added to a solution.
    {NameClass::Buffer,
     "SO4 SO3 PO4 PO3 2HP PI NO3 CO3 BCT NH4 SCN AZI CAC ACT ACY FMT CIT FLC TLA TAR MLI MLA SIN "
     "OXL MLT TRS BTB EPE MES MPO NHE PIN CXS IMD GAI URE GOL EDO PGO PDO MPD MRD DMS DMF EOH MOH "
     "IPA IOH TBU BU1 BU3 DIO CCN ACN HEZ PEG PGE PG4 PG0 P6G P33 P4G 1PE 2PE 7PE PE3 PE4 PE8 12P "
     "15P XPE BME DTT DTU DTV TCE"},
    // Solvents and cosolvents of force fields.
    {NameClass::Solvent, "MEOH ETOH PROH IPRO DMSO UREA CHCL3 CHCL CCL4 CCL3 TFE TFEA THF GDM GDMC "
                         "BENX PRPX IMIA ACEY MAMY"},
    {NameClass::Lipid,
     "LDA LMT BOG BNG HTG DMU UMQ SDS C8E HTO D10 D12 OCT HEX OLA OLB OLC MPG TRIO CHL1 CHOL CHOA "
     "CHSP ERG1 ERGO SITO STIG CAMP LDAO LAPAO FOS10 FOS12 FOS14 BLMNG DMNG TX100 CHAPS DHPC "
     "LPPG LMPG CER1 TRIPA LAU2 PIP2 PIP3 CDL1 CDL2 TOCL TMCL TYCL "
     "TLCL TOCL1 TOCL2 TMCL1 TMCL2 TYCL1 TYCL2 TLCL1 TLCL2 POCL1 POCL2 SOPIP"},
    {NameClass::LongLipid, "PSM SSM NSM BSM LSM ASM OSM CER TAG DDM GM1 GM3"},
    {NameClass::CutLipid, "POP DPP DOP DMP DLP DSP DYP SDP SAP SOP CHL"},
    {NameClass::AmberLipid, "PC PE PS PA PGR PGS PH- MY LAL ST AR OL DHA SA SPM"},
    // CHARMM's sugars; those of the Protein Data Bank that gemmi's table does not have.
    {NameClass::Sugar,
     "NDG FUL GLA XYS XYP ARA AHR RIB RHA SIA SLB GCU BDP IDR IDS NGA A2G GCS BM3 FRU FUC AGLC "
     "BGLC "
     "AMAN BMAN AGAL BGAL AFUC BFUC AXYL BXYL AGLCNA BGLCNA AGLCN BGLCN BGLN AGALNA BGALNA ANE5AC "
     "BNE5AC ARHM BRHM AGLCA BGLCA AIDOA BIDOA LAT MAL SUC TRE"}};

using NameMap = std::unordered_map<string_view, NameClass>;

NameMap makeNames()
{
    NameMap out;
    for (const NameList& list : nameLists) {
        const string_view all = list.names;
        for (std::size_t begin = 0; begin < all.size();) {
            const std::size_t end = std::min(all.find(' ', begin), all.size());
            out.emplace(all.substr(begin, end - begin), list.kind);
            begin = end + 1;
        }
    }
    return out;
}

NameClass listed(string_view name)
{
    static const NameMap names = makeNames();
    const auto found = names.find(name);
    return found == names.end() ? NameClass::Unknown : found->second;
}

/// "DOPC", "POPI24": two letters for the tails, two for the head, perhaps digits.
bool isLipidName(string_view name)
{
    constexpr string_view tails = " DA DB DC DD DE DF DG DH DI DK DL DM DN DO DP DR DS DT DU DV DX "
                                  "DY LL LO LP OP PD PE PG PI PL PO PQ PU PV PY SA SD SL SO YO ";
    constexpr string_view heads = " PC PE PG PS PA PI PP ";
    if (name.size() < 4) return false;
    const auto isIn = [](string_view list, string_view word) {
        const std::size_t at = list.find(word);
        return at != string_view::npos && at % 3 == 1;
    };
    for (const char c : name.substr(4))
        if (!std::isdigit(static_cast<unsigned char>(c))) return false;
    return isIn(tails, name.substr(0, 2)) && isIn(heads, name.substr(2, 2));
}

/// "NALA", "CGLY": the ends of a chain in Amber's files.
bool isAmberEnd(string_view name)
{
    return name.size() == 4 && (name[0] == 'N' || name[0] == 'C') &&
           listed(name.substr(1)) == NameClass::AminoAcid;
}

NameClass tabulated(const std::string& name)
{
    using Kind = gemmi::ResidueInfo;
    const Kind info = gemmi::find_tabulated_residue(name);
    if (info.is_amino_acid())
        return info.is_standard() ? NameClass::AminoAcid : NameClass::ModifiedAminoAcid;
    if (info.is_nucleic_acid())
        return info.is_standard() ? NameClass::Nucleotide : NameClass::ModifiedNucleotide;
    if (info.is_water()) return NameClass::Water;
    if (info.kind == Kind::PYR || info.kind == Kind::KET) return NameClass::Sugar;
    return NameClass::Unknown;
}

} // namespace

std::uint8_t ionElement(string_view name)
{
    struct Ion {
        string_view name;
        const char* symbol;
    };
    constexpr Ion ions[] = {{"SOD", "Na"}, {"CLA", "Cl"}, {"POT", "K"},  {"CAL", "Ca"},
                            {"CES", "Cs"}, {"LIT", "Li"}, {"RUB", "Rb"}, {"CAD", "Cd"},
                            {"BAR", "Ba"}, {"MAG", "Mg"}, {"IOD", "I"},  {"CIO", "Na"},
                            {"IP", "Na"},  {"IM", "Cl"},  {"CLO", "Cl"}, {"BRO", "Br"}};
    for (const Ion& ion : ions)
        if (name == ion.name) return elementNumber(ion.symbol);
    const auto isLetterAt = [&](std::size_t at) {
        return at < name.size() && std::isalpha(static_cast<unsigned char>(name[at]));
    };
    const std::size_t begin = name.empty() || isLetterAt(0) ? 0 : 1;
    std::size_t end = begin;
    while (isLetterAt(end)) ++end;
    const string_view before = name.substr(0, begin), behind = name.substr(end);
    const auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
    const auto digits = std::count_if(name.begin(), name.end(), isDigit);
    const bool charge = behind.find_first_not_of("0123456789+-") == string_view::npos;
    const bool charmm = behind == "2P"; // MN2P
    const bool good = (before.empty() || isDigit(before[0])) && digits <= 1 && (charge || charmm);
    if (end == begin || end - begin > 2 || !good) return 0;
    return elementNumber(std::string(name.substr(begin, end - begin)));
}

NameClass nameClass(string_view residue)
{
    const NameClass known = listed(residue);
    if (known != NameClass::Unknown) return known;
    const NameClass inTable = tabulated(std::string(residue));
    if (inTable != NameClass::Unknown) return inTable;
    if (isAmberEnd(residue)) return NameClass::AminoAcid;
    if (isLipidName(residue) || residue.substr(0, 3) == "CER") return NameClass::Lipid;
    return ionElement(residue) != 0 ? NameClass::Ion : NameClass::Unknown;
}

bool isStandardResidue(string_view residue)
{
    const NameClass kind = nameClass(residue);
    return kind == NameClass::AminoAcid || kind == NameClass::Nucleotide;
}

} // namespace molsurf
