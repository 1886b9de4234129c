// SPDX-License-Identifier: MPL-2.0
#include "cli/parse.h"

#include "cli/complete.h"
#include "cli/option_table.h"
#include "cli/pair_table.h"
#include "cli/suggest.h"
#include "cli/verb_table.h"

#include "molsurf/error.h"
#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/text_fields.h"
#include "molsurf/show/io/report_keys.h"

#include <boost/program_options.hpp>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace molsurf::tool
{

namespace po = boost::program_options;

namespace
{

/// Options that end the program after a text.
constexpr const char* texts[] = {"help", "help-all", "version", "list-radii"};

/// Options that print what the tables of the program hold: files of the project come from them.
struct Page {
    const char* option;
    std::string (*text)();
};
constexpr Page pages[] = {{"--man", manPage},
                          {"--bash-completion", bashCompletion},
                          {"--zsh-completion", zshCompletion},
                          {"--fish-completion", fishCompletion},
                          {"--options-page", optionsPage},
                          {"--report-page", reportPage}};

po::options_description describe(Verb verb)
{
    po::options_description all;
    for (const OptionGroup& group : optionTable()) {
        for (const Option& option : group.options) {
            if (!(option.verbs & verb)) continue;
            const std::string names =
                option.name + (option.letter ? std::string(",") + option.letter : "");
            for (const char* words : {names.c_str(), option.former}) {
                if (words && option.value)
                    all.add_options()(words, po::value<std::string>());
                else if (words)
                    all.add_options()(words, po::bool_switch());
            }
        }
    }
    all.add_options()("help,h", po::bool_switch())("help-all", po::bool_switch())(
        "version,V", po::bool_switch());
    if (verb == Build) all.add_options()("list-radii", po::bool_switch());
    all.add_options()("input", po::value<std::vector<std::string>>());
    return all;
}

/// The first words of the verbs.
std::vector<std::string> verbs()
{
    std::vector<std::string> names;
    for (const VerbInfo& info : verbTable()) {
        const std::string name = info.name;
        const std::string first = name.substr(0, name.find(' '));
        if (std::count(names.begin(), names.end(), first) == 0) names.push_back(first);
    }
    return names;
}

/// Whether a command line asks for the verbs of a first word: "bricks --help".
/// @param[in] helping  they follow the word help
bool asksForVerbs(const std::vector<std::string>& words, bool helping)
{
    const auto hasMore = [&](const VerbInfo& info) {
        return std::string(info.name).rfind(lowered(words[0]) + ' ', 0) == 0;
    };
    if (words.size() != (helping ? 1 : 2) ||
        std::none_of(verbTable().begin(), verbTable().end(), hasMore))
        return false;
    return helping || words[1] == "--help" || words[1] == "--help-all" || words[1] == "-h";
}

/// The verb that the first words of a command line name; takes them away.
Verb takeVerb(std::vector<std::string>& words)
{
    if (words.empty()) return Build;
    std::vector<std::string> second;
    for (const VerbInfo& info : verbTable()) {
        const std::string name = info.name;
        const std::size_t space = name.find(' ');
        const std::string first = name.substr(0, space);
        if (lowered(words[0]) != first) continue;
        if (space == std::string::npos) {
            words.erase(words.begin());
            return info.verb;
        }
        second.push_back(name.substr(space + 1));
        if (words.size() < 2 || lowered(words[1]) != second.back()) continue;
        words.erase(words.begin(), words.begin() + 2);
        return info.verb;
    }
    if (!second.empty())
        usageError(
            words[0] + ": expected " + joinWords(second, ", ") + " after it, got " +
            (words.size() > 1 ? "'" + words[1] + "'" + didYouMean(words[1], second) : "nothing") +
            (words.size() > 1 ? "" : " [hint: vdb_molsurf help]"));
    // A word that is nearly a verb, and no file.
    std::error_code ignored;
    const std::string hint = didYouMean(words[0], verbs());
    if (!hint.empty() && words[0][0] != '-' && words[0].find_first_of("./") == std::string::npos &&
        !std::filesystem::exists(words[0], ignored))
        usageError("unknown verb '" + words[0] + "'" + hint);
    return Build;
}

/// Refuses an option without its value.
[[noreturn]] void missingValue(const Option& option)
{
    usageError("--" + std::string(option.name) +
               ": expected a value, got none [hint: for example " + exampleOf(option) + "]");
}

/// A hint on an option that a verb does not have: its name as the program has it, what another
/// program's option is here, the name that it begins with, or the nearest one.
std::string hintOf(Verb verb, const std::string& name, const std::vector<std::string>& known)
{
    std::string plain = lowered(name);
    std::replace(plain.begin(), plain.end(), '_', '-');
    const auto isKnown = [&](const std::string& word) {
        return std::count(known.begin(), known.end(), "--" + word) > 0;
    };
    if (isKnown(plain)) return meant("--" + plain);
    const std::string other = meantByOption(plain);
    if (other.size() < 3 || other[1] != '-' || isKnown(other.substr(2, other.find(' ') - 2)))
        if (!other.empty()) return meant(other);
    for (std::size_t end = plain.rfind('-'); end != std::string::npos && end > 0;
         end = plain.rfind('-', end - 1))
        if (isKnown(plain.substr(0, end))) return meant("--" + plain.substr(0, end));
    const std::string near = didYouMean("--" + plain, known);
    if (!near.empty()) return near;
    return std::string(" [hint: vdb_molsurf ") +
           (verb == Build ? "" : std::string(infoOf(verb).name) + " ") + "--help]";
}

/// Refuses an option that a verb does not have.
[[noreturn]] void refuse(Verb verb, const std::string& typed)
{
    const std::string name = typed.substr(std::min(typed.find_first_not_of('-'), typed.size()));
    std::vector<std::string> known, others;
    for (const char* text : texts) known.push_back(std::string("--") + text);
    for (const OptionGroup& group : optionTable()) {
        for (const Option& option : group.options) {
            if (option.verbs & verb) known.push_back("--" + std::string(option.name));
            if (!isCalled(option, name)) continue;
            for (const VerbInfo& info : verbTable())
                if (option.verbs & info.verb) others.push_back(info.name);
        }
    }
    if (!others.empty()) {
        const bool file = name == "o" || name == "output";
        usageError(typed + " is for " + joinWords(others, ", ") + ", not for " + infoOf(verb).name +
                   (file && findOption(verb, "folder") ? meant("-O") : ""));
    }
    usageError("unknown option '" + typed + "'" + hintOf(verb, name, known));
}

/// Refuses an option without a value, or a switch with one.
[[noreturn]] void refuseValue(Verb verb, const po::error_with_option_name& error)
{
    const std::string typed = error.get_option_name();
    const std::string name = typed.substr(std::min(typed.find_first_not_of('-'), typed.size()));
    if (const Option* option = findOption(verb, name)) {
        if (option->value) missingValue(*option);
        usageError("--" + std::string(option->name) + ": it is a switch and takes no value");
    }
    usageError(error.what());
}

/// Whether a switch is on, by its value in a file of options.
bool isOn(const std::string& name, const std::string& value)
{
    const auto is = [&](std::initializer_list<const char*> words) {
        return std::find(words.begin(), words.end(), lowered(value)) != words.end();
    };
    if (is({"true", "yes", "on", "1"})) return true;
    if (is({"false", "no", "off", "0"})) return false;
    usageError("--" + name + ": expected true or false, got '" + value + "'");
}

/// Adds what was parsed; what is there already stays.
void add(Verb verb, const po::parsed_options& parsed, GivenOptions& given,
         std::vector<std::string>& inputs)
{
    GivenOptions fresh;
    for (const auto& option : parsed.options) {
        const std::string& name = option.string_key;
        if (name == "input") {
            inputs.insert(inputs.end(), option.value.begin(), option.value.end());
            continue;
        }
        const Option* known = findOption(verb, name);
        if (!known && std::find(std::begin(texts), std::end(texts), name) == std::end(texts))
            refuse(verb, "--" + name);
        if (!(known && known->value) && !option.value.empty() && !isOn(name, option.value[0]))
            continue; // a switch that is off
        std::vector<std::string>& values = fresh[known ? known->name : name];
        if (known && known->value && !known->repeats() && !values.empty())
            usageError("--" + name + " is given twice");
        if (known && known->value) {
            if (option.value.empty() || option.value[0].empty()) missingValue(*known);
            values.insert(values.end(), option.value.begin(), option.value.end());
        }
    }
    for (auto& [name, values] : fresh) given.emplace(name, std::move(values));
}

void readConfig(const std::string& path, const po::options_description& all, CommandLine& call)
{
    const auto limit = call.given.find("max-input");
    if (limit != call.given.end()) findOption(call.verb, "max-input")->set(call, limit->second);
    const std::string content = withoutMark(loadBytes(path, call.atoms.limits.maxInput));
    constexpr std::size_t longest = std::size_t{1} << 20;
    for (LineReader lines(content); lines.next();)
        if (lines.line().size() > longest)
            throw Error(ErrorKind::Input, "--config " + path + ": line " +
                                              std::to_string(lines.number()) +
                                              ": expected at most 1 MiB");
    std::istringstream text(content);
    try {
        const auto options = po::parse_config_file(text, all);
        for (const auto& option : options.options)
            if (option.string_key == "config" ||
                std::count(std::begin(texts), std::end(texts), option.string_key) > 0)
                usageError("'" + option.string_key + "' is for the command line alone");
        add(call.verb, options, call.given, call.inputs);
    } catch (const po::error& e) {
        usageError("--config " + path + ": " + e.what());
    } catch (const Error& e) {
        throw Error(e, "--config " + path + ": " + e.what());
    }
}

/// The text of "help WORDS": verbs, a verb, a group of options or an option.
std::string helpOn(std::vector<std::string> words)
{
    if (words.empty()) return overview();
    const std::string first = lowered(words[0]);
    const std::vector<std::string> known = verbs();
    if (std::count(known.begin(), known.end(), first) == 0) {
        if (words.size() > 1) usageError("help: expected one word, got '" + words[1] + "' too");
        if (first == "options") return helpText(Build, true);
        const std::string text = topicText(first);
        if (!text.empty()) return text;
        std::vector<std::string> topics = topicWords();
        topics.insert(topics.end(), known.begin(), known.end());
        usageError("help: expected a verb, a group of options or an option, got '" + words[0] +
                   "'" + didYouMean(words[0], topics));
    }
    if (asksForVerbs(words, true)) return overview(first);
    const Verb verb = takeVerb(words);
    if (!words.empty()) usageError("help: expected one verb, got '" + words[0] + "' too");
    return helpText(verb, false);
}

/// A word as a shell takes it.
std::string quoted(const std::string& word)
{
    const char* plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./=:,@%+-";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string all = "'";
    for (const char letter : word)
        all += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return all + "'";
}

} // namespace

void setOptions(const GivenOptions& given, CommandLine& call)
{
    call.given.clear();
    for (const auto& [name, values] : given) {
        const Option* option = findOption(call.verb, name);
        call.given[option ? option->name : name] = values;
    }
    for (const OptionGroup& group : optionTable()) {
        for (const Option& option : group.options) {
            if (!(option.verbs & call.verb)) continue;
            const auto found = call.given.find(option.name);
            if (found == call.given.end()) continue;
            if (option.value && found->second.empty()) // in a plan
                usageError(std::string("--") + option.name + ": expected a value, got none");
            option.set(call, found->second);
        }
    }
    call.progress = call.progress && !call.quiet;
}

Parsed parse(int argc, const char* const* argv)
{
    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    CommandLine call;
    for (int i = 0; i < argc; ++i) call.command += (i ? " " : "") + quoted(argv[i]);
    if (words.size() == 1) {
        for (const Page& page : pages)
            if (words[0] == page.option) return {{}, page.text()};
    }
    if (!words.empty() && lowered(words[0]) == "help") {
        words.erase(words.begin());
        return {{}, helpOn(std::move(words))};
    }
    if (asksForVerbs(words, false)) return {{}, overview(lowered(words[0]))};
    call.verb = takeVerb(words);

    const po::options_description all = describe(call.verb);
    po::positional_options_description positional;
    positional.add("input", -1);
    // Without guessing: --vox must not come to mean something else when an option is added.
    const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
    try {
        add(call.verb,
            po::command_line_parser(words).options(all).positional(positional).style(style).run(),
            call.given, call.inputs);
    } catch (const po::unknown_option& e) {
        refuse(call.verb, e.get_option_name());
    } catch (const po::error_with_option_name& e) {
        refuseValue(call.verb, e);
    } catch (const po::error& e) {
        usageError(e.what());
    }
    if (call.has("help-all")) return {{}, helpText(call.verb, true)};
    if (call.has("help")) return {{}, helpText(call.verb, false)};
    if (call.has("version")) return {{}, "vdb_molsurf " MOLSURF_VERSION "\n"};
    if (call.has("list-radii")) return {{}, describeRadii()};
    if (call.has("config")) readConfig(call.given["config"].back(), all, call);
    setOptions(GivenOptions(call.given), call);
    checkPairs(call);
    infoOf(call.verb).complete(call);
    checkPairs(call); // with its files
    return {std::move(call), ""};
}

} // namespace molsurf::tool
