// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Output files that appear whole or not at all.

#include "molsurf/error.h"
#include "molsurf/kernel/core/file_descriptor.h"

#include <ext/stdio_filebuf.h>

#include <ostream>
#include <string>
#include <string_view>

namespace molsurf
{

/// Whether an output is written as it comes, and not beside its place first: standard output ("-")
/// and pipes with names.
bool isStream(const std::string& path);

/// A write to a stream whose reader has gone, as `head` does.
class NoReader : public Error
{
public:
    explicit NoReader(const std::string& message) : Error(ErrorKind::Output, message) {}
};

/// Finds out before any work is done whether OutputFile could be made and committed.
///
/// @param[in] path       file name, or "-" for standard output, which always passes
/// @param[in] overwrite  true if an existing file may be replaced
/// @throws Error(ErrorKind::Output) if the folder does not exist or cannot be written to, if the
///         name is too long, if the path is a folder or another thing that is no file, or if the
///         file exists and may not be replaced
void checkWritable(const std::string& path, bool overwrite);

/// A file that is written under temporaryName() and gets its own name by commit(). Without a commit
/// the destructor removes it, and what was there before stays as it was.
///
/// A stream is written directly, and commit() only flushes it.
class OutputFile
{
public:
    /// Opens the temporary file.
    /// @throws Error(ErrorKind::Output) as checkWritable(), or if the file cannot be opened
    OutputFile(const std::string& path, bool overwrite);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    const std::string& path() const { return path_; }

    /// True if the output can be written out of order, that is, if it is no stream.
    bool seekable() const { return !temporary_.empty(); }

    /// The stream that takes the content. A write that fails throws std::ios_base::failure;
    /// finish() and write() turn it into an Error.
    std::ostream& stream();

    /// Appends @a size bytes, or a text.
    /// @throws Error(ErrorKind::Output) if they cannot be written
    void write(const void* bytes, std::size_t size);
    void write(std::string_view text) { write(text.data(), text.size()); }

    /// Opens the temporary file once more, for a program that writes it.
    /// @throws Error(ErrorKind::Output) if that fails
    FileDescriptor again();

    /// Whether it has content, and nothing else has its temporary name.
    bool isWhole();

    /// Flushes, and waits until the content is on the disk. No-op if it was done before.
    /// @throws Error(ErrorKind::Output) if that fails, for example because the disk is full
    void finish();

    /// finish(), then puts the file in its place. For several files see molsurf::commit().
    /// @throws Error(ErrorKind::Output) if that fails, or if without @a overwrite somebody else has
    ///         made a file of that name meanwhile
    void commit();

    /// The parts of molsurf::commit(): where the file goes, and whether it may replace another one
    /// there.
    const std::string& target() const { return target_; }
    bool replaces() const { return replaces_; }

    /// Only renames.
    /// @param[in] keeping  a file that is replaced stays under keptName(), until dropOld()
    void place(bool keeping);

    /// The way back after place(), whether or not that has failed: the file that was replaced is
    /// there again.
    /// @return false if the system refuses that
    bool takeBack();
    void dropOld();

    /// Leaves the file under the name that it has, for recover() to complete it.
    void leave() { placed_ = true; }

    /// Throws the Error for a write that failed with the present errno: NoReader for EPIPE.
    [[noreturn]] void fail(const char* step) const;

private:
    std::string path_, target_, temporary_;
    bool replaces_;
    bool finished_ = false, placed_ = false, hasOld_ = false;
    __gnu_cxx::stdio_filebuf<char> buffer_; // holds the lock of the temporary file
    std::ostream file_{nullptr};
};

} // namespace molsurf
