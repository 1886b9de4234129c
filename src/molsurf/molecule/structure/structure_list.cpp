// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/structure_list.h"

#include "molsurf/error.h"
#include "molsurf/molecule/structure/archive.h"
#include "molsurf/molecule/structure/detect_format.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <filesystem>

namespace molsurf
{

namespace
{

/// The structures of a folder, by name.
std::vector<std::string> structuresIn(const std::string& folder)
{
    std::vector<std::string> inputs;
    for (const std::filesystem::directory_entry& entry :
         std::filesystem::directory_iterator(folder)) {
        if (entry.is_regular_file() && hasStructureEnding(entry.path()))
            inputs.push_back(entry.path().string());
    }
    std::sort(inputs.begin(), inputs.end());
    if (inputs.empty()) throw Error(ErrorKind::Input, folder + ": no structures in this folder");
    return inputs;
}

/// The structures of an archive, in its order.
std::vector<std::string> structuresInArchive(const std::string& path)
{
    std::vector<std::string> inputs;
    for (std::string& member : membersIn(path))
        if (hasStructureEnding(member)) inputs.push_back(std::move(member));
    if (inputs.empty()) throw Error(ErrorKind::Input, path + ": no structures in this archive");
    return inputs;
}

} // namespace

std::vector<std::string> readStructureList(const std::string& path, std::size_t maxBytes)
{
    std::error_code ignored;
    if (path != "-") {
        if (std::filesystem::is_directory(path, ignored)) return structuresIn(path);
        if (isArchiveName(path)) return structuresInArchive(path);
        if (hasStructureEnding(path))
            throw Error(
                ErrorKind::Input,
                path +
                    ": it is a structure, expected a list of them or a folder [hint: vdb_molsurf " +
                    path + " -o FILE]");
    }
    const std::string text = loadBytes(path, maxBytes);
    std::vector<std::string> inputs;
    for (LineReader lines(text); lines.next();) {
        const std::string_view name = trimmed(lines.line());
        if (name.empty() || name[0] == '#') continue;
        constexpr std::size_t longest = 4096; // of the system's paths
        if (name.size() > longest)
            failAtLine(path, lines,
                       "expected the name of a structure file, got " + std::to_string(name.size()) +
                           " characters");
        inputs.emplace_back(name);
    }
    if (inputs.empty())
        throw Error(ErrorKind::Input, path + ": expected the name of a structure file a line");
    return inputs;
}

} // namespace molsurf
