// SPDX-License-Identifier: MPL-2.0
#include "molsurf/show/picture/view_file.h"

#include "molsurf/error.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/show/picture/view.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <string_view>

namespace molsurf
{

using openvdb::Vec3d;

namespace
{

std::array<double, 3> numbersOf(const Vec3d& x)
{
    return {x[0], x[1], x[2]};
}

/// @throws nlohmann::json::exception
Vec3d pointOf(const nlohmann::json& file, const char* key)
{
    const auto x = file.at(key).get<std::array<double, 3>>();
    return {x[0], x[1], x[2]};
}

} // namespace

bool isViewName(const std::string& path)
{
    constexpr std::string_view end = ".view";
    return path.size() > end.size() && path.compare(path.size() - end.size(), end.size(), end) == 0;
}

void lookFrom(const Vec3d& toEye, DrawOptions& options)
{
    options.toEye = toEye;
    constexpr double along = 0.99; // cosine of the angle to an axis
    const Vec3d way = toEye.unit();
    const bool level = std::max(std::abs(way.x()), std::abs(way.y())) > along;
    options.up = level ? Vec3d(0, 0, 1) : Vec3d(0, 1, 0);
}

void writeView(const Mesh& mesh, const DrawOptions& options, OutputFile& file)
{
    const View view = chooseView(mesh, options);
    const nlohmann::ordered_json text = {{"to_eye", numbersOf(view.toEye)},
                                         {"up", numbersOf(view.up)},
                                         {"center", numbersOf(view.center)},
                                         {"width", view.width * view.pixel},
                                         {"height", view.height * view.pixel}};
    file.write(text.dump(2) + "\n");
}

void readView(const std::string& path, DrawOptions& options)
{
    constexpr std::size_t enough = 1 << 20; // bytes
    const std::string text = loadSmallText(path, enough);
    PictureFrame frame{};
    try {
        const nlohmann::json file = nlohmann::json::parse(text);
        options.toEye = pointOf(file, "to_eye");
        options.up = pointOf(file, "up");
        frame = {pointOf(file, "center"), file.at("width").get<double>(),
                 file.at("height").get<double>()};
    } catch (const nlohmann::json::exception&) {
        throw Error(ErrorKind::Input,
                    path + ": expected a view: to_eye, up and center of three numbers, width and "
                           "height [hint: -o NAME.view writes one]");
    }
    constexpr double lowest = 0.1, highest = 5.0; // of the widths that drawMesh() has, 0.2 to 4
    const double across = options.up.cross(options.toEye).length();
    const bool bounded = frame.center.length() < 1e7 && frame.width < 1e7 && frame.height < 1e7;
    if (!(across > 1e-6 * options.up.length() * options.toEye.length()) || !std::isfinite(across) ||
        !bounded || !(frame.width > 1e-3) || !(frame.height > lowest * frame.width) ||
        !(frame.height < highest * frame.width))
        throw Error(ErrorKind::Input, path + ": expected a view with two directions that differ, "
                                             "and a width and a height of 0.1 to 5 widths");
    options.frame = frame;
}

} // namespace molsurf
