// SPDX-License-Identifier: MPL-2.0
#include "batch_journal.h"

#include "outputs.h"
#include "stop.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/transient_error.h"
#include "molsurf/show/io/commit.h"
#include "molsurf/show/io/output_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace molsurf::tool
{

namespace
{

[[noreturn]] void fail(const std::string& what, const std::string& path)
{
    const int reason = errno;
    throw Error(ErrorKind::Output, "cannot " + what + " " + path + ": " + std::strerror(reason),
                mayPass(reason));
}

// Other runs wait meanwhile. Where a file system has no locks, lines are appended all the same.
class Lock
{
public:
    explicit Lock(const FileDescriptor& file) : file_(file.get())
    {
        while (flock(file_, LOCK_EX) != 0 && errno == EINTR) {
        }
    }
    ~Lock() { flock(file_, LOCK_UN); }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

private:
    int file_;
};

void writeAll(const FileDescriptor& file, std::string text, const std::string& path)
{
    while (!text.empty()) {
        const ssize_t count = write(file.get(), text.data(), text.size());
        if (count < 0 && errno != EINTR) fail("write", path);
        if (count > 0) text.erase(0, std::size_t(count));
    }
}

std::string readFrom(const FileDescriptor& file, std::size_t offset, const std::string& path)
{
    std::string text, part(1 << 16, '\0');
    for (;;) {
        const ssize_t count =
            pread(file.get(), part.data(), part.size(), off_t(offset + text.size()));
        if (count < 0 && errno != EINTR) fail("read", path);
        if (count == 0) return text;
        if (count > 0) text.append(part, 0, std::size_t(count));
    }
}

} // namespace

std::vector<std::string> BatchJournal::paths(const std::string& folder)
{
    const std::filesystem::path in = folder;
    return {(in / "summary.jsonl").string(), (in / "summary.json").string(),
            (in / "summary.csv").string()};
}

BatchJournal::BatchJournal(const std::string& folder, const BatchSummary& own, bool anew)
    : folder_(folder), path_(paths(folder).front()),
      file_(open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666)), summary_(own)
{
    if (!file_) fail("write", path_);
    const Lock lock(file_);
    const std::string text = readFrom(file_, 0, path_), header = journalHeader(own);
    const std::size_t end = text.find('\n');
    if (end != std::string::npos) {
        const BatchSummary old = readJournalHeader(text.substr(0, end), path_);
        if (old.version == own.version && old.options == own.options) {
            read_ = end + 1;
            refresh();
            return;
        }
        if (!anew)
            throw Error(ErrorKind::Output, folder + " holds surfaces with other options (" +
                                               old.options + "; version " + old.version +
                                               ") [hint: another folder, or --force]");
    } else if (header.compare(0, text.size(), text) != 0 && !anew) { // not its own, cut short
        readJournalHeader(text, path_);
    }
    if (ftruncate(file_.get(), 0) != 0) fail("write", path_);
    writeAll(file_, header, path_);
    read_ = header.size();
}

void BatchJournal::enter(const BatchEntry& entry)
{
    if (entry.status == "begun") begun_.insert(entry.name);
    const auto [place, fresh] = places_.emplace(entry.name, summary_.entries.size());
    if (fresh)
        summary_.entries.push_back(entry);
    else
        summary_.entries[place->second] = entry;
}

// Reads what other runs and this one have appended.
void BatchJournal::refresh()
{
    const std::string text = readFrom(file_, read_, path_);
    read_ += text.size();
    rest_ += text;
    std::size_t begin = 0;
    for (std::size_t end; (end = rest_.find('\n', begin)) != std::string::npos; begin = end + 1)
        if (const auto entry = readJournalLine(rest_.substr(begin, end - begin))) enter(*entry);
    rest_.erase(0, begin);
}

const BatchEntry* BatchJournal::find(const std::string& name)
{
    refresh();
    const auto place = places_.find(name);
    return place == places_.end() ? nullptr : &summary_.entries[place->second];
}

void BatchJournal::append(const BatchEntry& entry)
{
    {
        const Lock lock(file_);
        refresh();
        const bool cut = !rest_.empty(); // by a run that was killed while it wrote
        writeAll(file_, (cut ? "\n" : "") + journalLine(entry), path_);
    }
    const bool ended = entry.status != "begun";
    // On the disk before the files that it allows the next run to replace.
    if (!ended && fsync(file_.get()) != 0 && errno != EINVAL && errno != ENOSYS)
        fail("write", path_);
    if (ended && Clock::now() - written_ > 20.0 * tableSeconds_) writeTables();
}

void BatchJournal::writeTables()
{
    const Clock::time_point start = Clock::now();
    ignoreSignals();
    const Lock lock(file_);
    refresh();
    BatchSummary ended{summary_.version, summary_.options, {}, summary_.optionsSha256};
    for (const BatchEntry& entry : summary_.entries)
        if (entry.status != "begun") ended.entries.push_back(entry);
    OutputFiles files;
    for (const std::string& path : {paths(folder_)[1], paths(folder_)[2]})
        files.push_back(std::make_unique<OutputFile>(path, true));
    writeSummaryJson(ended, *files[0]);
    writeSummaryCsv(ended, *files[1]);
    commit({files[0].get(), files[1].get()});
    written_ = Clock::now();
    tableSeconds_ = written_ - start;
}

} // namespace molsurf::tool
