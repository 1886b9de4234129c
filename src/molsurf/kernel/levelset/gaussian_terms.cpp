// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/levelset/gaussian_terms.h"

#include "molsurf/kernel/core/simd.h"

#include <algorithm>
#include <cmath>

namespace molsurf
{

namespace
{

constexpr int octants = 8;

/// A sum below this may have lost terms to underflow.
constexpr float smallestSum = 1e-30f;

MOLSURF_INLINE Floats square(Floats x)
{
    return x * x;
}

} // namespace

void GaussianLists::resize(std::size_t balls)
{
    for (auto* list : {&x, &y, &z}) list->resize(balls + floatLanes, 0.0);
    for (auto* list : {&decay, &level, &rim, &felt2, &felt}) list->resize(balls + floatLanes, 0.0f);
}

GaussianLeaf::GaussianLeaf(const openvdb::Coord& origin, double voxelSize, double reach_)
    : low(origin.asVec3d() * voxelSize), inverse(1.0 / voxelSize), reach(float(reach_))
{
}

namespace
{

/// addTerms() for lists that have room: eight balls at a time, those of them that count by the
/// square of their distance from the box [0, 7]^3 of the leaf's voxels.
MOLSURF_KERNEL void appendTerms(const GaussianLists& balls, std::int32_t begin, std::int32_t end,
                                const GaussianLeaf& leaf, GaussianTerms& terms)
{
    const std::vector<double>* centres[3] = {&balls.x, &balls.y, &balls.z};
    std::size_t count = terms.count;
    for (std::int32_t i = begin; i < end; i += floatLanes) {
        alignas(32) float from[3][floatLanes]; // the leaf's first voxel
        Floats apart2 = {};
        for (int a = 0; a < 3; ++a) {
            const double* centre = centres[a]->data() + i;
            for (int l = 0; l < floatLanes; ++l)
                from[a][l] = float((centre[l] - leaf.low[a]) * leaf.inverse);
            apart2 += square(larger(size(load(from[a]) - 3.5f) - 3.5f, Floats{}));
        }
        const Floats felt =
            larger(square(load(balls.rim.data() + i) + leaf.reach), load(balls.felt2.data() + i));
        const Ints counts = (apart2 <= felt) & (laneNumbers() < splat(end - i)); // not the padding
        for (std::uint32_t bits = bitsOf(counts & laneBits()); bits != 0; bits &= bits - 1) {
            const int l = __builtin_ctz(bits);
            terms.x[count] = from[0][l];
            terms.y[count] = from[1][l];
            terms.z[count] = from[2][l];
            terms.decay[count] = balls.decay[std::size_t(i + l)];
            terms.level[count] = balls.level[std::size_t(i + l)];
            ++count;
        }
    }
    terms.count = count;
}

} // namespace

void addTerms(const GaussianLists& balls, std::int32_t begin, std::int32_t end,
              const GaussianLeaf& leaf, GaussianTerms& terms)
{
    const std::size_t most = terms.count + std::size_t(end - begin) + floatLanes;
    if (most > terms.x.size()) {
        for (auto* list : {&terms.x, &terms.y, &terms.z, &terms.decay, &terms.level})
            list->resize(2 * most);
    }
    appendTerms(balls, begin, end, leaf, terms);
}

namespace
{

/// Squares of the distances from a coordinate to the nearest and the farthest of voxels 0 to 3 and
/// of voxels 4 to 7.
struct Halves {
    Floats near[2], far[2];
    MOLSURF_INLINE explicit Halves(Floats c)
    {
        for (int half = 0; half < 2; ++half) {
            const Floats d = size(c - (1.5f + 4.0f * float(half)));
            near[half] = square(larger(d - 1.5f, Floats{}));
            far[half] = square(d + 1.5f);
        }
    }
};

/// Bounds of the exponents of all terms in the octants of a leaf.
MOLSURF_KERNEL void boundBy8(const GaussianTerms& t, GaussianBounds& bounds)
{
    Floats top = splat(GaussianTerms::noExponent), floor[octants];
    for (Floats& f : floor) f = top;
    for (std::size_t i = 0; i < t.count; i += floatLanes) {
        const Floats decay = load(t.decay.data() + i), level = load(t.level.data() + i);
        const Halves x(load(t.x.data() + i)), y(load(t.y.data() + i)), z(load(t.z.data() + i));
        float* upper = bounds.upper.data() + octants * i;
        for (int o = 0; o < octants; ++o) {
            const Floats near = x.near[o >> 2] + y.near[o >> 1 & 1] + z.near[o & 1];
            const Floats far = x.far[o >> 2] + y.far[o >> 1 & 1] + z.far[o & 1];
            const Floats most = level - decay * near;
            store(upper + floatLanes * o, most);
            top = larger(top, most);
            floor[o] = larger(floor[o], level - decay * far);
        }
    }
    bounds.top = top[0];
    for (int l = 1; l < floatLanes; ++l) bounds.top = larger(bounds.top, top[l]);
    for (int o = 0; o < octants; ++o) {
        bounds.floor[o] = floor[o][0];
        for (int l = 1; l < floatLanes; ++l) bounds.floor[o] = larger(bounds.floor[o], floor[o][l]);
    }
}

} // namespace

void boundTerms(GaussianTerms& terms, GaussianBounds& bounds)
{
    if (terms.count == 0) {
        bounds.top = GaussianTerms::noExponent;
        std::fill_n(bounds.floor, octants, GaussianTerms::noExponent);
        return;
    }
    for (int l = 0; l < floatLanes; ++l) {
        terms.x[terms.count + l] = terms.y[terms.count + l] = terms.z[terms.count + l] = 0.0f;
        terms.decay[terms.count + l] = 0.0f;
        terms.level[terms.count + l] = GaussianTerms::noExponent;
    }
    const std::size_t padded = octants * (terms.count + floatLanes);
    if (padded > bounds.upper.size()) bounds.upper.resize(2 * padded);
    boundBy8(terms, bounds);
}

float GaussianBounds::least() const
{
    return *std::min_element(floor, floor + octants);
}

float GaussianBounds::most(std::size_t terms) const
{
    return terms == 0 ? lowestPsi : top + std::log(float(terms));
}

namespace
{

/// The exponentials of a term at the 8 coordinates along x, y and z: the term at a voxel is e^top
/// times the product of three, of which those of y and z are at most 1.
MOLSURF_INLINE void tabulate(const GaussianTerms& t, std::size_t i, float top, float* out)
{
    const Floats voxel = __builtin_convertvector(laneNumbers(), Floats);
    const auto near2 = [](float c) { // squared distance to the nearer of [0, 3] and [4, 7]
        const float d = larger(std::abs(std::abs(c - 3.5f) - 2.0f) - 1.5f, 0.0f);
        return d * d;
    };
    const float decay = t.decay[i], nearY2 = near2(t.y[i]), nearZ2 = near2(t.z[i]);
    const float above = t.level[i] - decay * (nearY2 + nearZ2) - top;
    store(out, fastExp(above - decay * square(voxel - t.x[i])));
    store(out + 8, fastExp(decay * (nearY2 - square(voxel - t.y[i]))));
    store(out + 16, fastExp(decay * (nearZ2 - square(voxel - t.z[i]))));
}

/// Tabulates the terms that count in some octant, and lists for each octant the places of its terms
/// in this table. Without branches: each is written to all eight lists, `stride` apart, and counted
/// where it belongs.
MOLSURF_KERNEL void listTerms(const GaussianTerms& t, const GaussianBounds& bounds,
                              std::size_t stride, GaussianTables& tables)
{
    std::size_t counts[octants] = {};
    std::int32_t* list = tables.list.data();
    float* out = tables.exponentials.data();
    std::int32_t used = 0;
    for (std::size_t i = 0; i < t.count; i += floatLanes) {
        const float* upper = bounds.upper.data() + octants * i;
        Ints where = {}; // a bit for each octant
        for (int o = 0; o < octants; ++o)
            where |= (load(upper + floatLanes * o) >= bounds.floor[o] - negligible) & (1 << o);
        if (!any(where)) continue;
        for (int l = 0; l < floatLanes; ++l) {
            const std::uint32_t bits = std::uint32_t(where[l]);
            if (bits == 0) continue;
            tabulate(t, i + std::size_t(l), bounds.top, out + 24 * used);
            for (std::size_t o = 0; o < octants; ++o) {
                list[o * stride + counts[o]] = used;
                counts[o] += bits >> o & 1;
            }
            ++used;
        }
    }
    std::copy_n(counts, octants, tables.counts);
}

/// Adds up the products of the terms in each octant. A vector holds two rows of four z: `low` those
/// of its first two y, `high` those of the other two.
MOLSURF_KERNEL void sumOctants(const GaussianTables& tables, std::size_t stride,
                               float* __restrict sum)
{
    for (int o = 0; o < octants; ++o) {
        const int x = 4 * (o >> 2), y = 4 * (o >> 1 & 1), z = 4 * (o & 1);
        const std::int32_t* list = tables.list.data() + std::size_t(o) * stride;
        Floats planes[4][2] = {}; // [x][low or high]
        for (std::size_t j = 0; j < tables.counts[o]; ++j) {
            const float* e = tables.exponentials.data() + 24 * list[j];
            const Floats4 ey = load4(e + 8 + y), ez = load4(e + 16 + z);
            const Floats row = __builtin_shufflevector(ez, ez, 0, 1, 2, 3, 0, 1, 2, 3);
            const Floats low = row * __builtin_shufflevector(ey, ey, 0, 0, 0, 0, 1, 1, 1, 1);
            const Floats high = row * __builtin_shufflevector(ey, ey, 2, 2, 2, 2, 3, 3, 3, 3);
            for (int k = 0; k < 4; ++k) {
                planes[k][0] += e[x + k] * low;
                planes[k][1] += e[x + k] * high;
            }
        }
        for (int k = 0; k < 4; ++k) {
            for (int pair = 0; pair < 2; ++pair) {
                float* to = sum + 64 * (x + k) + 8 * (y + 2 * pair) + z;
                const Floats s = planes[k][pair];
                store4(to, __builtin_shufflevector(s, s, 0, 1, 2, 3));
                store4(to + 8, __builtin_shufflevector(s, s, 4, 5, 6, 7));
            }
        }
    }
}

/// psi = top + ln sum, no lower than the lowest that matters.
MOLSURF_KERNEL void takeLogarithms(float top, float* sum)
{
    for (int v = 0; v < leafSize; ++v) {
        const float psi = top + fastLog(larger(sum[v], smallestSum));
        sum[v] = larger(psi, lowestPsi);
    }
}

/// psi at voxel v where the products underflowed, by log-sum-exp with the largest exponent there.
float psiAt(const GaussianTerms& t, int v)
{
    const float x = float(v >> 6), y = float(v >> 3 & 7), z = float(v & 7);
    const auto exponent = [&](std::size_t i) {
        const float dx = x - t.x[i], dy = y - t.y[i], dz = z - t.z[i];
        return t.level[i] - t.decay[i] * (dx * dx + dy * dy + dz * dz);
    };
    float largest = GaussianTerms::noExponent, sum = 0.0f;
    for (std::size_t i = 0; i < t.count; ++i) largest = std::max(largest, exponent(i));
    for (std::size_t i = 0; i < t.count; ++i) sum += std::exp(exponent(i) - largest);
    return std::max(largest + std::log(sum), lowestPsi);
}

} // namespace

void sumTerms(const GaussianTerms& terms, const GaussianBounds& bounds, GaussianTables& tables,
              float* psi)
{
    if (terms.count == 0) {
        std::fill_n(psi, leafSize, lowestPsi);
        return;
    }
    const FlushDenormals scope;
    const std::size_t stride = terms.count + 1; // a place may be written past the last
    if (tables.list.size() < octants * stride) {
        tables.list.resize(2 * octants * stride);
        tables.exponentials.resize(2 * 24 * stride);
    }
    listTerms(terms, bounds, stride, tables);
    sumOctants(tables, stride, psi);
    LeafMask lost; // none if psi of such a sum is below lowestPsi anyway
    if (bounds.top + std::log(smallestSum) > lowestPsi) lost = lessThan(psi, smallestSum);
    takeLogarithms(bounds.top, psi);
    lost.forEach([&](int v) { psi[v] = psiAt(terms, v); });
}

// Log-sum-exp in two passes, eight terms side by side: the exponents and the largest, then the sums
// of e = exp(exponent - largest) and of its gradient -2 C e (x - x_i).
MOLSURF_KERNEL PsiSample sampleTerms(const GaussianTerms& terms, float x, float y, float z,
                                     std::vector<float>& scratch)
{
    constexpr std::size_t width = floatLanes;
    if (scratch.size() < terms.count + width) scratch.resize(2 * (terms.count + width));
    float* exponent = scratch.data();
    alignas(32) float top[width], sum[width] = {}, sumX[width] = {}, sumY[width] = {},
                                  sumZ[width] = {};
    std::fill_n(top, width, GaussianTerms::noExponent);
    const float *cx = terms.x.data(), *cy = terms.y.data(), *cz = terms.z.data();
    const float *decay = terms.decay.data(), *level = terms.level.data();
    for (std::size_t k = 0; k < terms.count; k += width) {
        for (std::size_t l = 0; l < width; ++l) {
            const std::size_t i = k + l;
            const float u = x - cx[i], v = y - cy[i], w = z - cz[i];
            exponent[i] = level[i] - decay[i] * (u * u + v * v + w * w);
            top[l] = larger(top[l], exponent[i]);
        }
    }
    float largest = top[0];
    for (const float t : top) largest = larger(largest, t);
    const float least = largest - negligible;
    for (std::size_t k = 0; k < terms.count; k += width) {
        float most = exponent[k];
        for (std::size_t l = 1; l < width; ++l) most = larger(most, exponent[k + l]);
        if (most < least) continue; // all eight are negligible
        for (std::size_t l = 0; l < width; ++l) {
            const std::size_t i = k + l;
            const float e = fastExp(exponent[i] - largest), pull = -2.0f * decay[i] * e;
            sum[l] += e;
            sumX[l] += pull * (x - cx[i]);
            sumY[l] += pull * (y - cy[i]);
            sumZ[l] += pull * (z - cz[i]);
        }
    }
    float all = 0.0f, gx = 0.0f, gy = 0.0f, gz = 0.0f;
    for (std::size_t l = 0; l < width; ++l) {
        all += sum[l];
        gx += sumX[l];
        gy += sumY[l];
        gz += sumZ[l];
    }
    return {largest + fastLog(all), gx / all, gy / all, gz / all};
}

} // namespace molsurf
