// SPDX-License-Identifier: MPL-2.0
#include "molsurf/surface/picture_settings.h"

#include "molsurf/kernel/pipeline/surface_kind.h"
#include "molsurf/molecule/structure/text_fields.h"
#include "molsurf/show/color/palette.h"
#include "molsurf/show/color/value_colors.h"
#include "molsurf/show/io/file_content.h"
#include "molsurf/show/picture/style.h"
#include "molsurf/show/picture/view_file.h"
#include "molsurf/surface/set_value.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

namespace molsurf
{

namespace
{

using Values = std::vector<std::string>;

bool hasLength(const openvdb::Vec3d& way)
{
    return way.length() > 0.0 && std::isfinite(way.length());
}

/// Three numbers with commas between.
std::optional<openvdb::Vec3d> numbersIn(const std::string& text)
{
    openvdb::Vec3d way;
    const char *from = text.data(), *end = from + text.size();
    for (int i = 0; i < 3; ++i) {
        const auto [stop, problem] = std::from_chars(from, end, way[i]);
        if (problem != std::errc() || (i < 2 ? stop == end || *stop != ',' : stop != end))
            return std::nullopt;
        from = stop + 1;
    }
    return way;
}

PictureSetting viewSetting()
{
    PictureSetting row{"view",
                       SettingType::Text,
                       "FROM",
                       "a direction toward the eye, X,Y,Z or an axis as z or -z;\n"
                       "atoms that face it, as \"A/63\"; FILE.view, as -o writes it;\n"
                       "auto: the shortest extent toward the eye, the longest across",
                       "auto",
                       {"auto"}};
    row.set = [](PictureSettings& to, const Values& values) {
        if (!takeView(values.back(), to.picture))
            wrongValue("view", "auto, a direction X,Y,Z, an axis as z or a FILE.view",
                       values.back());
    };
    row.file = [](const std::string& value) {
        return std::string_view(value).substr(isViewName(value) ? 0 : value.size());
    };
    return shownIn(holds::Views, row);
}

PictureSetting zoomSetting()
{
    PictureSetting row{"zoom", SettingType::Text, "SEL",
                       "these atoms fill 80 % of a square frame; where something\n"
                       "hides them, it is cut away to their middle, as by `clip`",
                       ""};
    row.set = [](PictureSettings& to, const Values& values) {
        if (!takeZoom(values.back(), to.picture))
            wrongValue("zoom", "places X,Y,Z with semicolons between", values.back());
    };
    return shownIn(holds::Views | holds::ColorChoices, row);
}

PictureSetting uprightSetting()
{
    PictureSetting row{"up", SettingType::Text, "X,Y,Z",
                       "what is upright, such as z, the normal of a membrane;\n"
                       "without it y, or z for a view along x or y, or of itself\n"
                       "the normal of a membrane, where no view is asked for",
                       ""};
    row.set = [](PictureSettings& to, const Values& values) {
        const auto way = directionOf(values.back());
        if (!way || !hasLength(*way))
            wrongValue("up", "a direction X,Y,Z that is not 0, or an axis as z", values.back());
        to.picture.upright = *way;
    };
    return shownIn(holds::Views, row);
}

PictureSetting sizeSetting()
{
    auto row = countRow<PictureSettings>(
        {"size", "N", "width in pixels; the height follows the shape", "1200"}, 16, 16384,
        MOLSURF_OF(picture.width));
    row.set = [set = row.set](PictureSettings& to, const Values& values) {
        const std::size_t by = lowered(values.back()).find_first_of("x,*"); // "800x600"
        if (by != std::string::npos && by > 0)
            wrongValue("size", "the width alone", values.back(),
                       meant(values.back().substr(0, by)));
        set(to, values);
    };
    return row;
}

PictureSetting opacitySetting()
{
    constexpr NumberRange range = {0.01, 1.0, "a number from 0.01 to 1"};
    auto row =
        numberRow<PictureSettings>({"opacity", "O", "of the surface, seen from the front", "1"},
                                   range, MOLSURF_OF(picture.opacity));
    row.set = [set = row.set, range](PictureSettings& to, const Values& values) {
        std::string number = values.back();
        if (!number.empty() && number.back() == '%') number.pop_back();
        double percent = 0.0;
        if (parseWhole(number, percent) && percent > 1.0 && percent <= 100.0)
            wrongValue("opacity", range.words, values.back(), meant(shortest(percent / 100.0)));
        set(to, values);
    };
    return shownIn(holds::Pixels | holds::ColorChoices, row);
}

PictureSetting backgroundSetting()
{
    PictureSetting row{"background", SettingType::Text,
                       "COLOR",      "as #rrggbb or #rgb, a name such as black, or transparent",
                       "#ffffff",    {"transparent"}};
    row.set = [](PictureSettings& to, const Values& values) {
        to.picture.transparent = lowered(values.back()) == "transparent";
        if (to.picture.transparent) return;
        to.picture.background = colorValue("background", ", or transparent", values.back());
    };
    return row;
}

PictureSetting plainColorSetting()
{
    PictureSetting row{"plain-color", SettingType::Text, "COLOR", "of a surface without `color`",
                       "#8cb5de"};
    row.set = [](PictureSettings& to, const Values& values) {
        to.picture.plain = colorValue("plain-color", "", values.back());
    };
    return shownIn(holds::PlainColor, row);
}

PictureSetting styleSetting()
{
    Values words, all;
    for (const PictureStyle& row : styleTable()) {
        words.push_back(row.word);
        all.push_back(row.word + (*row.help ? std::string(": ") + row.help : ""));
    }
    PictureSetting row{"style",
                       SettingType::Word,
                       "WORD",
                       wrapped(joinWords(all, "; "), helpWidth),
                       styleTable().front().word,
                       words};
    row.set = [words](PictureSettings& to, const Values& values) {
        to.picture.style = findStyle(values.back());
        if (!to.picture.style)
            wrongValue("style", joinWords(words, ", "), values.back(),
                       didYouMean(values.back(), words));
    };
    return row;
}

/// A note between places in space.
PictureSetting noteSetting(const char* name, const char* value, const char* text,
                           NoteText (*parse)(const std::string& text))
{
    return rulesRow<PictureSettings>(
        {name, value, text}, [=](PictureSettings& to, const std::string& one) {
            const NoteText note = parse(one);
            const auto from = placeIn(note.places.front());
            const auto end = placeIn(note.places.back());
            if (!from || !end)
                wrongValue(name, std::string(value) + " within 1e6 Å of the origin", one);
            if (note.places.size() > 1 && *from == *end) wrongValue(name, "two places", one);
            to.picture.notes.push_back({*from, {}, note.text});
            if (note.places.size() > 1) to.picture.notes.back().to = *end;
        });
}

} // namespace

NoteText labelText(const std::string& text)
{
    // The text of a place begins after the first =. That of a selection, which may have one itself,
    // begins after the last.
    const std::size_t first = text.find('='), last = text.rfind('=');
    const bool ofPlace = bool(placeIn(std::string(trimmed(text.substr(0, first)))));
    const std::size_t equals = ofPlace ? first : last;
    const bool named = equals != std::string::npos;
    NoteText note{{std::string(trimmed(text.substr(0, equals)))}, ""};
    if (named) note.text = std::string(trimmed(text.substr(equals + 1)));
    if (note.places[0].empty() || (note.text.empty() && (named || ofPlace)))
        throw Error(ErrorKind::Usage,
                    "`label`: expected SELECTION, SELECTION=TEXT or X,Y,Z=TEXT, got " +
                        inQuotes(text));
    return note;
}

NoteText rulerText(const std::string& text)
{
    const std::size_t dots = text.find("..");
    const std::string from(trimmed(text.substr(0, dots)));
    const std::string to(dots == std::string::npos ? "" : trimmed(text.substr(dots + 2)));
    if (from.empty() || to.empty())
        throw Error(ErrorKind::Usage, "`ruler`: expected WHERE..WHERE, each a selection or a place "
                                      "X,Y,Z, got " +
                                          inQuotes(text));
    return {{from, to}, ""};
}

std::optional<openvdb::Vec3d> directionOf(const std::string& text)
{
    const std::string word = lowered(text), axis = word.substr(word.rfind('-', 0) == 0 ? 1 : 0);
    if (axis != "x" && axis != "y" && axis != "z") return numbersIn(text);
    openvdb::Vec3d direction(0.0);
    direction[axis[0] - 'x'] = axis.size() == word.size() ? 1.0 : -1.0;
    return direction;
}

std::optional<openvdb::Vec3d> placeIn(const std::string& text)
{
    const auto place = numbersIn(text);
    for (int a = 0; place && a < 3; ++a)
        if (!(std::abs((*place)[a]) <= 1e6)) return std::nullopt;
    return place;
}

const char* nameOf(LegendChoice choice)
{
    return choice == LegendChoice::On ? "on" : choice == LegendChoice::Off ? "off" : "auto";
}

bool PictureSettings::drawsLegend() const
{
    constexpr int wide = 600; // pixels; in smaller pictures letters would take too much room
    return legend == LegendChoice::On || (legend == LegendChoice::Auto && picture.width >= wide);
}

const std::vector<PictureSetting>& pictureSettings()
{
    static const std::vector<PictureSetting> all = [] {
        std::vector<PictureSetting> rows = {
            viewSetting(),
            zoomSetting(),
            uprightSetting(),
            shownIn(holds::Views,
                    numberRow<PictureSettings>(
                        {"turn", "A", "turned by so many degrees about the upright", "0"},
                        {-1e9, 1e9, "a number of degrees"}, MOLSURF_OF(picture.turn))),
            sizeSetting(),
            backgroundSetting(),
            plainColorSetting(),
            styleSetting(),
            opacitySetting(),
            renamed("all-walls",
                    switchRow<PictureSettings>(
                        "show-behind", "`opacity` shows what is behind the nearest wall, too",
                        MOLSURF_OF(picture.showBehind))),
            numberRow<PictureSettings>({"clip", "D",
                                        "cuts away what is nearer to the eye than the middle\n"
                                        "by more than D Å, and shows the inside"},
                                       {-1e6, 1e6, "a number of Å"}, MOLSURF_OF(picture.clip)),
            switchRow<PictureSettings>("depth-cue", "distant parts fade to the background",
                                       MOLSURF_OF(picture.depthCue)),
            wordRow<PictureSettings>(
                "legend", "on or off; auto: beside colours, if 600 pixels wide\nor more",
                std::vector{LegendChoice::Auto, LegendChoice::On, LegendChoice::Off},
                MOLSURF_OF(legend), {{"yes true 1 show", "on"}, {"no false 0 none hide", "off"}}),
            noteSetting("label", "X,Y,Z=TEXT", "a text at a place; repeats", labelText),
            noteSetting("ruler", "X,Y,Z..X,Y,Z",
                        "a line between two places with its length; repeats", rulerText),
            switchRow<PictureSettings>("scale-bar", "a bar below the picture that shows a length",
                                       MOLSURF_OF(scaleBar)),
            numberRow<PictureSettings>(
                {"dpi", "N", "pixels an inch when it is printed; `size` stays"},
                {1.0, 10000.0, "a number from 1 to 10000"}, MOLSURF_OF(picture.dpi))};
        for (PictureSetting& row : rows)
            if (row.shownIn == 0) row.shownIn = holds::Pixels;
        return rows;
    }();
    return all;
}

const PictureSetting& pictureSetting(const std::string& name)
{
    if (const PictureSetting* row = findRow(pictureSettings(), name)) return *row;
    throw Error(ErrorKind::Usage, "no option of pictures is named " + inQuotes(name));
}

bool takeView(const std::string& view, DrawOptions& picture)
{
    if (lowered(view) == "auto") return true;
    if (isViewName(view)) {
        readView(view, picture);
        return true;
    }
    const auto way = directionOf(view);
    if (!way) return false;
    if (!hasLength(*way)) wrongValue("view", "a direction X,Y,Z that is not 0", view);
    lookFrom(*way, picture);
    return true;
}

bool takeZoom(const std::string& text, DrawOptions& picture)
{
    std::vector<openvdb::Vec3d> places;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(';', begin), text.size());
        const auto place = placeIn(text.substr(begin, end - begin));
        if (!place) return false;
        places.push_back(*place);
        begin = end + 1;
    }
    zoomTo(std::move(places), picture);
    return true;
}

void zoomTo(std::vector<openvdb::Vec3d> places, DrawOptions& picture)
{
    picture.zoom = std::move(places);
    picture.frame.reset(); // of a .view
}

void setUpright(const BallSet& atoms, DrawOptions& picture)
{
    const bool chosen = picture.upright.lengthSqr() > 0.0 || picture.toEye.lengthSqr() > 0.0;
    if (atoms.record.membrane && !chosen) picture.upright = *atoms.record.membrane;
}

std::function<Color(const openvdb::Vec3d&)>
insideColors(const SurfaceOptions& options, const BallSet& atoms, const openvdb::Vec3d& origin,
             const std::shared_ptr<const ColorOwners>& borders)
{
    constexpr double farthest = 30.0; // from a ball [Å]
    if (borders)
        return [borders](const openvdb::Vec3d& x) {
            std::vector<OwnersPower> near;
            borders->owners.at(x, 0.0, near);
            return near.empty() ? neutralColor : borders->colors[std::size_t(near[0].owner)];
        };
    if (options.color == ColorBy::Nothing) return nullptr;
    if (options.color != ColorBy::Value || atoms.balls.empty())
        return [](const openvdb::Vec3d&) { return neutralColor; };
    const auto values = std::make_shared<PointValues>(atoms, outwardOf(atoms.coloring, options));
    return [values, origin](const openvdb::Vec3d& x) {
        return values->colorOf(values->at(x + origin, openvdb::Vec3d(0.0), farthest));
    };
}

} // namespace molsurf
