// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Where a function of a number vanishes.

#include <cmath>

namespace molsurf
{

/// When zeroBetween() ends.
struct ZeroAccuracy {
    int steps;       ///< after so many
    double interval; ///< or where the zero is known to lie within so much
    double value;    ///< or where the function is below this in size
};

/// Finds where a function vanishes that is below 0 at 0 and above 0 at 1, by regula falsi
/// (Illinois).
/// @param[in] below,above  the function at 0 and 1
/// @return the last place that it was taken at
template<typename F>
double zeroBetween(double below, double above, const ZeroAccuracy& accuracy, const F& f)
{
    double low = 0.0, high = 1.0, t = 0.5;
    for (int i = 0; i < accuracy.steps && high - low > accuracy.interval; ++i) {
        t = low + (high - low) * below / (below - above);
        if (!(t > low && t < high)) t = 0.5 * (low + high);
        const double value = f(t);
        if (std::abs(value) < accuracy.value) break;
        if (value < 0.0) {
            low = t;
            below = value;
            above *= 0.5;
        } else {
            high = t;
            above = value;
            below *= 0.5;
        }
    }
    return t;
}

} // namespace molsurf
