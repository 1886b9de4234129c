// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/style.h"

#include "molsurf/kernel/core/strings.h"

namespace molsurf
{

const std::vector<PictureStyle>& styleTable()
{
    static const std::vector<PictureStyle> all = {
        {"soft", "", 0.36f, 0.8f, 0.07f, 0.85f, 0.1f, 0.08f, 16.0f, 1.6f, 0.0f, 0.8f},
        {"glossy", "with highlights", 0.24f, 0.9f, 0.08f, 0.9f, 0.05f, 0.8f, 44.0f, 0.0f, 0.0f,
         0.0f},
        {"outline", "as drawn with a pen", 0.86f, 0.16f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 3.2f, 2.0f,
         0.95f},
        {"flat", "the colours as they are", 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 1.6f, 0.0f,
         0.8f}};
    return all;
}

const PictureStyle* findStyle(const std::string& word)
{
    for (const PictureStyle& style : styleTable())
        if (lowered(word) == style.word) return &style;
    return nullptr;
}

} // namespace molsurf
