// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/selection/scalar_map.h"

#include "molsurf/error.h"
#include "molsurf/kernel/core/strings.h"
#include "molsurf/molecule/structure/load_text.h"
#include "molsurf/molecule/structure/text_fields.h"

#include <algorithm>
#include <cmath>
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

} // namespace molsurf
