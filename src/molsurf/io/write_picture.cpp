// SPDX-License-Identifier: MPL-2.0
#include "molsurf/io/write_picture.h"

#include "molsurf/core/error.h"

#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/RayTracer.h>

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;
using openvdb::tools::Film;

constexpr std::size_t subpixels = 2; // a pixel is the mean of 2 x 2 rays
constexpr double border = 1.06;      // width of the picture over that of the molecule
constexpr double reach = 2.5;        // how far a point looks for a wall in front of it [voxel]
const Vec3d matte(0.30, 0.52, 0.78); // linear red, green, blue

// Where the camera stands: `toEye` and `right` are unit vectors along axes of the grid.
struct View {
    Vec3d center, toEye, right, up;
    double width, height, depth; // extent of the molecule along right, up, toEye [Å]
};

View chooseView(const openvdb::BBoxd& box)
{
    std::array<int, 3> axis = {0, 1, 2};
    const Vec3d extent = box.extents();
    std::stable_sort(axis.begin(), axis.end(), [&](int a, int b) { return extent[a] > extent[b]; });
    View view;
    view.center = 0.5 * (box.min() + box.max());
    view.right = view.up = Vec3d(0.0);
    view.right[axis[0]] = 1.0;
    view.up[axis[1]] = 1.0;
    view.toEye = view.right.cross(view.up); // right-handed: no mirror image
    view.width = extent[axis[0]];
    view.height = extent[axis[1]];
    view.depth = extent[axis[2]];
    return view;
}

// Two lamps, darker in grooves, paler with distance.
class Shader : public openvdb::tools::BaseShader
{
public:
    Shader(const openvdb::FloatGrid& surface, const View& view)
        : voxels_(surface.getConstAccessor()), transform_(&surface.transform()), view_(view),
          reach_(reach * surface.voxelSize()[0]),
          key_((view.toEye - 0.5 * view.right + 0.9 * view.up).unit()),
          fill_((view.toEye + 0.9 * view.right - 0.3 * view.up).unit()),
          half_((key_ + view.toEye).unit())
    {
    }

    // The normal that OpenVDB offers jumps from voxel to voxel and would show them.
    Film::RGBA operator()(const Vec3d& at, const Vec3d&, const Vec3d&) const override
    {
        const Vec3d normal = normalAt(at);
        const double key = std::max(0.0, normal.dot(key_)), fill = std::max(0.0, normal.dot(fill_));
        const double open = std::clamp(distanceAt(at + reach_ * normal) / reach_, 0.0, 1.0);
        const double light = (0.06 + 0.90 * key + 0.30 * fill) * (0.20 + 0.80 * open);
        const double gloss = 0.10 * std::pow(std::max(0.0, normal.dot(half_)), 40);
        const double behind = 0.5 - (at - view_.center).dot(view_.toEye) / view_.depth;
        const double haze = 0.25 * std::clamp(behind, 0.0, 1.0);
        const Vec3d color = (1.0 - haze) * (light * matte + Vec3d(gloss)) + Vec3d(haze);
        return Film::RGBA(color[0], color[1], color[2]);
    }

    // Every thread gets a copy, and with it an accessor of its own.
    BaseShader* copy() const override { return new Shader(*this); }

private:
    double distanceAt(const Vec3d& at) const
    {
        return openvdb::tools::BoxSampler::sample(voxels_, transform_->worldToIndex(at));
    }

    // Differences over two voxels, which vary continuously.
    Vec3d normalAt(const Vec3d& at) const
    {
        const double step = reach_ / reach;
        Vec3d gradient;
        for (int i = 0; i < 3; ++i) {
            Vec3d shift(0.0);
            shift[i] = step;
            gradient[i] = distanceAt(at + shift) - distanceAt(at - shift);
        }
        gradient.normalize();
        return gradient;
    }

    openvdb::FloatGrid::ConstAccessor voxels_;
    const openvdb::math::Transform* transform_;
    View view_;
    double reach_;
    Vec3d key_, fill_, half_; // toward the lamps; between the first lamp and the eye
};

std::uint8_t encode(double linear)
{
    const double x = std::clamp(linear, 0.0, 1.0);
    const double srgb = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return std::uint8_t(std::lround(255.0 * srgb));
}

void appendBytes(png_structp png, png_bytep bytes, png_size_t size)
{
    auto& all = *static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
    all.insert(all.end(), bytes, bytes + size);
}

void flushNothing(png_structp) {}

void stayQuiet(png_structp, png_const_charp) {}

// Apart from writePng() because of the jump: nothing here has a destructor.
bool encodePng(const Picture& picture, png_structp png, png_infop info,
               std::vector<std::uint8_t>& bytes)
{
    if (setjmp(png_jmpbuf(png))) return false;
    png_set_write_fn(png, &bytes, appendBytes, flushNothing);
    png_set_compression_level(png, 6);
    png_set_IHDR(png, info, png_uint_32(picture.width), png_uint_32(picture.height), 8,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (int row = 0; row < picture.height; ++row)
        png_write_row(png, picture.rgb.data() + std::size_t(row) * 3 * std::size_t(picture.width));
    png_write_end(png, info);
    return true;
}

} // namespace

Picture drawSurface(const openvdb::FloatGrid& surface, int width)
{
    Picture picture;
    picture.width = picture.height = width;
    const openvdb::CoordBBox active = surface.evalActiveVoxelBoundingBox();
    if (active.empty()) {
        picture.rgb.assign(3 * std::size_t(width) * std::size_t(width), 255);
        return picture;
    }

    const View view = chooseView(surface.transform().indexToWorld(active));
    const double shape = std::clamp(view.height / view.width, 0.05, 1.0);
    picture.height = std::max(1, int(std::lround(width * shape)));

    const auto columns = std::size_t(picture.width), rows = std::size_t(picture.height);
    Film film(subpixels * columns, subpixels * rows, Film::RGBA(1.0f));
    const Vec3d eye = view.center + view.depth * view.toEye;
    openvdb::tools::OrthographicCamera camera(film, Vec3d(0.0), eye, border * view.width, 1e-3,
                                              2.0 * view.depth);
    camera.lookAt(view.center, view.up);
    openvdb::tools::rayTrace(surface, Shader(surface, view), camera);

    picture.rgb.reserve(3 * columns * rows);
    for (std::size_t y = 0; y < rows; ++y) {
        for (std::size_t x = 0; x < columns; ++x) {
            Film::RGBA sum(0.0f);
            for (std::size_t s = 0; s < subpixels * subpixels; ++s)
                sum += film.pixel(subpixels * x + s % subpixels, subpixels * y + s / subpixels);
            for (float channel : {sum.r, sum.g, sum.b})
                picture.rgb.push_back(encode(double(channel) / (subpixels * subpixels)));
        }
    }
    return picture;
}

void writePng(const Picture& picture, OutputFile& file)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, stayQuiet);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    std::vector<std::uint8_t> bytes;
    const bool good = info && encodePng(picture, png, info, bytes);
    png_destroy_write_struct(&png, &info);
    if (!good) throw Error(ErrorKind::Output, "cannot write " + file.path() + ": libpng failed");
    file.write(bytes.data(), bytes.size());
    file.finish();
}

} // namespace molsurf
