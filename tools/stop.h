// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Ctrl-C and its relatives: the run stops within a second and leaves no temporary file.
///
/// The first signal asks the run to stop. If it has not done so after 0.7 s (some passes of OpenVDB
/// cannot be interrupted), or on a second signal, the process removes its temporary files and ends.

#include <exception>
#include <string>
#include <vector>

namespace molsurf::tool
{

/// How a run ends of an exception that no code foresees.
struct Ending {
    std::string text;
    int status;
};

/// A thread that the system does not grant means that memory, or a limit of it, has run out.
Ending endingOf(const std::exception& e);

/// Handles SIGINT, SIGTERM and SIGHUP as told above, but those that are ignored at the start of the
/// program (by nohup, or a shell for a job in the background) stay ignored; and ignores SIGPIPE and
/// SIGXFSZ, so that a closed pipe and a file that may not grow are errors of writing. An exception
/// that nobody can catch (OpenVDB and TBB let std::bad_alloc out of destructors) ends the process
/// after a line about it, and without leaving temporary files. To be called by
/// one thread, before files are written; again where other files follow.
/// @param[in] temporaries  the files to remove
void handleSignals(const std::vector<std::string>& temporaries);

/// Says of exceptions that nobody can catch what handleSignals() says, and looks at SIGPIPE for
/// endByPipe(). To be called before main(), since libraries start threads there that may lack
/// memory.
void handleEarly();

/// True once a signal has come.
bool stopRequested();

/// Ends the process by SIGPIPE, as a program ends that does not handle it: quietly, and as status
/// readerGoneStatus to a shell. Returns if the signal was ignored at the start of the program, by
/// which a caller asks for the error in words.
void endByPipe();

/// From here on signals end nothing: the files are being put in their place. After another
/// handleSignals() the program finds that the run is to stop.
void ignoreSignals();

} // namespace molsurf::tool
