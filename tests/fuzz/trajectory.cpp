// SPDX-License-Identifier: MPL-2.0
/// Trajectories: .dcd and .xtc, told by their content.
#include "fuzz.h"

#include "molsurf/structure/trajectory.h"

#include <algorithm>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace molsurf;
    const fuzz::InputFile file(data, size, ".dcd");
    fuzz::tryTo([&] {
        const auto trajectory = openTrajectory(file.path());
        const std::size_t frames = std::min<std::size_t>(trajectory->frames(), 4);
        for (std::size_t i = 0; i < frames; ++i) trajectory->read(i);
    });
    return 0;
}
