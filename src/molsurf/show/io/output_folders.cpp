// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/output_folders.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/transient_error.h"

#include <algorithm>
#include <filesystem>
#include <functional>

namespace molsurf
{

namespace fs = std::filesystem;

MadeFolders::~MadeFolders()
{
    std::error_code ignored;
    for (const std::string& folder : made_) fs::remove(folder, ignored);
}

void MadeFolders::make(const std::string& folder)
{
    std::vector<std::string> missing; // the innermost first
    std::error_code problem;
    for (fs::path path = folder; !path.empty() && !fs::exists(path, problem);
         path = path.parent_path())
        missing.push_back(path.string());
    if (missing.empty()) return;
    made_.insert(made_.end(), missing.begin(), missing.end());
    std::sort(made_.begin(), made_.end(), std::greater<>());
    fs::create_directories(folder, problem);
    if (problem)
        throw Error(ErrorKind::Output,
                    "cannot make the folder " + folder + ": " + problem.message(),
                    mayPass(problem.value()));
}

} // namespace molsurf
