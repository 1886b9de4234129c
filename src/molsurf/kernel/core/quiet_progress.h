// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The progress of a run within another run.

#include "molsurf/progress.h"

namespace molsurf
{

/// Progress of a run within another run: nobody is told of it, but the outer one can stop it.
class QuietProgress : public Progress
{
public:
    /// @param[in] outer  the progress of the outer run; it must outlive this object
    explicit QuietProgress(const Progress& outer) : outer_(outer) {}
    bool cancelled() const override { return outer_.cancelled(); }

private:
    const Progress& outer_;
};

} // namespace molsurf
