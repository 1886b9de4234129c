// SPDX-License-Identifier: MPL-2.0
#include "verbs.h"

#include "cli/option_table.h"
#include "draw_result.h"
#include "input_files.h"
#include "outputs.h"
#include "picture_atoms.h"
#include "sidecar.h"
#include "stop.h"
#include "write_result.h"

#include "molsurf/analysis/measures/tunnel_tracks.h"
#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/selection/shown_atoms.h"
#include "molsurf/request/usd_stage.h"
#include "molsurf/show/io/frame_table.h"
#include "molsurf/show/io/read_vdb.h"
#include "molsurf/show/io/temporary_file.h"
#include "molsurf/show/io/usda_text.h"
#include "molsurf/show/io/write_table.h"
#include "molsurf/show/io/write_vdb.h"
#include "molsurf/show/picture/film.h"
#include "molsurf/show/picture/view.h"
#include "molsurf/surface/drawn_surface.h"
#include "molsurf/surface/field_table.h"
#include "molsurf/surface/frame_source.h"
#include "molsurf/surface/velocity.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <utility>

namespace molsurf::tool
{

namespace
{

/// Products that a frame may not have.
struct Passing {
    const char *option, *table;  ///< with the errors, and the files, that are of it
    const char* text;            ///< "no pore"
    void (*drop)(SearchPlaces&); ///< asks for it no more
};
constexpr std::array<Passing, 2> passings = {
    {{"`pore`: ", "pore", "no pore", [](SearchPlaces& places) { places.pore.reset(); }},
     {"`tunnelsFrom`: ", "tunnels", "no tunnels",
      [](SearchPlaces& places) { places.tunnelsFrom.reset(); }}}};

/// Whether a file is the table of tunnels over all frames.
bool ofTracks(const Output& output)
{
    return std::string(output.format->table) == "tunnel_frames";
}

/// A line on tunnels over frames.
std::string tracksLine(const TunnelTracks& tracks)
{
    const auto& all = tracks.tracks();
    const auto most = std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
        return a.open.size() < b.open.size();
    });
    const auto [least, widest] =
        std::minmax_element(most->open.begin(), most->open.end(),
                            [](const auto& a, const auto& b) { return a.radius < b.radius; });
    return formatted("tunnels: %zu in all; the most often open: number %zu, in %zu of %zu frames, "
                     "%.3f to %.3f Å wide, mean %.3f Å",
                     all.size(), std::size_t(most - all.begin()) + 1, most->open.size(),
                     tracks.frames(), least->radius, widest->radius, most->meanRadius());
}

// The call of one frame: "name.vdb" becomes "name.0001.vdb".
CommandLine callOf(const CommandLine& call, std::size_t file, int frame)
{
    CommandLine one = call;
    one.frame = frame;
    one.quiet = true;
    one.outputs.clear();
    const std::string number = formatted(".%04zu", file);
    const auto numbered = [&](const std::string& path) {
        const std::filesystem::path whole = path;
        return (whole.parent_path() / (whole.stem().string() + number)).string() +
               whole.extension().string();
    };
    for (Output output : call.outputs) {
        if (output.holds(AllFrames)) continue;
        if (output.holds(Stage)) { // one file for all frames
            const bool film = output.beside.empty();
            output.beside = numbered(film ? output.path : output.beside);
            if (film) one.outputs.push_back({output.beside, output.format});
        } else if (!output.holds(Moving)) { // which has them all
            output.path = numbered(output.path);
        }
        one.outputs.push_back(std::move(output));
    }
    return one;
}

std::string tableOf(const CommandLine& call)
{
    for (const Output& output : call.outputs)
        if (output.holds(FrameRows)) return output.path;
    return "";
}

[[noreturn]] void foreign(const std::string& path)
{
    throw Error(ErrorKind::Output, path + ": exists, of another frame or with other options "
                                          "[hint: another name, or --force]");
}

/// The options and the frame that a file was made of.
std::pair<std::string, std::int64_t> madeOf(const Output& output)
{
    if (output.holds(Stage)) {
        std::int64_t frame = 0;
        parseWhole(usdaData(output.path, usdaFrame), frame);
        return {usdaData(output.path, usdaFrameOptions), frame};
    }
    const VdbFile stored = readVdb(output.path);
    const auto made = stored.metadata.getMetadata<openvdb::StringMetadata>("frames.options");
    const auto frame = stored.metadata.getMetadata<openvdb::Int64Metadata>("frame");
    return {made ? made->value() : "", frame ? frame->value() : 0};
}

// Whether all files of a frame are there, by the metadata of a grid or the row in the table with
// this frame and these options. It is an error if they are of others.
bool isDone(const CommandLine& one, const std::string& options, const FrameTable& table,
            const std::string& tableName, std::size_t file)
{
    std::size_t files = 0, there = 0;
    bool known = false;
    for (const Output& output : one.outputs) {
        if (!output.beside.empty()) continue;
        ++files;
        std::error_code ignored;
        if (!std::filesystem::exists(output.path, ignored)) continue;
        ++there;
        if (!output.holds(Grids | Stage)) continue;
        if (madeOf(output) != std::make_pair(options, std::int64_t(one.frame)))
            foreign(output.path);
        known = true;
    }
    const auto row = table.find(file);
    if (!tableName.empty()) {
        if (row == table.end()) return false;
        if (there > 0 && (row->second.frame != one.frame || row->second.options != options))
            foreign(tableName);
        known = true;
    }
    return known && files == there;
}

openvdb::Vec3d centerOf(const std::vector<Ball>& balls)
{
    openvdb::BBoxd box;
    for (const Ball& ball : balls) box.expand(openvdb::Vec3d(ball.center));
    return box.getCenter();
}

std::string describe(const FrameRow& row, const Report& report)
{
    std::string line = formatted("frame %d: area %.1f Å^2, volume %.1f Å^3, Euler %d", row.frame,
                                 report.surface.area, report.surface.volume, row.euler);
    if (report.evolution)
        line += ", " + counted(std::size_t(report.evolution->steps), "step", "steps") +
                (row.rests ? "" : ", not converged");
    return line + formatted(", %.2f s", report.seconds.back().second);
}

/// Adds the velocities of the grids, in units of the scene, and of the vertices, in Å.
void addVelocities(const CommandLine& call, const BallSet& selection,
                   const std::vector<openvdb::Vec3f>& displacement, const Progress& progress,
                   MolecularSurface& result)
{
    if (!result.surface) return;
    const double perTime = call.fps > 0.0 ? call.fps : 1.0;
    const std::string length = call.scene.scale == 1.0 ? "Å" : "scene units";
    const VelocityUnit unit{call.scene.scale * perTime,
                            length + (call.fps > 0.0 ? " per second" : " per frame")};
    if (call.writes(anyGrids)) {
        result.fields.push_back(
            velocityGrid(*result.surface, selection, displacement, unit, call.options, progress));
        result.fields.back()->setCreator(result.surface->getCreator());
    }
    if (call.writes(VertexCurvatures))
        addVelocity(selection, displacement, perTime, call.options, progress, result.mesh);
}

/// The share of frames in which a point is in a pocket, for a .pockets.vdb.
class OpenShare
{
public:
    explicit OpenShare(const CommandLine& call)
    {
        for (const Output& output : call.outputs) {
            if (!output.holds(Shares)) continue;
            checkOutput(call, output);
            file_ = std::make_unique<OutputFile>(output.path, call.force);
            path_ = output.path;
        }
    }

    bool isAsked() const { return file_ != nullptr; }
    std::string temporary() const { return temporaryName(path_); }

    void add(const MolecularSurface& result)
    {
        ++frames_;
        for (const auto& grid : result.fields) {
            const auto ids = openvdb::gridPtrCast<openvdb::Int32Grid>(grid);
            if (!ids || ids->getName() != "pocket_id") continue;
            if (!counts_) counts_ = openvdb::FloatGrid::create();
            counts_->setTransform(ids->transform().copy());
            auto counts = counts_->getAccessor();
            for (auto voxel = ids->cbeginValueOn(); voxel; ++voxel)
                counts.setValue(voxel.getCoord(), counts.getValue(voxel.getCoord()) + 1.0f);
        }
    }

    std::unique_ptr<OutputFile> written(const openvdb::MetaMap& metadata)
    {
        if (!counts_) counts_ = openvdb::FloatGrid::create();
        counts_->setName("pocket_open");
        counts_->setGridClass(openvdb::GRID_FOG_VOLUME);
        for (auto voxel = counts_->beginValueOn(); voxel; ++voxel)
            voxel.setValue(*voxel / float(frames_));
        writeVdb({counts_}, metadata, *file_);
        return std::move(file_);
    }

private:
    std::unique_ptr<OutputFile> file_;
    std::string path_;
    openvdb::FloatGrid::Ptr counts_;
    int frames_ = 0;
};

/// The longest time that lines of a table wait if no other files go with them [s]. Putting a file
/// in its place takes 10 ms, as long as three such frames of 3,000 atoms.
constexpr double longestWait = 5.0;

/// All frames of a call, one after the other.
class FrameRun
{
public:
    FrameRun(const CommandLine& asked, Terminal& terminal)
        : call_(asked), terminal_(terminal),
          source_(call_.input, call_.trajectory, call_.frames, call_, terminal),
          moves_(hasField(call_.options.fields, "v")), tableName_(tableOf(call_)), share_(call_)
    {
        if (call_.updateSelections) source_.update();
        if (!call_.superpose.empty()) source_.superpose({call_.superpose, call_.atoms.select});
        if (share_.isAsked() && call_.options.grid && !hasField(call_.options.fields, "pocket_id"))
            call_.options.fields.push_back("pocket_id");
        for (const ShowRule& rule : call_.shows) shown_.push_back(choose(rule.select));
        for (const NoteText& note : call_.notes)
            for (const std::string& place : note.places)
                if (!placeIn(place)) noted_.push_back(choose(place));
        if (!call_.viewed.empty())
            lookAt(call_, source_.balls(0, choose(call_.viewed)), source_.balls(0), call_.picture);
        if (!call_.zoomed.empty()) zoomTo(source_.balls(0, choose(call_.zoomed)), call_.picture);
        if (call_.center) call_.scene.center = centerOf(source_.balls(0).balls);
        if (call_.writes(Views) && !call_.picture.frame) keepOneView();
        options_ = call_.frameDigest = optionsDigest(call_);
        if (!tableName_.empty()) {
            InputFiles(call_).refuse(tableName_);
            checkWritable(tableName_, true);
        }
        if (!tableName_.empty() && !call_.force) table_ = readFrameTable(tableName_);
        for (const Output& output : call_.outputs) {
            if (!output.holds(Areas) || !output.holds(AllFrames)) continue;
            checkOutput(call_, output);
            areas_.push_back({output, std::make_unique<OutputFile>(output.path, call_.force)});
        }
        for (Output& output : call_.outputs) {
            if (!output.holds(Moving)) continue;
            checkOutput(call_, output);
            films_.push_back(
                std::make_shared<Film>(std::make_unique<OutputFile>(output.path, call_.force),
                                       call_.fps > 0.0 ? call_.fps : filmRate, terminal_));
            output.film = films_.back();
        }
        for (std::size_t i = 0; i < source_.size(); ++i) {
            calls_.push_back(callOf(call_, fileOf(i), source_.number(i)));
            done_.push_back(!call_.force && !isOfAllFrames() &&
                            isDone(calls_[i], options_, table_, tableName_, fileOf(i)));
            if (done_[i]) continue;
            for (const Output& output : calls_[i].outputs) checkOutput(call_, output);
        }
    }

    std::size_t size() const { return source_.size(); }

    void introduce()
    {
        if (call_.quiet) return;
        printLine(source_.description());
        const BallSet& first = source_.balls(0);
        std::vector<std::string> warnings = call_.warnings;
        warnings.insert(warnings.end(), first.record.warnings.begin(), first.record.warnings.end());
        const bool parts = call_.options.ofParts();
        if (moves_ && parts) warnings.push_back("no grid v: groups have surfaces of their own");
        for (const std::string& warning : warnings) printLine("warning: " + warning);
        const auto kept = std::count(done_.begin(), done_.end(), true);
        printLine(counted(size(), "frame", "frames") +
                  (kept > 0 ? ", " + std::to_string(kept) + " done before" : ""));
    }

    /// Builds frame i, or takes over what is known of it.
    void build(std::size_t i)
    {
        if (!done_[i]) {
            make(i);
            return;
        }
        const auto known = table_.find(fileOf(i));
        euler_.reset();
        if (known == table_.end()) return;
        creeping_ += !known->second.rests;
        euler_ = known->second.euler;
    }

    /// Puts the table in its place, if lines wait for that.
    void keepLines()
    {
        if (!std::exchange(linesWait_, false)) return;
        OutputFile file(tableName_, true);
        writeFrameTable(table_, file);
        ignoreSignals();
        file.commit();
    }

    /// @return the exit status
    int finish(Clock::time_point start)
    {
        keepLines();
        OutputFiles files;
        for (auto& [output, file] : areas_) {
            if (ofTracks(output)) writeCsv(tracks_.table(), *file);
            files.push_back(std::move(file));
        }
        if (share_.isAsked()) {
            openvdb::MetaMap metadata = vdbMetadata(call_, lastReport_);
            for (const char* ofFrame : {"area", "volume"}) metadata.removeMeta(ofFrame);
            files.push_back(share_.written(metadata));
        }
        for (const auto& film : films_) files.push_back(film->finish());
        if (!files.empty()) commitUndisturbed(files);
        if (!call_.quiet) {
            if (!changes_.empty())
                printLine("the topology is another than that before in frames " + changes_);
            for (const std::string& line : leftOutOf(calls_.back())) printLine(line);
            printLine(counted(size(), "frame", "frames") +
                      formatted(", %.2f s", secondsSince(start)));
        }
        if (!tracks_.tracks().empty() && !call_.quiet) printLine(tracksLine(tracks_));
        for (std::size_t k = 0; k < passings.size(); ++k)
            if (!closed_[k].empty())
                printLine(std::string(passings[k].text) + " in frames " +
                          joinWords(closed_[k], ", ") + " [" + whyClosed_[k] + "]");
        if (creeping_ == 0) return 0;
        printLine("not converged: " + counted(creeping_, "frame", "frames") +
                  "; the files are written [hint: a larger --tolerance or a smaller --voxel]");
        return notConvergedStatus;
    }

private:
    /// Whether a frame cannot be left out, since something is of all of them.
    bool isOfAllFrames() const
    {
        return !areas_.empty() || !films_.empty() || share_.isAsked() ||
               !call_.places.tunnelsFrom.empty(); // whose numbers follow from the frames before
    }

    /// The number in the names of the files of frame i.
    std::size_t fileOf(std::size_t i) const { return std::size_t(call_.firstFrame) + i; }

    FrameSource::Choice choose(const std::string& select)
    {
        return source_.choose(besideSurface(call_.atoms, select));
    }

    /// Adds the labels and rulers of frame i.
    void addNotesOf(std::size_t i, DrawOptions& picture)
    {
        std::size_t next = 0;
        addNotes(
            call_.notes, [&](const std::string&) { return source_.balls(i, noted_[next++]); },
            picture);
    }

    /// All frames are seen from one side, in one size.
    void keepOneView()
    {
        double margin = 0.0; // [Å]
        for (const Ball& ball : asMeshed(source_.balls(0).balls, call_.options))
            margin = std::max(margin, double(ball.radius));
        // measured: surfaces of 1UBQ at 6, 12 and 20 Å reach 1.8, 3.7 and 7.8 Å beyond its atoms
        constexpr double blurred = 0.4;
        for (const ResolutionRule& rule : call_.atoms.resolutions)
            margin = std::max(margin, blurred * rule.resolution);
        const openvdb::Vec3d origin = call_.center ? call_.scene.center : openvdb::Vec3d(0.0);
        setUpright(source_.balls(0), call_.picture);
        for (openvdb::Vec3d& place : call_.picture.zoom) place -= origin;
        const auto pointsOf = [&](std::size_t i) {
            std::vector<openvdb::Vec3d> points;
            const auto add = [&](const BallSet& atoms) {
                for (const Ball& ball : atoms.balls)
                    points.push_back(openvdb::Vec3d(ball.center) - origin);
            };
            add(source_.balls(i));
            for (const auto choice : shown_) add(source_.balls(i, choice));
            DrawOptions noted;
            addNotesOf(i, noted);
            for (const PictureNote& note : noted.notes)
                for (const auto& place : {note.from, note.to.value_or(note.from)})
                    points.push_back(place - origin);
            return points;
        };
        keepView(source_.size(), pointsOf, margin, call_.picture);
    }

    /// All frames have the colours of values, and so the legend, of the first one.
    void keepOneRange(const BallSet& balls, const MolecularSurface& result)
    {
        if (!range_ && call_.writes(Views)) range_ = rangeOf(call_, balls, result.mesh, terminal_);
    }

    /// Drops the pore, or the tunnels, of a frame that has none, with the files that are only of
    /// it.
    bool goesOnWithout(const Error& error, std::size_t i)
    {
        const std::string text = error.what();
        const auto passing = std::find_if(passings.begin(), passings.end(), [&](const Passing& p) {
            return text.rfind(p.option, 0) == 0;
        });
        if (error.kind() != ErrorKind::Input || passing == passings.end()) return false;
        const auto k = std::size_t(passing - passings.begin());
        passing->drop(calls_[i].options.places);
        if (closed_[k].empty()) whyClosed_[k] = text.substr(0, text.find(" [")); // without its hint
        closed_[k].push_back(std::to_string(source_.number(i)));
        if (closed_[k].size() == size()) throw error; // none has one
        std::vector<Output>& outputs = calls_[i].outputs;
        outputs.erase(std::remove_if(outputs.begin(), outputs.end(),
                                     [&](const Output& output) {
                                         return output.format->table == std::string(passing->table);
                                     }),
                      outputs.end());
        return true;
    }

    void make(std::size_t i)
    {
        const Clock::time_point start = Clock::now();
        ExtraOutputs table;
        if (!tableName_.empty()) table.temporaries.push_back(temporaryName(tableName_));
        for (const auto& [output, file] : areas_)
            table.temporaries.push_back(temporaryName(output.path));
        if (share_.isAsked()) table.temporaries.push_back(share_.temporary());
        prepareOutputs(calls_[i], table.temporaries);
        terminal_.begin(i, size(),
                        "frame " + std::to_string(i + 1) + "/" + std::to_string(size()) + ": ");
        std::vector<openvdb::Vec3f> displacement;
        if (moves_) displacement = source_.displacement(i);
        BallSet balls = source_.balls(i);
        calls_[i].options.places = source_.places(i);
        takeRange(range_, balls);
        std::vector<BallSet> shown;
        for (const auto choice : shown_) shown.push_back(source_.balls(i, choice));
        showAtoms(call_.shows, std::move(shown), source_.bonds(), balls, terminal_,
                  calls_[i].picture);
        addNotesOf(i, calls_[i].picture);
        Report read;
        read.warnings = call_.warnings;
        read.seconds = {{"read", secondsSince(start)}};
        const auto extend = [&](MolecularSurface& result) {
            keepOneRange(balls, result);
            if (!call_.places.tunnelsFrom.empty()) {
                Report::Tunnels none;
                auto& tunnels = result.report.tunnels;
                tracks_.add(balls, source_.number(i), tunnels ? *tunnels : none);
            }
            if (moves_) addVelocities(call_, balls, displacement, terminal_, result);
            if (share_.isAsked()) share_.add(result);
            for (auto& [output, file] : areas_) {
                if (ofTracks(output)) continue;
                Table rows = areaTable(output.format->table, call_, balls, result);
                appendCsv(rows, source_.number(i), i == 0, *file);
            }
        };
        FrameRow row;
        table.add = [&](const Report& report, OutputFiles& files) {
            table_[fileOf(i)] = row = frameRow(fileOf(i), source_.number(i), options_, report);
            linesWait_ = !tableName_.empty();
            if (!linesWait_ || (files.empty() && secondsSince(kept_) < longestWait)) return;
            files.push_back(std::make_unique<OutputFile>(tableName_, true));
            writeFrameTable(table_, *files.back());
            linesWait_ = false;
            kept_ = Clock::now();
        };
        Report report;
        for (bool isMade = false; !isMade;) {
            try {
                report = surfaceOf(calls_[i], balls, read, terminal_, start, extend, table);
                isMade = true;
            } catch (const Error& error) {
                if (!goesOnWithout(error, i)) throw;
            }
        }
        lastReport_ = report;
        creeping_ += !row.rests;
        if (euler_ && *euler_ != row.euler)
            changes_ += (changes_.empty() ? "" : ", ") + std::to_string(row.frame);
        euler_ = row.euler;
        const Superposition* motion = source_.superposed(i);
        if (!call_.quiet)
            printLine(describe(row, report) + (motion ? "; " + describe(*motion) : ""));
    }

    CommandLine call_;
    Terminal& terminal_;
    FrameSource source_;
    std::vector<FrameSource::Choice> shown_; // of each --show
    std::vector<FrameSource::Choice> noted_; // of each selection of --label and --ruler
    bool moves_;
    std::string tableName_, options_;
    FrameTable table_;
    bool linesWait_ = false;                // for the table's next time in its place
    Clock::time_point kept_ = Clock::now(); // the last one
    OpenShare share_;
    Report lastReport_;
    struct AreaFile {
        Output output;
        std::unique_ptr<OutputFile> file;
    };
    std::vector<AreaFile> areas_; // of all frames
    std::vector<std::shared_ptr<Film>> films_;
    std::optional<std::array<double, 2>> range_; // of values, as the first frame has it
    std::vector<CommandLine> calls_;
    std::vector<bool> done_;
    std::size_t creeping_ = 0;
    TunnelTracks tracks_;
    std::array<std::vector<std::string>, passings.size()> closed_; // frames without them
    std::array<std::string, passings.size()> whyClosed_;           // the first of each
    std::optional<int> euler_;                                     // of the frame before
    std::string changes_;                                          // of the topology: frames
};

} // namespace

int frames(const CommandLine& call, Clock::time_point start)
{
    Terminal terminal(call.progress);
    terminal.update("read", 0.0);
    FrameRun run(call, terminal);
    terminal.erase();
    run.introduce();
    try {
        for (std::size_t i = 0; i < run.size(); ++i) run.build(i);
    } catch (...) {
        run.keepLines();
        throw;
    }
    return run.finish(start);
}

} // namespace molsurf::tool
