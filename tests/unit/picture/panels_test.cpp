// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/panels.h"

#include <gtest/gtest.h>

namespace molsurf
{
namespace
{

TEST(Panels, UpToFourAreInARow)
{
    const int columns[] = {1, 2, 3, 4, 3, 3, 3, 3, 3, 4};
    for (std::size_t count = 1; count <= 10; ++count) {
        EXPECT_EQ(panelColumns(count), columns[count - 1]) << count;
        EXPECT_EQ(panelWidth(count, 1200), 1200 / columns[count - 1]) << count;
    }
}

} // namespace
} // namespace molsurf
