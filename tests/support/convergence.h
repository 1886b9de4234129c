// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Points in general position, observed orders of convergence, and a table of them for the message
/// of a failing test.

#include <openvdb/Types.h>

#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

namespace molsurf::test
{

/// n unit vectors spread evenly over the sphere (a Fibonacci lattice), turned so that none lies on
/// an axis.
inline std::vector<openvdb::Vec3d> directions(int n)
{
    std::vector<openvdb::Vec3d> out;
    const double golden = M_PI * (3.0 - std::sqrt(5.0));
    for (int i = 0; i < n; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / n, r = std::sqrt(1.0 - z * z);
        const double a = golden * i + 0.3;
        const double x = r * std::cos(a), y = r * std::sin(a);
        const double c = std::cos(0.7), s = std::sin(0.7); // about the x axis
        out.emplace_back(x, c * y - s * z, s * y + c * z);
    }
    return out;
}

/// The slope of ln error over ln h, by least squares.
inline double observedOrder(const std::vector<double>& h, const std::vector<double>& error)
{
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    const double n = double(h.size());
    for (std::size_t i = 0; i < h.size(); ++i) {
        const double a = std::log(h[i]), b = std::log(error[i]);
        x += a;
        y += b;
        xx += a * a;
        xy += a * b;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

/// Spacing, error and order between neighbouring grids, one line each.
inline std::string table(const std::vector<double>& h, const std::vector<double>& error)
{
    std::ostringstream out;
    out << "\n     h [Å]      error   order\n";
    for (std::size_t i = 0; i < h.size(); ++i) {
        out << std::fixed << std::setprecision(4) << std::setw(10) << h[i] << std::scientific
            << std::setprecision(3) << std::setw(11) << error[i];
        if (i == 0) {
            out << "       -\n";
        } else {
            out << std::fixed << std::setprecision(2) << std::setw(8)
                << std::log(error[i - 1] / error[i]) / std::log(h[i - 1] / h[i]) << '\n';
        }
    }
    return out.str();
}

} // namespace molsurf::test
