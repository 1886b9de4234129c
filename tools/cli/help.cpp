// SPDX-License-Identifier: MPL-2.0
#include "cli/parse.h"

#include "cli/option_table.h"
#include "cli/verb_table.h"
#include "exit_status.h"

#include <algorithm>

namespace molsurf::tool
{

namespace
{

/// The options that --help shows: those that most calls have, and what people ask for first.
constexpr const char* common[] = {"output",  "folder", "formats", "force",   "select", "assembly",
                                  "hetero",  "waters", "radii",   "probe",   "frames", "surface",
                                  "voxel",   "color",  "pockets", "pore",    "for",    "show",
                                  "opacity", "size",   "memory",  "dry-run", "bricks", "threads"};

bool isCommon(const Option& option)
{
    return std::find(std::begin(common), std::end(common), option.name) != std::end(common);
}

std::string textOf(const Option& option)
{
    return option.text + (option.preset.empty() ? "" : " [" + option.preset + "]");
}

std::string nameOf(const VerbInfo& info)
{
    return info.verb == Build ? "" : std::string(info.name) + " ";
}

/// What comes first of a text, for the short help: up to the first semicolon, but for lists.
std::string firstOf(const Option& option)
{
    const std::string name = option.name;
    if (name == "output" || name == "select" || name == "surface" ||
        option.text.find(';') == std::string::npos)
        return textOf(option);
    Option brief = option;
    brief.text = wrapped(option.text.substr(0, option.text.find(';')), helpWidth);
    return textOf(brief);
}

/// The lines of an option in a help text.
/// @param[in] all  its whole text
std::string helpLine(const Option& option, bool all = true)
{
    std::string line = option.letter ? std::string("  -") + option.letter + ", --" : "      --";
    line += option.name;
    if (option.value) line += std::string(" ") + option.value;
    const std::size_t column = 26;
    if (line.size() + 2 > column) line += "\n"; // a line of its own
    line.resize(line.back() == '\n' ? line.size() + column : column, ' ');
    for (const char letter : all ? textOf(option) : firstOf(option)) {
        line += letter;
        if (letter == '\n') line.append(column, ' ');
    }
    return line + "\n";
}

std::string statusOf(const VerbInfo& info)
{
    std::vector<std::string> all;
    for (const ExitStatus& row : exitStatuses) {
        if (row.status == laterStatus && *info.status) // 3 comes before it
            all.push_back(std::to_string(notConvergedStatus) + " " + info.status);
        all.push_back(std::to_string(row.status) + " " + row.text);
    }
    return joinWords(all, ", ") + ".";
}

std::string exampleLines(const std::vector<Example>& examples)
{
    std::string lines = examples.empty() ? "" : "\nExamples\n";
    for (const Example& example : examples)
        lines += std::string("  ") + example.command + "\n      " + example.text + "\n";
    return lines;
}

/// Whether a word, of small letters, names a group: "pockets", "pocket", "colors".
bool isTitle(const std::string& title, const std::string& word)
{
    const std::string name = lowered(title);
    return word == name || word + "s" == name || word == name + "s" ||
           (name == "colours" && (word == "colors" || word == "color"));
}

/// The verbs but the first one, a line each.
std::string verbLines()
{
    std::string text = "\nVerbs (vdb_molsurf help VERB)\n";
    for (const VerbInfo& info : verbTable()) {
        if (info.verb == Build) continue;
        std::string line = std::string("  ") + info.name;
        line.resize(16, ' ');
        text += line + std::string(info.text) + "\n";
    }
    return text;
}

/// The groups of options of a verb: "output, atoms, ...".
std::string titles(Verb verb)
{
    std::vector<std::string> all;
    for (const OptionGroup& group : optionGroups(verb)) all.push_back(lowered(group.title));
    return joinWords(all, ", ");
}

} // namespace

std::vector<std::string> topicWords()
{
    std::vector<std::string> words;
    for (const OptionGroup& group : optionGroups(0xff)) {
        words.push_back(lowered(group.title));
        for (const Option& option : group.options) words.push_back(option.name);
    }
    return words;
}

std::string topicText(const std::string& word)
{
    std::string text;
    for (const OptionGroup& group : optionGroups(0xff)) {
        if (!isTitle(group.title, word)) continue;
        text = std::string(group.title) + "\n";
        for (const Option& option : group.options) text += helpLine(option);
        return text + exampleLines(group.examples);
    }
    for (const OptionGroup& group : optionGroups(0xff))
        for (const Option& option : group.options)
            if (option.isNamed(word) || "--" + std::string(option.name) == word)
                text += helpLine(option);
    return text;
}

std::string overview(const std::string& first)
{
    std::string text;
    for (const VerbInfo& info : verbTable())
        if (std::string(info.name).rfind(first, 0) == 0)
            text += "vdb_molsurf " + nameOf(info) + info.synopsis + "\n    " + info.text + "\n";
    for (std::size_t at = 0; (at = text.find(",\n", at)) != std::string::npos; ++at)
        text.replace(at, 2, ",\n    ");
    return text +
           "\nvdb_molsurf help VERB prints the common options of a verb, vdb_molsurf help GROUP a "
           "group\nof options with examples, vdb_molsurf help options all options.\n";
}

std::string helpText(Verb verb, bool all)
{
    const VerbInfo& info = infoOf(verb);
    std::string text = "vdb_molsurf " + nameOf(info) + info.synopsis + "\n\n" + info.text + "\n" +
                       info.more + "Lengths are in Å. Defaults are in brackets.\n";
    text += exampleLines(info.examples);
    if (verb == Build) text += verbLines();
    if (!all) text += "\nCommon options\n";
    for (const OptionGroup& group : optionGroups(verb)) {
        std::string lines;
        for (const Option& option : group.options)
            if (all || isCommon(option)) lines += helpLine(option, all);
        if (!lines.empty() && all) text += std::string("\n") + group.title + "\n";
        text += lines;
    }
    if (!all)
        text += "\nAll options: vdb_molsurf " + nameOf(info) + "--help-all\n" +
                wrapped("Groups of options: vdb_molsurf help GROUP, one of " + titles(verb), 88) +
                "\n";
    return text + "\n" + wrapped("Exit status: " + statusOf(info), 88) + "\n";
}

namespace
{

/// Text for roff: no line of it is a command, and hyphens can be copied.
std::string escaped(const std::string& text)
{
    std::string out;
    for (const char letter : text) {
        if (letter == '\\')
            out += "\\e";
        else if (letter == '-')
            out += "\\-";
        else if ((letter == '.' || letter == '\'') && (out.empty() || out.back() == '\n'))
            out += std::string("\\&") + letter;
        else
            out += letter;
    }
    return out;
}

/// The verbs that take an option, if it is not for all: " (build, batch)".
std::string takersOf(const Option& option)
{
    std::vector<std::string> names;
    for (const VerbInfo& info : verbTable())
        if (option.verbs & info.verb) names.push_back(info.name);
    return names.size() == verbTable().size() ? "all" : joinWords(names, ", ");
}

std::string manItem(const Option& option)
{
    std::string head = option.letter ? std::string("\\fB\\-") + option.letter + "\\fR, " : "";
    head += "\\fB" + escaped(std::string("--") + option.name) + "\\fR";
    if (option.value) head += " \\fI" + escaped(option.value) + "\\fR";
    return ".TP\n" + head + " (" + escaped(takersOf(option)) + ")\n" + escaped(textOf(option)) +
           "\n";
}

} // namespace

std::string manPage()
{
    std::string page = ".TH VDB_MOLSURF 1 \"\" \"vdb_molsurf " MOLSURF_VERSION "\"\n"
                       ".ad l\n.SH NAME\nvdb_molsurf \\- molecular surfaces as OpenVDB level sets\n"
                       ".SH SYNOPSIS\n.nf\n";
    for (const VerbInfo& info : verbTable())
        page += "\\fBvdb_molsurf " + nameOf(info) + "\\fR" + escaped(info.synopsis) + "\n";
    page += std::string(".fi\n.SH DESCRIPTION\n") + escaped(infoOf(Build).text) +
            "\nLengths are in Å. Defaults are in brackets.\n.SH VERBS\n";
    for (const VerbInfo& info : verbTable())
        page += std::string(".TP\n\\fB") + info.name + "\\fR\n" + escaped(info.text) + "\n" +
                escaped(info.more);
    page += ".SH OPTIONS\nThe verbs that take an option stand behind it.\n";
    for (const OptionGroup& group : optionGroups(0xff)) {
        page += ".SS " + escaped(group.title) + "\n";
        for (const Option& option : group.options) page += manItem(option);
    }
    std::string examples;
    for (const VerbInfo& info : verbTable())
        for (const Example& example : info.examples)
            examples += ".TP\n" + escaped(example.command) + "\n" + escaped(example.text) + "\n";
    return page + ".SH EXIT STATUS\n" + wrapped(statusOf(infoOf(Build)), 88) + "\n.SH EXAMPLES\n" +
           examples;
}

std::string optionsPage()
{
    // Markdown cells are one line, and | ends them.
    const auto cell = [](const std::string& text) {
        std::string out;
        for (const char letter : text) {
            if (letter == '|') out += '\\';
            out += letter == '\n' ? ' ' : letter;
        }
        return out;
    };
    std::string page =
        "# Options\n\nThe program makes this page out of its tables of verbs and options. "
        "Lengths are in Å.\n\n## Verbs\n\nThe verb `build` may be left out.\n";
    for (const VerbInfo& info : verbTable())
        page += "\n### " + std::string(info.name) + "\n\n```\nvdb_molsurf " + nameOf(info) +
                info.synopsis + "\n```\n\n" + info.text + "\n" + info.more +
                "Exit status: " + statusOf(info) + "\n";
    for (const OptionGroup& group : optionGroups(0xff)) {
        page += std::string("\n## ") + group.title +
                "\n\n| option | meaning | default | verbs |\n|---|---|---|---|\n";
        for (const Option& option : group.options)
            page += "| `--" + std::string(option.name) +
                    (option.value ? cell(std::string(" ") + option.value) : "") + "`" +
                    (option.letter ? std::string(", `-") + option.letter + "`" : "") + " | " +
                    cell(option.text) + " | " + cell(option.preset) + " | " + takersOf(option) +
                    " |\n";
    }
    return page;
}

} // namespace molsurf::tool
