// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// The atoms of frames: models of a structure, or a trajectory beside it.

#include "molsurf/molecule/selection/match_atoms.h"
#include "molsurf/molecule/selection/superpose.h"
#include "molsurf/molecule/structure/structure.h"
#include "molsurf/molecule/structure/trajectory.h"
#include "molsurf/progress.h"
#include "molsurf/settings.h"

#include <deque>
#include <map>
#include <memory>
#include <optional>
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

/// The atoms of some frames, loaded when they are asked for; all have the same atoms. The files are
/// read once, whatever is selected of them.
class FrameSource
{
public:
    /// Atoms that are used of each frame.
    using Choice = std::size_t;
    static constexpr Choice surface = 0; ///< those that the surface is of

    /// Reads the structure and finds the frames.
    /// @param[in] input       a structure file, or "-"
    /// @param[in] trajectory  a file of openTrajectory(); empty: the frames are models of the
    /// structure
    /// @param[in] frames      see parseFrames()
    /// @param[in] asked       the atoms, their labels, places, and the options of the surfaces
    /// @param[in] progress    is kept by reference
    /// @throws Error(ErrorKind::Input) if a file cannot be read, a frame of the range is not there,
    ///         or the trajectory has another number of atoms than the structure
    FrameSource(const std::string& input, const std::string& trajectory, const std::string& frames,
                const Settings& asked, const Progress& progress);
    FrameSource(const FrameSource&) = delete;
    FrameSource& operator=(const FrameSource&) = delete;

    /// From the second frame on selections by distance are those of their own frame, and frames may
    /// have other balls than the first. To be called before choose() and balls().
    void update();

    /// Lays every frame on the first one. To be called before choose() and balls().
    /// @throws Error(ErrorKind::Input) if the first frame has no such atoms
    void superpose(const AnchorRule& rule);

    /// Uses further atoms of each frame. To be called before balls().
    Choice choose(const SelectOptions& atoms);

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
    const BallSet& balls(std::size_t i, Choice choice = surface)
    {
        return frame(i, choices_[choice]).balls;
    }

    /// Where products are searched for in frame i.
    const SearchPlaces& places(std::size_t i) { return frame(i, choices_[surface]).places; }

    /// Displacement of each ball from frame i to the next, of the last one from the one before [Å].
    std::vector<openvdb::Vec3f> displacement(std::size_t i);

    /// One line on the structure and what was used of it.
    std::string description();

private:
    struct Frame {
        BallSet balls;
        SearchPlaces places;
    };
    /// What is asked for of each frame, and the frames that are loaded.
    struct Chosen {
        Settings asked;
        double probe; ///< [Å]
        Frame first;
        std::map<std::size_t, Frame> loaded{};
    };

    const Frame& frame(std::size_t i, Chosen& chosen);
    /// Adds a choice. The atoms of its selections by distance stay those of the first frame.
    Choice add(const Settings& asked, double probe);
    /// Brings the structure to where frame i has its atoms.
    void moveTo(std::size_t i);
    Frame load(std::size_t i, const Chosen& chosen);
    void layOnFirst(std::size_t i, const Model& model);
    [[noreturn]] void missing(int number, const std::string& there) const;
    void chooseModels(const FrameRange& range);
    const Model& modelOf(std::size_t i) const;

    std::string input_, trajectoryName_;
    const Progress& progress_;
    Structure structure_;
    Selections selections_{structure_};
    std::unique_ptr<Trajectory> trajectory_;
    bool updates_ = false;
    AnchorRule anchorRule_;            ///< of superpose(); no anchors: none
    std::vector<char> anchorAtoms_;    ///< those of the rule
    Anchors anchors_;                  ///< of the first frame
    std::vector<Assembly> assemblies_; ///< where the first frame has them
    std::map<std::size_t, Superposition> motions_;
    std::size_t model_ = 0; ///< of the structure, for a trajectory
    std::vector<int> numbers_;
    std::optional<std::size_t> at_; ///< the frame whose atoms the structure has
    std::deque<Chosen> choices_;    ///< does not move them
};

} // namespace molsurf
