// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/io/commit.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/transient_error.h"
#include "molsurf/show/io/temporary_file.h"

#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mutex>
#include <sstream>
#include <utility>

namespace molsurf
{

namespace fs = std::filesystem;

namespace
{

// An entry of a record is a letter, a name, and a zero. The name is that of a file in the record's
// folder, or the path of another folder as seen from there: the first one, or one of the others.
constexpr char newFile = '+', replacement = '=', firstFolder = '@', otherFolder = '&';

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
    return name == recordName(maker) && isMaker(maker) ? maker : "";
}

fs::path canonicalFolder(const OutputFile& file)
{
    std::error_code problem;
    fs::path folder = fs::canonical(folderOf(file.path()), problem);
    if (!problem) return folder;
    throw Error(ErrorKind::Output, "cannot write " + file.path() + ": " + problem.message(),
                mayPass(problem.value()));
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
    ~Record()
    {
        if (!left_) unlink(path_.c_str());
    }
    void leave() { left_ = true; }
    Record(const Record&) = delete;
    Record& operator=(const Record&) = delete;

private:
    std::string path_;
    OutputFile file_; // locked as long as it is open
    bool left_ = false;
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
                add(folder,
                    entry(firstFolder, first.lexically_relative(folder)) + filesIn(folder, files));
        std::string entries = filesIn(first, files);
        for (const fs::path& folder : folders)
            if (folder != first) entries += entry(otherFolder, folder.lexically_relative(first));
        syncFolder(first.string());
        add(first, entries);
    }
    ~Records()
    {
        while (!all_.empty()) all_.pop_back();
    }
    Records(const Records&) = delete;
    Records& operator=(const Records&) = delete;
    void leave()
    {
        for (const auto& record : all_) record->leave();
    }

private:
    static std::string entry(char kind, const fs::path& name)
    {
        return kind + name.string() + '\0';
    }
    static std::string filesIn(const fs::path& folder, const std::vector<OutputFile*>& files)
    {
        std::string entries;
        for (const OutputFile* file : files)
            if (canonicalFolder(*file) == folder)
                entries += entry(file->replaces() ? replacement : newFile,
                                 fs::path(file->target()).filename());
        return entries;
    }
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

using Entries = std::vector<std::pair<char, std::string>>;

/// The entries of a record; none if it is not this user's.
Entries entriesOf(const fs::path& record)
{
    constexpr std::size_t most = 1 << 20; // bytes; no command line names more
    std::string text(most, '\0');
    const FileDescriptor file = openOwn(record.string());
    const ssize_t size = file ? pread(file.get(), text.data(), most, 0) : 0;
    std::istringstream words(text.substr(0, std::size_t(std::max<ssize_t>(size, 0))));
    Entries entries;
    for (std::string word; std::getline(words, word, '\0');)
        if (!word.empty()) entries.emplace_back(word[0], word.substr(1));
    return entries;
}

/// Puts the files that a record names in their places in its folder.
void placeFiles(const fs::path& folder, const std::string& maker, const Entries& entries)
{
    for (const auto& [kind, name] : entries) {
        const bool replace = kind == replacement;
        const bool isName = name.find('/') == name.npos && name.find_first_not_of('.') != name.npos;
        if ((!replace && kind != newFile) || !isName) continue;
        const std::string place = (folder / name).string();
        if (moveFile(temporaryName(place, maker), place, replace)) continue;
        // It is there already, or somebody else has made another one.
        if (errno == ENOENT || errno == EEXIST) continue;
        const int reason = errno;
        throw Error(ErrorKind::Output,
                    "cannot write " + place +
                        ", which a killed run has left complete: " + std::strerror(reason) +
                        " [hint: remove " + (folder / recordName(maker)).string() + "]",
                    mayPass(reason));
    }
    syncFolder(folder.string());
}

/// The folder that a record calls the first one; empty if it is that one's.
fs::path firstOf(const Entries& entries, const fs::path& folder)
{
    for (const auto& [kind, name] : entries)
        if (kind == firstFolder) return folder / name;
    return {};
}

/// Does what the record of a folder says, and removes it. That of the first folder decides for all:
/// the others lead to it, and if it is gone they name nothing that is left to do.
void finish(const fs::path& folder, const std::string& maker)
{
    const fs::path record = folder / recordName(maker);
    FileDescriptor lock = lockAbandoned(record.string(), maker);
    if (!lock) return;
    const Entries entries = entriesOf(record);
    const fs::path first = firstOf(entries, folder);
    if (!first.empty()) {
        const auto decides = [&] {
            const Entries there = entriesOf(first / recordName(maker));
            return !there.empty() && firstOf(there, first).empty();
        };
        lock = FileDescriptor(); // for the record there leads back to this one
        if (decides()) finish(first, maker);
        if (!decides()) unlink(record.c_str());
        return;
    }
    placeFiles(folder, maker, entries);
    std::vector<fs::path> done = {record};
    for (const auto& [kind, name] : entries) {
        if (kind != otherFolder) continue;
        const fs::path other = folder / name;
        const Entries there = entriesOf(other / recordName(maker));
        std::error_code ignored;
        if (!fs::equivalent(firstOf(there, other), folder, ignored)) continue;
        placeFiles(other, maker, there);
        done.push_back(other / recordName(maker));
    }
    for (const fs::path& path : done) unlink(path.c_str()); // the first one decides
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
    std::unique_ptr<Records> records;
    if (files.size() > 1) {
        turn.lock();
        records = std::make_unique<Records>(files, folders);
    }
    std::size_t placed = 0;
    try {
        for (; placed < files.size(); ++placed) files[placed]->place(records != nullptr);
    } catch (...) {
        std::size_t left = placed + 1; // with the one that failed
        while (left > 0 && files[left - 1]->takeBack()) --left;
        if (left > 0 && records) {
            for (OutputFile* file : files) file->leave();
            records->leave();
        }
        for (const fs::path& folder : folders) syncFolder(folder.string());
        throw;
    }
    for (const fs::path& folder : folders) syncFolder(folder.string());
    tbb::parallel_for(std::size_t(0), files.size(), [&](std::size_t i) { files[i]->dropOld(); });
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
        if (maker.empty()) continue;
        const FileDescriptor lock = lockAbandoned((place / name).string(), maker);
        if (lock && access((place / recordName(maker)).c_str(), F_OK) != 0)
            fs::remove_all(place / name, problem);
    }
}

} // namespace molsurf
