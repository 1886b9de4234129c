// SPDX-License-Identifier: MPL-2.0
#include "molsurf/settings.h"

#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/selection/ball_values.h"
#include "molsurf/molecule/selection/choose_copies.h"
#include "molsurf/molecule/selection/coarse_grain.h"
#include "molsurf/molecule/selection/groups.h"
#include "molsurf/molecule/selection/radii.h"
#include "molsurf/show/color/color_map.h"
#include "molsurf/show/color/color_table.h"
#include "molsurf/surface/field_table.h"
#include "molsurf/surface/option_row.h"
#include "molsurf/surface/product_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace molsurf
{

namespace
{

using Values = std::vector<std::string>;

/// The default of each.
const Settings& presetSettings()
{
    static const Settings all;
    return all;
}

// Rows whose values files store. checkOptions() checks the ranges of numbers.

template<typename Of>
Setting number(const char* name, const char* value, std::string text, const Of& of)
{
    Setting row{name, SettingType::Number, value, std::move(text), shortest(of(presetSettings()))};
    row.set = [=](Settings& s, const Values& v) {
        of(s) = parsedValue<double>(name, "a number", v.back());
    };
    return stored(row, of);
}

/// The row of a number with its range.
Setting within(double low, double high, Setting row)
{
    row.low = low;
    row.high = high;
    return row;
}

/// @param[in] none  the value, in files, of a number that is not given
template<typename Of>
Setting count(const char* name, const char* value, std::string text, const char* none,
              std::pair<int, int> range, const Of& of)
{
    const auto [low, high] = range;
    Setting row = countRow<Settings>({name, value, std::move(text), none}, low, high, of);
    row.get = [=](const Settings& s) -> SettingValue {
        const std::optional<int> given = of(s);
        return given ? std::to_string(*given) : std::string(none);
    };
    return within(low, high, row);
}

/// @param[in] on  what the switch sets
template<typename Of, typename T = bool>
Setting flag(const char* name, std::string text, const Of& of, T on = T(true))
{
    return stored(switchRow<Settings>(name, std::move(text), of, on),
                  [=](const Settings& s) { return of(s) == on; });
}

/// @param[in] none  what an empty text means
template<typename Of>
Setting text(const char* name, const char* value, std::string help, const char* none, const Of& of)
{
    const auto shown = [=](const Settings& s) { return of(s).empty() ? none : of(s); };
    return stored(textRow<Settings>({name, value, std::move(help), shown(presetSettings())}, of),
                  shown);
}

/// One of a few values that nameOf() names.
template<typename Of, typename Enum>
Setting word(const char* name, const char* value, std::string help, const Of& of,
             const std::vector<Enum>& choices)
{
    Setting row = wordRow<Settings>(name, std::move(help), choices, of);
    row.value = value;
    row.preset = nameOf(of(presetSettings()));
    return stored(row, [=](const Settings& s) { return std::string(nameOf(of(s))); });
}

bool evolves(const KindRow& kind)
{
    return kind.hasFlow;
}

/// The row of a setting that only some kinds of surface have.
Setting onlyOf(bool (*such)(const KindRow&), Setting row)
{
    for (const KindRow& kind : kindTable())
        if (such(kind)) row.kinds.push_back(kind.kind);
    return row;
}

std::vector<SurfaceKind> surfaceKinds()
{
    std::vector<SurfaceKind> all;
    for (const KindRow& row : kindTable()) all.push_back(row.kind);
    return all;
}

/// The words of kinds and what they mean.
std::string kindText()
{
    Values all;
    for (const KindRow& row : kindTable())
        all.push_back(row.word + (*row.title ? std::string(": ") + row.title : ""));
    return wrapped(joinWords(all, "; "), helpWidth);
}

/// GROUP=KIND, the group ending at the last =.
std::pair<std::string, SurfaceKind> parseSurfaceOf(const std::string& text)
{
    const std::size_t split = text.rfind('=');
    for (const SurfaceKind kind : surfaceKinds()) {
        if (split != std::string::npos && split > 0 &&
            lowered(text.substr(split + 1)) == nameOf(kind))
            return {text.substr(0, split), kind};
    }
    wrongValue("surface-of", "GROUP=KIND with a kind of `surface`", text,
               split == std::string::npos ? "" : kindMeant(text.substr(split + 1)));
}

/// D or SELECTION=D, the selection ending at the last =.
ResolutionRule parseResolution(const std::string& text)
{
    const std::size_t split = text.rfind('=');
    const std::string digits = split == std::string::npos ? text : text.substr(split + 1);
    ResolutionRule rule;
    if (split != std::string::npos) rule.select = text.substr(0, split);
    if (!parseWhole(digits, rule.resolution) || split == 0 ||
        !(rule.resolution >= 1.0 && rule.resolution <= 50.0))
        wrongValue("resolution", "D or SELECTION=D with D from 1 to 50 Å", text);
    return rule;
}

/// The words of `fields`, without "all".
Values knownFields()
{
    Values names = {"surface"};
    for (const FieldRow& row : fieldTable()) names.push_back(row.name);
    return names;
}

Values allFields()
{
    Values names = fieldNames();
    names.insert(names.begin(), "surface");
    return names;
}

void setFields(Settings& settings, const Values& values)
{
    const Values known = knownFields();
    Values wanted;
    for (const std::string& field : splitWords(values.back())) {
        const auto same = [&](const std::string& one) { return lowered(one) == lowered(field); };
        const auto found = std::find_if(known.begin(), known.end(), same);
        if (lowered(field) == "all") {
            const Values all = allFields();
            wanted.insert(wanted.end(), all.begin(), all.end());
        } else if (found != known.end()) {
            wanted.push_back(*found);
        } else {
            const std::string hint = didYouMean(field, known);
            throw Error(ErrorKind::Usage,
                        "`fields`: unknown field '" + field + "'" +
                            (hint.empty() ? " [hint: all, or some of " + joinWords(known, ",") + "]"
                                          : hint));
        }
    }
    settings.options.fields.clear();
    for (const std::string& field : known) // `surface` is always there
        if (field != "surface" && std::count(wanted.begin(), wanted.end(), field))
            settings.options.fields.push_back(field);
}

Setting assemblySetting()
{
    Setting assembly{"assembly", SettingType::Text, "ID",
                     "biological assembly to build; none: as in the file;\n"
                     "ncs: with the copies of MTRIX records or struct_ncs_oper",
                     "none"};
    assembly.set = [](Settings& s, const Values& values) {
        s.atoms.assembly.name.reset();
        if (values.back() != "none") s.atoms.assembly.name = values.back();
    };
    assembly.get = [](const Settings& s) { return s.atoms.assembly.name.value_or("none"); };
    return assembly;
}

Setting copiesSetting()
{
    Setting copies{"copies", SettingType::Text, "LIST",
                   "copies of the assembly: numbers such as 1,7,20-25, or\n"
                   "fold:N, those about the nearest N-fold axis, with copy 1",
                   "all"};
    copies.set = [](Settings& s, const Values& values) {
        s.atoms.assembly.copies = parseCopies(values.back());
    };
    copies.get = [](const Settings& s) {
        return s.atoms.assembly.copies.all() ? "all" : textOf(s.atoms.assembly.copies);
    };
    return copies;
}

std::vector<Setting> atomSettings()
{
    const auto of = [](auto member) {
        return [=](auto& s) -> auto&
        {
            return s.atoms.*member;
        };
    };
    Setting maxInput{"max-input", SettingType::Text, "SIZE",
                     "bytes that INPUT may have, unpacked, such as 10G", "4G"};
    maxInput.set = [](Settings& s, const Values& values) {
        s.atoms.limits.maxInput = sizeValue("max-input", values.back());
    };
    return {
        text("select", "EXPR", "atoms: \"chain A and resid 5-9\" or \"/1/A/5-9|*;polymer\"", "all",
             of(&SelectOptions::select)),
        with(count("model", "N", "number of the model in the file", "the first", {1, 1000000000},
                   of(&SelectOptions::model)),
             [](Setting& row) {
                 row.get = [](const Settings& s) {
                     return s.atoms.model ? std::to_string(s.atoms.model) : "first";
                 };
             }),
        assemblySetting(),
        flag("instances",
             "the surface of each distinct copy of the assembly once:\n"
             "the .glb, .usda, .html, .png and .json place the copies",
             MOLSURF_OF(atoms.assembly.instances)),
        flag("by-symmetry",
             "the joint surface of the whole assembly from one unit,\n"
             "which its rotations repeat",
             MOLSURF_OF(atoms.assembly.bySymmetry)),
        copiesSetting(),
        text("altloc", "A", "alternate location to take, or all", "highest occupancy",
             of(&SelectOptions::altloc)),
        flag("no-hydrogens", "drop hydrogens", of(&SelectOptions::hydrogens), false),
        flag("ions", "keep free ions of the solution", of(&SelectOptions::ions)),
        flag("hetero",
             "keep all ligands, ions, buffers and lipids; otherwise\n"
             "those that touch a polymer and are no free ions, buffers,\n"
             "lipids or detergents",
             of(&SelectOptions::hetero), Hetero::All),
        flag("no-hetero", "drop all ligands and ions", of(&SelectOptions::hetero), Hetero::None),
        flag("waters", "keep waters", of(&SelectOptions::waters)),
        with(flag("charges", "the charges of all atoms come along, for the files of APBS",
                  MOLSURF_OF(labels.charges)),
             [](Setting& row) { row.get = nullptr; }), // files of APBS alone have them
        with(text("radii", "SET", "van der Waals radii: a name of `listRadii`, or a file", "",
                  of(&SelectOptions::radii)),
             [](Setting& row) {
                 row.file = [](const std::string& value) {
                     return std::string_view(value).substr(isRadiiSet(value) ? value.size() : 0);
                 };
             }),
        maxInput};
}

Setting fieldSetting()
{
    std::string text = "grids of the .vdb, by commas, or all of\n" + inLines(allFields()) + ";\n";
    for (const FieldRow& row : fieldTable())
        if (*row.help) text += row.name + ": " + row.help + ";\n";
    Setting fields{"fields",
                   SettingType::List,
                   "LIST",
                   text + "curvatures also at the vertices of a .ply; positive\n"
                          "where convex, 1/R on a ball; shape_index 1: a cap",
                   "surface",
                   knownFields()};
    fields.words.insert(fields.words.begin(), "all");
    fields.set = setFields;
    fields.get = [](const Settings& s) {
        std::string all = "surface";
        for (const std::string& field : s.options.fields) all += "," + field;
        return all;
    };
    return fields;
}

Setting measureSetting()
{
    std::string text = "numbers of the whole surface for the report, by commas";
    Values words;
    for (const MeasureRow& row : measureTable()) {
        words.push_back(row.name);
        text += std::string(";\n") + row.name + ": " + row.help;
        if (*row.unit) text += std::string(" [") + row.unit + "]";
    }
    Setting measures{"measures", SettingType::List, "LIST", text, "none", words};
    measures.set = [words](Settings& s, const Values& values) {
        s.options.measures.clear();
        for (const std::string& word : splitWords(values.back())) {
            if (std::count(words.begin(), words.end(), lowered(word)) == 0)
                wrongValue("measures", joinWords(words, " or "), word, didYouMean(word, words));
            if (!hasField(s.options.measures, lowered(word)))
                s.options.measures.push_back(lowered(word));
        }
    };
    return measures;
}

Setting kindSetting()
{
    Setting row = word("surface", "KIND", kindText(), MOLSURF_OF(options.kind), surfaceKinds());
    row.set =
        hintedWordSetter("surface", surfaceKinds(), MOLSURF_OF(options.kind),
                         [](const std::string& typed, const Values&) { return kindMeant(typed); });
    return row;
}

std::vector<Setting> surfaceSettings()
{
    return {
        kindSetting(),
        within(minVoxel, maxVoxel,
               number("voxel", "H", "edge of a voxel [Å], 0.05 to 10", MOLSURF_OF(options.voxel))),
        onlyOf([](const KindRow& kind) { return kind.hasProbe; },
               within(0.0, 100.0,
                      number("probe", "R", "probe radius [Å]", MOLSURF_OF(options.probe)))),
        onlyOf(isGaussian,
               within(0.1, 100.0,
                      number("blobbiness", "D", "decay of the Gaussians of `surface` gaussian",
                             MOLSURF_OF(options.blobbiness)))),
        flag("fill-cavities", "drop the inner walls", MOLSURF_OF(options.fillCavities)),
        with(number("min-thickness", "W", "thicken what is thinner than W Å, for a print",
                    MOLSURF_OF(options.minThickness)),
             [](Setting& row) {
                 row.preset = "";
                 row.former = "min-wall";
                 row.set = numberSetter("min-thickness", 1e-300, maxThickness,
                                        "above 0, up to 100 Å", MOLSURF_OF(options.minThickness));
             }),
        fieldSetting(),
        flag("vdb-half", "floats of the .vdb in 16 bits, within 0.05 %: half the size",
             MOLSURF_OF(options.halfFloats)),
        flag("curvature-totals", "integrate curvature over the surface, for the report",
             MOLSURF_OF(options.curvatureTotals)),
        measureSetting()};
}

/// A number that is 0 unless it is given, with its range.
/// @param[in] range  in words: "0.05 to 10 Å"
template<typename Of>
Setting optionalNumber(const char* name, const char* value, std::string text, const char* range,
                       std::pair<double, double> limits, const Of& of)
{
    const auto [low, high] = limits;
    Setting row = within(low, high, number(name, value, std::move(text), of));
    row.preset = "";
    row.set = numberSetter(name, low, high, range, of);
    row.get = [=](const Settings& s) -> SettingValue {
        if (of(s) > 0.0) return of(s);
        return std::string("none");
    };
    return row;
}

/// Triangles of an even size.
std::vector<Setting> meshSettings()
{
    Setting density = optionalNumber("density", "N", "the same with N vertices per Å^2 of surface",
                                     "0.014 to 400 vertices per Å^2", {0.014, 400.0},
                                     MOLSURF_OF(options.meshEdge));
    const auto set = density.set;
    density.set = [=](Settings& s, const Values& values) {
        set(s, values); // meshEdge is N until below
        // Equal triangles of edge L, two a vertex, have an area of sqrt(3)/4 L^2 each.
        // measured: a ball with edges of 0.3, 0.5 and 1 Å gets 1.11, 1.25 and 1.12 times as many,
        // 1CRN and 4AT1 with 0.8 and 0.5 Å 1.18 and 1.28 times.
        constexpr double more = 1.18;
        s.options.meshEdge = std::sqrt(2.0 * more / (std::sqrt(3.0) * s.options.meshEdge));
    };
    density.get = nullptr; // files store `remesh` instead
    return {optionalNumber("remesh", "L", "triangles of even shape, with edges near L [Å]",
                           "0.05 to 10 Å", {0.05, 10.0}, MOLSURF_OF(options.meshEdge)),
            density,
            optionalNumber("adapt", "D",
                           "with `remesh` or `density`: shorter edges where it bends,\n"
                           "so that triangles lie within D [Å] of the surface",
                           "0.001 to 1 Å", {0.001, 1.0}, MOLSURF_OF(options.meshError))};
}

/// Parameters of the variational surface that make it agree with another kind.
Setting matchSetting()
{
    Setting match{"match",
                  SettingType::Word,
                  "KIND",
                  "ses: variational with `epsilon` 0.1, `lambda` 0.003 and 0.073 Å\n"
                  "further inside, whose solvation energies are those of ses",
                  "none",
                  {"none", "ses"}};
    match.set = [](Settings& s, const Values& values) {
        const std::string word = lowered(values.back());
        if (word != "none" && word != "ses") wrongValue("match", "none or ses", values.back());
        if (word == "none") return;
        // measured: vdb_molsurf x.pqr --match ses --for apbs -o run/ beside --surface ses: fas2,
        // lysozyme, 451c, 1ubq, 1crn and 1bna; docs/electrostatics.md has the errors.
        s.options.epsilon = 0.1;
        s.options.evolution.lambda = 0.003;
        s.options.inset = 0.073;
    };
    match.get = [](const Settings& s) -> SettingValue {
        return std::string(s.options.inset > 0.0 ? "ses" : "none");
    };
    return match;
}

std::vector<Setting> resolutionSettings()
{
    Setting resolution =
        rulesRow<Settings>({"resolution", "[SEL=]D",
                            "blur to D [Å], 1 to 50, all atoms or those of a\n"
                            "selection or a group; repeats, later ones win"},
                           [](Settings& s, const std::string& value) {
                               s.atoms.resolutions.push_back(parseResolution(value));
                           });
    resolution.get = [](const Settings& s) {
        Values all;
        for (const ResolutionRule& rule : s.atoms.resolutions)
            all.push_back((rule.select.empty() ? "" : rule.select + "=") +
                          shortest(rule.resolution));
        return joinWords(all, ", ");
    };
    Setting coarse = rulesRow<Settings>({"coarse", "[SEL=]WORD",
                                         "beads in the place of atoms: residue (its backbone and\n"
                                         "side chain), N (about N atoms each) or atom; all or\n"
                                         "those of a selection; repeats, later ones win",
                                         "atom"},
                                        [](Settings& s, const std::string& value) {
                                            s.atoms.coarse.push_back(parseCoarse(value));
                                        });
    coarse.words = {"atom", "residue"};
    coarse.get = [](const Settings& s) {
        Values all;
        for (const CoarseRule& rule : s.atoms.coarse) all.push_back(nameOf(rule));
        return all.empty() ? "atom" : joinWords(all, ", ");
    };
    resolution.of = coarse.of = SettingOf::Balls;
    return {
        onlyOf(evolves, within(0.01, 10.0,
                               number("epsilon", "E",
                                      "tolerance of the Gaussian sum [Å]; larger is smoother",
                                      MOLSURF_OF(options.epsilon)))),
        onlyOf([](const KindRow& kind) { return kind.hasFlow && kind.hasOffset; }, matchSetting()),
        onlyOf(evolves, resolution), coarse,
        onlyOf(evolves, flag("match-volume", "resolutions keep the volume of the fine surface",
                             MOLSURF_OF(options.matchVolume)))};
}

/// The words of groups that are made to be coloured.
const Values coloredGroups = {"copy", "entity", "class"};

/// The beginning of colours by the groups of a file.
constexpr char groupsStart[] = "groups=";

/// The beginnings of colours by the values of a file.
Values colorFiles()
{
    Values starts;
    for (std::size_t k = valuesWithoutFile; k < valueWords().size(); ++k)
        starts.push_back(valueWords()[k] + "=");
    return starts;
}

/// The path in a value behind one of some words; empty: there is none.
std::string_view pathBehind(const Values& words, const std::string& value)
{
    for (const std::string& word : words)
        if (lowered(value).rfind(word, 0) == 0) return std::string_view(value).substr(word.size());
    return {};
}

Values colorWords()
{
    Values words;
    for (const ColorBy by : completeColors()) words.push_back(nameOf(by));
    words.insert(words.end(), coloredGroups.begin(), coloredGroups.end());
    words.insert(words.end(), valueWords().begin(), valueWords().begin() + valuesWithoutFile);
    for (const std::string& start : colorFiles()) words.push_back(start + "FILE");
    words.push_back(groupsStart + std::string("FILE"));
    words.push_back("residue-type");
    words.push_back("plain=#RRGGBB");
    return words;
}

/// Colours of other programs.
const std::vector<Synonyms>& otherColors()
{
    static const std::vector<Synonyms> all = {
        {"plddt confidence af alphafold", "bfactor, with `palette` plddt"},
        {"electrostatic electrostatics esp apbs coulombic", "potential=FILE.dx"},
        {"potential", "potential=FILE.dx"},
        {"b b-factor b-factors bfac tempfactor temperature", "bfactor"},
        {"by-chain bychain chainid chainbow", "chain"},
        {"by-element byelement atom atoms cpk heteroatom", "element"},
        {"by-residue resname residue-name aa", "residue"},
        {"spectrum n-to-c resid index", "rainbow"},
        {"hydropathy kyte-doolittle lipophilicity mlp", "hydrophobicity"},
        {"curvature", "mean-curvature"},
        {"conservation consurf scores csv", "table=FILE"},
        {"charges", "charge"},
        {"pockets", "pocket"}};
    return all;
}

void setColor(Settings& s, const Values& values)
{
    const std::string typed = lowered(values.back());
    const std::string word = typed == "residue-type" ? "residue" : typed;
    s.colorGroups.reset();
    s.colorGroupsFile.clear();
    s.labels.plainColor.reset();
    s.labels.valueBy = parseValueBy(values.back());
    s.options.color = s.labels.valueBy ? ColorBy::Value : ColorBy::Nothing;
    if (s.labels.valueBy) return;
    if (std::count(coloredGroups.begin(), coloredGroups.end(), word)) {
        s.colorGroups = parseGroupBy(word);
        return;
    }
    if (word.rfind(groupsStart, 0) == 0 && word != groupsStart) {
        s.colorGroupsFile = values.back().substr(std::string(groupsStart).size());
        s.options.color = ColorBy::FileGroup;
        return;
    }
    if (word.rfind("plain=", 0) == 0) {
        s.labels.plainColor = colorValue("color", "", word.substr(6));
        s.options.color = ColorBy::Plain;
        return;
    }
    for (const ColorBy by : completeColors()) {
        if (word != nameOf(by)) continue;
        s.options.color = by;
        return;
    }
    const Values all = colorWords();
    wrongValue("color", joinWords(all, ", "), values.back(),
               parseColor(word) ? " [hint: `color` plain=" + word + "]"
                                : didYouMean(word, all, otherColors()));
}

Setting colorSetting()
{
    Values words = colorHelp(),
           values(valueWords().begin(), valueWords().begin() + valuesWithoutFile);
    words.insert(words.end(), coloredGroups.begin(), coloredGroups.end());
    for (const std::string& start : colorFiles()) values.push_back(start + "FILE");
    const std::string text = "colours of the mesh and the grid Cd: " + joinWords(words, ", ") +
                             ", groups=FILE, plain=#RRGGBB; by value: " + joinWords(values, ", ") +
                             "; potentials are .dx";
    Setting color{"color", SettingType::Text, "WORD", wrapped(text, helpWidth),
                  "none",  colorWords()};
    color.set = setColor;
    color.get = [](const Settings& s) -> std::string {
        if (s.colorGroups) return textOf(*s.colorGroups);
        if (!s.colorGroupsFile.empty()) return groupsStart + s.colorGroupsFile;
        return s.labels.valueBy ? textOf(*s.labels.valueBy) : nameOf(s.options.color);
    };
    color.file = [](const std::string& value) {
        Values starts = colorFiles();
        starts.push_back(groupsStart);
        return pathBehind(starts, value);
    };
    return color;
}

/// The words of values that patches may be of, the curvatures first.
Values patchWords()
{
    Values words;
    for (const ColorBy by : completeColors())
        if (kindOf(by).ofCurvature) words.push_back(nameOf(by));
    words.insert(words.end(), valueWords().begin(), valueWords().begin() + valuesWithoutFile);
    for (const std::string& start : colorFiles()) words.push_back(start + "FILE");
    return words;
}

/// VALUE>LEVEL or VALUE<LEVEL.
void setPatches(Settings& s, const Values& values)
{
    const std::string& text = values.back();
    const std::size_t side = std::min(text.find_last_of("<>"), text.size());
    const std::string word = text.substr(0, side), known = lowered(word);
    Products::PatchRule rule;
    if (side == text.size() || !parseWhole(text.substr(side + 1), rule.level) ||
        !std::isfinite(rule.level))
        wrongValue("patches", "VALUE>NUMBER or VALUE<NUMBER", text, " [hint: hydrophobicity>0]");
    rule.above = text[side] == '>';
    s.labels.patchBy = parseValueBy(word, "patches");
    const Values words = patchWords();
    for (const ColorBy by : completeColors())
        if (kindOf(by).ofCurvature && known == nameOf(by)) rule.by = by;
    if (rule.by == ColorBy::Value && !s.labels.patchBy)
        wrongValue("patches", joinWords(words, ", ") + ", and > or < with a number", text,
                   didYouMean(known, words));
    s.options.patches = rule;
}

Setting patchSetting()
{
    Setting row{"patches", SettingType::Text, "VALUE>T",
                "connected pieces of the surface where a value of `color`,\n"
                "as hydrophobicity or mean-curvature, is above T, or by <\n"
                "below it: for .patches.csv, .patches.pdb and `color` patch",
                "none"};
    row.set = setPatches;
    row.get = [](const Settings& s) -> std::string {
        const std::optional<Products::PatchRule>& rule = s.options.patches;
        if (!rule) return "none";
        return (s.labels.patchBy ? textOf(*s.labels.patchBy) : nameOf(rule->by)) +
               (rule->above ? ">" : "<") + shortest(rule->level);
    };
    row.file = [](const std::string& value) {
        const std::string_view behind = pathBehind(colorFiles(), value);
        return behind.substr(0, behind.find_last_of("<>"));
    };
    for (const std::string& word : patchWords()) row.words.push_back(word + ">");
    row.of = SettingOf::Molecule;
    return row;
}

void setRange(Settings& s, const Values& values)
{
    const std::string expected = "two numbers LOW,HIGH, the first one less";
    const Values words = splitWords(values.back());
    if (words.size() != 2) {
        const std::size_t dash = values.back().find_first_of("-:", 1); // "0-100"
        const bool two = words.size() == 1 && dash < values.back().size();
        wrongValue("range", expected, values.back(),
                   two ? meant(values.back().substr(0, dash) + "," + values.back().substr(dash + 1))
                       : "");
    }
    const double low = parsedValue<double>("range", expected, words[0]);
    const double high = parsedValue<double>("range", expected, words[1]);
    if (!(low < high))
        wrongValue("range", expected, values.back(),
                   low > high ? meant(words[1] + "," + words[0]) : "");
    s.labels.coloring.range = {low, high};
}

/// The rows of how values and curvatures are shown.
std::vector<Setting> coloringSettings()
{
    Setting range{"range", SettingType::List, "LOW,HIGH", "values at the ends of the colours", ""};
    range.set = setRange;
    range.get = [](const Settings& s) {
        const auto& r = s.labels.coloring.range;
        return r ? shortest((*r)[0]) + "," + shortest((*r)[1]) : "auto";
    };
    Values palettes;
    for (const Palette& row : paletteTable()) palettes.push_back(row.word);
    Setting palette{
        "palette",
        SettingType::Word,
        "WORD",
        wrapped("colours of values and curvatures, low ones first: " + joinWords(palettes, ", "),
                helpWidth),
        "that of the values",
        palettes};
    palette.set = [=](Settings& s, const Values& values) {
        const Palette* row = findPalette(values.back());
        if (!row)
            wrongValue("palette", joinWords(palettes, ", "), values.back(),
                       didYouMean(values.back(), palettes));
        s.labels.coloring.palette = row->word;
    };
    palette.get = [](const Settings& s) {
        return s.labels.coloring.palette.empty() ? "auto" : s.labels.coloring.palette;
    };
    Setting valueOf{"value-of", SettingType::Word,
                    "WORD",     "whose values: atom, or residue (the mean of its atoms)",
                    "atom",     {"atom", "residue"}};
    valueOf.set = [](Settings& s, const Values& values) {
        const std::string word = lowered(values.back());
        if (word != "atom" && word != "residue") wrongValue("value-of", "atom or residue", word);
        s.labels.coloring.byResidue = word == "residue";
    };
    valueOf.get = [](const Settings& s) {
        return std::string(s.labels.coloring.byResidue ? "residue" : "atom");
    };
    Setting offset{"potential-offset", SettingType::Number, "A",
                   "potentials are taken A outside of the surface [Å]", "probe radius; sas: 0"};
    offset.former = "outward";
    offset.low = 0.0;
    offset.high = 100.0;
    offset.set = [](Settings& s, const Values& values) {
        const double length = parsedValue<double>("potential-offset", "a number", values.back());
        if (!(length >= 0.0 && length <= 100.0))
            wrongValue("potential-offset", "a number of Å from 0 to 100", values.back());
        s.labels.coloring.potentialOffset = length;
    };
    offset.get = [](const Settings& s) -> SettingValue {
        const auto& length = s.labels.coloring.potentialOffset;
        if (length) return *length;
        return std::string("auto");
    };
    std::vector<Setting> rows = {
        range, palette, valueOf,
        flag("flat-values", "a point has the value of one atom, not a blend of nearby ones",
             MOLSURF_OF(labels.coloring.flat)),
        offset};
    for (Setting& row : rows) row.of = SettingOf::Molecule;
    rows.push_back(optionalNumber("smooth-colors", "D",
                                  "vertices have the mean of values and curvatures over the\n"
                                  "surface within D [Å], for colours and patches",
                                  "0.5 to 20 Å", {0.5, 20.0}, MOLSURF_OF(options.smoothColors)));
    return rows;
}

std::vector<Setting> groupSettings()
{
    Setting surfaceOf = rulesRow<Settings>({"surface-of", "GROUP=KIND",
                                            "this group alone, by another `surface`; repeats; the\n"
                                            "other atoms together"},
                                           [](Settings& s, const std::string& value) {
                                               s.options.surfaceOf.push_back(parseSurfaceOf(value));
                                           });
    surfaceOf.get = [](const Settings& s) {
        Values all;
        for (const auto& [name, kind] : s.options.surfaceOf)
            all.push_back(name + "=" + nameOf(kind));
        return joinWords(all, ",");
    };
    Setting split{"split", SettingType::Word,
                  "group", "a level set and a closed mesh for every group, alone",
                  "",      {"group"}};
    split.set = [](Settings& s, const Values& values) {
        const std::string word = lowered(values.back());
        const bool grouping = word == "chain" || word == "entity" || word == "copy";
        if (word != "group")
            wrongValue("split", "group", values.back(),
                       grouping ? " [hint: `groupBy` " + word + " `split` group]" : "");
        s.options.split = true;
    };
    split.get = [](const Settings& s) { return std::string(s.options.split ? "group" : "none"); };
    Setting groupBy{
        "group-by", SettingType::Text, "WORD",
        "groups by chain, entity, class (a chain's copies),\ncopy or residues:N instead", ""};
    groupBy.set = [](Settings& s, const Values& values) {
        s.labels.groupBy = parseGroupBy(values.back());
    };
    groupBy.get = [](const Settings& s) {
        return s.labels.groupBy ? textOf(*s.labels.groupBy) : std::string();
    };
    groupBy.words = {"chain", "entity", "class", "copy"};
    groupBy.of = SettingOf::Molecule;
    return {groupBy,
            split,
            surfaceOf,
            with(flag("interfaces", "buried areas between groups, for the report",
                      MOLSURF_OF(options.interfaces)),
                 [](Setting& row) { row.get = nullptr; }),
            colorSetting(),
            patchSetting()};
}

std::vector<Setting> pocketSettings()
{
    const auto of = [](auto member) {
        return [=](auto& s) -> auto&
        {
            return s.options.pocket.*member;
        };
    };
    Setting at = text("pocket-at", "SEL",
                      "only the pocket at these atoms of the file, used or not:\n"
                      "a ligand, or residues that line it; volume 0 in frames\n"
                      "where it is closed",
                      "none", MOLSURF_OF(places.pocketAt));
    Setting pore = text("pore", "WAY",
                        "the pore, for the report, .pore.csv, profiles .pore.svg,\n"
                        ".pore.png, a tube as .pore.ply, .obj, .stl, .glb or .3mf:\n"
                        "auto, an axis as z, or its ends, points or atoms, as\n"
                        "'0,0,-9 -> 0,0,9', 'resid 14 -> resid 43'",
                        "none", MOLSURF_OF(places.pore));
    Setting tunnels =
        text("tunnels-from", "PLACE",
             "the ways out of a place, for the report, pictures and pages,\n"
             ".tunnels.csv, over frames .tunnel_frames.csv, and as\n"
             ".tunnels.ply, .obj, .stl, .glb, .3mf, .pdb, .cif, .cxc, .pml:\natoms, as "
             "'resid 197', or a point X,Y,Z",
             "none", MOLSURF_OF(places.tunnelsFrom));
    at.of = pore.of = tunnels.of = SettingOf::Molecule;
    return {
        at,
        pore,
        tunnels,
        number("tunnel-probe", "R",
               "tunnels are at least as wide as a ball of this radius [Å],\n0.3 to 10; they end "
               "where one of `probeOut` gets",
               MOLSURF_OF(options.tunnelProbe)),
        flag("pockets",
             "pockets of the surface, for the report, .pockets.csv, and a\n"
             "mesh of each, as by .pockets.ply, .obj, .stl, .glb or .3mf",
             MOLSURF_OF(options.pockets)),
        number("probe-in", "R", "radius of the probe that gets into pockets [Å], 0.5 to 10",
               of(&Products::PocketRule::probeIn)),
        number("probe-out", "R",
               "radius of the probe that stays out of them [Å], above\n"
               "`probeIn`; larger: shallow ones are found, too",
               of(&Products::PocketRule::probeOut)),
        within(0.0, 50.0,
               number("pocket-cut", "D", "pockets begin so far below the surface of that probe [Å]",
                      of(&Products::PocketRule::cut))),
        within(0.0, 1.0,
               number("pocket-neck", "S",
                      "two pockets, where the ball that passes between them has\n"
                      "less than this share of the smaller one's radius; 0: one",
                      of(&Products::PocketRule::neck)))};
}

std::vector<Setting> flowSettings()
{
    const auto of = [](auto member) {
        return [=](auto& s) -> auto&
        {
            return s.options.evolution.*member;
        };
    };
    const auto shown = [](const char* preset, Setting row) {
        row.preset = preset;
        return row;
    };
    constexpr std::pair<int, int> steps = {0, 1000000};
    std::vector<Setting> rows = {
        within(0.0, 1e6,
               number("lambda", "L", "weight of the regulariser [Å^2 for gradient, 1 for area]",
                      of(&EvolveOptions::lambda))),
        word("regularizer", "KIND", "gradient or area", of(&EvolveOptions::regularizer),
             std::vector<Regularizer>{Regularizer::Gradient, Regularizer::Area}),
        word("flow", "KIND",
             "rest: in closed form, where no front moves, else newton;\n"
             "newton: by steps; paper: the paper's scheme, to compare",
             of(&EvolveOptions::flow), std::vector<Flow>{Flow::Rest, Flow::Newton, Flow::Paper}),
        shown("50; paper: 200", count("max-steps", "N", "steps at most", "default of the flow",
                                      steps, of(&EvolveOptions::maxSteps))),
        shown("until it converges",
              count("steps", "N", "so many steps, converged or not", "by the stopping rule", steps,
                    of(&EvolveOptions::steps))),
        number("tolerance", "T",
               "converged when a step moves the surface by less than T\n"
               "voxels (rms), and by less than 8 T on 99.9 % of it",
               of(&EvolveOptions::tolerance))};
    for (Setting& row : rows) row = onlyOf(evolves, std::move(row));
    rows.push_back(
        with(count("spline-level", "L", "spline on voxels of 2^L times the edge; 0, 1 or 2", "0",
                   {0, 2}, MOLSURF_OF(options.splineLevel)),
             [](Setting& row) {
                 row.get = [](const Settings& s) { return std::int64_t(s.options.splineLevel); };
             }));
    return rows;
}

} // namespace

const std::vector<Setting>& settingTable()
{
    static const std::vector<Setting> all = [] {
        std::vector<Setting> rows = atomSettings();
        for (Setting& row : rows)
            row.of = row.name == std::string("charges") ? SettingOf::Molecule : SettingOf::Balls;
        for (auto* more : {surfaceSettings, meshSettings, resolutionSettings, groupSettings,
                           coloringSettings, pocketSettings, flowSettings})
            for (Setting& row : more()) rows.push_back(std::move(row));
        return rows;
    }();
    return all;
}

} // namespace molsurf
