// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/commit.h"

#include "molsurf/error.h"
#include "molsurf/io/temporary_file.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>

namespace molsurf
{

namespace fs = std::filesystem;

namespace
{

// An entry of a record is a letter, a path as seen from the record's folder, and a zero.
constexpr char newFile = '+', replacement = '=', seeFolder = '@';

constexpr const char *recordStart = ".vdb_molsurf.", *recordEnd = ".commit";

std::string recordName(const std::string& maker)
{
    return recordStart + maker + recordEnd;
}

/// The maker of a record of such a name; empty for other names.
std::string makerOfRecord(const std::string& name)
{
    const std::size_t start = std::strlen(recordStart), end = std::strlen(recordEnd);
    if (name.size() <= start + end) return "";
    const std::string maker = name.substr(start, name.size() - start - end);
    return name == recordName(maker) ? maker : "";
}

fs::path canonicalFolder(const OutputFile& file)
{
    std::error_code problem;
    fs::path folder = fs::canonical(folderOf(file.path()), problem);
    if (!problem) return folder;
    throw Error(ErrorKind::Output, "cannot write " + file.path() + ": " + problem.message());
}

/// One record of this process, which goes at the end.
class Record
{
public:
    Record(const fs::path& folder, const std::string& entries)
        : path_(folder / recordName(ownMaker())), file_(path_, true)
    {
        file_.write(entries.data(), entries.size());
        file_.commit();
    }
    ~Record() { unlink(path_.c_str()); }
    Record(const Record&) = delete;
    Record& operator=(const Record&) = delete;

private:
    std::string path_;
    OutputFile file_; // locked as long as it is open
};

/// All records of a commit. The first that goes is the one that decides.
class Records
{
public:
    Records(const std::vector<OutputFile*>& files, const std::vector<fs::path>& folders)
    {
        const fs::path& first = folders[0];
        for (const fs::path& folder : folders)
            if (folder != first)
                add(folder, seeFolder + first.lexically_relative(folder).string() + '\0');
        std::string entries;
        for (const OutputFile* file : files) {
            const fs::path target = canonicalFolder(*file) / fs::path(file->target()).filename();
            entries += (file->replaces() ? replacement : newFile) +
                       target.lexically_relative(first).string() + '\0';
        }
        syncFolder(first.string());
        add(first, entries);
    }
    ~Records()
    {
        while (!all_.empty()) all_.pop_back();
    }
    Records(const Records&) = delete;
    Records& operator=(const Records&) = delete;

private:
    void add(const fs::path& folder, const std::string& entries)
    {
        all_.push_back(std::make_unique<Record>(folder, entries));
    }
    std::vector<std::unique_ptr<Record>> all_;
};

/// The folders of files, each once, in their order.
std::vector<fs::path> foldersOf(const std::vector<OutputFile*>& files)
{
    std::vector<fs::path> folders;
    for (const OutputFile* file : files) {
        const fs::path folder = canonicalFolder(*file);
        if (std::count(folders.begin(), folders.end(), folder) == 0) folders.push_back(folder);
    }
    return folders;
}

/// Does what a record says, and removes it.
void finish(const fs::path& folder, const std::string& maker)
{
    const fs::path path = folder / recordName(maker);
    const int lock = lockAbandoned(path.string());
    if (lock < 0) return;
    bool decided = true; // not if another process is finishing the record in the other folder
    std::ifstream record(path, std::ios_base::binary);
    for (std::string entry; std::getline(record, entry, '\0');) {
        if (entry.empty()) continue;
        const fs::path place = folder / entry.substr(1);
        if (entry[0] == seeFolder) {
            recover(place.string());
            decided = access((place / recordName(maker)).c_str(), F_OK) != 0;
            continue;
        }
        const std::string temporary = temporaryName(place.string(), maker);
        const bool replace = entry[0] == replacement;
        if (moveFile(temporary, place.string(), replace)) {
            syncFolder(place.parent_path().string());
            continue;
        }
        // It is there already, or somebody else has made another one.
        if (errno == ENOENT || errno == EEXIST) continue;
        const int reason = errno;
        close(lock);
        throw Error(ErrorKind::Output,
                    "cannot rename " + temporary +
                        ", which a killed run has left complete: " + std::strerror(reason));
    }
    if (decided) unlink(path.c_str());
    close(lock);
}

} // namespace

void commit(const std::vector<OutputFile*>& all)
{
    std::vector<OutputFile*> files;
    for (OutputFile* file : all) {
        file->finish();
        if (file->seekable()) files.push_back(file);
    }
    if (files.empty()) return;
    const std::vector<fs::path> folders = foldersOf(files);
    static std::mutex one; // a process has one record in a folder
    std::unique_lock<std::mutex> turn(one, std::defer_lock);
    std::unique_ptr<const Records> records;
    if (files.size() > 1) {
        turn.lock();
        for (const OutputFile* file : files) checkWritable(file->path(), file->replaces());
        records = std::make_unique<const Records>(files, folders);
    }
    std::size_t placed = 0;
    try {
        for (; placed < files.size(); ++placed) files[placed]->place();
    } catch (...) {
        while (placed > 0) files[--placed]->takeBack();
        throw;
    }
    for (const fs::path& folder : folders) syncFolder(folder.string());
}

void recover(const std::string& folder)
{
    std::vector<std::string> names;
    std::error_code problem;
    fs::directory_iterator entry(folder, problem);
    for (; !problem && entry != fs::directory_iterator(); entry.increment(problem)) {
        std::string name = entry->path().filename().string();
        if (name.front() == '.') names.push_back(std::move(name));
    }
    const fs::path place = folder;
    for (const std::string& name : names) {
        const std::string maker = makerOfRecord(name);
        if (!maker.empty()) finish(place, maker);
    }
    for (const std::string& name : names) {
        const std::string maker = makerOf(name);
        const int lock = maker.empty() ? -1 : lockAbandoned((place / name).string());
        if (lock < 0) continue;
        if (access((place / recordName(maker)).c_str(), F_OK) != 0)
            fs::remove_all(place / name, problem);
        close(lock);
    }
}

} // namespace molsurf
