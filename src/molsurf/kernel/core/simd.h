// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Instruction sets for the hot loops, the vectors they use, and an exponential and a logarithm
/// that the compiler can vectorise.

#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

/// Put before a hot function with plain loops: the compiler makes one version of it for each
/// instruction set, and the loader picks the widest that the machine has. A macro, since an
/// attribute cannot be had otherwise; off under sanitizers, whose run time is not ready when the
/// loader picks. (Defined as nothing by the build it gives the portable path.)
#ifndef MOLSURF_KERNEL
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define MOLSURF_KERNEL __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define MOLSURF_KERNEL
#endif
#endif

/// Put before a function that has to become part of the kernel that calls it: only so does it use
/// the kernel's instruction set, and its vectors stay in registers.
#define MOLSURF_INLINE inline __attribute__((always_inline))

// GCC warns that a vector is returned in another way with AVX than without it. The functions below
// become part of their callers and return nothing at run time.
#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace molsurf
{

/// Vectors of 32 bytes, the width of AVX2. Wider ones are slower: GCC 12 splits their comparisons
/// into single numbers, except those in the condition of ?: with AVX-512. The alignment stands
/// before the vector, where clang heeds it, too.
constexpr int floatLanes = 8, doubleLanes = 4;
using Floats __attribute__((aligned(4))) = float __attribute__((vector_size(32)));
using Ints __attribute__((aligned(4))) = std::int32_t __attribute__((vector_size(32)));
using Doubles __attribute__((aligned(8))) = double __attribute__((vector_size(32)));
using Longs __attribute__((aligned(8))) = std::int64_t __attribute__((vector_size(32)));
/// Four floats, one for each of the cubic B-splines that overlap a cell.
using Floats4 __attribute__((aligned(4))) = float __attribute__((vector_size(16)));

/// The vector that begins at p, which needs no alignment beyond that of its numbers.
MOLSURF_INLINE Floats load(const float* p)
{
    return *reinterpret_cast<const Floats*>(p);
}
MOLSURF_INLINE Ints load(const std::int32_t* p)
{
    return *reinterpret_cast<const Ints*>(p);
}
MOLSURF_INLINE Doubles load(const double* p)
{
    return *reinterpret_cast<const Doubles*>(p);
}
MOLSURF_INLINE Floats4 load4(const float* p)
{
    return *reinterpret_cast<const Floats4*>(p);
}

/// Writes a vector to p, which needs no alignment beyond that of its numbers.
MOLSURF_INLINE void store(float* p, Floats v)
{
    *reinterpret_cast<Floats*>(p) = v;
}
MOLSURF_INLINE void store(std::int32_t* p, Ints v)
{
    *reinterpret_cast<Ints*>(p) = v;
}
MOLSURF_INLINE void store4(float* p, Floats4 v)
{
    *reinterpret_cast<Floats4*>(p) = v;
}

/// The vector that has one number in all lanes; 0 for -0. It is added to 0 in place because GCC 12
/// inserts the lanes one by one otherwise.
MOLSURF_INLINE Floats splat(float c)
{
    Floats v = {};
    v += c;
    return v;
}
MOLSURF_INLINE Ints splat(std::int32_t c)
{
    Ints v = {};
    v += c;
    return v;
}

/// The vector 0, 1, 2, ...
MOLSURF_INLINE Ints laneNumbers()
{
    return Ints{0, 1, 2, 3, 4, 5, 6, 7};
}

/// The square root of each lane.
MOLSURF_INLINE Floats squareRoot(Floats x)
{
    alignas(32) float values[floatLanes];
    std::memcpy(values, &x, sizeof values);
    for (float& v : values) v = std::sqrt(v);
    std::memcpy(&x, values, sizeof values);
    return x;
}
MOLSURF_INLINE Doubles squareRoot(Doubles x)
{
    for (int l = 0; l < doubleLanes; ++l) x[l] = std::sqrt(x[l]);
    return x;
}

/// The smaller and the larger of two numbers, lane by lane; b where they do not compare.
MOLSURF_INLINE Floats smaller(Floats a, Floats b)
{
    return a < b ? a : b;
}
MOLSURF_INLINE Floats larger(Floats a, Floats b)
{
    return a > b ? a : b;
}
MOLSURF_INLINE Floats clamped(Floats x, Floats low, Floats high)
{
    return smaller(larger(x, low), high);
}
MOLSURF_INLINE Floats size(Floats x)
{
    return larger(x, -x);
}

/// Bit l in lane l.
MOLSURF_INLINE Ints laneBits()
{
    return splat(1) << laneNumbers();
}

/// The bits of all lanes together.
MOLSURF_INLINE std::uint32_t bitsOf(Ints v)
{
    std::uint64_t pairs[floatLanes / 2], all = 0;
    std::memcpy(pairs, &v, sizeof pairs);
    for (const std::uint64_t pair : pairs) all |= pair;
    return std::uint32_t(all | all >> 32);
}

/// Whether a condition holds in any lane.
MOLSURF_INLINE bool any(Ints condition)
{
    return bitsOf(condition) != 0;
}
MOLSURF_INLINE bool any(Longs condition)
{
    Ints halves;
    std::memcpy(&halves, &condition, sizeof halves);
    return bitsOf(halves) != 0;
}

/// Makes its thread take denormal numbers (below 1e-38 in float) for 0 while it lives. Products of
/// exponentials run into them, and many processors take a hundred times as long there.
class FlushDenormals
{
public:
#ifdef __SSE__
    FlushDenormals()
    {
        _mm_setcsr(before_ | results | operands);
    }
    ~FlushDenormals()
    {
        _mm_setcsr(before_);
    }
#else
    FlushDenormals() {}
#endif
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

#ifdef __SSE__
private:
    static constexpr unsigned results = 0x8000, operands = 0x40; // "flush to zero" and "are zeros"
    const unsigned before_ = _mm_getcsr();
#endif
};

/// The smaller and the larger of two numbers, by value: std::min and std::max hand out references,
/// which keeps loops over arrays from vectorising.
MOLSURF_INLINE float smaller(float a, float b)
{
    return a < b ? a : b;
}
MOLSURF_INLINE float larger(float a, float b)
{
    return a > b ? a : b;
}
MOLSURF_INLINE float clamped(float x, float low, float high)
{
    return smaller(larger(x, low), high);
}

/// The whole number towards zero from a number, lane by lane.
MOLSURF_INLINE std::int32_t truncated(float x)
{
    return std::int32_t(x);
}
MOLSURF_INLINE Ints truncated(Floats x)
{
    return __builtin_convertvector(x, Ints);
}

/// e^x in float, relative error below 3e-7, for |x| <= 87; x is clamped to that range. Without
/// branches or calls, so that loops over it vectorise. Cody-Waite reduction by ln 2, then the
/// Taylor polynomial of degree 6 on [-ln 2/2, ln 2/2].
/// @tparam T  float, or Floats for eight at a time
template<typename T>
MOLSURF_INLINE T fastExp(T x)
{
    x = clamped(x, T{} - 87.0f, T{} + 87.0f);
    const float shifter = 12582912.0f; // 1.5 * 2^23: adding it rounds to an integer
    const T k = (x * 1.44269504f + shifter) - shifter;
    const T r = (x - k * 0.693359375f) + k * 2.12194440e-4f;
    T p = T{} + 1.0f / 720.0f;
    p = p * r + 1.0f / 120.0f;
    p = p * r + 1.0f / 24.0f;
    p = p * r + 1.0f / 6.0f;
    p = p * r + 0.5f;
    p = p * r + 1.0f;
    p = p * r + 1.0f;
    const auto bits = (truncated(k) + 127) << 23; // 2^k
    T scale;
    static_assert(sizeof scale == sizeof bits);
    std::memcpy(&scale, &bits, sizeof scale);
    return p * scale;
}

/// The same in double, relative error below 1e-15, for |x| <= 700; four at a time.
MOLSURF_INLINE Doubles fastExp(Doubles x)
{
    const double shifter = 6755399441055744.0; // 1.5 * 2^52: adding it rounds to an integer
    x = x < -700.0 ? Doubles{} - 700.0 : x;
    x = x > 700.0 ? Doubles{} + 700.0 : x;
    const Doubles shifted = x * 1.4426950408889634 + shifter, k = shifted - shifter;
    const Doubles r = (x - k * 0.693145751953125) - k * 1.42860682030941723212e-6;
    Doubles p = Doubles{} + 1.0 / 6227020800.0; // 1/13!
    for (const double c :
         {1.0 / 479001600.0, 1.0 / 39916800.0, 1.0 / 3628800.0, 1.0 / 362880.0, 1.0 / 40320.0,
          1.0 / 5040.0, 1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0})
        p = p * r + c;
    Longs bits;
    std::memcpy(&bits, &shifted, sizeof bits);
    bits = (bits + 1023) << 52; // 2^k: the low bits of shifted are k
    Doubles scale;
    std::memcpy(&scale, &bits, sizeof scale);
    return p * scale;
}

/// ln x in float for finite normal x > 0, absolute error below 2e-7 (1 + |ln x|). Like fastExp():
/// ln m = 2 artanh((m - 1)/(m + 1)) for the fraction m in [2/3, 4/3), by its Taylor series.
MOLSURF_INLINE float fastLog(float x)
{
    std::int32_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    const std::int32_t exponent = (bits - 0x3f2aaaab) >> 23; // of 2/3
    bits -= exponent * (1 << 23);
    float m;
    std::memcpy(&m, &bits, sizeof m);
    const float s = (m - 1.0f) / (m + 1.0f), s2 = s * s;
    float p = 1.0f / 9.0f;
    p = p * s2 + 1.0f / 7.0f;
    p = p * s2 + 1.0f / 5.0f;
    p = p * s2 + 1.0f / 3.0f;
    const float k = float(exponent);
    return k * 0.693359375f + (2.0f * (s + s * s2 * p) - k * 2.12194440e-4f);
}

} // namespace molsurf
