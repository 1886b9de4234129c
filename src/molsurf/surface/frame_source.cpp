// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/frame_source.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/selection/search_places.h"
#include "molsurf/molecule/selection/select_balls.h"
#include "molsurf/molecule/structure/read_structure.h"
#include "molsurf/show/color/palette.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace molsurf
{

FrameRange parseFrames(const std::string& text)
{
    FrameRange range;
    if (text == "all") return range;
    const auto wrong = [&](const std::string& hint = "") -> void {
        throw Error(ErrorKind::Usage, "`frames`: expected all, or FIRST-LAST:STEP with whole "
                                      "numbers from 1, FIRST not above LAST, got '" +
                                          text + "'" + hint);
    };
    const char *at = text.data(), *end = at + text.size();
    const auto number = [&](int& value) {
        const auto [stop, problem] = std::from_chars(at, end, value);
        if (problem != std::errc() || value < 1) wrong();
        at = stop;
    };
    number(range.first);
    if (at != end && *at != '-') { // a range of Python or of MDAnalysis, or a step of one frame
        const char* next = std::find_if(at, end, [](char c) { return c >= '0' && c <= '9'; });
        wrong(next == end ? "" : meant(std::to_string(range.first) + "-" + std::string(next, end)));
    }
    range.last = range.first;
    if (at != end && *at == '-') {
        range.last = 0;
        if (++at != end && *at != ':') number(range.last);
    }
    if (at != end && *at == ':') {
        ++at;
        number(range.step);
    }
    if (at != end || (range.last > 0 && range.last < range.first)) wrong();
    return range;
}

FrameSource::FrameSource(const std::string& input, const std::string& trajectory,
                         const std::string& frames, const Settings& asked, const Progress& progress)
    : input_(input), trajectoryName_(trajectory), progress_(progress)
{
    const FrameRange range = parseFrames(frames);
    structure_ = readStructure(input, asked.atoms.limits.maxInput);
    if (trajectory.empty()) {
        chooseModels(range);
    } else {
        const int wanted = asked.atoms.model;
        const auto& models = structure_.models;
        const auto model = std::find_if(models.begin(), models.end(), [&](const Model& m) {
            return wanted == 0 || m.number == wanted;
        });
        if (model == models.end())
            throw Error(ErrorKind::Input, input + ": has no model " + std::to_string(wanted));
        model_ = std::size_t(model - models.begin());
        trajectory_ = openTrajectory(trajectory);
        if (!trajectory_->warning().empty())
            structure_.warnings.push_back(trajectory + ": " + trajectory_->warning());
        const std::size_t count = model->end - model->begin;
        if (trajectory_->atoms() != count)
            throw Error(ErrorKind::Input,
                        trajectory + ": expected the " + std::to_string(count) + " atoms of " +
                            input + ", got " + std::to_string(trajectory_->atoms()) +
                            " [hint: the structure has to hold the atoms of the trajectory, in "
                            "their order]");
        const int frameCount = int(trajectory_->frames());
        if (range.first > frameCount || range.last > frameCount)
            missing(std::max(range.first, range.last), "1-" + std::to_string(frameCount));
        for (std::int64_t i = range.first; i <= (range.last ? range.last : frameCount);
             i += range.step)
            numbers_.push_back(int(i));
    }
    add(asked, probeOf(asked.options));
}

FrameSource::Choice FrameSource::add(const Settings& asked, double probe)
{
    Chosen& chosen = choices_.emplace_back(Chosen{asked, probe, {}});
    chosen.first = load(0, chosen);
    std::vector<std::string> expressions = selectionsOf(asked.places);
    expressions.push_back(asked.atoms.select);
    for (const auto* groups : {&asked.labels.groups, &asked.labels.colorGroups})
        for (const GroupRule& rule : *groups) expressions.push_back(rule.select);
    for (const ResolutionRule& rule : asked.atoms.resolutions) expressions.push_back(rule.select);
    for (const CoarseRule& rule : asked.atoms.coarse) expressions.push_back(rule.select);
    selections_.keep(expressions, modelOf(0));
    if (updates_) selections_.forgetPlaces();
    BallSet& first = chosen.first.balls;
    if (first.labels) {
        first.labels->chainColors = chainColors(first, progress_);
        const std::vector<Color> colors = groupColors(first, progress_);
        for (std::size_t g = 0; g < colors.size(); ++g) first.labels->groups[g].color = colors[g];
    }
    return choices_.size() - 1;
}

FrameSource::Choice FrameSource::choose(const SelectOptions& atoms)
{
    Settings asked;
    asked.atoms = atoms;
    return add(asked, 0.0);
}

const Model& FrameSource::modelOf(std::size_t i) const
{
    const auto& models = structure_.models;
    if (trajectory_) return models[model_];
    return *std::find_if(models.begin(), models.end(),
                         [&](const Model& m) { return m.number == number(i); });
}

void FrameSource::missing(int number, const std::string& there) const
{
    throw Error(ErrorKind::Input, (trajectory_ ? trajectoryName_ : input_) + ": has no frame " +
                                      std::to_string(number) + ", only " + there +
                                      " [hint: `frames` FIRST- goes to the end]");
}

void FrameSource::chooseModels(const FrameRange& range)
{
    std::string there; // "1-4,6-38"
    const auto& models = structure_.models;
    for (std::size_t begin = 0, end; begin < models.size(); begin = end) {
        for (end = begin + 1;
             end < models.size() && models[end].number == models[end - 1].number + 1; ++end) {
        }
        there += (there.empty() ? "" : ",") + std::to_string(models[begin].number);
        if (end > begin + 1) there += "-" + std::to_string(models[end - 1].number);
    }
    const auto has = [&](int number) {
        return std::any_of(models.begin(), models.end(),
                           [=](const Model& m) { return m.number == number; });
    };
    if (range.last == 0) { // to the end: every step-th model there is, whatever their numbers
        if (range.first > 1 && !has(range.first)) missing(range.first, there);
        int passed = 0;
        for (const Model& model : models)
            if (model.number >= range.first && passed++ % range.step == 0)
                numbers_.push_back(model.number);
        return;
    }
    for (std::int64_t i = range.first; i <= range.last; i += range.step) {
        if (!has(int(i))) missing(int(i), there);
        numbers_.push_back(int(i));
    }
    if (!has(range.last)) missing(range.last, there);
}

void FrameSource::update()
{
    updates_ = true;
    selections_.forgetPlaces();
}

void FrameSource::superpose(const AnchorRule& rule)
{
    anchorRule_ = rule;
    anchorAtoms_ = anchorAtoms(selections_, rule);
    anchors_ = anchorsOf(structure_, rule, anchorAtoms_, modelOf(0).number);
    assemblies_ = structure_.assemblies;
}

const Superposition* FrameSource::superposed(std::size_t i) const
{
    const auto known = motions_.find(i);
    return known == motions_.end() ? nullptr : &known->second;
}

void FrameSource::layOnFirst(std::size_t i, const Model& model)
{
    if (anchorRule_.anchors.empty()) return;
    auto known = motions_.find(i);
    if (known == motions_.end() || trajectory_) { // a model stays where it was moved to
        if (trajectory_)                          // atoms by their distance are those of the frame
            anchorAtoms_ = anchorAtoms(selections_, anchorRule_);
        const Superposition motion = superpositionOf(
            anchorsOf(structure_, anchorRule_, anchorAtoms_, model.number), anchors_);
        moveBy(motion, model, structure_);
        known = motions_.insert_or_assign(i, motion).first;
    }
    structure_.assemblies = moved(known->second, assemblies_);
}

void FrameSource::moveTo(std::size_t i)
{
    if (at_ == i) return;
    at_.reset(); // where reading fails
    const Model& model = modelOf(i);
    if (trajectory_) {
        const std::vector<openvdb::Vec3f> positions = trajectory_->read(std::size_t(number(i)) - 1);
        for (std::size_t a = 0; a < positions.size(); ++a)
            structure_.atoms[model.begin + a].position = openvdb::Vec3d(positions[a]);
        structure_.placed = true;
    }
    layOnFirst(i, model);
    at_ = i;
}

FrameSource::Frame FrameSource::load(std::size_t i, const Chosen& chosen)
{
    moveTo(i);
    SelectOptions options = chosen.asked.atoms;
    options.model = modelOf(i).number;
    Frame frame{selectBalls(selections_, options, chosen.asked.labels, chosen.probe, progress_),
                {}};
    frame.places = findPlaces(selections_, chosen.asked.places, frame.balls);
    return frame;
}

/// Gives frames the colours of chains and groups that the first one has.
static void keepColors(const BallSet& first, BallSet& selection)
{
    if (!selection.labels || !first.labels) return;
    selection.labels->chainColors = first.labels->chainColors;
    const std::size_t known =
        std::min(selection.labels->groups.size(), first.labels->groups.size());
    for (std::size_t g = 0; g < known; ++g)
        selection.labels->groups[g].color = first.labels->groups[g].color;
}

const FrameSource::Frame& FrameSource::frame(std::size_t i, Chosen& chosen)
{
    if (i == 0) return chosen.first;
    auto& loaded = chosen.loaded;
    const auto known = loaded.find(i);
    if (known != loaded.end()) return known->second;
    Frame frame = load(i, chosen);
    const std::size_t first = chosen.first.balls.balls.size(), now = frame.balls.balls.size();
    if (!updates_ && now != first)
        throw Error(ErrorKind::Input, "frame " + std::to_string(number(i)) + ": expected " +
                                          std::to_string(first) + " atoms as in frame " +
                                          std::to_string(number(0)) + ", got " +
                                          std::to_string(now));
    keepColors(chosen.first.balls, frame.balls);
    // The two before it stay, for displacement().
    loaded.erase(loaded.begin(), loaded.lower_bound(i > 2 ? i - 2 : 0));
    return loaded.emplace(i, std::move(frame)).first->second;
}

std::vector<openvdb::Vec3f> FrameSource::displacement(std::size_t i)
{
    const std::size_t from = i + 1 < size() ? i : i > 0 ? i - 1 : 0;
    const std::size_t to = std::min(from + 1, size() - 1);
    const std::vector<Ball> before = balls(from).balls;
    const std::vector<Ball>& after = balls(to).balls;
    std::vector<openvdb::Vec3f> out;
    for (std::size_t b = 0; b < before.size(); ++b)
        out.emplace_back(after[b].center - before[b].center);
    return out;
}

std::string FrameSource::description()
{
    return describeSelection(structure_, choices_[surface].first.balls);
}

} // namespace molsurf
