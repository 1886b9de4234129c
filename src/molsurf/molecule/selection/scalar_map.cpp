// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/scalar_map.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/byte_order.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

namespace molsurf
{

using openvdb::Vec3d;

float ScalarMap::at(const Vec3d& x) const
{
    std::size_t low[3];
    double t[3];
    for (int a = 0; a < 3; ++a) {
        const double place = (x[a] - origin[a]) / spacing[a];
        if (!(place >= 0.0 && place <= double(counts[a] - 1)))
            return std::numeric_limits<float>::quiet_NaN();
        low[a] = std::min(std::size_t(place), counts[a] - 2);
        t[a] = place - double(low[a]);
    }
    double sum = 0.0;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        double weight = 1.0;
        std::size_t index = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            const std::size_t up = corner >> a & 1;
            weight *= up ? t[a] : 1.0 - t[a];
            index = index * counts[a] + low[a] + up;
        }
        if (weight > 0.0) sum += weight * double(values[index]);
    }
    return float(sum);
}

ScalarMap readDx(const std::string& path, std::size_t maxBytes)
{
    const std::string text = loadText(path, maxBytes);
    ScalarMap out;
    std::size_t items = 0;
    int deltas = 0;
    bool placed = false, data = false;
    LineReader lines(text);
    const auto fail = [&](const std::string& expected) {
        throw Error(ErrorKind::Input, displayName(path) + ":" + std::to_string(lines.number()) +
                                          ": expected " + expected + ", got " +
                                          inQuotes(std::string(lines.line())));
    };
    const auto vectorOf = [&](const Fields& fields, std::size_t first) {
        Vec3d vector(0.0);
        for (std::size_t a = 0; a < 3; ++a)
            if (fields.size() != first + 3 || !parseWhole(fields[first + a], vector[int(a)]))
                fail("three numbers");
        return vector;
    };
    while (lines.next()) {
        const Fields fields = splitFields(lines.line());
        if (fields.empty() || fields[0][0] == '#') continue;
        if (data) {
            if (out.values.size() == items) { // attributes of the field
                double value = 0.0;
                if (parseWhole(fields[0], value))
                    fail("no more than " + std::to_string(items) + " values");
                break;
            }
            for (const std::string_view field : fields) {
                double value = 0.0;
                if (!parseWhole(field, value) || !std::isfinite(value) ||
                    out.values.size() == items)
                    fail("numbers");
                out.values.push_back(float(value));
            }
        } else if (fields[0] == "object" && fields.size() == 8 && fields[3] == "gridpositions") {
            items = 1;
            for (std::size_t a = 0; a < 3; ++a) {
                constexpr std::size_t most = 100000;
                if (!parseWhole(fields[5 + a], out.counts[a]) || out.counts[a] < 2 ||
                    out.counts[a] > most)
                    fail("three counts from 2 to 100000");
                items *= out.counts[a];
            }
        } else if (fields[0] == "origin") {
            out.origin = vectorOf(fields, 1);
            placed = true;
        } else if (fields[0] == "delta" && deltas < 3) {
            const Vec3d delta = vectorOf(fields, 1);
            const double along = delta[deltas];
            if (!(along > 0.0) || delta.lengthSqr() != along * along) fail("a step along the axis");
            out.spacing[deltas++] = along;
        } else if (fields.size() >= 2 && fields[fields.size() - 2] == "data" &&
                   fields.back() == "follows") {
            if (items == 0 || !placed || deltas < 3) fail("counts, origin and three deltas before");
            data = true;
        }
    }
    if (!data || out.values.size() != items)
        throw Error(ErrorKind::Input, displayName(path) + ": expected " +
                                          (data ? std::to_string(items) + " values, got " +
                                                      std::to_string(out.values.size())
                                                : std::string("a map in the format OpenDX")));
    return out;
}

namespace
{

constexpr std::size_t mrcHeader = 1024, mrcName = 208; // [byte]

bool isMrc(const std::string& bytes)
{
    return bytes.size() >= mrcHeader && bytes.compare(mrcName, 4, "MAP ") == 0;
}

/// The words of a map, of either byte order.
class MrcWords
{
public:
    explicit MrcWords(const std::string& bytes) : bytes_(bytes)
    {
        constexpr std::int32_t most = 0xffff; // of the mode
        const std::int32_t mode = integer(4);
        if (mode < 0 || mode > most) order_ = ByteOrder::Big;
    }

    /// A word of the header, counted from 1.
    std::int32_t integer(std::size_t word) const { return std::int32_t(bits(4 * (word - 1), 4)); }
    double real(std::size_t word) const { return realAt(&bytes_[4 * (word - 1)], 4, order_); }

    /// A value of a mode behind the header.
    float value(std::size_t begin, std::size_t i, int mode) const
    {
        switch (mode) {
        case 0:
            return float(std::int8_t(bits(begin + i, 1)));
        case 1:
            return float(std::int16_t(bits(begin + 2 * i, 2)));
        case 6:
            return float(std::uint16_t(bits(begin + 2 * i, 2)));
        case 12: {
            openvdb::math::half half;
            half.setBits(std::uint16_t(bits(begin + 2 * i, 2)));
            return half;
        }
        default:
            return float(realAt(&bytes_[begin + 4 * i], 4, order_));
        }
    }

private:
    std::uint32_t bits(std::size_t at, std::size_t width) const
    {
        return std::uint32_t(unsignedAt(&bytes_[at], width, order_));
    }

    const std::string& bytes_;
    ByteOrder order_ = ByteOrder::Little;
};

/// Bytes of a value of a mode; 0: it is not read.
std::size_t mrcWidth(int mode)
{
    switch (mode) {
    case 0:
        return 1;
    case 1:
    case 6:
    case 12:
        return 2;
    case 2:
        return 4;
    default:
        return 0;
    }
}

/// A map in the format MRC2014 or CCP4, whose cell has right angles.
ScalarMap mrcOf(const std::string& bytes, const std::string& path)
{
    const MrcWords words(bytes);
    const int mode = words.integer(4);
    const std::size_t width = mrcWidth(mode);
    if (width == 0)
        failAt(path, "expected a map of mode 0, 1, 2, 6 or 12, got " + std::to_string(mode));
    for (const std::size_t word : {14, 15, 16})
        if (std::abs(words.real(word) - 90.0) > 1e-3 && words.real(word) != 0.0)
            failAt(path, "expected a map whose cell has right angles, got one of " +
                             shortest(words.real(word)) + " degrees");
    std::size_t sizes[3], axes[3]; // of columns, rows and sections
    std::size_t count = 1, axesSeen = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t size = words.integer(1 + k), axis = words.integer(17 + k);
        if (size < 2 || size > 100000) failAt(path, "expected a map of 2 to 100000 points a side");
        sizes[k] = std::size_t(size);
        axes[k] = axis >= 1 && axis <= 3 ? std::size_t(axis - 1) : k;
        axesSeen |= std::size_t(1) << axes[k];
        count *= sizes[k];
    }
    if (axesSeen != 7) failAt(path, "expected three axes in MAPC, MAPR and MAPS");
    const std::int32_t extended = words.integer(24);
    const std::size_t begin = mrcHeader + std::size_t(std::max(extended, 0));
    if (bytes.size() < begin || (bytes.size() - begin) / width < count)
        failAt(path, "is cut short: expected " + std::to_string(count) + " values");
    ScalarMap out;
    bool hasOrigin = false;
    for (const std::size_t word : {50, 51, 52}) hasOrigin = hasOrigin || words.real(word) != 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t a = axes[k];
        const std::int32_t intervals = words.integer(8 + a);
        const double length = words.real(11 + a);
        if (intervals < 1 || !(length > 0.0))
            failAt(path, "expected a cell with edges and intervals above 0");
        out.counts[a] = sizes[k];
        out.spacing[int(a)] = length / intervals;
        out.origin[int(a)] =
            hasOrigin ? words.real(50 + a) : words.integer(5 + k) * out.spacing[int(a)];
    }
    std::size_t steps[3]; // in `values`, of columns, rows and sections
    for (std::size_t k = 0; k < 3; ++k)
        steps[k] = axes[k] == 2 ? 1 : axes[k] == 1 ? out.counts[2] : out.counts[1] * out.counts[2];
    out.values.resize(count);
    std::size_t i = 0;
    for (std::size_t s = 0; s < sizes[2]; ++s)
        for (std::size_t r = 0; r < sizes[1]; ++r)
            for (std::size_t c = 0; c < sizes[0]; ++c) {
                const float value = words.value(begin, i++, mode);
                if (!std::isfinite(value)) failAt(path, "expected finite values");
                out.values[c * steps[0] + r * steps[1] + s * steps[2]] = value;
            }
    return out;
}

} // namespace

ScalarMap readMrc(const std::string& path, std::size_t maxBytes)
{
    const std::string bytes = loadUnpacked(path, maxBytes);
    if (!isMrc(bytes)) failAt(path, "expected a map of MRC2014 or CCP4");
    return mrcOf(bytes, path);
}

std::size_t pointsOfMap(const std::string& path)
{
    if (readsOnce(path)) return 0;
    const auto product = [](double x, double y, double z) {
        return x >= 1.0 && y >= 1.0 && z >= 1.0 && x * y * z < 1e15 ? std::size_t(x * y * z) : 0;
    };
    try {
        const std::string begin = unpackedBegin(path, mrcHeader);
        if (isMrc(begin)) {
            const MrcWords words(begin);
            return product(words.integer(1), words.integer(2), words.integer(3));
        }
        LineReader lines(begin);
        while (lines.next()) {
            const Fields fields = splitFields(lines.line());
            if (fields.empty() || fields[0][0] == '#') continue;
            double counts[3] = {};
            if (fields.size() != 8 || fields[0] != "object" || fields[3] != "gridpositions")
                return 0;
            for (std::size_t a = 0; a < 3; ++a) parseWhole(fields[5 + a], counts[a]);
            return product(counts[0], counts[1], counts[2]);
        }
    } catch (const Error&) { // it cannot be read
    }
    return 0;
}

ScalarMap readMap(const std::string& path, std::size_t maxBytes)
{
    return isMrc(unpackedBegin(path, mrcHeader)) ? readMrc(path, maxBytes) : readDx(path, maxBytes);
}

} // namespace molsurf
