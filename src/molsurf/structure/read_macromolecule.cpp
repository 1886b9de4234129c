// SPDX-License-Identifier: MPL-2.0
#include "molsurf/structure/readers.h"

#include "molsurf/core/cancel.h"
#include "molsurf/error.h"
#include "molsurf/structure/assembly_operators.h"
#include "molsurf/structure/atom_tree.h"
#include "molsurf/structure/binary_cif.h"
#include "molsurf/structure/cif_rows.h"
#include "molsurf/structure/gemmi_model.h"
#include "molsurf/structure/ihm_spheres.h"
#include "molsurf/structure/residue_bonds.h"
#include "molsurf/structure/text_fields.h"

#include <gemmi/cif.hpp>
#include <gemmi/mmcif.hpp>
#include <gemmi/numb.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <exception>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <stdexcept>
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
Block& blockWithAtoms(gemmi::cif::Document& document, const std::string& path, Structure& out)
{
    Block* chosen = nullptr;
    std::size_t further = 0;
    for (Block& block : document.blocks) {
        if (!block.has_tag("_atom_site.Cartn_x") && !hasSpheres(block)) continue;
        if (chosen)
            ++further;
        else
            chosen = &block;
    }
    if (further > 0) {
        out.warnings.push_back(std::to_string(further) +
                               " further data blocks with atoms were ignored");
    }
    if (chosen) return *chosen;
    std::string hint;
    for (const Block& block : document.blocks) {
        if (block.has_tag("_chem_comp_atom.atom_id")) hint = " [it describes a chemical component]";
        if (block.has_tag("_atom_site_label")) hint = " [it is a small-molecule CIF]";
        if (block.has_tag("_refln.index_h") || block.has_tag("_diffrn_refln.index_h"))
            hint =
                " [it has structure factors, the reflections of a crystal; hint: take the file of "
                "the coordinates]";
    }
    failAt(path, "no atoms: expected _atom_site.Cartn_x and others of mmCIF, got none" + hint);
}

/// Makes a loop of one row of a category whose values are given as pairs.
void makeLoop(Block& block, const std::string& category)
{
    std::vector<std::string> tags, values;
    auto& items = block.items;
    const auto isPair = [&](const gemmi::cif::Item& item) {
        return item.type == gemmi::cif::ItemType::Pair &&
               gemmi::istarts_with(item.pair[0], category);
    };
    for (const gemmi::cif::Item& item : items) {
        if (!isPair(item)) continue;
        tags.push_back(item.pair[0]);
        values.push_back(item.pair[1]);
    }
    if (tags.empty()) return;
    items.erase(std::remove_if(items.begin(), items.end(), isPair), items.end());
    items.emplace_back(gemmi::cif::LoopArg{});
    items.back().loop.tags = std::move(tags);
    items.back().loop.values = std::move(values);
}

/// Fills in the author's numbers that are "." or "?": by label_seq_id, and where there is none
/// either by counting, on from one molecule to the next.
void completeNumbers(gemmi::cif::Loop& loop)
{
    const int author = loop.find_tag("_atom_site.auth_seq_id");
    const int label = loop.find_tag("_atom_site.label_seq_id");
    const int asym = loop.find_tag("_atom_site.label_asym_id");
    const int atom = loop.find_tag("_atom_site.label_atom_id");
    const auto isNull = [](const std::string& text) { return text == "." || text == "?"; };
    const int model = loop.find_tag("_atom_site.pdbx_PDB_model_num");
    std::string chain, first, ofModel; // of the molecule that is counted
    int count = 0;
    const std::size_t width = loop.width();
    for (std::size_t begin = 0; begin + width <= loop.values.size(); begin += width) {
        const auto value = [&](int column) -> std::string& {
            return loop.values[begin + std::size_t(column)];
        };
        if (!isNull(value(author))) continue;
        if (label >= 0 && !isNull(value(label))) {
            value(author) = value(label);
            continue;
        }
        if (value(asym) != chain || (model >= 0 && value(model) != ofModel)) count = 0;
        const std::string name = atom >= 0 ? value(atom) : std::string();
        if (count == 0 || name == first) {
            ++count;
            first = name;
        }
        chain = value(asym);
        if (model >= 0) ofModel = value(model);
        value(author) = std::to_string(count);
    }
}

/// Refuses alternate locations of several letters.
void checkAlternates(const gemmi::cif::Loop& loop, const std::string& path)
{
    const int column = loop.find_tag("_atom_site.label_alt_id");
    if (column < 0) return;
    for (std::size_t at = std::size_t(column); at < loop.values.size(); at += loop.width()) {
        if (loop.values[at].size() < 2) continue;
        const std::string value = gemmi::cif::as_string(loop.values[at]);
        if (value.size() > 1)
            failAt(path, "_atom_site.label_alt_id of atom " +
                             std::to_string(at / loop.width() + 1) +
                             ": expected one character, got " + inQuotes(value));
    }
}

/// Adds the columns without which gemmi's reader finds no atoms, if they can be made up.
void completeAtomSite(Block& block, const std::string& path)
{
    gemmi::cif::Item* const item = block.find_loop("_atom_site.Cartn_x").item();
    auto has = [&](const std::string& tag) { return block.has_tag("_atom_site." + tag); };
    struct Default {
        const char* tag;
        const char* value;
    };
    constexpr std::array<Default, 4> defaults{
        {{"label_alt_id", "."}, {"occupancy", "1"}, {"B_iso_or_equiv", "0"}, {"type_symbol", "?"}}};
    std::vector<Default> missing;
    for (const Default& column : defaults) {
        if (!has(column.tag)) missing.push_back(column);
    }
    const bool copySequence = !has("auth_seq_id") && has("label_seq_id");
    for (const char* tag : {"id", "label_asym_id", "Cartn_y", "Cartn_z"}) {
        if (!has(tag)) failAt(path, std::string("_atom_site has no column ") + tag);
    }
    if (!copySequence && !has("auth_seq_id")) failAt(path, "_atom_site has no column auth_seq_id");
    if (!item) return;
    gemmi::cif::Loop& loop = item->loop;
    checkAlternates(loop, path);
    if (!copySequence) completeNumbers(loop);
    if (missing.empty() && !copySequence) return;
    const int sequence = loop.find_tag("_atom_site.label_seq_id");
    const std::size_t rows = loop.length(), width = loop.width();
    std::vector<std::string> values;
    values.reserve(loop.values.size() + rows * (missing.size() + 1));
    for (std::size_t row = 0; row < rows; ++row) {
        const auto begin = loop.values.begin() + static_cast<std::ptrdiff_t>(row * width);
        values.insert(values.end(), begin, begin + static_cast<std::ptrdiff_t>(width));
        for (const Default& column : missing) values.emplace_back(column.value);
        if (copySequence) values.push_back(begin[sequence]);
    }
    for (const Default& column : missing)
        loop.tags.push_back(std::string("_atom_site.") + column.tag);
    if (copySequence) loop.tags.push_back("_atom_site.auth_seq_id");
    loop.values = std::move(values);
    if (copySequence) completeNumbers(loop);
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

std::vector<std::string> splitList(const std::string& list)
{
    std::vector<std::string> names;
    std::size_t begin = 0;
    while (begin <= list.size()) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        const std::string_view name = trimmed(std::string_view(list).substr(begin, end - begin));
        if (!name.empty() && name != "\n") names.emplace_back(name);
        begin = end + 1;
    }
    return names;
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
            for (std::string& chain : splitList(chains)) list.push_back(std::move(chain));
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

/// Takes out what is not of the atoms: faster, and nothing in it can fail.
void keepOnlyAtoms(Block& block)
{
    auto isNeeded = [&](const gemmi::cif::Item& item) {
        const std::string* tag = nullptr;
        if (item.type == gemmi::cif::ItemType::Pair) tag = &item.pair[0];
        if (item.type == gemmi::cif::ItemType::Loop) tag = &item.loop.tags.at(0);
        return tag && gemmi::istarts_with(*tag, "_atom_site.");
    };
    auto& items = block.items;
    items.erase(std::remove_if(items.begin(), items.end(), std::not_fn(isNeeded)), items.end());
}

/// What a block says that its molecules are. gemmi looks through all entities for each chain.
class EntityTypes
{
public:
    explicit EntityTypes(Block& block)
    {
        for (auto row : block.find("_entity.", {"id", "type"}))
            types_.emplace(row.str(0), gemmi::entity_type_from_string(row.str(1)));
        auto chains = block.find("_struct_asym.", {"id", "entity_id"});
        listed_ = chains.ok();
        for (auto row : chains) {
            const auto type = types_.find(row.str(1));
            if (type != types_.end()) ofChain_.emplace(row.str(0), type->second);
        }
    }

    /// Sets the types of residues where the block has them; others keep what gemmi takes them for.
    void set(gemmi::Structure& tree)
    {
        for (gemmi::Model& model : tree.models)
            for (gemmi::Chain& chain : model.chains)
                for (gemmi::Residue& residue : chain.residues) {
                    const gemmi::EntityType type = typeOf(residue);
                    if (type != gemmi::EntityType::Unknown) residue.entity_type = type;
                }
    }

private:
    gemmi::EntityType typeOf(const gemmi::Residue& residue)
    {
        const auto known = ofChain_.find(residue.subchain);
        if (known != ofChain_.end()) return known->second;
        const auto type = listed_ ? types_.end() : types_.find(residue.entity_id);
        if (type == types_.end() || residue.subchain.empty()) return gemmi::EntityType::Unknown;
        return ofChain_.emplace(residue.subchain, type->second).first->second;
    }

    std::unordered_map<std::string, gemmi::EntityType> types_, ofChain_; // by entity, label chain
    bool listed_ = false; ///< whether the chains are, or else the atoms name their entities
};

constexpr std::size_t rowsOfPiece = 20000; // which take 30 MB

/// Makes atoms of a block's rows, with what gemmi reads of it; the next rows are those of other
/// chains.
class AtomAdder
{
public:
    AtomAdder(Block& block, const std::string& path, Structure& out)
        : path_(path), entities_(block), copier_(out, block.has_tag("_entity.type")), out_(out)
    {
    }

    /// To be called behind the last rows.
    void finish() { copier_.finish(); }

    void add(Block& block, const Progress& progress)
    {
        prepare(block);
        addTree(block, progress, goesOn_);
        goesOn_ = true;
    }

    /// The same of all rows at once, which may be cut.
    /// @param[in] enough  rows of a part, at least
    void addInParts(Block& block, std::size_t enough, const Progress& progress)
    {
        prepare(block);
        gemmi::cif::Loop* const loop = block.find_loop("_atom_site.Cartn_x").get_loop();
        const std::vector<std::size_t> cuts =
            loop ? cutsOfRows(*loop, enough) : std::vector<std::size_t>();
        if (cuts.size() <= 2) return addTree(block, progress, false);
        if (out_.atoms.empty()) out_.atoms.reserve(loop->length());
        for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
            Block part("");
            part.items.emplace_back(gemmi::cif::LoopArg{});
            gemmi::cif::Loop& rows = part.items.back().loop;
            rows.tags = loop->tags;
            const auto at = [&](std::size_t row) {
                return std::make_move_iterator(loop->values.begin() +
                                               std::ptrdiff_t(row * loop->width()));
            };
            rows.values.assign(at(cuts[k]), at(cuts[k + 1]));
            addTree(part, progress, k > 0);
        }
    }

private:
    void prepare(Block& block)
    {
        makeLoop(block, "_atom_site.");
        completeAtomSite(block, path_);
        keepOnlyAtoms(block);
    }

    void addTree(const Block& block, const Progress& progress, bool goesOn)
    {
        gemmi::Structure tree = gemmi::make_structure_from_block(block);
        stopIfCancelled(progress);
        entities_.set(tree);
        copier_.add(tree, goesOn);
    }

    const std::string& path_;
    EntityTypes entities_;
    TreeCopier copier_;
    Structure& out_;
    bool goesOn_ = false;
};

/// The atoms of a block that has but the first of some rows in a text.
/// @throws std::runtime_error if that is no such block, or if a row cannot be read
void addPieces(Block& block, const std::string& text, const CifRows& rows, const std::string& path,
               const Progress& progress, Structure& out)
{
    std::string head = "data_piece\nloop_\n";
    for (const std::string& tag : rows.tags) head += tag + "\n";
    AtomAdder atoms(block, path, out);
    keepOnlyAtoms(block);
    gemmi::cif::Loop* const loop = block.find_loop("_atom_site.Cartn_x").get_loop();
    if (!loop || loop->length() != 1)
        throw std::runtime_error("the rows are those of another loop");
    loop->values.clear();
    out.atoms.reserve(rows.rows);
    for (std::size_t k = 0; k + 1 < rows.cuts.size(); ++k) {
        const std::string piece =
            head + text.substr(rows.cuts[k], rows.cuts[k + 1] - rows.cuts[k]) + "\n";
        gemmi::cif::Document document =
            gemmi::cif::read_memory(piece.data(), piece.size(), path.c_str());
        Block one("");
        for (const gemmi::cif::Item& item : block.items)
            if (!(item.type == gemmi::cif::ItemType::Loop && item.loop.values.empty()))
                one.items.push_back(item);
        one.items.push_back(std::move(document.sole_block().items.at(0)));
        atoms.add(one, progress);
    }
    atoms.finish();
}

/// @param[in] addRows  adds the atoms of the table _atom_site
Structure structureOf(gemmi::cif::Document& document, const std::string& path,
                      const Progress& progress,
                      const std::function<void(Block& block, Structure& out)>& addRows)
{
    stopIfCancelled(progress);
    Structure out;
    Block& block = blockWithAtoms(document, path, out);
    out.assemblies = readAssemblies(block);
    out.plddt = namesPlddt(block);
    out.bonds = readBonds(block);
    Block spheres("");
    if (hasSpheres(block)) spheres.items = block.items;
    if (block.has_tag("_atom_site.Cartn_x")) addRows(block, out);
    if (hasSpheres(spheres)) addSpheres(spheres, path, out);
    dropPlainSerials(out);
    return out;
}

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

gemmi::cif::Document parseCif(const std::string& text, const std::string& path)
{
    tao::pegtl::memory_input<> in(text.data(), text.size(), path);
    gemmi::cif::Document document;
    document.source = path;
    gemmi::cif::parse_input(document, in);
    gemmi::cif::check_for_missing_values(document);
    checkDuplicates(document);
    return document;
}

/// An mmCIF text whose rows of atoms are read piece by piece: a document of all of them takes
/// twelve times the memory of the text.
/// @throws std::exception if something is not as it was expected
Structure readInPieces(const std::string& text, const CifRows& rows, const std::string& path,
                       const Progress& progress)
{
    const std::string rest = text.substr(0, rows.firstEnd) + text.substr(rows.cuts.back());
    gemmi::cif::Document document = parseCif(rest, path);
    return structureOf(document, path, progress, [&](Block& block, Structure& out) {
        addPieces(block, text, rows, path, progress, out);
    });
}

/// The structure of a document that is parsed from text or bytes.
template<typename Parse>
Structure readDocument(std::string all, const std::string& path, const Progress& progress,
                       std::size_t enough, const Parse& parse)
{
    try {
        gemmi::cif::Document document = parse(all);
        std::string().swap(all);
        return structureOf(document, path, progress, [&](Block& block, Structure& out) {
            AtomAdder atoms(block, path, out);
            atoms.addInParts(block, enough, progress);
            atoms.finish();
        });
    } catch (const Error&) {
        throw;
    } catch (const Cancelled&) {
        throw;
    } catch (const std::exception& error) {
        failAt(path, oneLine(error, path));
    }
}

/// The categories that structureOf() reads.
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

} // namespace

double bytesForMmcif(const std::string& text)
{
    constexpr double ofStructure = 3.0, perRow = 1.7e3; // a row of 21 values in a document
    const std::optional<CifRows> rows = findCifRows(text, rowsOfPiece);
    if (!rows) return cifDocumentPerByte * double(text.size());
    return ofStructure * double(text.size()) + perRow * double(rows->longest);
}

Structure readMmcif(std::string text, const std::string& path, const Progress& progress)
{
    return readMmcifInPieces(std::move(text), path, progress, rowsOfPiece);
}

Structure readMmcifInPieces(std::string text, const std::string& path, const Progress& progress,
                            std::size_t enough)
{
    checkLines(text, path);
    const std::optional<CifRows> rows = findCifRows(text, enough);
    if (rows && rows->cuts.size() > 2) {
        try {
            return readInPieces(text, *rows, path, progress);
        } catch (const Cancelled&) {
            throw;
        } catch (const std::exception&) { // read as a whole it gives the line
        }
    }
    return readDocument(std::move(text), path, progress, enough,
                        [&](const std::string& all) { return parseCif(all, path); });
}

Structure readBinaryCif(std::string bytes, const std::string& path, const Progress& progress)
{
    return readDocument(std::move(bytes), path, progress, rowsOfPiece,
                        [&](const std::string& all) { return decodeBinaryCif(all, path, isRead); });
}

} // namespace molsurf
