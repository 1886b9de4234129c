// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/drawn_surface.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/memory.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/show/picture/draw_legend.h"
#include "molsurf/show/picture/panels.h"
#include "molsurf/show/picture/view.h"
#include "molsurf/surface/unit_mesh.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace molsurf
{

std::vector<Ball> movedBalls(const BallSet& atoms, const openvdb::Vec3d& origin)
{
    std::vector<Ball> balls = atoms.balls;
    for (Ball& ball : balls) ball.center -= origin;
    return balls;
}

Mesh crispMesh(const Mesh& mesh, const ColorOwners& owners, const BallSet& atoms,
               const SurfaceOptions& options, const Progress& progress)
{
    const KindRow& kind = rowOf(options.kind);
    // The creases of a union are off by a voxel at most.
    const double crease = kind.isUnion && !kind.hasOffset ? options.voxel : 0.0;
    const bool ofValues = options.color == ColorBy::Value;
    return withCrispBorders(mesh, owners, crease, ofValues ? atoms.labels->values->name : "",
                            progress);
}

std::vector<MeshInstance> instancesOf(const BallSet& atoms, const Mesh& mesh, bool colored,
                                      const Color& plain, const Progress& progress)
{
    const Color one = mesh.colors.empty() ? plain : Color{255, 255, 255};
    const std::vector<Color> colors =
        colored ? instanceColors(atoms, progress) : std::vector<Color>();
    std::vector<MeshInstance> out;
    for (std::size_t i = 0; i < atoms.placement.instances.size(); ++i) {
        const Instance& copy = atoms.placement.instances[i];
        const std::string name = "copy " + (copy.name.empty() ? std::to_string(i + 1) : copy.name);
        const std::vector<std::size_t> parts = partsOfCopy(atoms.placement, mesh, copy);
        for (const std::size_t part : parts)
            out.push_back({copy, part, parts.size() > 1 ? name + " " + mesh.parts[part].name : name,
                           colors.empty() ? one : colors[i]});
    }
    return out;
}

DrawOptions pictureOf(const DrawnSurface& surface, const Progress& progress)
{
    const BallSet& atoms = surface.atoms;
    DrawOptions options = surface.look;
    if (surface.options.color == ColorBy::Pocket) options.glass = neutralColor;
    setUpright(atoms, options);
    options.borders = surface.borders;
    if (options.clip)
        options.inside = insideColors(surface.options, atoms, surface.origin, surface.borders);
    if (surface.whole || atoms.placement.isWhole()) {
        for (const Ball& ball : surface.whole ? surface.whole->balls : atoms.balls)
            options.about.emplace_back(ball.center);
        return options;
    }
    options.instances =
        instancesOf(atoms, surface.mesh, surface.colorsCopies, options.plain, progress);
    constexpr std::size_t enough = 300; // balls of a prototype
    for (std::size_t p = 0; p < atoms.placement.prototypes(); ++p) {
        const auto [begin, end] = atoms.prototype(p);
        std::vector<openvdb::Vec3d>& some = options.aboutParts.emplace_back();
        for (std::size_t i = begin; i < end; i += 1 + (end - begin) / enough)
            some.emplace_back(atoms.balls[i].center);
    }
    if (options.aboutParts.size() < surface.mesh.parts.size()) // several repeat with a copy
        options.aboutParts.resize(surface.mesh.parts.size());
    return options;
}

namespace
{

/// The colours of a surface's chains by their names.
std::map<std::string, Color> colorsOfChains(const BallSet& surface, const Progress& progress)
{
    std::map<std::string, Color> out;
    if (!surface.labels) return out;
    const std::vector<Color> own = chainColors(surface, progress);
    for (std::size_t i = 0; i < own.size(); ++i) out[surface.labels->chains[i]] = own[i];
    return out;
}

/// The colours of chains by their names: those of the surface, and for others their own.
std::vector<Color> colorsOfChains(const BallSet& atoms,
                                  const std::map<std::string, Color>& ofSurface,
                                  const Progress& progress)
{
    std::vector<Color> colors = chainColors(atoms, progress);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const auto known = ofSurface.find(atoms.labels->chains[i]);
        if (known != ofSurface.end()) colors[i] = known->second;
    }
    return colors;
}

/// Adds the centres of balls, of all copies, and their number.
void addCentres(const BallSet& atoms, openvdb::Vec3d& sum, double& count)
{
    for (std::size_t p = 0; p < atoms.placement.prototypes(); ++p) {
        const auto [begin, end] = atoms.prototype(p);
        openvdb::Vec3d own(0.0);
        for (std::size_t i = begin; i < end; ++i) own += atoms.balls[i].center;
        const auto n = double(end - begin);
        const auto add = [&](const openvdb::Vec3d& more) {
            sum += more;
            count += n;
        };
        if (atoms.placement.isWhole()) add(own);
        for (const Instance& copy : atoms.placement.instances)
            if (copy.part == p) add(n * copy.placed(own / n));
    }
}

} // namespace

void colorLikeSurface(const BallSet& surface, ColorBy by, const Color& plain,
                      const Progress& progress, BallSet& others)
{
    BallLabels& labels = *others.labels;
    labels.chainColors = colorsOfChains(others, colorsOfChains(surface, progress), progress);
    if (surface.labels && surface.labels->values && labels.values) {
        labels.values->low = surface.labels->values->low;
        labels.values->high = surface.labels->values->high;
    }
    if (by == ColorBy::Nothing)
        others.colors.assign(others.balls.size(), plain);
    else if (others.colors.empty())
        others.colors = ballColors(others, by, progress);
}

void faceSurface(const BallSet& surface, const std::vector<BallSet>& others, DrawOptions& picture)
{
    if (picture.toEye.lengthSqr() > 0.0 || picture.upright.lengthSqr() > 0.0) return;
    constexpr double least = 1.0; // a surface about the middle has no side [Å]
    openvdb::Vec3d own(0.0), all(0.0);
    double ofOwn = 0.0, ofAll = 0.0;
    addCentres(surface, own, ofOwn);
    addCentres(surface, all, ofAll);
    for (const BallSet& some : others) addCentres(some, all, ofAll);
    const openvdb::Vec3d way = own / ofOwn - all / ofAll;
    if (way.length() > least) lookFrom(way, picture);
}

void showAtoms(const std::vector<ShowRule>& rules, std::vector<BallSet> atoms,
               const std::shared_ptr<const FileBonds>& bonds, const BallSet& surface,
               const Progress& progress, DrawOptions& picture)
{
    if (atoms.empty()) return;
    const std::map<std::string, Color> ofSurface = colorsOfChains(surface, progress);
    std::set<std::string> chains; // of the surface and of what is shown beside it
    for (const auto& [name, color] : ofSurface) chains.insert(name);
    for (const BallSet& some : atoms)
        for (const std::int32_t chain : some.labels->chainOf)
            chains.insert(some.labels->chains[std::size_t(chain)]);
    std::vector<ShownAtoms> shown;
    for (std::size_t k = 0; k < atoms.size(); ++k) {
        atoms[k].labels->chainColors = colorsOfChains(atoms[k], ofSurface, progress);
        if (rules[k].color) atoms[k].colors.assign(atoms[k].balls.size(), *rules[k].color);
        const bool byChain = chains.size() > 1 && !rules[k].golden;
        shown.push_back({std::move(atoms[k]), rules[k], bonds, byChain});
    }
    const double bytes = bytesOfModel(shown), available = double(availableMemory());
    if (bytes > available)
        throw Error(ErrorKind::Input,
                    "`show`: these atoms take about " + sizeText(bytes) +
                        " of memory, and there are " + sizeText(available) +
                        ", expected fewer atoms",
                    true);
    picture.model = std::make_shared<AtomModel>(atomModel(shown, progress));
}

namespace
{

/// Whether colours mean the same values.
bool haveOneScale(const Legend& a, const Legend& b)
{
    if (!a.scale || !b.scale) return !a.scale && !b.scale;
    return a.scale->low == b.scale->low && a.scale->high == b.scale->high;
}

} // namespace

std::vector<Legend> legendsOf(const std::vector<DrawnSurface>& surfaces, const Progress& progress)
{
    std::vector<Legend> all;
    for (const DrawnSurface& surface : surfaces) {
        const auto own =
            surface.legend ? surface.legend
                           : legendOf(surface.options.color, surface.atoms, surface.mesh, progress);
        for (Legend& legend : legendsOf(own, surface.look.model.get())) {
            const auto known = std::find_if(all.begin(), all.end(), [&](const Legend& other) {
                return other.title == legend.title && haveOneScale(other, legend);
            });
            if (known != all.end()) {
                for (const LegendEntry& entry : legend.entries) addEntry(entry, known->entries);
                continue;
            }
            const bool isOther = std::any_of(all.begin(), all.end(), [&](const Legend& other) {
                return other.title == legend.title;
            });
            if (isOther && !surface.name.empty()) legend.title += ", " + surface.name;
            all.push_back(std::move(legend));
        }
    }
    return all;
}

namespace
{

/// Gives all panels the view direction of the first, but those with an eye of their own. All get
/// one frame size, the largest that any needs. Each panel shows the middle of its structure, unless
/// its options say what it shows.
void shareCamera(const std::vector<DrawnSurface>& surfaces, std::vector<DrawOptions>& shots)
{
    DrawOptions unturned = shots[0];
    unturned.turn = 0.0; // each panel turns from there by its own options
    const auto axes = viewAxes(surfaces[0].mesh, unturned);
    PictureFrame largest{openvdb::Vec3d(0.0), 0.0, 0.0};
    std::vector<openvdb::Vec3d> centers;
    for (std::size_t n = 0; n < shots.size(); ++n) {
        DrawOptions& options = shots[n];
        if (!surfaces[n].ownEye) {
            options.upright = openvdb::Vec3d(0.0); // is in the axes, and would go before `up`
            options.up = axes[1];
            options.toEye = axes[2];
        }
        const View view = chooseView(surfaces[n].mesh, options);
        centers.push_back(view.center);
        largest.width = std::max(largest.width, view.width * view.pixel);
        largest.height = std::max(largest.height, view.height * view.pixel);
    }
    for (std::size_t n = 0; n < shots.size(); ++n)
        shots[n].frame = PictureFrame{centers[n], largest.width, largest.height};
}

} // namespace

Picture drawSurfaces(const std::vector<DrawnSurface>& surfaces, const PictureSettings& settings,
                     const Progress& progress)
{
    const bool explains = settings.drawsLegend();
    const std::vector<Legend> legends =
        explains ? legendsOf(surfaces, progress) : std::vector<Legend>();
    std::vector<DrawOptions> shots;
    for (const DrawnSurface& surface : surfaces) shots.push_back(pictureOf(surface, progress));
    if (shots.size() == 1)
        return drawExplained(surfaces[0].mesh, std::move(shots[0]), legends, settings.scaleBar,
                             progress);
    shareCamera(surfaces, shots);
    const int whole = shots[0].width, width = widthBeside(legends, whole);
    const Color background = shots[0].background;
    std::vector<PanelPicture> panels;
    for (std::size_t n = 0; n < shots.size(); ++n) {
        shots[n].width = panelWidth(shots.size(), width);
        shots[n].whole = whole;
        panels.push_back(
            {drawMesh(surfaces[n].mesh, shots[n], progress), explains ? surfaces[n].name : ""});
    }
    return explained(joinPanels(panels, width, whole, background), legends, settings.scaleBar,
                     whole, background);
}

HtmlPage pageOf(const DrawnSurface& surface, const std::string& title, const std::string& about,
                const Progress& progress)
{
    const BallSet& atoms = surface.atoms;
    DrawnSurface colored = surface;
    colored.colorsCopies = true; // the page offers these colours
    const DrawOptions view = pictureOf(colored, progress);
    HtmlPage page;
    page.title = title;
    page.about = about;
    page.legends = surface.legend
                       ? std::vector{*surface.legend}
                       : offeredLegends(surface.options.color, atoms, surface.mesh, progress);
    page.plain = surface.look.plain;
    page.axes = viewAxes(surface.mesh, view);
    if (!view.zoom.empty()) {
        const View shown = chooseView(surface.mesh, view);
        page.zoom =
            PictureFrame{shown.center, shown.width * shown.pixel, shown.height * shown.pixel};
    }
    page.instances = view.instances;
    page.copiesFirst = surface.colorsCopies;
    page.name = surface.name;
    page.opacity = surface.look.opacity;
    const std::vector<Ball> balls =
        surface.whole ? surface.whole->balls : movedBalls(atoms, surface.origin);
    if (atoms.names) nameAtoms(*atoms.names, balls, surface.mesh, progress, page);
    for (std::int32_t& ball : page.ballOf)
        if (surface.whole && ball >= 0)
            ball = std::int32_t(surface.whole->sources[std::size_t(ball)]);
    colorCut(atoms, balls, progress, page);
    return page;
}

} // namespace molsurf
