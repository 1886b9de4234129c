// SPDX-License-Identifier: MPL-2.0
#include "cli/parse.h"

#include "cli/option_table.h"
#include "cli/verb_table.h"

#include <algorithm>

namespace molsurf::tool
{

namespace
{

/// Options that every verb has.
const OptionGroup& information()
{
    static const OptionGroup group = {
        "Information",
        {{"list-radii", 0, nullptr, "print the radii sets and stop", "", Build},
         {"version", 'V', nullptr, "print the version and stop", "", 0xff},
         {"help", 'h', nullptr, "print this text and stop", "", 0xff}}};
    return group;
}

/// The groups that have options of a verb, with these alone.
std::vector<OptionGroup> groupsOf(Verb verb)
{
    std::vector<OptionGroup> all = optionTable();
    all.push_back(information());
    for (OptionGroup& group : all) {
        std::vector<Option>& options = group.options;
        options.erase(std::remove_if(options.begin(), options.end(),
                                     [=](const Option& o) { return !(o.verbs & verb); }),
                      options.end());
    }
    all.erase(std::remove_if(all.begin(), all.end(),
                             [](const OptionGroup& group) { return group.options.empty(); }),
              all.end());
    return all;
}

std::string textOf(const Option& option)
{
    return option.text + (option.preset.empty() ? "" : " [" + option.preset + "]");
}

std::string nameOf(const VerbInfo& info)
{
    return info.verb == Build ? "" : std::string(info.name) + " ";
}

/// The lines of an option in a help text.
std::string helpLine(const Option& option)
{
    std::string line = option.letter ? std::string("  -") + option.letter + ", --" : "      --";
    line += option.name;
    if (option.value) line += std::string(" ") + option.value;
    const std::size_t column = 26;
    if (line.size() + 2 > column) line += "\n"; // a line of its own
    line.resize(line.back() == '\n' ? line.size() + column : column, ' ');
    for (const char letter : textOf(option)) {
        line += letter;
        if (letter == '\n') line.append(column, ' ');
    }
    return line + "\n";
}

std::string statusOf(const VerbInfo& info)
{
    std::string all = "0 done, 1 failed, 2 wrong usage, ";
    if (*info.status) all += std::string(info.status) + ", ";
    return all + "130 interrupted.";
}

} // namespace

std::string overview()
{
    std::string text;
    for (const VerbInfo& info : verbTable())
        text += "vdb_molsurf " + nameOf(info) + info.synopsis + "\n    " + info.text + "\n";
    for (std::size_t at = 0; (at = text.find(",\n", at)) != std::string::npos; ++at)
        text.replace(at, 2, ",\n    ");
    return text + "\nvdb_molsurf help VERB tells the options of a verb.\n";
}

std::string helpText(Verb verb)
{
    const VerbInfo& info = infoOf(verb);
    std::string text = "vdb_molsurf " + nameOf(info) + info.synopsis + "\n";
    if (verb == Build) {
        for (const VerbInfo& other : verbTable())
            if (other.verb != Build)
                text += std::string("vdb_molsurf ") + other.name + " " + other.synopsis + "\n";
        text += "vdb_molsurf help [VERB]\n";
    }
    text += std::string("\n") + info.text + "\n" + info.more +
            "Lengths are in Å. Defaults are in brackets.\n";
    for (const OptionGroup& group : groupsOf(verb)) {
        text += std::string("\n") + group.title + "\n";
        for (const Option& option : group.options) text += helpLine(option);
    }
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

/// All groups, those that are not in the table of options too.
std::vector<OptionGroup> allGroups()
{
    std::vector<OptionGroup> all = optionTable();
    all.push_back(information());
    return all;
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
    for (const OptionGroup& group : allGroups()) {
        page += ".SS " + escaped(group.title) + "\n";
        for (const Option& option : group.options) page += manItem(option);
    }
    return page +
           ".SH EXIT STATUS\n"
           "0 done, 1 failed, 2 wrong usage, 3 not converged (files are written) or a result "
           "failed\n"
           "its own checks (none are), 130 interrupted.\n"
           ".SH EXAMPLES\n.nf\nvdb_molsurf 1crn.pdb \\-o 1crn.vdb \\-o 1crn.ply\n"
           "vdb_molsurf top.pdb \\-\\-trajectory run.dcd \\-\\-frames 1\\-100:5 \\-o run.vdb "
           "\\-o run.csv\nvdb_molsurf convert 1crn.vdb \\-o 1crn.stl\n.fi\n";
}

std::string bashCompletion()
{
    std::string firsts = "help", seconds, words, lists;
    for (const VerbInfo& info : verbTable()) {
        const std::string name = info.name;
        const std::size_t space = name.find(' ');
        const std::string first = name.substr(0, space);
        if ((" " + firsts + " ").find(" " + first + " ") == std::string::npos)
            firsts += " " + first;
        if (space != std::string::npos)
            seconds += (seconds.empty() ? "" : " ") + name.substr(space + 1);
        std::string all;
        for (const OptionGroup& group : groupsOf(info.verb)) {
            for (const Option& option : group.options) {
                all += (all.empty() ? "--" : " --") + std::string(option.name);
                if (option.letter) all += std::string(" -") + option.letter;
                if (!option.words.empty())
                    words += "        \"" + name + "\":--" + option.name + ") words=\"" +
                             joinWords(option.words, " ") + "\" ;;\n";
            }
        }
        lists += "        \"" + name + "\") options=\"" + all + "\" ;;\n";
    }
    std::string alternatives = firsts;
    std::replace(alternatives.begin(), alternatives.end(), ' ', '|');
    return "# bash completion of vdb_molsurf " MOLSURF_VERSION "\n"
           "_vdb_molsurf()\n{\n"
           "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
           "    local verb=build options= words=\n"
           "    case ${COMP_WORDS[1]} in\n"
           "        bricks) verb=\"bricks ${COMP_WORDS[2]}\" ;;\n"
           "        " +
           alternatives + ") verb=${COMP_WORDS[1]} ;;\n    esac\n    case $verb:$before in\n" +
           words + "    esac\n    case $verb in\n" + lists +
           "    esac\n"
           "    if [[ $COMP_CWORD == 2 && ${COMP_WORDS[1]} == bricks ]]; then\n"
           "        COMPREPLY=($(compgen -W \"" +
           seconds +
           "\" -- \"$word\"))\n"
           "    elif [[ -n $words ]]; then\n"
           "        COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
           "    elif [[ $word == -* ]]; then\n"
           "        COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
           "    else\n"
           "        COMPREPLY=($(compgen -f -- \"$word\"))\n"
           "        [[ $COMP_CWORD == 1 ]] && COMPREPLY+=($(compgen -W \"" +
           firsts +
           "\" -- \"$word\"))\n"
           "    fi\n}\n"
           "complete -o filenames -F _vdb_molsurf vdb_molsurf\n";
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
    for (const OptionGroup& group : allGroups()) {
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
