// SPDX-License-Identifier: MPL-2.0
#include "manual.h"

#include "cli.h"

#include "molsurf/surface/extra_grids.h"

#include <algorithm>
#include <set>

namespace molsurf::tool
{

namespace
{

struct VerbText {
    Verb verb;
    const char* name; // empty: the main job
    const char* synopsis;
    const char* text;
};

constexpr VerbText verbs[] = {
    {Verb::Build, "", "INPUT -o FILE [-o FILE ...] [options]",
     "Builds the molecular surface of the atoms in INPUT (.pdb .ent .cif .mmcif .pqr .xyzr, each "
     "also .gz, or - for standard input): a level set as OpenVDB grid, meshes, pictures, a report. "
     "With --frames one for every frame."},
    {Verb::Batch, "batch", "LIST -O DIR [options]",
     "Builds the surfaces of many structures, one after the other. LIST has the name of a "
     "structure "
     "file a line. All options but those of Output and Frames are those of the main job."},
    {Verb::Compare, "compare", "A B [-o FILE ...] [options]",
     "Distances of surface A from surface B and back. Each is a .vdb, a mesh or a structure."},
    {Verb::Plan, "plan", "INPUT -o plan.json --bricks N [options]",
     "Cuts the space about a molecule into bricks that can be computed on many machines."},
    {Verb::Brick, "brick", "plan.json K [options]", "Computes brick K of a plan."},
    {Verb::Merge, "merge", "plan.json -o FILE [-o FILE ...] [options]",
     "Joins the bricks of a plan to one surface."},
    {Verb::Mesh, "mesh", "FILE.vdb -o FILE [-o FILE ...] [options]",
     "Meshes and pictures of a stored surface, without computing it again."},
    {Verb::Color, "color", "FILE.vdb --color WORD -o FILE [-o FILE ...] [options]",
     "Colours a stored surface anew, without the atoms."},
    {Verb::Info, "info", "FILE ...", "Prints what .vdb files and structures hold."}};

// Text for roff: no line of it is a command, and hyphens can be copied.
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

std::string item(const OptionText& option)
{
    std::string head = option.letter.empty() ? "" : "\\fB\\-" + option.letter + "\\fR, ";
    head += "\\fB" + escaped("--" + option.name) + "\\fR";
    if (!option.value.empty()) head += " \\fI" + escaped(option.value) + "\\fR";
    std::string text = option.text;
    if (!option.preset.empty()) text += " [" + option.preset + "]";
    return ".TP\n" + head + "\n" + escaped(text) + "\n";
}

std::string options(Verb verb, const std::set<std::string>& left)
{
    std::string out, group;
    for (const OptionText& option : optionTexts(verb)) {
        if (left.count(option.group)) continue;
        if (option.group != group) out += ".SS " + escaped(option.group) + "\n";
        group = option.group;
        out += item(option);
    }
    return out;
}

// Values that are words, by option.
std::string wordsOf(Verb verb, const std::string& option)
{
    if (option == "surface") {
        std::string all;
        for (const SurfaceKind kind :
             {SurfaceKind::Variational, SurfaceKind::SolventExcluded,
              SurfaceKind::SolventAccessible, SurfaceKind::VanDerWaals, SurfaceKind::Gaussian})
            all += std::string(nameOf(kind)) + " ";
        return all;
    }
    if (option == "color" && verb == Verb::Compare) return "distance signed-distance";
    if (option == "color") return "chain group element residue mean-curvature gaussian-curvature";
    if (option == "fields") {
        std::string all = "all surface";
        for (const std::string& field : fieldNames()) all += " " + field;
        return all;
    }
    if (option == "format") return "vdb ply obj stl off glb 3mf html json png";
    if (option == "regularizer") return "gradient area";
    if (option == "flow") return "preconditioned plain";
    if (option == "for") return "blender houdini usd";
    if (option == "start") return "cold warm";
    if (option == "legend") return "auto on off";
    if (option == "split") return "group";
    if (option == "group-by") return "chain entity copy";
    if (option == "coarse") return "atom residue";
    return "";
}

} // namespace

std::string manPage()
{
    std::string page = ".TH VDB_MOLSURF 1 \"\" \"vdb_molsurf " MOLSURF_VERSION "\"\n"
                       ".ad l\n.SH NAME\nvdb_molsurf \\- molecular surfaces as OpenVDB level sets\n"
                       ".SH SYNOPSIS\n.nf\n";
    for (const VerbText& verb : verbs)
        page += "\\fBvdb_molsurf" + (*verb.name ? " " + std::string(verb.name) : "") + "\\fR " +
                escaped(verb.synopsis) + "\n";
    page += ".fi\n.SH DESCRIPTION\n" + escaped(verbs[0].text) +
            "\nLengths are in Å. Defaults are in brackets.\n.SH OPTIONS\n" +
            options(Verb::Build, {});
    for (const VerbText& verb : verbs) {
        if (!*verb.name) continue;
        std::string title = verb.name;
        for (char& letter : title) letter = char(letter - 'a' + 'A');
        page += ".SH " + title + "\n" + escaped(verb.text) + "\n";
        if (verb.verb == Verb::Info) continue;
        std::set<std::string> left; // what the main job has, too
        for (const OptionText& option : optionTexts(Verb::Build))
            if (option.group != "Output") left.insert(option.group);
        page += options(verb.verb, left);
    }
    return page +
           ".SH EXIT STATUS\n"
           "0 done, 1 failed, 2 wrong usage, 3 not converged (files are written), 130 "
           "interrupted.\n"
           ".SH EXAMPLES\n.nf\nvdb_molsurf 1crn.pdb \\-o 1crn.vdb \\-o 1crn.ply\n"
           "vdb_molsurf top.pdb \\-\\-trajectory run.dcd \\-\\-frames 1\\-100:5 \\-o run.vdb "
           "\\-o run.csv\nvdb_molsurf mesh 1crn.vdb \\-o 1crn.stl\n.fi\n";
}

std::string bashCompletion()
{
    std::string out =
        "# bash completion of vdb_molsurf " MOLSURF_VERSION "\n"
        "_vdb_molsurf()\n{\n"
        "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
        "    local verb=build options= words=\n"
        "    case ${COMP_WORDS[1]} in\n        ";
    std::string names;
    for (const VerbText& verb : verbs)
        if (*verb.name) names += (names.empty() ? "" : "|") + std::string(verb.name);
    out += names + ") verb=${COMP_WORDS[1]} ;;\n    esac\n    case $verb:$before in\n";
    std::string lists;
    for (const VerbText& verb : verbs) {
        const std::string name = *verb.name ? verb.name : "build";
        std::string all;
        if (verb.verb == Verb::Info) {
            all = "--help";
        } else {
            for (const OptionText& option : optionTexts(verb.verb)) {
                all += (all.empty() ? "" : " ") + ("--" + option.name);
                if (!option.letter.empty()) all += " -" + option.letter;
                const std::string words = wordsOf(verb.verb, option.name);
                if (!words.empty())
                    out +=
                        "        " + name + ":--" + option.name + ") words=\"" + words + "\" ;;\n";
            }
        }
        lists += "        " + name + ") options=\"" + all + "\" ;;\n";
    }
    out += "    esac\n    case $verb in\n" + lists + "    esac\n";
    std::replace(names.begin(), names.end(), '|', ' ');
    return out +
           "    if [[ -n $words ]]; then\n"
           "        COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
           "    elif [[ $word == -* ]]; then\n"
           "        COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
           "    else\n"
           "        COMPREPLY=($(compgen -f -- \"$word\"))\n"
           "        [[ $COMP_CWORD == 1 ]] && COMPREPLY+=($(compgen -W \"" +
           names +
           "\" -- \"$word\"))\n"
           "    fi\n}\n"
           "complete -o filenames -F _vdb_molsurf vdb_molsurf\n";
}

} // namespace molsurf::tool
