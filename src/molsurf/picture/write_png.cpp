// SPDX-License-Identifier: MPL-2.0
#include "molsurf/picture/write_png.h"

#include "molsurf/core/error.h"

#include <png.h>

#include <csetjmp>

namespace molsurf
{

namespace
{

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
