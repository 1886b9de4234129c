// SPDX-License-Identifier: MPL-2.0
#include "molsurf/molecule/structure/read_xtc.h"

#include "molsurf/molecule/structure/byte_order.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace molsurf
{

namespace
{

// A frame is a header of 14 words: mark, atoms, step, time, the box of 9, atoms again. Up to 9
// atoms follow as they are; of more, 8 words (precision, the least and the greatest coordinates, an
// index of a span), the length of the packed coordinates and these, filled up to whole words.
constexpr std::uint32_t mark = 1995, wideMark = 2023; // the latter with a length of two words
constexpr std::uint64_t xtcHeaderSize = 56, packHeaderSize = 32;
constexpr std::size_t plainAtoms = 9;
constexpr std::size_t mostAtoms = 1u << 28; // number of atoms
constexpr double angstrom = 10.0;           // in a nanometre

using Integers = std::array<std::int64_t, 3>;

// Spans of small displacements, about 2^(i/3); which they are is part of the format.
constexpr int firstSpan = 9, lastSpan = 72;
constexpr std::array<std::uint32_t, lastSpan + 1> spans = {
    0,        0,        0,       0,       0,       0,       0,       0,       0,       8,
    10,       12,       16,      20,      25,      32,      40,      50,      64,      80,
    101,      128,      161,     203,     256,     322,     406,     512,     645,     812,
    1024,     1290,     1625,    2048,    2580,    3250,    4096,    5060,    6501,    8192,
    10321,    13003,    16384,   20642,   26007,   32768,   41285,   52015,   65536,   82570,
    104031,   131072,   165140,  208063,  262144,  330280,  416127,  524287,  660561,  832255,
    1048576,  1321122,  1664510, 2097152, 2642245, 3329021, 4194304, 5284491, 6658042, 8388607,
    10568983, 13316085, 16777216};

int bitLength(std::uint64_t value)
{
    int bits = 0;
    for (; value > 0; value >>= 1) ++bits;
    return bits;
}

/// Numbers of some bits each, the most significant bit first.
class Bits
{
public:
    explicit Bits(const std::vector<char>& bytes) : bytes_(bytes) {}

    /// @param[in] count  up to 32
    std::uint32_t take(int count)
    {
        for (; have_ < count; have_ += 8) {
            held_ = held_ << 8 | (at_ < bytes_.size() ? std::uint8_t(bytes_[at_]) : 0);
            ++at_;
        }
        have_ -= count;
        return std::uint32_t(held_ >> have_ & ((std::uint64_t(1) << count) - 1));
    }

    /// Whether more bits were taken than there are.
    bool exhausted() const { return at_ > bytes_.size(); }

private:
    const std::vector<char>& bytes_;
    std::uint64_t held_ = 0;
    std::size_t at_ = 0;
    int have_ = 0;
};

/// Three numbers below `sizes` (each at most 2^24) as one of `count` bits, (x sy + y) sz + z, whose
/// bytes come the least significant first.
Integers takeMixed(Bits& bits, int count, const std::array<std::uint32_t, 3>& sizes)
{
    std::array<std::uint32_t, 3> limbs{};
    for (int at = 0; at < count; at += 8)
        limbs[std::size_t(at / 32)] |= bits.take(std::min(8, count - at)) << at % 32;
    const auto divide = [&](std::uint32_t size) { // leaves the quotient, returns the remainder
        std::uint64_t rest = 0;
        for (std::size_t i = 3; i-- > 0;) {
            rest = rest << 32 | limbs[i];
            limbs[i] = std::uint32_t(rest / size);
            rest %= size;
        }
        return std::int64_t(rest);
    };
    const std::int64_t z = divide(sizes[2]), y = divide(sizes[1]);
    return {limbs[0], y, z};
}

/// Coordinates anywhere in the box from `least` to `greatest`.
class Box
{
public:
    Box(const Integers& least, const Integers& greatest) : least_(least)
    {
        for (std::size_t a = 0; a < 3; ++a) sizes_[a] = std::uint32_t(greatest[a] - least[a] + 1);
        constexpr std::uint32_t limit = 1u << 24;
        if (std::any_of(sizes_.begin(), sizes_.end(), [](auto size) { return size >= limit; }))
            return;
        // The length of sx sy sz, which may have more than 64 bits.
        const std::uint64_t area = std::uint64_t(sizes_[0]) * sizes_[1];
        const std::uint64_t low = area % limit * sizes_[2];
        const std::uint64_t high = area / limit * sizes_[2] + low / limit;
        mixed_ = high > 0 ? 24 + bitLength(high) : bitLength(low);
    }

    Integers take(Bits& bits) const
    {
        Integers out{};
        if (mixed_ > 0)
            out = takeMixed(bits, mixed_, sizes_);
        else
            for (std::size_t a = 0; a < 3; ++a) out[a] = bits.take(bitLength(sizes_[a]));
        for (std::size_t a = 0; a < 3; ++a) out[a] += least_[a];
        return out;
    }

private:
    Integers least_;
    std::array<std::uint32_t, 3> sizes_{};
    int mixed_ = 0; ///< bits of the three as one number; 0: each by itself
};

/// Unpacks: an atom anywhere in the box, then a run of atoms near to the one before. The first of
/// a run changes places with the atom before it, so that of a water the oxygen comes in the
/// middle. A run has the length of the last one, unless a set bit and a new length in five bits
/// come, which also encode whether the span of displacements shrinks or grows.
///
/// @return fewer than `count` if the data are damaged
std::vector<Integers> unpack(Bits& bits, std::size_t count, const Box& box, int span)
{
    std::vector<Integers> out;
    out.reserve(count);
    for (std::size_t run = 0; out.size() < count && !bits.exhausted();) {
        Integers last = box.take(bits);
        int growth = 0;
        if (bits.take(1)) {
            const std::uint32_t code = bits.take(5);
            run = code / 3;
            growth = int(code % 3) - 1;
        }
        if (span < firstSpan || span > lastSpan || out.size() + 1 + run > count) break;
        if (run == 0) out.push_back(last);
        const std::uint32_t size = spans[std::size_t(span)];
        for (std::size_t k = 0; k < run; ++k) {
            Integers near = takeMixed(bits, span, {size, size, size});
            for (std::size_t a = 0; a < 3; ++a) near[a] += last[a] - size / 2;
            out.push_back(near);
            if (k == 0) out.push_back(last);
            last = near;
        }
        span += growth;
    }
    if (bits.exhausted()) out.clear();
    return out;
}

float asFloat(std::uint32_t bits)
{
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

} // namespace

bool XtcFile::recognizes(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    unsigned char b[4] = {};
    file.read(reinterpret_cast<char*>(b), 4);
    const std::uint32_t first = std::uint32_t(b[0] << 24 | b[1] << 16 | b[2] << 8 | b[3]);
    return file && (first == mark || first == wideMark);
}

std::uint32_t XtcFile::word()
{
    char bytes[4] = {};
    file_.read(bytes, sizeof bytes);
    return std::uint32_t(unsignedAt(bytes, sizeof bytes, ByteOrder::Big));
}

XtcFile::XtcFile(const std::string& path) : Trajectory(path)
{
    for (std::uint64_t at = 0; at < size_;) {
        begins_.push_back(at);
        at = startFrame(begins_.size() - 1);
        if (at == 0 || at > size_) fail("cut short within frame " + std::to_string(begins_.size()));
    }
    if (begins_.empty()) fail("expected a trajectory in the XTC format");
}

std::uint64_t XtcFile::startFrame(std::size_t frame)
{
    const auto expect = [&](bool condition, const std::string& what) {
        if (!condition) fail("frame " + std::to_string(frame + 1) + ": expected " + what);
    };
    const std::uint64_t begin = begins_[frame];
    file_.clear();
    file_.seekg(std::streamoff(begin));
    const std::uint32_t first = word(), count = word();
    file_.seekg(std::streamoff(begin + xtcHeaderSize - 4));
    const std::uint32_t again = word();
    if (!file_) return 0;
    expect(first == mark || first == wideMark,
           "the mark 1995 of XTC, got " + std::to_string(first));
    expect(count > 0 && count <= mostAtoms && count == again, "a number of atoms, twice, got " +
                                                                  std::to_string(count) + " and " +
                                                                  std::to_string(again));
    if (atoms_ == 0) atoms_ = count;
    expect(count == atoms_,
           "the " + std::to_string(atoms_) + " atoms of the first, got " + std::to_string(count));
    wide_ = first == wideMark;
    if (count <= plainAtoms) return begin + xtcHeaderSize + 12 * std::uint64_t(count);
    file_.seekg(packHeaderSize, std::ios::cur);
    std::uint64_t length = wide_ ? std::uint64_t(word()) << 32 : 0;
    length |= word();
    if (!file_) return 0;
    const std::uint64_t content = std::uint64_t(file_.tellg());
    // An atom takes two bits at least: one of its coordinates, and whether a run has a new length.
    expect(count / 4 <= length, "coordinates of " + std::to_string(count) + " atoms, got " +
                                    std::to_string(length) + " bytes");
    return length > size_ ? 0 : content + (length + 3) / 4 * 4;
}

std::vector<openvdb::Vec3f> XtcFile::load(std::size_t frame)
{
    const std::uint64_t end = startFrame(frame);
    file_.seekg(std::streamoff(begins_[frame] + xtcHeaderSize));
    std::vector<openvdb::Vec3f> out(atoms_);
    if (atoms_ <= plainAtoms) {
        for (openvdb::Vec3f& x : out)
            for (int a = 0; a < 3; ++a) x[a] = float(angstrom * asFloat(word()));
        if (!file_) fail("frame " + std::to_string(frame + 1) + ": cannot be read");
        return out;
    }
    const auto damaged = [&]() { fail("frame " + std::to_string(frame + 1) + ": is damaged"); };
    const double precision = asFloat(word());
    Integers least{}, greatest{};
    for (std::int64_t& value : least) value = std::int32_t(word());
    for (std::int64_t& value : greatest) value = std::int32_t(word());
    const std::uint32_t span = word();
    if (wide_) word();
    std::vector<char> content(word());
    if (!file_ || end == 0 || content.size() > size_) damaged();
    file_.read(content.data(), std::streamsize(content.size()));
    if (!file_ || !(precision > 0) || span > lastSpan) damaged();
    for (std::size_t a = 0; a < 3; ++a)
        if (greatest[a] < least[a]) damaged();
    Bits bits(content);
    const std::vector<Integers> packed = unpack(bits, atoms_, Box(least, greatest), int(span));
    if (packed.size() != atoms_) damaged();
    for (std::size_t i = 0; i < atoms_; ++i)
        for (int a = 0; a < 3; ++a)
            out[i][a] = float(angstrom * double(packed[i][std::size_t(a)]) / precision);
    return out;
}

} // namespace molsurf
