// SPDX-License-Identifier: MPL-2.0
#include "cli/note_rule.h"

#include "molsurf/core/words.h"
#include "molsurf/error.h"
#include "molsurf/structure/text_fields.h"

namespace molsurf::tool
{

NoteRule parseLabel(const std::string& text)
{
    const std::size_t equals = text.rfind('=');
    const bool named = equals != std::string::npos;
    NoteRule rule{{std::string(trimmed(text.substr(0, equals)))}, ""};
    if (named) rule.text = std::string(trimmed(text.substr(equals + 1)));
    if (rule.selects[0].empty() || (named && rule.text.empty()))
        throw Error(ErrorKind::Usage,
                    "--label: expected SELECTION or SELECTION=TEXT, got " + inQuotes(text));
    return rule;
}

NoteRule parseRuler(const std::string& text)
{
    const std::size_t dots = text.find("..");
    const std::string from(trimmed(text.substr(0, dots)));
    const std::string to(dots == std::string::npos ? "" : trimmed(text.substr(dots + 2)));
    if (from.empty() || to.empty())
        throw Error(ErrorKind::Usage,
                    "--ruler: expected SELECTION..SELECTION, got " + inQuotes(text));
    return {{from, to}, ""};
}

} // namespace molsurf::tool
