// SPDX-License-Identifier: MPL-2.0
#include "input_files.h"

#include "cli/option_table.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/archive.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

namespace molsurf::tool
{

namespace
{

/// Whether a name is that of an entry of the Protein Data Bank: 1crn, or pdb_00001crn.
bool isEntry(const std::string& name)
{
    const std::string small = lowered(name);
    const bool longName = small.size() == 12 && small.compare(0, 4, "pdb_") == 0;
    const std::string id = longName ? small.substr(4) : small;
    const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
    return (longName || (id.size() == 4 && id[0] >= '1' && id[0] <= '9')) &&
           std::all_of(id.begin(), id.end(), isLetter);
}

} // namespace

void failIfNoFile(const std::string& path)
{
    if (path == "-" || memberOf(path)) return;
    std::error_code problem;
    const auto status = std::filesystem::status(path, problem);
    if (std::filesystem::is_directory(status))
        throw Error(ErrorKind::Input, path +
                                          ": is a folder, expected a file [hint: vdb_molsurf "
                                          "batch " +
                                          path + " -O DIR reads all structures in it]");
    if (status.type() != std::filesystem::file_type::not_found) return;
    std::string hint;
    const std::size_t scheme = path.find("://");
    if (scheme != std::string::npos && path.rfind("http", 0) != 0 && path.rfind("ftp", 0) != 0)
        hint = " [hint: it is an address; aws s3 cp ADDRESS - | vdb_molsurf - reads it, or gcloud "
               "storage cat or the like in place of aws]";
    else if (scheme != std::string::npos)
        hint = " [hint: it is an address; curl -LO " + path + " loads the file first]";
    else if (isEntry(path))
        hint = " [hint: it is the name of an entry of the Protein Data Bank; curl -LO "
               "https://files.rcsb.org/download/" +
               path + ".cif.gz loads the file first]";
    throw Error(ErrorKind::Input, path + ": cannot be opened: No such file or directory" + hint);
}

void failIfStream(const std::string& path, const std::string& expected)
{
    if (readsOnce(path))
        throw Error(ErrorKind::Input,
                    displayName(path) + ": is a pipe or a device, expected " + expected);
}

InputFiles::InputFiles(const CommandLine& call)
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
