// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/core/superposition.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace molsurf
{

namespace
{

using openvdb::Vec3d;
using Matrix4 = std::array<std::array<double, 4>, 4>;

/// Eigenvalues of a symmetric matrix, with eigenvectors in the columns of `vectors`: cyclic
/// rotations of Jacobi, which converge quadratically.
std::array<double, 4> eigenvalues(Matrix4 a, Matrix4& vectors)
{
    vectors = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    constexpr int sweeps = 50; // 6 to 8 suffice
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        double off = 0.0, all = 0.0;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) (i == j ? all : off) += a[i][j] * a[i][j];
        if (off <= 1e-32 * all) break;
        for (int p = 0; p < 3; ++p)
            for (int q = p + 1; q < 4; ++q) {
                if (a[p][q] == 0.0) continue;
                const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
                const double t =
                    std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
                const double c = 1.0 / std::hypot(t, 1.0), s = t * c;
                for (int k = 0; k < 4; ++k) {
                    const double x = a[k][p], y = a[k][q];
                    a[k][p] = c * x - s * y;
                    a[k][q] = s * x + c * y;
                }
                for (int k = 0; k < 4; ++k) {
                    const double x = a[p][k], y = a[q][k];
                    a[p][k] = c * x - s * y;
                    a[q][k] = s * x + c * y;
                }
                for (int k = 0; k < 4; ++k) {
                    const double x = vectors[k][p], y = vectors[k][q];
                    vectors[k][p] = c * x - s * y;
                    vectors[k][q] = s * x + c * y;
                }
            }
    }
    return {a[0][0], a[1][1], a[2][2], a[3][3]};
}

Vec3d middleOf(const std::vector<Vec3d>& points)
{
    return std::accumulate(points.begin(), points.end(), Vec3d(0.0)) / double(points.size());
}

/// The rows of the rotation by a unit quaternion.
std::array<std::array<double, 3>, 3> rotationBy(double w, double x, double y, double z)
{
    return {{{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
             {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
             {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}}};
}

} // namespace

std::optional<Superposition> superposition(const std::vector<Vec3d>& points,
                                           const std::vector<Vec3d>& onto)
{
    if (points.size() < 3) return std::nullopt;
    const Vec3d from = middleOf(points), to = middleOf(onto);
    double s[3][3] = {}; // sums of products of coordinates
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec3d a = points[k] - from, b = onto[k] - to;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) s[i][j] += a[i] * b[j];
    }
    const Matrix4 horn = {
        {{s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]},
         {s[1][2] - s[2][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]},
         {s[2][0] - s[0][2], s[0][1] + s[1][0], s[1][1] - s[0][0] - s[2][2], s[1][2] + s[2][1]},
         {s[0][1] - s[1][0], s[2][0] + s[0][2], s[1][2] + s[2][1], s[2][2] - s[0][0] - s[1][1]}}};
    Matrix4 vectors;
    std::array<double, 4> values = eigenvalues(horn, vectors);
    const auto best = std::size_t(std::max_element(values.begin(), values.end()) - values.begin());
    const double largest = values[best];
    values[best] = -INFINITY;
    const double next = *std::max_element(values.begin(), values.end());
    constexpr double least = 1e-9; // of the largest eigenvalue, above its rounding
    if (!(largest - next > least * std::abs(largest))) return std::nullopt;

    Superposition found;
    found.rotation =
        rotationBy(vectors[0][best], vectors[1][best], vectors[2][best], vectors[3][best]);
    found.translation = to - found.turned(from);
    found.pairs = points.size();
    double sum = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k)
        sum += (found.placed(points[k]) - onto[k]).lengthSqr();
    found.rmsd = std::sqrt(sum / double(points.size()));
    return found;
}

} // namespace molsurf
