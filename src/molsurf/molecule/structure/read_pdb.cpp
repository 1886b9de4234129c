// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/readers.h"

#include "molsurf/kernel/core/cancel.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/assembly_operators.h"
#include "molsurf/molecule/structure/atom_tree.h"
#include "molsurf/molecule/structure/element.h"
#include "molsurf/molecule/structure/guess_element.h"
#include "molsurf/molecule/structure/pdb_columns.h"
#include "molsurf/molecule/structure/residue_bonds.h"
#include "molsurf/molecule/structure/residue_names.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace molsurf
{
namespace
{

using std::string_view;

int modelNumber(string_view line, int previous)
{
    const Fields fields = splitFields(line);
    int number = previous + 1;
    if (fields.size() > 1) parseInteger(fields[1], number);
    return number;
}

/// A number for the chain, residue and name of an atom.
std::size_t hashOf(const Structure& structure, const Atom& atom)
{
    const Residue& r = residueOf(structure, atom);
    const std::hash<std::string> ofText;
    std::size_t hash = ofText(atom.name) * 31 + ofText(r.name);
    for (const int part : {r.number, int(r.insertionCode), int(r.chain)})
        hash = (hash ^ std::size_t(part)) * 0x9e3779b97f4a7c15u;
    return hash;
}

/// END ends a frame, which has at least half of the atoms of the first one, or these half of its
/// own. What has others is another molecule, as the ligand that cat appended to a receptor.
/// @param[in] named  whether MODEL begins models: then a warning names those of other atoms
void joinMolecules(Structure& structure, bool named)
{
    std::vector<Model>& models = structure.models;
    if (models.size() < 2) return;
    const auto at = [&](std::size_t i) { return structure.atoms.begin() + std::ptrdiff_t(i); };
    std::unordered_set<std::size_t> first;
    for (std::size_t i = models[0].begin; i < models[0].end; ++i)
        first.insert(hashOf(structure, structure.atoms[i]));
    std::vector<Model> frames{models[0]};
    for (std::size_t m = 1; m < models.size(); ++m) {
        const auto same = std::count_if(at(models[m].begin), at(models[m].end), [&](const Atom& a) {
            return first.count(hashOf(structure, a)) > 0;
        });
        if (2 * std::size_t(same) >= std::min(first.size(), models[m].end - models[m].begin))
            frames.push_back({int(frames.size()) + 1, models[m].begin, models[m].end});
        else
            frames.back().end = models[m].end;
    }
    if (frames.size() == models.size()) return;
    if (named) {
        structure.warnings.push_back(
            counted(models.size() - frames.size(), "model has", "models have") +
            " other atoms than the first one");
        return;
    }
    structure.warnings.push_back(
        "END stands between molecules of other atoms: " + std::to_string(models.size()) +
        " were read as " + counted(frames.size(), "model", "models"));
    models = std::move(frames);
    structure.bonds = nullptr; // numbers of atoms begin anew in each
}

/// Reads the records of a PDB or PDBQT file.
class PdbReader
{
public:
    PdbReader(const std::string& path, bool autoDock) : path_(path), autoDock_(autoDock) {}

    Structure read(const std::string& text, const Progress& progress)
    {
        PdbLayoutFinder finder;
        // CONECT comes first, too: names are kept of those atoms alone that a bond asks for.
        for (LineReader lines(text); lines.next();) {
            if (isAtomRecord(lines.line()))
                finder.add(lines.line());
            else if (lines.line().substr(0, 6) == "CONECT")
                connect(lines.line());
        }
        layout_ = finder.layout();
        layout_.autoDock = autoDock_;
        constexpr std::size_t shortest = 54; // of the line of an atom
        tree_.reserve(std::min(finder.atoms(), text.size() / shortest + 1));
        stopIfCancelled(progress);
        for (LineReader lines(text); lines.next();) record(lines);
        stopIfCancelled(progress);
        Structure out = tree_.finish();
        out.assemblies = parseRemark350(remarks_);
        auto ncs = parseMtrix(matrices_, out.warnings);
        if (ncs) out.assemblies.push_back(std::move(*ncs));
        out.bonds = bonds();
        joinMolecules(out, explicitModels_);
        if (autoDock_ && charges_.size() == out.atoms.size()) out.charges = std::move(charges_);
        return out;
    }

private:
    /// Counts the bonds of a record CONECT, an atom and up to four that it is bonded to, for each
    /// direction. Some programs give a double bond twice.
    void connect(string_view line)
    {
        constexpr std::size_t first = 6, width = 5, most = 4;
        int from = 0;
        if (!parseInteger(columns(line, first, width), from)) return;
        for (std::size_t n = 1; n <= most; ++n) {
            int to = 0;
            if (!parseInteger(columns(line, first + n * width, width), to) || to == from) continue;
            ++connected_[{std::min(from, to), std::max(from, to)}][from < to];
            ends_[from] = ends_[to] = std::nullopt;
        }
    }

    std::shared_ptr<const FileBonds> bonds() const
    {
        const auto all = std::make_shared<FileBonds>();
        for (const auto& [pair, times] : connected_) {
            const auto &a = ends_.at(pair.first), &b = ends_.at(pair.second);
            if (!a || !b) continue;
            const int most = std::max(times[0], times[1]);
            const BondOrder order = most == 2   ? BondOrder::Double
                                    : most == 3 ? BondOrder::Triple
                                                : BondOrder::Single;
            all->links.push_back({*a, *b, order});
        }
        return all->links.empty() ? nullptr : all;
    }

    void record(const LineReader& lines)
    {
        const string_view line = lines.line();
        const string_view name = line.substr(0, 6);
        if (isAtomRecord(line)) {
            if (!inModel_) tree_.startModel(last_ = next_);
            inModel_ = true;
            atom(lines);
        } else if (name.substr(0, 5) == "MODEL") {
            next_ = modelNumber(line, last_);
            inModel_ = false;
            explicitModels_ = true;
        } else if (name == "ENDMDL" || trimmed(name) == "END") {
            if (inModel_) next_ = last_ + 1;
            inModel_ = false;
        } else if (line.substr(0, 10) == "REMARK 350") {
            remarks_.push_back(line);
        } else if (line.substr(0, 5) == "MTRIX") {
            matrices_.push_back(line);
        } else {
            refuseMisspeltAtom(path_, lines);
        }
    }

    void atom(const LineReader& lines)
    {
        AtomLine atom = atomInColumns(lines.line(), layout_);
        atom.position = placeInColumns(path_, lines);
        if (layout_.autoDock) autoDockType(lines.line(), atom);
        const auto end = ends_.find(atom.serial);
        if (end != ends_.end() && !end->second)
            end->second = {std::string(atom.chain), atom.number, atom.insertionCode,
                           std::string(atom.name)};
        tree_.add(atom);
    }

    void autoDockType(string_view line, AtomLine& atom)
    {
        const string_view type = columns(line, 77, 4);
        atom.element = elementOfAutoDockType(type);
        const std::uint8_t ion = ionElement(atom.residue);
        if (ion != 0 && ion == elementNumber(std::string(type))) atom.element = ion; // NA of NA
        if (isAutoDockParticle(type)) {
            atom.element = 0;
            atom.role = AtomRole::Particle;
        }
        double charge = 0.0;
        if (parseNumber(columns(line, 70, 6), charge)) charges_.push_back(float(charge));
    }

    /// Types of the glue of rings that are open, of hydrating water and of a zinc's fourth ligand.
    static bool isAutoDockParticle(string_view type)
    {
        return type == "W" || type == "TZ" || type == "Z" || type == "J" || type == "Q" ||
               type == "GA" || (type.size() == 2 && type[0] == 'G' && isDigit(type[1]));
    }

    const std::string& path_;
    bool autoDock_;
    PdbLayout layout_;
    AtomTree tree_;
    std::vector<string_view> remarks_, matrices_;
    std::vector<float> charges_;
    /// By numbers of atoms: how often a bond is given from either end, and the atoms, once known.
    std::map<std::pair<int, int>, std::array<int, 2>> connected_;
    std::unordered_map<int, std::optional<FileBonds::End>> ends_;
    int next_ = 1, last_ = 0; ///< numbers of the model that the next atom starts, and of the last
    bool inModel_ = false, explicitModels_ = false;
};

} // namespace

Structure readPdb(std::string text, const std::string& path, const Progress& progress)
{
    return PdbReader(path, false).read(text, progress);
}

Structure readPdbqt(std::string text, const std::string& path, const Progress& progress)
{
    return PdbReader(path, true).read(text, progress);
}

} // namespace molsurf
