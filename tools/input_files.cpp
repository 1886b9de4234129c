// SPDX-License-Identifier: MPL-2.0
#include "input_files.h"

#include "cli/option_table.h"

#include "molsurf/error.h"

#include <sys/stat.h>
#include <unistd.h>

namespace molsurf::tool
{

InputFiles::InputFiles(const Call& call)
{
    for (const std::string& path : call.inputs) add(path);
    add(call.input);
    for (const OptionFile& file : filesOf(call.verb, call.given)) add(file.path);
}

void InputFiles::add(const std::string& path)
{
    struct stat info;
    const int missing = path == "-" ? fstat(STDIN_FILENO, &info) : stat(path.c_str(), &info);
    if (missing == 0 && S_ISREG(info.st_mode))
        names_.emplace(std::pair(info.st_dev, info.st_ino), path == "-" ? "standard input" : path);
}

void InputFiles::refuse(const std::string& output) const
{
    struct stat info;
    if (output == "-" || stat(output.c_str(), &info) != 0) return;
    const auto found = names_.find({info.st_dev, info.st_ino});
    if (found != names_.end())
        throw Error(ErrorKind::Output, "cannot write " + output + ": it is " + found->second +
                                           ", which is read [hint: another name]");
}

} // namespace molsurf::tool
