// SPDX-License-Identifier: MPL-2.0
#include "outputs.h"
#include "verbs.h"

#include "molsurf/color/palette.h"
#include "molsurf/structure/read_structure.h"

#include <malloc.h>

namespace molsurf::tool
{

DescribedBalls readBalls(const std::string& path, const Options& options, Terminal& terminal)
{
    terminal.update("read", 0.0);
    const Structure structure = readStructure(path);
    stopIfAsked();
    BallSelection balls = selectBalls(structure, options.atoms, probeOf(options), terminal);
    std::string description = describeSelection(structure, balls);
    return {std::move(balls), std::move(description)};
}

BallSelection readBalls(const Call& call, Terminal& terminal, Report& report)
{
    const Clock::time_point start = Clock::now();
    auto [balls, description] = readBalls(call.input, call.options, terminal);
    malloc_trim(0); // what the parser has left is in pieces too small for the fields
    report.warnings = call.warnings;
    report.warnings.insert(report.warnings.end(), balls.warnings.begin(), balls.warnings.end());
    report.seconds.emplace_back("read", secondsSince(start));
    terminal.erase();
    if (!call.quiet) {
        say(description);
        for (const std::string& warning : report.warnings) say("warning: " + warning);
    }
    stopIfAsked();
    return std::move(balls);
}

void colorBalls(const Options& options, Terminal& terminal, BallSelection& balls)
{
    if (options.color != ColorBy::Nothing)
        balls.colors = ballColors(balls, options.color, terminal);
}

} // namespace molsurf::tool
