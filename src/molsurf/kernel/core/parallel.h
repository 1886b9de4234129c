// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Loops over leaves on all threads, with sums that have the same bits for any number of them.

#include "molsurf/progress.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

namespace molsurf
{

/// Calls f(i) for every i in [0, n) in parallel.
///
/// @throws Cancelled soon after the progress object wants the run to stop
template<typename F>
void parallelFor(std::size_t n, const Progress& progress, const F& f)
{
    std::atomic<bool> stop{false};
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 8), [&](const auto& range) {
        if (stop.load(std::memory_order_relaxed) || progress.cancelled()) {
            stop = true;
            return;
        }
        for (std::size_t i = range.begin(); i != range.end(); ++i) f(i);
    });
    if (stop) throw Cancelled();
}

/// The sum of f(i) over [0, n): computed in parallel, added up in ascending order.
/// @tparam T  a value with operator+= and a default that is zero
template<typename T, typename F>
T parallelSum(std::size_t n, const Progress& progress, const F& f)
{
    std::vector<T> slots(n);
    parallelFor(n, progress, [&](std::size_t i) { slots[i] = f(i); });
    T sum{};
    for (const T& slot : slots) sum += slot;
    return sum;
}

/// Calls f(i, out) in parallel for i in [0, n) and returns what they append to `out`, in ascending
/// order of i.
template<typename T, typename F>
std::vector<T> parallelCollect(std::size_t n, const Progress& progress, const F& f)
{
    constexpr std::size_t chunk = 4096;
    std::vector<std::vector<T>> parts((n + chunk - 1) / chunk);
    parallelFor(parts.size(), progress, [&](std::size_t c) {
        for (std::size_t i = c * chunk; i < std::min(n, (c + 1) * chunk); ++i) f(i, parts[c]);
    });
    std::vector<std::size_t> begins(parts.size() + 1, 0);
    for (std::size_t c = 0; c < parts.size(); ++c) begins[c + 1] = begins[c] + parts[c].size();
    std::vector<T> out(begins.back());
    parallelFor(parts.size(), progress, [&](std::size_t c) {
        std::copy(parts[c].begin(), parts[c].end(), out.begin() + std::ptrdiff_t(begins[c]));
        parts[c] = std::vector<T>();
    });
    return out;
}

/// Keeps the elements of an array that keep(i) names, in their order and in their place in memory.
/// keep(i) may look at element i, and at no other of the array.
template<typename T, typename F>
void parallelKeep(std::vector<T>& values, const Progress& progress, const F& keep)
{
    constexpr std::size_t chunk = 4096;
    const std::size_t n = values.size(), chunks = (n + chunk - 1) / chunk;
    std::vector<std::size_t> begins(chunks + 1, 0); // of what stays
    parallelFor(chunks, progress, [&](std::size_t c) {
        for (std::size_t i = c * chunk; i < std::min(n, (c + 1) * chunk); ++i)
            begins[c + 1] += keep(i) ? 1 : 0;
    });
    for (std::size_t c = 0; c < chunks; ++c) begins[c + 1] += begins[c];
    std::vector<std::vector<T>> early(chunks); // what moves to the place of another chunk
    parallelFor(chunks, progress, [&](std::size_t c) {
        std::size_t at = begins[c];
        for (std::size_t i = c * chunk; i < std::min(n, (c + 1) * chunk); ++i) {
            if (!keep(i)) continue;
            at < c* chunk ? early[c].push_back(values[i]) : void(values[at] = values[i]);
            ++at;
        }
    });
    parallelFor(chunks, progress, [&](std::size_t c) {
        std::copy(early[c].begin(), early[c].end(), values.begin() + std::ptrdiff_t(begins[c]));
    });
    values.resize(begins.back());
}

} // namespace molsurf
