// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/readers.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/cancel.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/assembly_operators.h"
#include "molsurf/molecule/structure/atom_tree.h"
#include "molsurf/molecule/structure/binary_cif.h"
#include "molsurf/molecule/structure/element.h"
#include "molsurf/molecule/structure/ihm_spheres.h"
#include "molsurf/molecule/structure/residue_bonds.h"
#include "molsurf/molecule/structure/small_cif.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <gemmi/cif.hpp>
#include <gemmi/numb.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace molsurf
{
namespace
{

/// "line 2, column 1: what is expected" of gemmi's "2:1: what is wrong"; other texts as they are.
std::string withPlace(const std::string& text)
{
    const std::size_t line = text.find(':'), column = text.find(": ", line + 1);
    const auto isNumber = [&](std::size_t begin, std::size_t end) {
        return end != std::string::npos && begin < end &&
               std::all_of(text.begin() + std::ptrdiff_t(begin), text.begin() + std::ptrdiff_t(end),
                           isDigit);
    };
    if (!isNumber(0, line) || !isNumber(line + 1, column)) return text;
    const std::string what = text.substr(column + 2);
    return "line " + text.substr(0, line) + ", column " + text.substr(line + 1, column - line - 1) +
           ": " + (what == "parse error" ? "expected a tag, a value or a keyword of CIF" : what);
}

/// gemmi's message in one line, without the path that it may start with.
std::string oneLine(const std::exception& error, const std::string& path)
{
    std::string text = error.what();
    if (text.compare(0, path.size() + 1, path + ":") == 0) text.erase(0, path.size() + 1);
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    }
    return withPlace(text.substr(
        text.find_first_not_of(' ') == std::string::npos ? 0 : text.find_first_not_of(' ')));
}

using gemmi::cif::Block;

/// First data block that has atoms.
Block& blockWithAtoms(gemmi::cif::Document& document, const std::string& path,
                      std::vector<std::string>& warnings)
{
    const auto isMacromolecule = [](const Block& block) {
        return block.has_tag("_atom_site.Cartn_x") || hasSpheres(block);
    };
    for (bool (*const has)(const Block&) : {+isMacromolecule, hasSmallMolecule}) {
        std::vector<Block*> found;
        for (Block& block : document.blocks)
            if (has(block)) found.push_back(&block);
        if (found.size() > 1)
            warnings.push_back(std::to_string(found.size() - 1) +
                               " further data blocks with atoms were ignored");
        if (!found.empty()) return *found[0];
    }
    std::string hint;
    for (const Block& block : document.blocks) {
        if (block.has_tag("_chem_comp_atom.atom_id"))
            hint = " [it describes a chemical component without coordinates]";
        if (block.has_tag("_refln.index_h") || block.has_tag("_diffrn_refln.index_h"))
            hint =
                " [it has structure factors, the reflections of a crystal; hint: take the file of "
                "the coordinates]";
    }
    failAt(path, "no atoms: expected _atom_site.Cartn_x and others of mmCIF, got none" + hint);
}

/// Columns of a matrix and a vector in a table of operators.
constexpr std::array<const char*, 12> operatorColumns{
    "matrix[1][1]", "matrix[1][2]", "matrix[1][3]", "matrix[2][1]", "matrix[2][2]", "matrix[2][3]",
    "matrix[3][1]", "matrix[3][2]", "matrix[3][3]", "vector[1]",    "vector[2]",    "vector[3]"};

/// The operators of a category, each with the row of `id` and of a further column, if it is given.
template<typename Add>
void readOperators(Block& block, const std::string& category, const char* further, Add add)
{
    std::vector<std::string> columns{"id"};
    columns.insert(columns.end(), operatorColumns.begin(), operatorColumns.end());
    if (further) columns.push_back(std::string("?") + further);
    auto table = block.find(category, columns);
    for (auto row : table) {
        Operator op{};
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                op.rotation[i][j] = gemmi::cif::as_number(row[1 + 3 * i + j]);
            }
            op.translation[static_cast<int>(i)] = gemmi::cif::as_number(row[10 + i]);
        }
        op.name = row.str(0);
        add(op, further && row.has(13) ? row.str(13) : std::string());
    }
}

/// Chains that share an operator expression become one part, so that a copy is whole.
std::vector<Assembly> readAssemblies(Block& block)
{
    std::map<std::string, Operator> operators;
    readOperators(block, "_pdbx_struct_oper_list.", nullptr,
                  [&](const Operator& op, const std::string&) { operators[op.name] = op; });
    std::vector<Assembly> assemblies;
    std::unordered_map<std::string, std::size_t> indices; // by name
    std::map<std::pair<std::size_t, std::string>, std::size_t> partOf;
    std::size_t count = 0; // of operators
    auto table = block.find("_pdbx_struct_assembly_gen.",
                            {"assembly_id", "oper_expression", "asym_id_list"});
    for (auto row : table) {
        const std::string name = row.str(0), expression = row.str(1);
        std::string chains = row.str(2);
        chains.erase(std::remove_if(chains.begin(), chains.end(),
                                    [](unsigned char c) { return std::isspace(c) != 0; }),
                     chains.end());
        const auto place = indices.emplace(name, assemblies.size());
        if (place.second) assemblies.push_back({name, {}, {}});
        const std::size_t index = place.first->second;
        Assembly& assembly = assemblies[index];
        const auto known = partOf.emplace(std::pair(index, expression), assembly.parts.size());
        try {
            if (known.second) {
                if (count > maxOperators)
                    throw Error(ErrorKind::Input, "the assemblies before it have more than " +
                                                      std::to_string(maxOperators) + " operators");
                assembly.parts.push_back({{}, expandOperators(expression, operators)});
                count += assembly.parts.back().operators.size();
            }
            auto& list = assembly.parts[known.first->second].chains;
            for (const std::string_view chain : splitNames(chains)) list.emplace_back(chain);
        } catch (const Error& error) {
            partOf.erase(known.first);
            assembly.problem = error.what();
        }
    }
    std::vector<Operator> generated;
    readOperators(block, "_struct_ncs_oper.", "code",
                  [&](const Operator& op, const std::string& code) {
                      if (code == "generate") generated.push_back(op);
                  });
    auto ncs = ncsAssembly(std::move(generated));
    if (ncs) assemblies.push_back(std::move(*ncs));
    return assemblies;
}

/// Whether a block says that its B factors are pLDDT, as AlphaFold and ModelCIF do.
bool namesPlddt(Block& block)
{
    for (const char* column : {"name", "type"})
        for (const std::string& text : block.find_values(std::string("_ma_qa_metric.") + column))
            if (gemmi::to_lower(text).find("plddt") != std::string::npos) return true;
    return false;
}

/// The order of a bond as mmCIF has it.
BondOrder orderOf(const std::string& word, bool aromatic)
{
    const std::string lower = gemmi::to_lower(word);
    if (aromatic || lower == "arom") return BondOrder::Aromatic;
    return lower == "doub"   ? BondOrder::Double
           : lower == "trip" ? BondOrder::Triple
                             : BondOrder::Single;
}

/// The bonds of _chem_comp_bond, and covalent ones, disulfides and those of metals of _struct_conn
/// that lead to no copy by the crystal's symmetry.
std::shared_ptr<const FileBonds> readBonds(Block& block)
{
    const auto all = std::make_shared<FileBonds>();
    const auto text = [](auto& row, std::size_t n) {
        return row.has2(n) ? row.str(n) : std::string();
    };
    for (auto row : block.find("_chem_comp_bond.", {"comp_id", "atom_id_1", "atom_id_2",
                                                    "?value_order", "?pdbx_aromatic_flag"}))
        all->residues[row.str(0)].add(row.str(1), row.str(2),
                                      orderOf(text(row, 3), text(row, 4) == "Y"));
    for (auto& [name, bonds] : all->residues) bonds.finish();
    auto table =
        block.find("_struct_conn.",
                   {"conn_type_id", "ptnr1_label_asym_id", "ptnr1_auth_seq_id",
                    "ptnr1_label_atom_id", "ptnr2_label_asym_id", "ptnr2_auth_seq_id",
                    "ptnr2_label_atom_id", "?pdbx_ptnr1_PDB_ins_code", "?pdbx_ptnr2_PDB_ins_code",
                    "?ptnr1_symmetry", "?ptnr2_symmetry", "?pdbx_value_order"});
    for (auto row : table) {
        const std::string type = gemmi::to_lower(row.str(0)).substr(0, 6);
        if (type != "covale" && type != "disulf" && type != "metalc") continue;
        if (text(row, 9) != text(row, 10)) continue;
        const auto end = [&](std::size_t first, std::size_t code) {
            FileBonds::End out{row.str(first), 0, ' ', row.str(first + 2)};
            parseInteger(row.str(first + 1), out.number);
            if (row.has2(code)) out.insertionCode = row.str(code)[0];
            return out;
        };
        all->links.push_back({end(1, 7), end(4, 8), orderOf(text(row, 11), false)});
    }
    return all->links.empty() && all->residues.empty() ? nullptr : all;
}

/// What a block says that its molecules are.
class EntityTypes
{
public:
    explicit EntityTypes(Block& block)
    {
        for (auto row : block.find("_entity.", {"id", "type"})) types_[row.str(0)] = row.str(1);
        auto chains = block.find("_struct_asym.", {"id", "entity_id"});
        listed_ = chains.ok();
        for (auto row : chains) {
            const auto type = types_.find(row.str(1));
            if (type != types_.end()) ofChain_.emplace(row.str(0), hintOf(type->second));
        }
    }

    /// Of a label chain by the table of chains, or by the entity that its atoms name.
    EntityHint of(const std::string& asym, const std::string& entity)
    {
        const auto known = ofChain_.find(asym);
        if (known != ofChain_.end()) return known->second;
        const auto type = listed_ ? types_.end() : types_.find(entity);
        const EntityHint hint = type == types_.end() ? EntityHint::None : hintOf(type->second);
        return ofChain_.emplace(asym, hint).first->second;
    }

private:
    static EntityHint hintOf(const std::string& type)
    {
        const std::string lower = gemmi::to_lower(type);
        return lower == "polymer"              ? EntityHint::Polymer
               : lower == "water"              ? EntityHint::Water
               : lower == "?" || lower.empty() ? EntityHint::None
                                               : EntityHint::Other;
    }

    std::map<std::string, std::string> types_;            // by entity
    std::unordered_map<std::string, EntityHint> ofChain_; // by label chain
    bool listed_ = false; ///< whether the chains are, or else the atoms name their entities
};

/// Text of a value, without its quotes; empty for "." and "?".
std::string_view textOf(std::string_view value, std::string& buffer)
{
    if (value.size() == 1 && (value[0] == '.' || value[0] == '?')) return {};
    if (value.empty() || (value[0] != '\'' && value[0] != '"' && value[0] != ';')) return value;
    return buffer = gemmi::cif::as_string(std::string(value));
}

/// Makes atoms of the rows of _atom_site.
class AtomSite
{
public:
    AtomSite(const std::vector<std::string>& tags, const std::string& path) : path_(path)
    {
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            const auto found = std::find_if(tags.begin(), tags.end(), [&](const std::string& tag) {
                return lowered(tag) == lowered(std::string("_atom_site.") + names[c]);
            });
            columns_[c] = std::size_t(found - tags.begin());
        }
        width_ = tags.size();
        if (!has(Asym) && !has(AuthorChain))
            failAt(path_, "_atom_site has no column label_asym_id");
        for (const Column column : {Y, Z})
            if (!has(column))
                failAt(path_, std::string("_atom_site has no column ") + names[column]);
        if (!has(Number) && !has(Sequence)) failAt(path_, "_atom_site has no column auth_seq_id");
    }

    void add(const Fields& row)
    {
        row_ = &row;
        startModel();
        ++rows_;
        AtomLine atom;
        atom.name = first(AuthorAtom, Atom_);
        atom.residue = first(AuthorResidue, ResidueName);
        atom.asym = first(Asym, AuthorChain);
        atom.chain = first(AuthorChain, Asym);
        atom.number = number(atom);
        if (const std::string_view code = text(Code); !code.empty()) atom.insertionCode = code[0];
        atom.hetatm = text(Group).substr(0, 1) == "H";
        // What stands in no sequence is no link of the chain.
        const bool placeless = has(Sequence) && text(Sequence).empty() && atom.hetatm;
        atom.entity = placeless ? EntityHint::None : EntityHint::Polymer;
        if (asym_ != atom.asym) entities_.emplace(asym_ = atom.asym, text(Entity));
        atom.altloc = altloc();
        const std::string_view symbol = text(Symbol);
        const auto letters = std::find_if_not(symbol.begin(), symbol.end(), isLetter);
        atom.element = elementNumber(std::string(symbol.begin(), letters));
        atom.position = {value(X, nan), value(Y, nan), value(Z, nan)};
        atom.occupancy = float(value(Occupancy, 1.0));
        atom.bFactor = float(value(BFactor, 0.0));
        parseInteger(text(Id), atom.serial);
        tree_.add(atom);
    }

    void reserve(std::size_t atoms) { tree_.reserve(atoms); }

    /// The structure of all rows, with the entities of the block that has them.
    Structure finish(Block& block)
    {
        Structure out = tree_.finish();
        EntityTypes types(block);
        std::vector<EntityHint> hints;
        for (const std::string& asym : out.asyms) hints.push_back(types.of(asym, entities_[asym]));
        for (Residue& residue : out.residues) {
            const EntityHint hint = hints[std::size_t(residue.asym)];
            const bool placeless = residue.entity == EntityHint::None;
            residue.entity = hint == EntityHint::Polymer && placeless ? EntityHint::None : hint;
        }
        joinModels(out);
        return out;
    }

private:
    using Column = std::size_t;
    static constexpr Column Group = 0, Id = 1, Symbol = 2, Atom_ = 3, AuthorAtom = 4, Alternate = 5,
                            ResidueName = 6, AuthorResidue = 7, Asym = 8, AuthorChain = 9,
                            Entity = 10, Sequence = 11, Number = 12, Code = 13, X = 14, Y = 15,
                            Z = 16, Occupancy = 17, BFactor = 18, ModelNumber = 19, Count = 20;
    static constexpr std::array<const char*, Count> names{"group_PDB",       "id",
                                                          "type_symbol",     "label_atom_id",
                                                          "auth_atom_id",    "label_alt_id",
                                                          "label_comp_id",   "auth_comp_id",
                                                          "label_asym_id",   "auth_asym_id",
                                                          "label_entity_id", "label_seq_id",
                                                          "auth_seq_id",     "pdbx_PDB_ins_code",
                                                          "Cartn_x",         "Cartn_y",
                                                          "Cartn_z",         "occupancy",
                                                          "B_iso_or_equiv",  "pdbx_PDB_model_num"};
    static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

    bool has(Column column) const { return columns_[column] < width_; }

    std::string_view text(Column column)
    {
        return has(column) ? textOf((*row_)[columns_[column]], buffers_[column])
                           : std::string_view();
    }

    std::string_view first(Column column, Column other)
    {
        const std::string_view found = text(column);
        return found.empty() ? text(other) : found;
    }

    double value(Column column, double missing)
    {
        const std::string_view field = text(column);
        double out = missing;
        if (!field.empty() && !parseNumber(field, out))
            out = gemmi::cif::as_number(std::string(field), missing); // "1.23(4)"
        return out;
    }

    void startModel()
    {
        int number = model_ == 0 ? 1 : model_;
        parseInteger(text(ModelNumber), number);
        if (number == model_) return;
        tree_.startModel(model_ = number);
        count_ = 0;
    }

    /// The author's number; where it is missing that of the sequence, and without either the
    /// molecules of a chain are counted.
    int number(const AtomLine& atom)
    {
        int out = 0;
        if (const std::string_view field = first(Number, Sequence); !field.empty()) {
            parseInteger(field, out);
            return out;
        }
        if (atom.asym != counted_) count_ = 0;
        if (count_ == 0 || atom.name == firstName_) {
            ++count_;
            firstName_ = atom.name;
        }
        counted_ = atom.asym;
        return count_;
    }

    char altloc()
    {
        const std::string_view label = text(Alternate);
        if (label.size() > 1)
            failAt(path_, "_atom_site.label_alt_id of atom " + std::to_string(rows_) +
                              ": expected one character, got " + inQuotes(label));
        return label.empty() ? '\0' : label[0];
    }

    const std::string& path_;
    AtomTree tree_;
    std::string asym_;                            ///< of the row before
    std::map<std::string, std::string> entities_; ///< that rows name, by label chain
    std::array<std::size_t, Count> columns_;
    std::array<std::string, Count> buffers_; ///< of texts in quotes
    std::size_t width_ = 0, rows_ = 0;
    const Fields* row_ = nullptr;
    int model_ = 0;
    std::string counted_, firstName_; ///< chain and first atom of the molecule that is counted
    int count_ = 0;
};

/// The atoms of a document: rows of a loop, or pairs, which are a loop of one row.
Structure atomsOf(Block& block, const std::string& path)
{
    std::vector<std::string> tags, values;
    if (gemmi::cif::Loop* const loop = block.find_loop("_atom_site.Cartn_x").get_loop()) {
        tags = loop->tags;
        values = std::move(loop->values);
    }
    for (const gemmi::cif::Item& item : block.items) {
        if (item.type != gemmi::cif::ItemType::Pair ||
            !gemmi::istarts_with(item.pair[0], "_atom_site."))
            continue;
        tags.push_back(item.pair[0]);
        values.push_back(item.pair[1]);
    }
    AtomSite atoms(tags, path);
    atoms.reserve(values.size() / tags.size());
    Fields fields(tags.size());
    for (std::size_t at = 0; at + fields.size() <= values.size(); at += fields.size()) {
        std::copy_n(values.begin() + std::ptrdiff_t(at), fields.size(), fields.begin());
        atoms.add(fields);
    }
    return atoms.finish(block);
}

/// A document of which the first table of atoms is read row by row, and keeps the first row alone:
/// all of its values take twelve times the memory of the text.
struct RowDocument : gemmi::cif::Document {
    RowDocument(const std::string& file, const Progress& reader) : path(file), progress(reader) {}

    const std::string& path;
    const Progress& progress;
    std::optional<AtomSite> atoms;
    std::size_t likely = 0;       ///< number of atoms
    std::size_t blockOfAtoms = 0; ///< counted from 1; 0: none yet
    bool inAtoms = false;         ///< whether the present loop is a table of atoms
    Fields row;
    std::size_t rows = 0;

    /// Takes a value of the present loop.
    void take(std::string_view value)
    {
        gemmi::cif::Loop& loop = items_->back().loop;
        if (loop.values.empty()) {
            inAtoms = loop.has_tag("_atom_site.Cartn_x");
            row.clear();
        }
        if (!inAtoms || loop.values.size() < loop.tags.size()) loop.values.emplace_back(value);
        if (!inAtoms) return;
        if (!atoms) {
            atoms.emplace(loop.tags, path);
            atoms->reserve(likely);
        }
        if (blockOfAtoms == 0) blockOfAtoms = blocks.size();
        row.push_back(value);
        if (row.size() < loop.tags.size()) return;
        constexpr std::size_t often = 65536; // rows
        if (++rows % often == 0) stopIfCancelled(progress);
        if (blockOfAtoms == blocks.size()) atoms->add(row);
        row.clear();
    }
};

template<typename Rule>
struct RowAction : gemmi::cif::Action<Rule> {
};

template<>
struct RowAction<gemmi::cif::rules::loop_value> {
    template<typename Input>
    static void apply(const Input& in, RowDocument& out)
    {
        out.take({in.begin(), in.size()});
    }
};

template<>
struct RowAction<gemmi::cif::rules::loop> {
    template<typename Input>
    static void apply(const Input& in, RowDocument& out)
    {
        if (out.inAtoms && !out.row.empty())
            throw tao::pegtl::parse_error("Wrong number of values in the loop", in);
        out.inAtoms = false;
        gemmi::cif::Action<gemmi::cif::rules::loop>::apply(in, out);
    }
};

/// Refuses names that stand twice, as gemmi::cif::read_memory() does. That empties one table for
/// each block, which takes the square of their number.
void checkDuplicates(gemmi::cif::Document& document)
{
    std::unordered_set<std::string> names;
    gemmi::cif::Document one;
    one.source = document.source;
    one.blocks.resize(1);
    for (gemmi::cif::Block& block : document.blocks) {
        if (!names.insert(gemmi::to_lower(block.name)).second && !block.name.empty())
            gemmi::fail(document.source + ": duplicate block name: ", block.name);
        std::swap(one.blocks[0], block);
        gemmi::cif::check_for_duplicates(one);
        std::swap(one.blocks[0], block);
    }
}

void parseCif(const std::string& text, const std::string& path, RowDocument& document)
{
    tao::pegtl::memory_input<> in(text.data(), text.size(), path);
    document.source = path;
    tao::pegtl::parse<gemmi::cif::rules::file, RowAction, gemmi::cif::Errors>(in, document);
    gemmi::cif::check_for_missing_values(document);
    checkDuplicates(document);
}

/// The structure of a document that is parsed.
/// @param[in] rows  gives the atoms of the table _atom_site of a block
template<typename Rows>
Structure readDocument(gemmi::cif::Document& document, const std::string& path,
                       const Progress& progress, const Rows& rows)
{
    stopIfCancelled(progress);
    std::vector<std::string> warnings;
    Block& block = blockWithAtoms(document, path, warnings);
    Structure out;
    if (block.has_tag("_atom_site.Cartn_x"))
        out = rows(block);
    else if (!hasSpheres(block))
        out = readSmallMolecule(block, path);
    stopIfCancelled(progress);
    out.assemblies = readAssemblies(block);
    out.plddt = namesPlddt(block);
    out.bonds = readBonds(block);
    if (hasSpheres(block)) addSpheres(block, path, out);
    out.warnings.insert(out.warnings.begin(), warnings.begin(), warnings.end());
    return out;
}

/// The categories that readDocument() reads.
bool isRead(const std::string& category)
{
    constexpr std::array<const char*, 13> read{"_atom_site",
                                               "_entity",
                                               "_struct_asym",
                                               "_pdbx_struct_oper_list",
                                               "_pdbx_struct_assembly_gen",
                                               "_struct_ncs_oper",
                                               "_ihm_sphere_obj_site",
                                               "_entity_poly_seq",
                                               "_chem_comp_atom",
                                               "_chem_comp_bond",
                                               "_struct_conn",
                                               "_atom_site_label",
                                               "_ma_qa_metric"};
    return std::any_of(read.begin(), read.end(),
                       [&](const char* name) { return gemmi::iequal(category, name); });
}

/// Refuses a line that no program writes: CIF 1.1 allows 2,048 characters. Its values would take 40
/// times its memory.
void checkLines(const std::string& text, const std::string& path)
{
    constexpr std::size_t longest = 1000000;
    for (LineReader lines(text); lines.next();)
        if (lines.line().size() > longest)
            failAtLine(path, lines,
                       "expected at most " + std::to_string(longest) + " characters, got " +
                           std::to_string(lines.line().size()));
}

bool isAtomRow(std::string_view line)
{
    return line.substr(0, 5) == "ATOM " || line.substr(0, 7) == "HETATM ";
}

/// Calls read(), whose errors name the file.
template<typename Read>
Structure reading(const std::string& path, const Read& read)
{
    try {
        return read();
    } catch (const Error&) {
        throw;
    } catch (const Cancelled&) {
        throw;
    } catch (const std::exception& error) {
        failAt(path, oneLine(error, path));
    }
}

} // namespace

double bytesForMmcif(const std::string& text)
{
    constexpr double ofStructure = 3.0;
    double bytes = 0.0;
    for (LineReader lines(text); lines.next();) {
        const bool atom = isAtomRow(lines.line());
        bytes += (atom ? ofStructure : cifDocumentPerByte) * double(lines.line().size());
    }
    return bytes;
}

Structure readMmcif(std::string text, const std::string& path, const Progress& progress)
{
    checkLines(text, path);
    return reading(path, [&] {
        RowDocument document(path, progress);
        for (LineReader lines(text); lines.next();) document.likely += isAtomRow(lines.line());
        parseCif(text, path, document);
        return readDocument(document, path, progress, [&](Block& block) {
            const bool own = document.blockOfAtoms == std::size_t(&block - &document.blocks[0]) + 1;
            return own ? document.atoms->finish(block) : atomsOf(block, path);
        });
    });
}

Structure readBinaryCif(std::string bytes, const std::string& path, const Progress& progress)
{
    return reading(path, [&] {
        gemmi::cif::Document document = decodeBinaryCif(bytes, path, isRead);
        std::string().swap(bytes);
        return readDocument(document, path, progress,
                            [&](Block& block) { return atomsOf(block, path); });
    });
}

} // namespace molsurf
