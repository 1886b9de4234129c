// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/ball_values.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/selection/ball_names.h"
#include "molsurf/molecule/selection/near_atoms.h"
#include "molsurf/molecule/selection/scalar_map.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <tuple>

namespace molsurf
{
namespace
{

using openvdb::Vec3d;

constexpr float missing = std::numeric_limits<float>::quiet_NaN();

const Residue& residueOf(const Structure& structure, const Ball& ball)
{
    return residueOf(structure, structure.atoms[std::size_t(ball.atom)]);
}

/// Sets the range to the values that 2 and 98 % of the balls do not exceed.
void spread(BallValues& out)
{
    std::vector<float> sorted;
    for (const float v : out.valueOf)
        if (std::isfinite(v)) sorted.push_back(v);
    if (sorted.empty()) return;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t last = sorted.size() - 1;
    out.low = double(sorted[last / 50]);
    out.high = double(sorted[last - last / 50]);
    if (out.high <= out.low) out.high = double(sorted.back());
    if (out.high <= out.low) out.low = double(sorted.front());
    if (out.high <= out.low) out.high = out.low + 1.0;
}

/// Makes the range reach as far below 0 as above it.
void balance(BallValues& out)
{
    const double most = std::max({std::abs(out.low), std::abs(out.high), 1e-6});
    out.low = -most;
    out.high = most;
}

/// Whether the B factors of the chains are as those of predicted models: the same within each
/// residue, in [0, 100]. Ligands and waters may have one an atom.
bool lookPredicted(const Structure& structure)
{
    std::map<std::int32_t, float> ofResidue;
    std::size_t repeated = 0;
    bool varied = false;
    for (const Atom& atom : structure.atoms) {
        if (!residueOf(structure, atom).polymer() || atom.role != AtomRole::Atom) continue;
        if (!(atom.bFactor >= 0.0f && atom.bFactor <= 100.0f)) return false;
        const auto [found, isNew] = ofResidue.emplace(atom.residue, atom.bFactor);
        if (!isNew && found->second != atom.bFactor) return false;
        repeated += !isNew;
        varied = varied || atom.bFactor != ofResidue.begin()->second;
    }
    return varied && repeated >= ofResidue.size();
}

/// Factor from B factors to pLDDT from 0 to 100: 100 where they are from 0 to 1, as
/// of ESMFold; 0: they are none.
float plddtScale(const Structure& structure)
{
    if (!structure.plddt && !lookPredicted(structure)) return 0.0f;
    float most = 0.0f;
    for (const Atom& atom : structure.atoms) {
        if (structure.plddt && !(atom.bFactor >= 0.0f && atom.bFactor <= 100.0f)) return 0.0f;
        most = std::max(most, atom.bFactor);
    }
    return most <= 1.0f ? 100.0f : 1.0f;
}

/// @param[in] scale  as plddtScale() gives it
BallValues bFactors(const Structure& structure, float scale, std::vector<std::string>& warnings)
{
    if (scale == 0.0f) return {"bfactor", "B factor", "Å²", "viridis", 0.0, 1.0, {}};
    const std::string why = structure.plddt
                                ? "the file says that its B factors are pLDDT: taken as those"
                                : "B factors are the same within every residue and from 0 to " +
                                      std::string(scale > 1.0f ? "1" : "100") +
                                      ": taken as the pLDDT of a predicted model";
    warnings.push_back(why + " [hint: with `range` they are B factors]");
    return {"plddt", "pLDDT", "", "plddt", 0.0, 100.0, {}};
}

/// The place of every residue in its chain, ligands and waters left out.
std::vector<float> placesInChains(const Structure& structure)
{
    std::map<std::int32_t, std::vector<std::size_t>> ofChain;
    for (std::size_t r = 0; r < structure.residues.size(); ++r) {
        const Residue& residue = structure.residues[r];
        if (!residue.water() && !residue.hetero()) ofChain[residue.chain].push_back(r);
    }
    std::vector<float> out(structure.residues.size(), missing);
    for (const auto& [chain, residues] : ofChain)
        for (std::size_t i = 0; i < residues.size(); ++i)
            out[residues[i]] = residues.size() > 1 ? float(i) / float(residues.size() - 1) : 0.0f;
    return out;
}

/// Values by chain, number, insertion code and perhaps name of an atom.
using Table = std::map<std::tuple<std::string, int, char, std::string>, float>;

/// Lines of chain, residue number and perhaps atom, in words or by commas, with the value last.
/// Lines without a number, as a heading, are left out.
Table readTable(const std::string& path, std::size_t maxBytes)
{
    const std::string text = loadText(path, maxBytes);
    Table out;
    for (LineReader lines(text); lines.next();) {
        std::string line(lines.line());
        for (char& c : line)
            if (c == ',' || c == ';') c = ' ';
        const Fields fields = splitFields(line);
        if (fields.empty() || fields[0][0] == '#') continue;
        constexpr std::size_t longest = 64; // of a number
        const std::string last(fields.back().substr(0, longest));
        char* end = nullptr;
        const float value = std::strtof(last.c_str(), &end);
        const bool isText = end != last.c_str() + last.size() || fields.back().size() > longest;
        if (isText && out.empty()) continue; // names of the columns
        const bool number = !isText && std::isfinite(value);
        int residue = 0;
        char insertion = ' ';
        bool good = number && (fields.size() == 3 || fields.size() == 4);
        if (good) {
            const char* begin = fields[1].data();
            const char* stop = begin + fields[1].size();
            const auto [rest, problem] = std::from_chars(begin, stop, residue);
            good = problem == std::errc() && stop - rest <= 1;
            if (good && rest < stop) insertion = *rest;
        }
        if (!good)
            throw Error(ErrorKind::Input,
                        displayName(path) + ":" + std::to_string(lines.number()) +
                            ": expected chain, residue number, perhaps atom, and a finite value, "
                            "got " +
                            inQuotes(std::string(lines.line())));
        const bool isNew =
            out.emplace(std::tuple(std::string(fields[0]), residue, insertion,
                                   fields.size() == 4 ? std::string(fields[2]) : std::string()),
                        value)
                .second;
        if (!isNew)
            throw Error(ErrorKind::Input,
                        displayName(path) + ":" + std::to_string(lines.number()) +
                            ": expected one value for each, got a second one for " +
                            inQuotes(std::string(fields[0]) + " " + std::string(fields[1])));
    }
    if (out.empty()) failAt(path, "it has no values");
    return out;
}

/// Gives each ball the value of its atom, or else of its residue, and warns of unused lines.
void fillFromTable(const Structure& structure, const std::vector<Ball>& balls,
                   const std::string& path, std::size_t maxBytes, BallValues& out,
                   std::vector<std::string>& warnings)
{
    const Table table = readTable(path, maxBytes);
    Table unused = table;
    for (const Ball& ball : balls) {
        const Residue& residue = residueOf(structure, ball);
        const std::string& chain = structure.chains[std::size_t(residue.chain)];
        float value = missing;
        for (const std::string& atom :
             {std::string(), structure.atoms[std::size_t(ball.atom)].name}) {
            const auto found = table.find({chain, residue.number, residue.insertionCode, atom});
            if (found == table.end()) continue;
            value = found->second;
            unused.erase(found->first);
        }
        out.valueOf.push_back(value);
    }
    if (unused.empty()) return;
    if (unused.size() == table.size()) {
        const auto& [chain, number, insertion, atom] = table.begin()->first;
        const Residue& first = residueOf(structure, balls.front());
        throw Error(ErrorKind::Input, path +
                                          ": none of its atoms is there: it has those of chain " +
                                          inQuotes(chain) + ", " + std::to_string(number) +
                                          ", for example, expected such as " +
                                          inQuotes(structure.chains[std::size_t(first.chain)]) +
                                          ", " + std::to_string(first.number));
    }
    const auto& [chain, number, insertion, atom] = unused.begin()->first;
    warnings.push_back(std::to_string(unused.size()) +
                       " values of the table are for atoms that there are not, as of " + chain +
                       " " + std::to_string(number) +
                       (insertion == ' ' ? "" : std::string(1, insertion)) +
                       (atom.empty() ? "" : " " + atom));
}

} // namespace

float hydrophobicityOf(const std::string& residue)
{
    static const std::map<std::string, float> scale = {
        {"ILE", 4.5f},  {"VAL", 4.2f},  {"LEU", 3.8f},  {"PHE", 2.8f},  {"CYS", 2.5f},
        {"MET", 1.9f},  {"ALA", 1.8f},  {"GLY", -0.4f}, {"THR", -0.7f}, {"SER", -0.8f},
        {"TRP", -0.9f}, {"TYR", -1.3f}, {"PRO", -1.6f}, {"HIS", -3.2f}, {"GLU", -3.5f},
        {"GLN", -3.5f}, {"ASP", -3.5f}, {"ASN", -3.5f}, {"LYS", -3.9f}, {"ARG", -4.5f}};
    const auto found = scale.find(parentResidue(residue));
    return found == scale.end() ? missing : found->second;
}

const std::vector<std::string>& valueWords()
{
    static const std::vector<std::string> words = {"bfactor",        "occupancy", "charge",
                                                   "hydrophobicity", "rainbow",   "radius",
                                                   "depth",          "table",     "potential"};
    return words;
}

std::optional<ValueBy> parseValueBy(const std::string& text, const std::string& option)
{
    const std::size_t equals = text.find('=');
    const std::string word = lowered(text.substr(0, equals));
    for (std::size_t k = 0; k < valueWords().size(); ++k) {
        if (word != valueWords()[k] || (equals != std::string::npos) != (k >= valuesWithoutFile))
            continue;
        ValueBy by{ValueBy::Kind(k)};
        if (k >= valuesWithoutFile) by.file = text.substr(equals + 1);
        if (k >= valuesWithoutFile && by.file.empty())
            throw Error(ErrorKind::Usage,
                        "`" + option + "`: expected " + word + "=FILE, got '" + text + "'");
        return by;
    }
    return std::nullopt;
}

std::string textOf(const ValueBy& by)
{
    const std::string& word = valueWords()[std::size_t(by.kind)];
    return by.file.empty() ? word : word + "=" + by.file;
}

namespace
{

/// Gives hydrogens without a value of their own that of their heavy atom.
/// @param[in] zeroIsNone  whether 0 is no value of a hydrogen
void lendToHydrogens(const Structure& structure, const std::vector<Ball>& balls, bool zeroIsNone,
                     BallValues& values)
{
    constexpr std::uint8_t hydrogen = 1;
    std::vector<AtomSite> sites;
    for (const Atom& atom : structure.atoms)
        sites.push_back({atom.position, atom.residue, atom.element != hydrogen});
    const std::vector<std::int32_t> heavy = heavyAtoms(sites, structure.residues.size());
    std::vector<float> ofAtom(structure.atoms.size(), missing);
    for (std::size_t i = 0; i < balls.size(); ++i)
        ofAtom[std::size_t(balls[i].atom)] = values.valueOf[i];
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const auto atom = std::size_t(balls[i].atom);
        float& value = values.valueOf[i];
        if (heavy[atom] == balls[i].atom) continue;
        if (!std::isfinite(value) || (zeroIsNone && value == 0.0f))
            value = ofAtom[std::size_t(heavy[atom])];
    }
}

/// Gives the balls of a residue the mean of their values.
void averageResidues(const Structure& structure, const std::vector<Ball>& balls, BallValues& values)
{
    std::vector<double> sums(structure.residues.size(), 0.0), counts(sums);
    const auto residue = [&](std::size_t i) {
        return std::size_t(structure.atoms[std::size_t(balls[i].atom)].residue);
    };
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (!std::isfinite(values.valueOf[i])) continue;
        sums[residue(i)] += double(values.valueOf[i]);
        counts[residue(i)] += 1.0;
    }
    for (std::size_t i = 0; i < balls.size(); ++i)
        if (counts[residue(i)] > 0.0)
            values.valueOf[i] = float(sums[residue(i)] / counts[residue(i)]);
}

/// Sets the range of values that have none of their own, and says what they cannot show.
void judge(const Coloring& coloring, bool spreads, bool signedRange, BallValues& values,
           std::vector<std::string>& warnings)
{
    std::size_t none = 0;
    float low = std::numeric_limits<float>::max(), high = -low;
    for (const float v : values.valueOf) {
        none += !std::isfinite(v);
        if (!std::isfinite(v)) continue;
        low = std::min(low, v);
        high = std::max(high, v);
    }
    if (values.byPoint() && !spreads) return;
    if (none > 0 && none < values.valueOf.size())
        warnings.push_back(values.title + ": " + std::to_string(none) + " of " +
                           std::to_string(values.valueOf.size()) +
                           " atoms have none and are pale green");
    if (coloring.range) {
        values.low = (*coloring.range)[0];
        values.high = (*coloring.range)[1];
        return;
    }
    const bool varies = high > low || values.byPoint();
    if (!spreads) return;
    if (varies) {
        spread(values);
        if (signedRange) balance(values);
    } else if (none < values.valueOf.size()) {
        values.low = values.high = double(low);
        warnings.push_back(values.title + ": all atoms have " + formatted("%.6g", double(low)) +
                           ", which is grey [hint: `range`]");
    }
}

} // namespace

BallValues ballValues(const Structure& structure, const std::vector<Ball>& balls, const ValueBy& by,
                      const Coloring& coloring, const BallPlaces& places, std::size_t maxBytes,
                      std::vector<std::string>& warnings)
{
    const auto filled = [&](BallValues out, const auto& value) {
        for (const Ball& ball : balls) out.valueOf.push_back(value(ball));
        return out;
    };
    const auto atomOf = [&](const Ball& ball) -> const Atom& {
        return structure.atoms[std::size_t(ball.atom)];
    };
    using Kind = ValueBy::Kind;
    const std::string& word = valueWords()[std::size_t(by.kind)];
    BallValues out;
    bool spreads = true; // the range over the values
    if ((by.kind == Kind::BFactor || by.kind == Kind::Occupancy) && structure.hasRadii)
        failAt(structure.source, std::string("it has no ") +
                                     (by.kind == Kind::BFactor ? "B factors" : "occupancies") +
                                     ", which a PDB or mmCIF file has");
    if (by.kind == Kind::BFactor) {
        const float scale = coloring.range ? 0.0f : plddtScale(structure);
        out = filled(bFactors(structure, scale, warnings), [&](const Ball& ball) {
            return atomOf(ball).bFactor * (scale > 0.0f ? scale : 1.0f);
        });
        spreads = out.name == word;
    } else if (by.kind == Kind::Occupancy) {
        out = filled({word, "Occupancy", "", "viridis", 0.0, 1.0, {}},
                     [&](const Ball& ball) { return atomOf(ball).occupancy; });
    } else if (by.kind == Kind::Charge) {
        if (structure.charges.empty())
            failAt(structure.source, "it has no charges, which a PQR file has");
        out = filled({word, "Charge", "e", "BuRd", -1.0, 1.0, {}},
                     [&](const Ball& ball) { return structure.charges[std::size_t(ball.atom)]; });
    } else if (by.kind == Kind::Hydrophobicity) {
        out = filled(
            {word, "Hydrophobicity", "Kyte-Doolittle", "RdBu", -4.5, 4.5, {}},
            [&](const Ball& ball) { return hydrophobicityOf(residueOf(structure, ball).name); });
        spreads = false;
    } else if (by.kind == Kind::Rainbow) {
        const std::vector<float> alongChains = placesInChains(structure);
        out = filled({word, "N to C", "", "turbo", 0.0, 1.0, {}}, [&](const Ball& ball) {
            return alongChains[std::size_t(atomOf(ball).residue)];
        });
        spreads = false;
    } else if (by.kind == Kind::Radius) {
        const Vec3d& centre = places.centre;
        out = filled({word, "Radius", "Å", "viridis", 0.0, 1.0, centre}, [&](const Ball& ball) {
            return float((Vec3d(ball.center) - centre).length());
        });
    } else if (by.kind == Kind::Depth) {
        out = {word, "Depth", "Å", "viridis", 0.0, 1.0, {}};
        out.valueOf.assign(places.depths.begin(), places.depths.end());
    } else if (by.kind == Kind::Table) {
        out = {"value", "Value", "", "viridis", 0.0, 1.0, {}};
        fillFromTable(structure, balls, by.file, maxBytes, out, warnings);
    } else {
        out = {"potential", "Potential", "kT/e", "BuRd", -5.0, 5.0, {}};
        const auto field = std::make_shared<ScalarMap>(readDx(by.file, maxBytes));
        out.field = field;
        spreads = false;
        for (const Ball& ball : balls) out.valueOf.push_back(field->at(Vec3d(ball.center)));
    }
    if (!out.byPoint()) lendToHydrogens(structure, balls, by.kind == Kind::BFactor, out);
    if (!out.byPoint() && coloring.byResidue) averageResidues(structure, balls, out);
    judge(coloring, spreads, by.kind == Kind::Charge, out, warnings);
    if (!coloring.palette.empty()) out.palette = coloring.palette;
    out.flat = coloring.flat;
    return out;
}

} // namespace molsurf
