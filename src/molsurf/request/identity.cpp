// SPDX-License-Identifier: MPL-2.0
#include "molsurf/request/identity.h"

#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/sha256.h"

namespace molsurf
{

std::string optionsLine(const std::vector<GivenOption>& given)
{
    std::string line, hashes;
    for (const GivenOption& option : given) {
        line += (line.empty() ? "--" : " --") + option.name;
        for (const std::string& value : option.values) line += " " + value;
        for (const std::string& path : option.files)
            if (!readsOnce(path))
                hashes += " (" + path + ": " + sha256OfFile(path).substr(0, 16) + ")";
    }
    return line + hashes;
}

std::string identityOf(const std::string& optionsLine)
{
    return sha256OfText(MOLSURF_VERSION "\n" + optionsLine);
}

std::string inputSha256(const SelectionRecord& record)
{
    return record.isFile ? sha256OfInput(record.input, ReadLimits().maxInput) : "";
}

} // namespace molsurf
