// SPDX-License-Identifier: MPL-2.0
/// @file
/// Trajectories, DCD and XTC.

#include "input.h"

#include "molsurf/molecule/structure/trajectory.h"

#include <algorithm>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace molsurf;
    fuzz::expectErrorAtMost([&] {
        const auto trajectory = openTrajectory(fuzz::inputFile(data, size, ".dcd"));
        constexpr std::size_t most = 4;
        for (std::size_t i = 0; i < std::min(trajectory->frames(), most); ++i) trajectory->read(i);
        trajectory->read(trajectory->frames() - 1);
    });
    return 0;
}
