// SPDX-License-Identifier: MPL-2.0
#include "support/exact_minimum.h"

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>

namespace molsurf::test
{

double minimalRadius(double R, const Energy& energy)
{
    const double C = M_LN2 / (energy.epsilon * R);
    // r^2 w and with E = e^psi, psi = -C (r^2 - R^2): g = 1 - E, g' = 2 C r E.
    // w = g^2 + lambda (2 C r E)^2 or + lambda;  E' = -2 C r E.
    const auto slope = [&](double r) {
        const double E = std::exp(-C * (r * r - R * R)), a = 2.0 * C * r;
        const double g = 1.0 - E;
        double w = g * g, dw = 2.0 * g * a * E;
        if (energy.regularizer == Regularizer::Gradient) {
            w += energy.lambda * a * a * E * E;
            dw += energy.lambda * (8.0 * C * C * r * E * E - 2.0 * a * a * a * E * E);
        } else {
            w += energy.lambda;
        }
        return 2.0 * r * w + r * r * dw;
    };
    // The derivative rises through zero at a minimum: the sign change nearest to R is bracketed.
    const double step = 0.01;
    double best = -1.0;
    for (double r = 0.3 * R; r < 1.5 * R; r += step) {
        if (slope(r) < 0.0 && slope(r + step) >= 0.0 &&
            (best < 0.0 || std::abs(r - R) < std::abs(best - R)))
            best = r;
    }
    if (best < 0.0) return NAN;
    std::uintmax_t rounds = 100;
    const auto root = boost::math::tools::toms748_solve(
        slope, best, best + step, boost::math::tools::eps_tolerance<double>(45), rounds);
    return 0.5 * (root.first + root.second);
}

double PolarCurve::at(double theta) const
{
    // Cubic through four nodes; the curve is even about both ends.
    const int n = int(rho.size()) - 1;
    const double t = theta / M_PI * n;
    const int i = std::clamp(int(t), 0, n - 1);
    const double s = t - i;
    const auto node = [&](int k) { return rho[k < 0 ? -k : k > n ? 2 * n - k : k]; };
    return -s * (s - 1) * (s - 2) / 6.0 * node(i - 1) +
           (s + 1) * (s - 1) * (s - 2) / 2.0 * node(i) - (s + 1) * s * (s - 2) / 2.0 * node(i + 1) +
           (s + 1) * s * (s - 1) / 6.0 * node(i + 2);
}

namespace
{

struct Field {
    const std::vector<AxisBall>& balls;
    Energy energy;

    double psi(double z, double r) const
    {
        double sum = 0.0;
        for (const AxisBall& b : balls)
            sum += std::exp(-M_LN2 / (energy.epsilon * b.R) *
                            ((z - b.z) * (z - b.z) + r * r - b.R * b.R));
        return std::log(sum);
    }
    double w(double z, double r) const
    {
        double sum = 0.0, gz = 0.0, gr = 0.0;
        for (const AxisBall& b : balls) {
            const double C = M_LN2 / (energy.epsilon * b.R);
            const double e = std::exp(-C * ((z - b.z) * (z - b.z) + r * r - b.R * b.R));
            sum += e;
            gz += 2.0 * C * (z - b.z) * e;
            gr += 2.0 * C * r * e;
        }
        const double g = 1.0 - sum;
        const double h = energy.regularizer == Regularizer::Gradient ? gz * gz + gr * gr : 1.0;
        return g * g + energy.lambda * h;
    }
    /// Energy of the element between two nodes.
    double element(double a, double b, double theta, double step) const
    {
        const double rho = 0.5 * (a + b), slope = (b - a) / step;
        const double c = std::cos(theta), s = std::sin(theta);
        return 2.0 * M_PI * rho * s * w(rho * c, rho * s) * std::sqrt(rho * rho + slope * slope) *
               step;
    }
};

} // namespace

PolarCurve minimalCurve(const std::vector<AxisBall>& balls, const Energy& energy, int n)
{
    const Field field{balls, energy};
    const double step = M_PI / n;
    PolarCurve curve;
    for (int i = 0; i <= n; ++i) { // psi = 0 by bisection
        double low = 0.1, high = 30.0;
        for (int k = 0; k < 60; ++k) {
            const double t = 0.5 * (low + high);
            (field.psi(t * std::cos(i * step), t * std::sin(i * step)) > 0.0 ? low : high) = t;
        }
        curve.rho.push_back(low);
    }
    const auto total = [&](const std::vector<double>& rho) {
        double sum = 0.0;
        for (int i = 0; i < n; ++i)
            sum += field.element(rho[i], rho[i + 1], (i + 0.5) * step, step);
        return sum;
    };
    double damping = 1e-3, now = total(curve.rho);
    for (int round = 0; round < 300; ++round) {
        // Gradient and tridiagonal Hessian by central differences of the elements.
        std::vector<double> gradient(n + 1, 0.0), diagonal(n + 1, 0.0), off(n, 0.0);
        const double d = 1e-4;
        for (int i = 0; i < n; ++i) {
            const double a = curve.rho[i], b = curve.rho[i + 1], t = (i + 0.5) * step;
            const auto e = [&](double da, double db) {
                return field.element(a + da, b + db, t, step);
            };
            const double e0 = e(0, 0), pa = e(d, 0), ma = e(-d, 0), pb = e(0, d), mb = e(0, -d);
            gradient[i] += (pa - ma) / (2.0 * d);
            gradient[i + 1] += (pb - mb) / (2.0 * d);
            diagonal[i] += (pa - 2.0 * e0 + ma) / (d * d);
            diagonal[i + 1] += (pb - 2.0 * e0 + mb) / (d * d);
            off[i] = (e(d, d) - e(d, -d) - e(-d, d) + e(-d, -d)) / (4.0 * d * d);
        }
        for (int attempt = 0; attempt < 40; ++attempt) {
            std::vector<double> upper(n + 1), move(n + 1);
            double pivot = 0.0;
            for (int i = 0; i <= n; ++i) {
                const double lower = i > 0 ? off[i - 1] : 0.0;
                pivot = diagonal[i] + damping * (1e-3 + std::abs(diagonal[i])) -
                        (i > 0 ? lower * upper[i - 1] : 0.0);
                upper[i] = i < n ? off[i] / pivot : 0.0;
                move[i] = (-gradient[i] - (i > 0 ? lower * move[i - 1] : 0.0)) / pivot;
            }
            for (int i = n - 1; i >= 0; --i) move[i] -= upper[i] * move[i + 1];
            double largest = 0.0;
            std::vector<double> next = curve.rho;
            for (int i = 0; i <= n; ++i) {
                next[i] += std::clamp(move[i], -0.1, 0.1);
                largest = std::max(largest, std::abs(move[i]));
            }
            const double after = total(next);
            if (largest < 1e-7 && damping < 1e-2) {
                curve.rho = next;
                curve.stationary = true;
                return curve;
            }
            if (after <= now * (1.0 + 1e-12)) {
                curve.rho = next;
                now = after;
                damping = std::max(0.2 * damping, 1e-9);
                break;
            }
            damping *= 5.0;
        }
    }
    return curve;
}

} // namespace molsurf::test
