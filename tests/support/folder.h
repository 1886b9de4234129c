// SPDX-License-Identifier: MPL-2.0
#pragma once

#include "molsurf/show/io/output_file.h"

#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace molsurf::test
{

/// A folder of its own for one test; gone at the end.
class Folder
{
public:
    Folder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "molsurf-XXXXXX").string();
        path_ = mkdtemp(name.data());
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::string operator/(const std::string& name) const { return (path_ / name).string(); }

    /// Names of all files in it, sorted.
    std::vector<std::string> names() const
    {
        std::vector<std::string> all;
        for (const auto& entry : std::filesystem::directory_iterator(path_))
            all.push_back(entry.path().filename().string());
        std::sort(all.begin(), all.end());
        return all;
    }

private:
    std::filesystem::path path_;
};

/// The content of a file.
inline std::string contentOf(const std::string& path)
{
    std::ifstream file(path, std::ios_base::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// The bytes that `write(OutputFile&)` leaves in a file.
template<typename Write>
std::string written(const Write& write)
{
    const Folder folder;
    OutputFile file(folder / "a", false);
    write(file);
    file.commit();
    return contentOf(folder / "a");
}

} // namespace molsurf::test
