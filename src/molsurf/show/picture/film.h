// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Films of pictures, coded by the program ffmpeg.

#include "molsurf/kernel/core/file_descriptor.h"
#include "molsurf/progress.h"
#include "molsurf/show/io/output_file.h"
#include "molsurf/show/picture/draw_mesh.h"

#include <sys/types.h>

#include <memory>
#include <string>
#include <vector>

namespace molsurf
{

constexpr double filmRate = 25.0; ///< pictures a second, unless the call has others

/// Finds out before any work is done whether a film can be written.
/// @throws Error(ErrorKind::Output) if there is no ffmpeg, or the film would go to a pipe
void checkFilm(const std::string& path);

/// A film that is being made: ffmpeg gets the pictures through a pipe and writes the temporary
/// file, which it gets open and not by its name. It is killed when this program ends.
class Film
{
public:
    /// @param[in] file      to be committed after finish(); its ending says how the film is coded
    /// @param[in] rate      pictures a second
    /// @param[in] progress  whether the run is to stop; it lives longer
    Film(OutputFile& file, double rate, const Progress& progress);
    /// The same with a file of its own.
    Film(std::unique_ptr<OutputFile> file, double rate, const Progress& progress);
    /// Ends ffmpeg, if finish() has not.
    ~Film();
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;

    OutputFile& file() { return file_; }

    /// Adds a picture. All have the size of the first one, made even, as codecs want it.
    /// @throws Error(ErrorKind::Output) if ffmpeg cannot be run or ends early
    void add(const Picture& picture);

    /// Waits for ffmpeg.
    /// @return the file of its own, whole; null: it belongs to somebody else
    /// @throws Error(ErrorKind::Output) if ffmpeg fails
    std::unique_ptr<OutputFile> finish();

private:
    /// Starts ffmpeg: raw pictures through a pipe to its input, its messages to a file in memory.
    void begin();
    /// The call of ffmpeg that writes a descriptor.
    std::vector<std::string> call(int target) const;
    [[noreturn]] void fail();
    /// @return the status that ffmpeg ended with, as of waitpid()
    int wait();

    std::unique_ptr<OutputFile> own_;
    OutputFile& file_;
    double rate_;
    const Progress& progress_;
    int width_ = 0, height_ = 0;   ///< [pixel]
    pid_t program_ = 0;            ///< 0: it does not run
    FileDescriptor pipe_, errors_; ///< to its input; its error messages
};

} // namespace molsurf
