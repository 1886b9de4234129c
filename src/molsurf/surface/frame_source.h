// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The atoms of frames: models of a structure, or a trajectory beside it.

#include "molsurf/atoms.h"
#include "molsurf/molecule/selection/superpose.h"
#include "molsurf/molecule/structure/structure.h"
#include "molsurf/molecule/structure/trajectory.h"
#include "molsurf/progress.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace molsurf
{

/// Some frames, by their numbers: "1-100:5", "7", "20-" or "all".
struct FrameRange {
    int first = 1, last = 0; ///< last 0: the last one there is
    int step = 1;
};

/// @throws Error(ErrorKind::Usage) if the text is none of these, or empty from first to last
FrameRange parseFrames(const std::string& text);

/// The atoms of some frames, loaded when they are asked for; all have the same atoms.
class FrameSource
{
public:
    /// Reads the structure and finds the frames.
    /// @param[in] input       a structure file, or "-"
    /// @param[in] trajectory  a file of openTrajectory(); empty: the frames are models of the
    /// structure
    /// @param[in] frames      see parseFrames()
    /// @param[in] probe       that the surfaces are made with, see readAtoms() [Å]
    /// @param[in] progress    is kept by reference
    /// @throws Error(ErrorKind::Input) if a file cannot be read, a frame of the range is not there,
    ///         or the trajectory has another number of atoms than the structure
    FrameSource(const std::string& input, const std::string& trajectory, const std::string& frames,
                const SelectOptions& atoms, double probe, const Progress& progress);

    /// From the second frame on selections by distance are those of their own frame, and frames may
    /// have other balls than the first. To be called before balls().
    void update();

    /// Lays every frame on the first one. To be called before balls().
    /// @throws Error(ErrorKind::Input) if the first frame has no such atoms
    void superpose(const AnchorRule& rule);

    /// How frame i, which was loaded, lies on the first one; null: it was not moved.
    const Superposition* superposed(std::size_t i) const;

    std::size_t size() const { return numbers_.size(); }

    /// The bonds that the structure gives; null: none.
    const std::shared_ptr<const FileBonds>& bonds() const { return structure_.bonds; }

    /// The number of frame i in the file.
    int number(std::size_t i) const { return numbers_[i]; }

    /// The balls of frame i, with the colours of chains and groups that frame 0 has.
    /// @throws Error(ErrorKind::Input) if it cannot be read, or has another number of balls than
    ///         frame 0 without update()
    const BallSet& balls(std::size_t i);

    /// Displacement of each ball from frame i to the next, of the last one from the one before [Å].
    std::vector<openvdb::Vec3f> displacement(std::size_t i);

    /// One line on the structure and what was used of it.
    std::string description();

private:
    /// Keeps the atoms of selections by distance as they are in the first frame.
    void chooseAtoms();
    BallSet load(std::size_t i);
    void layOnFirst(std::size_t i, const Model& model);
    void keepColors(BallSet& selection);
    [[noreturn]] void missing(int number, const std::string& there) const;
    void chooseModels(const FrameRange& range);

    std::string input_, trajectoryName_;
    SelectOptions atoms_;
    double probe_;
    const Progress& progress_;
    Structure structure_;
    std::unique_ptr<Trajectory> trajectory_;
    bool updates_ = false;
    AnchorRule anchorRule_;            ///< of superpose(); no anchors: none
    std::vector<char> anchorAtoms_;    ///< those of the rule
    Anchors anchors_;                  ///< of the first frame
    std::vector<Assembly> assemblies_; ///< where the first frame has them
    std::map<std::size_t, Superposition> motions_;
    std::size_t model_ = 0; ///< of the structure, for a trajectory
    std::vector<int> numbers_;
    std::map<std::size_t, BallSet> loaded_;
    BallSet first_;
};

} // namespace molsurf
