// SPDX-License-Identifier: MPL-2.0
#include "cli.h"
#include "cli_table.h"

#include <charconv>
#include <cmath>

namespace molsurf::tool
{

const std::vector<Group>& planGroups()
{
    static const std::vector<Group> all = {
        {"Output",
         {{"output,o", "FILE", "the manifest, a name that ends in .json", ""},
          {"force", nullptr, "replace it", ""}}},
        {"Bricks",
         {{"bricks", "N", "how many, about as large each", ""},
          {"memory", "SIZE",
           "or as many as it takes for each to need no more,\n"
           "such as 500M or 4G",
           ""}}}};
    return all;
}

const std::vector<Group>& brickGroups()
{
    static const std::vector<Group> all = {
        {"Output", {{"force", nullptr, "do it again if it is done", ""}}}};
    return all;
}

const std::vector<Group>& mergeGroups()
{
    static const std::vector<Group> all = {
        {"Output",
         {{"output,o", "FILE",
           "file to write; repeats; the extension says what:\n"
           ".vdb level set and fields, .ply mesh, .json report",
           "", true},
          {"format", "WORD", "what -o - writes: vdb, ply or json", ""},
          {"force", nullptr, "replace existing files", ""}}}};
    return all;
}

std::size_t parseSize(const std::string& text)
{
    double number = 0.0;
    const char* end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data(), end, number);
    if (problem != std::errc() || !std::isfinite(number) || number <= 0.0) return 0;
    const std::string unit(stop, end);
    const std::string letters = "KMGT";
    if (unit.empty()) return std::size_t(number);
    const std::size_t place = letters.find(unit[0]);
    const std::string rest = unit.substr(1);
    if (place == std::string::npos || !(rest.empty() || rest == "B" || rest == "iB")) return 0;
    return std::size_t(number * std::pow(1024.0, double(place + 1)));
}

namespace
{

std::string tableOf(const std::vector<Group>& groups)
{
    std::string text;
    for (const Group& group : groups) {
        text += std::string("\n") + group.title + "\n";
        for (const Entry& entry : group.entries) text += helpLine(entry);
    }
    return text;
}

const char* const runOptions =
    "\n"
    "Also --threads, --quiet, --verbose and --no-progress of vdb_molsurf --help.\n";

} // namespace

std::string planHelpText()
{
    return "vdb_molsurf plan INPUT -o plan.json (--bricks N | --memory SIZE) [options]\n"
           "\n"
           "Cuts the space about a molecule into bricks that can be computed one by one, on one\n"
           "machine or many, and says what each of them is expected to take. Writes a manifest\n"
           "for the verbs brick and merge, which refuse an INPUT that has changed since.\n" +
           tableOf(planGroups()) +
           "\n"
           "All other options are those of vdb_molsurf --help, but for pictures and for what "
           "needs\n"
           "the whole molecule at once. The number of steps is fixed by the plan [--steps 16].\n";
}

std::string brickHelpText()
{
    return "vdb_molsurf brick plan.json K [options]\n"
           "\n"
           "Computes brick K of a plan, from 1 to the number of bricks, and writes it beside the\n"
           "manifest, as plan.K.brick. A brick that is there already is not done again.\n" +
           tableOf(brickGroups()) + runOptions;
}

std::string mergeHelpText()
{
    return "vdb_molsurf merge plan.json -o FILE [-o FILE ...] [options]\n"
           "\n"
           "Joins the bricks of a plan, all of which have to be there, to one level set and one\n"
           "closed mesh. Holds neither in memory.\n" +
           tableOf(mergeGroups()) + runOptions +
           "\n"
           "Exit status: 0 done, 1 failed, 2 wrong usage, 3 not converged (files are written),\n"
           "130 interrupted.\n";
}

} // namespace molsurf::tool
