// SPDX-License-Identifier: MPL-2.0
#include "stand_in.h"

#include "program.h"
#include "stop.h"

#include "molsurf/error.h"
#include "molsurf/progress.h"
#include "molsurf/show/io/commit.h"
#include "molsurf/show/io/temporary_file.h"

#include <filesystem>
#include <memory>
#include <set>

namespace molsurf::tool
{

void prepareFiles(const std::vector<std::string>& paths, const std::string& input,
                  const std::string& hint)
{
    std::vector<std::string> temporaries;
    for (const std::string& path : paths) {
        std::error_code absent;
        if (std::filesystem::equivalent(path, input, absent))
            throw Error(ErrorKind::Output, path + ": it is the file of spheres itself" + hint);
        checkWritable(path, true);
        temporaries.push_back(temporaryName(path));
    }
    handleSignals(temporaries);
}

void recoverFolders(const std::vector<std::string>& paths)
{
    std::set<std::string> folders;
    for (const std::string& path : paths) folders.insert(folderOf(path));
    for (const std::string& folder : folders) recover(folder);
}

void writeFiles(const std::vector<std::string>& paths,
                const std::function<void(std::size_t, OutputFile&)>& write,
                const std::function<void()>& complete)
{
    std::vector<std::unique_ptr<OutputFile>> files;
    std::vector<OutputFile*> pointers;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        files.push_back(std::make_unique<OutputFile>(paths[i], true));
        pointers.push_back(files.back().get());
        write(i, *files.back());
        files.back()->finish();
        if (stopRequested()) throw Cancelled();
    }
    complete();
    ignoreSignals();
    commit(pointers);
}

int runStandIn(const std::function<void()>& perform)
{
    return runProgram(
        [&] {
            perform();
            return 0;
        },
        [](const Error& e) {
            std::string text = e.what();
            const std::size_t hint = text.find(" [hint:");
            // Those of the library name its own options.
            if (hint != std::string::npos && text.find('`', hint) != std::string::npos)
                text.erase(hint);
            return text;
        });
}

} // namespace molsurf::tool
