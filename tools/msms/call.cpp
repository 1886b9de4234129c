// SPDX-License-Identifier: MPL-2.0
#include "msms/call.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <functional>
#include <set>

namespace molsurf::msms
{

namespace
{

/// The value of an option that takes one.
using Value = const std::string&;

struct Option {
    const char* name;
    const char* value; ///< in the help; "": it takes none
    const char* help;
    std::function<void(MsmsCall&, Value)> set;
};

[[noreturn]] void fail(const std::string& option, const std::string& what)
{
    throw Error(ErrorKind::Usage, "-" + option + ": " + what);
}

double number(const char* option, Value text, double least, bool leastToo, double most)
{
    double value = 0.0;
    const bool read = parseNumber(text, value);
    if (read && (leastToo ? value >= least : value > least) && value <= most) return value;
    fail(option, formatted("expected a number %s %g, at most %g",
                           leastToo ? "of at least" : "above", least, most) +
                     ", got " + inQuotes(text));
}

/// An option of MSMS that would give something else than this program can.
std::function<void(MsmsCall&, Value)> refused(const char* option, const char* why)
{
    return [=](MsmsCall&, Value) { fail(option, why); };
}

std::function<void(MsmsCall&, Value)> pointless(const char* option, const char* why)
{
    return [=](MsmsCall& call, Value) {
        call.warnings.push_back(std::string("-") + option + " changes nothing: " + why);
    };
}

const char* const synopsis = "vdb_molsurf_msms -if filename [options]";
const char* const about =
    "Computes the solvent-excluded surface of spheres. It takes the options of MSMS 2.6 and "
    "writes\n"
    "its files, so it can stand in for it under the name msms. Options may be cut short: -probe,\n"
    "-all. Defaults are in brackets. With --dry-run it says what it takes, and stops.\n";
const char* const statuses =
    "Exit status: 0 done, 1 failed, 2 wrong usage, 3 a result failed its own "
    "checks, 75 failed; try again later, 130 interrupted.";
const char* const noServer = "expected a file by -if, this program is no server";

/// The options of MSMS, in its order.
const std::vector<Option>& options()
{
    static const std::vector<Option> all = {
        {"probe_radius", "float", "radius of the probe, 0 or 0.2 to 100 [1.5]",
         [](MsmsCall& c, Value v) {
             c.probe = number("probe_radius", v, 0.0, true, 100.0);
             if (c.probe > 0.0 && c.probe < leastProbe)
                 fail("probe_radius",
                      "expected a number of at least 0.2, or 0, got " + inQuotes(v));
         }},
        {"density", "float", "vertices an Å^2, 0.1 to 400 [1.0]",
         [](MsmsCall& c, Value v) {
             c.density = number("density", v, leastDensity, true, largestDensity);
         }},
        {"hdensity", "float", "has no effect: all of a surface has -density [3.0]",
         [](MsmsCall& c, Value v) { c.highDensity = number("hdensity", v, 0.0, false, 1e6); }},
        {"surface", "tses", "the triangulated surface, the only one [tses]",
         [](MsmsCall&, Value v) {
             if (v != "tses")
                 fail("surface", "expected tses, the triangulated surface, got " + inQuotes(v));
         }},
        {"no_area", "", "prints no areas", [](MsmsCall& c, Value) { c.totals = false; }},
        {"socketName", "name", "is refused: this program is no server",
         refused("socketName", noServer)},
        {"socketPort", "number", "is refused, too", refused("socketPort", noServer)},
        {"xdr", "", "is refused, too", refused("xdr", noServer)},
        {"sinetd", "", "is refused, too", refused("sinetd", noServer)},
        {"noh", "", "leaves out spheres of radius 1.2",
         [](MsmsCall& c, Value) { c.hydrogens = false; }},
        {"no_rest_on_pbr", "", "has no effect: radii are never changed",
         pointless("no_rest_on_pbr", "no surface is begun again with other radii")},
        {"no_rest", "", "has no effect, too",
         pointless("no_rest", "no surface is begun again with other radii")},
        {"if", "filename", "spheres: x y z radius [number] [name] on each line",
         [](MsmsCall& c, Value v) { c.input = v; }},
        {"of", "filename", "writes the surface to filename.vert and filename.face",
         [](MsmsCall& c, Value v) { c.surface = v; }},
        {"af", "filename", "writes the areas of the spheres to filename.area",
         [](MsmsCall& c, Value v) { c.areas = v; }},
        {"no_header", "", "writes surfaces without their first three lines",
         [](MsmsCall& c, Value) { c.header = false; }},
        {"free_vertices", "", "has no effect: single spheres are components as others",
         pointless("free_vertices", "a sphere apart is a component as others are "
                                    "[hint: -all_components]")},
        {"all_components", "", "computes all components, and not the outer one alone",
         [](MsmsCall& c, Value) { c.all = true; }},
        {"one_cavity", "#atoms at1 [at2] [at3]", "is refused: take one of -all_components",
         refused("one_cavity", "cannot choose a cavity by its atoms [hint: -all_components writes "
                               "each to a file of its own]")},
    };
    return all;
}

/// The option that a word means.
const Option& optionOf(const std::string& word)
{
    const std::string name = word.substr(1);
    std::vector<const Option*> found;
    std::vector<std::string> names;
    for (const Option& option : options()) {
        if (name == option.name) return option;
        if (name.empty() || std::string(option.name).compare(0, name.size(), name) != 0) continue;
        found.push_back(&option);
        names.push_back(std::string("-") + option.name);
    }
    if (found.size() == 1) return *found[0];
    throw Error(ErrorKind::Usage,
                inQuotes(word) + ": " +
                    (found.empty() ? "expected an option of MSMS [hint: -h lists them]"
                                   : "it may be " + joined(names) + " [hint: write more of it]"));
}

} // namespace

MsmsCall parseMsms(int argc, const char* const* argv)
{
    MsmsCall call;
    std::set<std::string> given;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "-h" || word == "-help" || word == "--help") {
            call.help = true;
            return call;
        }
        if (word == "--man") {
            call.manual = true;
            return call;
        }
        if (word == "--dry-run") {
            call.dryRun = true;
            continue;
        }
        if (word == "--version") {
            call.version = true;
            return call;
        }
        if (word.empty() || word[0] != '-')
            throw Error(ErrorKind::Usage, inQuotes(word) + ": expected an option [hint: the file "
                                                           "of spheres follows -if]");
        const Option& option = optionOf(word);
        if (!given.insert(option.name).second) fail(option.name, "expected once, got it again");
        std::string value;
        // A refused option may take any number of values.
        const bool takes = option.value[0] != '\0' && option.value[0] != '#';
        if (takes) {
            if (++i == argc) fail(option.name, std::string("expected a value: ") + option.value);
            value = argv[i];
            if (value.empty()) fail(option.name, "expected a value, got an empty one");
        }
        option.set(call, value);
    }
    if (call.input.empty()) fail("if", "expected the file of spheres [hint: -h lists the options]");
    if (!call.totals && !call.areas.empty()) fail("no_area", "expected no -af with it");
    if (given.count("hdensity") && call.highDensity != call.density) {
        call.warnings.push_back(
            formatted("-hdensity %g changes nothing: all of the surface has -density %g",
                      call.highDensity, call.density));
    }
    return call;
}

std::string msmsHelp()
{
    std::string text = std::string("Usage: ") + synopsis + "\n\n" + about + "\n";
    for (const Option& option : options()) {
        std::string left = std::string("  -") + option.name;
        if (option.value[0] != '\0') left += std::string(" ") + option.value;
        constexpr std::size_t column = 26;
        if (left.size() >= column) left += "\n" + std::string(column, ' ');
        left.resize(std::max(left.size(), column), ' ');
        text += left + option.help + "\n";
    }
    return text + "\n" + statuses + "\n";
}

std::string msmsManual()
{
    const auto escaped = [](const std::string& plain) {
        std::string out;
        for (const char c : plain) out += c == '-' ? std::string("\\-") : std::string(1, c);
        return out;
    };
    std::string text = std::string(".TH VDB_MOLSURF_MSMS 1 \"\" \"vdb_molsurf ") + MOLSURF_VERSION +
                       "\"\n.SH NAME\n" + escaped("vdb_molsurf_msms - stands in for MSMS 2.6") +
                       "\n.SH SYNOPSIS\n" + escaped(synopsis) + "\n.SH DESCRIPTION\n" +
                       escaped(about) + ".SH OPTIONS\n";
    for (const Option& option : options())
        text += ".TP\n\\fB" + escaped(std::string("-") + option.name) + "\\fR \\fI" + option.value +
                "\\fR\n" + escaped(option.help) + "\n";
    return text + ".SH EXIT STATUS\n" + escaped(statuses) + "\n";
}

} // namespace molsurf::msms
