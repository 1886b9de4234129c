// SPDX-License-Identifier: MPL-2.0
#include "molsurf/request/request_table.h"

namespace molsurf
{

const std::vector<OptionRow<Request>>& requestTable()
{
    static const std::vector<OptionRow<Request>> all = [] {
        std::vector<OptionRow<Request>> rows;
        for (const Setting& row : settingTable()) rows.push_back(row);
        for (const FileSetting& row : fileSettings()) rows.push_back(row);
        for (const PictureSetting& row : pictureSettings()) rows.push_back(row);
        return rows;
    }();
    return all;
}

} // namespace molsurf
