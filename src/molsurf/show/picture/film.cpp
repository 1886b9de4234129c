// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/film.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/core/transient_error.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <utility>
#include <vector>

namespace molsurf
{

namespace
{

constexpr const char* insteadHint =
    " [hint: a name that ends in .png writes the pictures one by one]";

/// How ffmpeg codes the films of an ending.
struct Coding {
    const char* ending;
    const char* muxer;
    std::vector<std::string> words;
};

const Coding& codingOf(const std::string& path)
{
    // Players take only 4:2:0, and its colours for those of HD television.
    static const std::vector<std::string> yuv = {
        "-vf",
        "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p",
        "-colorspace",
        "bt709",
        "-color_trc",
        "bt709",
        "-color_primaries",
        "bt709",
        "-color_range",
        "tv"};
    static const std::vector<Coding> all = [] {
        std::vector<Coding> codings = {
            {".mp4", "mp4", {"-c:v", "libx264", "-crf", "18", "-movflags", "+faststart"}},
            {".webm", "webm", {"-c:v", "libvpx-vp9", "-b:v", "0", "-crf", "24", "-cpu-used", "4"}}};
        for (Coding& coding : codings)
            coding.words.insert(coding.words.end(), yuv.begin(), yuv.end());
        codings.push_back(
            {".gif", "gif", {"-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse"}});
        return codings;
    }();
    const std::string ending = lowered(std::filesystem::path(path).extension().string());
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const Coding& coding) { return ending == coding.ending; });
    return found == all.end() ? all.front() : *found;
}

/// The file of a program, where the shell would look for it; empty: there is none.
std::string fileOf(const char* program)
{
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path ? path : "/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::string file = (folder.empty() ? "." : folder) + "/" + program;
        if (access(file.c_str(), X_OK) == 0 && !std::filesystem::is_directory(file)) return file;
    }
    return "";
}

/// Becomes a program that is killed with its parent. Behind fork() only calls that a handler of
/// signals may make are allowed.
/// @param[in] ends   of the standard streams
/// @param[in] extra  a file that it gets besides
/// @param[in] told   gets the errno if that fails
[[noreturn]] void become(char* const* call, const char* file, pid_t parent,
                         const std::array<int, 3>& ends, int extra, int told)
{
    bool good = prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 && fcntl(extra, F_SETFD, 0) == 0;
    for (int n = 0; n < 3; ++n) good = good && dup2(ends[std::size_t(n)], n) >= 0;
    if (good && getppid() == parent) execv(file, call);
    const int reason = errno;
    const ssize_t ignored = write(told, &reason, sizeof reason);
    _exit(ignored < 0 ? 126 : 127);
}

/// A number of pixels made even.
int even(int pixels)
{
    return pixels + pixels % 2;
}

/// The pixels of a picture in another size: cut off, or with its last column and row again.
std::vector<std::uint8_t> pixelsOf(const Picture& picture, int width, int height)
{
    std::vector<std::uint8_t> out;
    out.reserve(3 * std::size_t(width) * std::size_t(height));
    for (int y = 0; y < height; ++y) {
        const int row = std::min(y, picture.height - 1);
        for (int x = 0; x < width; ++x) {
            const int column = std::min(x, picture.width - 1);
            const auto* pixel =
                picture.rgb.data() + 3 * (std::ptrdiff_t(row) * picture.width + column);
            out.insert(out.end(), pixel, pixel + 3);
        }
    }
    return out;
}

} // namespace

void checkFilm(const std::string& path)
{
    if (isStream(path))
        throw Error(ErrorKind::Output, path + ": expected a file for a film, got a pipe");
    if (fileOf("ffmpeg").empty())
        throw Error(ErrorKind::Output,
                    "cannot write " + path +
                        ": expected the program ffmpeg, got none [hint: install "
                        "ffmpeg, or a name that ends in .png writes the pictures one by one]");
}

Film::Film(OutputFile& file, double rate, const Progress& progress)
    : file_(file), rate_(rate), progress_(progress)
{
}

Film::Film(std::unique_ptr<OutputFile> file, double rate, const Progress& progress)
    : own_(std::move(file)), file_(*own_), rate_(rate), progress_(progress)
{
}

Film::~Film()
{
    if (program_ == 0) return;
    kill(program_, SIGKILL);
    wait();
}

std::vector<std::string> Film::call(int target) const
{
    const Coding& coding = codingOf(file_.path());
    std::vector<std::string> words = {"ffmpeg",
                                      "-loglevel",
                                      "error",
                                      "-nostdin",
                                      "-y",
                                      "-f",
                                      "rawvideo",
                                      "-pix_fmt",
                                      "rgb24",
                                      "-video_size",
                                      formatted("%dx%d", width_, height_),
                                      "-framerate",
                                      formatted("%.6g", rate_),
                                      "-i",
                                      "pipe:0"};
    words.insert(words.end(), coding.words.begin(), coding.words.end());
    // One thread: the bytes of some codecs depend on their number.
    for (const char* const word : {"-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact",
                                   "-map_metadata", "-1", "-f", coding.muxer})
        words.push_back(word);
    words.push_back("file:/proc/self/fd/" + std::to_string(target));
    return words;
}

void Film::begin()
{
    std::array<int, 2> ends{}, answer{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) file_.fail("cannot write");
    const FileDescriptor input(ends[0]);
    pipe_ = FileDescriptor(ends[1]);
    errors_ = FileDescriptor(memfd_create("ffmpeg", MFD_CLOEXEC));
    const FileDescriptor nowhere(open("/dev/null", O_WRONLY | O_CLOEXEC)), target = file_.again();
    if (!errors_ || !nowhere || pipe2(answer.data(), O_CLOEXEC) != 0) file_.fail("cannot write");
    const FileDescriptor told(answer[0]);
    FileDescriptor telling(answer[1]);

    std::vector<std::string> words = call(target.get());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const std::string file = fileOf("ffmpeg");
    const pid_t parent = getpid();
    program_ = fork();
    if (program_ == 0)
        become(arguments.data(), file.c_str(), parent, {input.get(), nowhere.get(), errors_.get()},
               target.get(), telling.get());
    int problem = program_ < 0 ? errno : 0;
    telling = FileDescriptor();
    if (problem == 0 && read(told.get(), &problem, sizeof problem) <= 0) return;
    if (program_ > 0) wait();
    program_ = 0;
    errno = problem;
    file_.fail("cannot run ffmpeg for");
}

void Film::add(const Picture& picture)
{
    if (program_ == 0) {
        width_ = even(picture.width);
        height_ = even(picture.height);
        begin();
    }
    const std::vector<std::uint8_t> pixels = pixelsOf(picture, width_, height_);
    for (std::size_t done = 0; done < pixels.size();) {
        const ssize_t taken = write(pipe_.get(), pixels.data() + done, pixels.size() - done);
        if (taken < 0 && errno == EINTR) continue;
        if (taken < 0) fail();
        done += std::size_t(taken);
    }
}

int Film::wait()
{
    pipe_ = FileDescriptor();
    int status = 0;
    while (waitpid(program_, &status, 0) < 0 && errno == EINTR) {
    }
    program_ = 0;
    return status;
}

std::unique_ptr<OutputFile> Film::finish()
{
    if (program_ == 0 || wait() != 0) fail();
    // It may have failed to write and ended well: then it has said something.
    if (lseek(errors_.get(), 0, SEEK_END) > 0) fail();
    file_.finish();
    if (!file_.isWhole())
        throw Error(ErrorKind::Output, "cannot write " + file_.path() +
                                           ": ffmpeg: it has written nothing, or another file lies "
                                           "in its place" +
                                           insteadHint);
    return std::move(own_);
}

void Film::fail()
{
    if (program_ != 0) wait();
    if (progress_.cancelled()) throw Cancelled(); // a signal from the keyboard ends both
    std::string all(1 << 16, '\0'), line;
    const ssize_t size = pread(errors_.get(), all.data(), all.size(), 0);
    all.resize(std::size_t(std::max<ssize_t>(size, 0)));
    std::istringstream lines(all);
    std::string last = "it ended early";
    bool full = false;
    while (std::getline(lines, line)) {
        full = full || line.find(std::strerror(ENOSPC)) != std::string::npos;
        if (!line.empty()) last = line;
    }
    if (full) last = std::strerror(ENOSPC);
    throw Error(ErrorKind::Output,
                "cannot write " + file_.path() + ": ffmpeg: " + last + insteadHint,
                full && mayPass(ENOSPC));
}

} // namespace molsurf
