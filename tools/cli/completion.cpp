// SPDX-License-Identifier: MPL-2.0
#include "cli/parse.h"

#include "cli/option_table.h"
#include "cli/verb_table.h"

#include <algorithm>

namespace molsurf::tool
{

namespace
{

/// The words that a command line may begin with, and those that follow "bricks".
struct VerbWords {
    std::vector<std::string> firsts = {"help"}, seconds;
};

VerbWords verbWords()
{
    VerbWords words;
    for (const VerbInfo& info : verbTable()) {
        const std::string name = info.name;
        const std::size_t space = name.find(' ');
        const std::string first = name.substr(0, space);
        if (std::count(words.firsts.begin(), words.firsts.end(), first) == 0)
            words.firsts.push_back(first);
        if (space != std::string::npos) words.seconds.push_back(name.substr(space + 1));
    }
    return words;
}

/// The first line of what help says of an option, between single quotes of a shell.
std::string described(const Option& option, const std::string& quote)
{
    const std::string line = option.text.substr(0, option.text.find('\n'));
    std::string out;
    for (const char letter : line) out += letter == '\'' ? quote : std::string(1, letter);
    return out;
}

/// A text with a backslash before each colon.
std::string withoutColons(const std::string& text)
{
    std::string out;
    for (const char letter : text) out += (letter == ':' ? "\\" : "") + std::string(1, letter);
    return out;
}

} // namespace

std::string bashCompletion()
{
    const VerbWords known = verbWords();
    std::string words, lists; // cases: the values of an option of a verb, the options of a verb
    for (const VerbInfo& info : verbTable()) {
        const std::string name = info.name;
        std::string all;
        for (const OptionGroup& group : optionGroups(info.verb)) {
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
    return "# bash completion of vdb_molsurf " MOLSURF_VERSION "\n"
           "_vdb_molsurf()\n{\n"
           "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
           "    local verb=build options= words=\n"
           "    case ${COMP_WORDS[1]} in\n"
           "        bricks) verb=\"bricks ${COMP_WORDS[2]}\" ;;\n"
           "        " +
           joinWords(known.firsts, "|") +
           ") verb=${COMP_WORDS[1]} ;;\n    esac\n    case $verb:$before in\n" + words +
           "    esac\n    case $verb in\n" + lists +
           "    esac\n"
           "    if [[ $COMP_CWORD == 2 && ${COMP_WORDS[1]} == bricks ]]; then\n"
           "        COMPREPLY=($(compgen -W \"" +
           joinWords(known.seconds, " ") +
           "\" -- \"$word\"))\n"
           "    elif [[ -n $words ]]; then\n"
           "        COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
           "    elif [[ $word == -* ]]; then\n"
           "        COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
           "    else\n"
           "        COMPREPLY=($(compgen -f -- \"$word\"))\n"
           "        [[ $COMP_CWORD == 1 ]] && COMPREPLY+=($(compgen -W \"" +
           joinWords(known.firsts, " ") +
           "\" -- \"$word\"))\n"
           "    fi\n}\n"
           "complete -o filenames -F _vdb_molsurf vdb_molsurf\n";
}

std::string zshCompletion()
{
    const VerbWords known = verbWords();
    std::string words, lists; // as of bash
    for (const VerbInfo& info : verbTable()) {
        const std::string name = info.name;
        lists += "    \"" + name + "\") options=(";
        for (const OptionGroup& group : optionGroups(info.verb)) {
            for (const Option& option : group.options) {
                const std::string text = withoutColons(described(option, "'\\''"));
                lists += std::string("\n      '--") + option.name + ":" + text + "'";
                if (option.letter)
                    lists += std::string("\n      '-") + option.letter + ":" + text + "'";
                if (!option.words.empty())
                    words += "    \"" + name + ":--" + option.name + "\") compadd -- '" +
                             joinWords(option.words, "' '") + "'; return ;;\n";
            }
        }
        lists += ") ;;\n";
    }
    return "#compdef vdb_molsurf\n"
           "# zsh completion of vdb_molsurf " MOLSURF_VERSION "\n"
           "local verb=build\nlocal -a options\n"
           "case $words[2] in\n"
           "    bricks) verb=\"bricks $words[3]\" ;;\n"
           "    " +
           joinWords(known.firsts, "|") + ") verb=$words[2] ;;\nesac\n" +
           "case \"$verb:$words[CURRENT-1]\" in\n" + words +
           "esac\n"
           "if [[ $CURRENT == 3 && $words[2] == bricks ]]; then\n"
           "    compadd -- " +
           joinWords(known.seconds, " ") +
           "\n    return\nfi\n"
           "if [[ $words[CURRENT] == -* ]]; then\n"
           "    case $verb in\n" +
           lists +
           "    esac\n"
           "    _describe option options\n    return\nfi\n"
           "(( CURRENT == 2 )) && compadd -- " +
           joinWords(known.firsts, " ") + "\n_files\n";
}

namespace
{

/// Words of an option as fish takes them from a string: it reads > and < in there itself.
std::string fishWords(const std::vector<std::string>& words)
{
    std::string text;
    for (const char c : joinWords(words, " ")) {
        if (c == '<' || c == '>') text += '\\';
        text += c;
    }
    return text;
}

} // namespace

std::string fishCompletion()
{
    const VerbWords known = verbWords();
    std::string text =
        "# fish completion of vdb_molsurf " MOLSURF_VERSION "\n"
        "function __vdb_molsurf_verb\n"
        "    set -l words (commandline -opc)\n    set -l verb build\n"
        "    switch \"$words[2]\"\n"
        "        case bricks\n            set verb \"bricks $words[3]\"\n"
        "        case " +
        joinWords(known.firsts, " ") +
        "\n            set verb $words[2]\n    end\n"
        "    contains -- $verb $argv\nend\n"
        "complete -c vdb_molsurf -n '__fish_is_nth_token 1' -a '" +
        joinWords(known.firsts, " ") +
        "'\n"
        "complete -c vdb_molsurf -n '__fish_is_nth_token 2; and __fish_seen_subcommand_from "
        "bricks' -x -a '" +
        joinWords(known.seconds, " ") + "'\n";
    for (const OptionGroup& group : optionGroups(0xff)) {
        for (const Option& option : group.options) {
            std::string verbs;
            for (const VerbInfo& info : verbTable())
                if (option.verbs & info.verb) verbs += std::string(" \"") + info.name + "\"";
            text +=
                "complete -c vdb_molsurf -n '__vdb_molsurf_verb" + verbs + "' -l " + option.name;
            if (option.letter) text += std::string(" -s ") + option.letter;
            if (!option.words.empty())
                text += " -x -a '" + fishWords(option.words) + "'";
            else if (option.value)
                text += " -r";
            text += " -d '" + described(option, "\\'") + "'\n";
        }
    }
    return text;
}

} // namespace molsurf::tool
