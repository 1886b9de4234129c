// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/core/content_digest.h"

#include "molsurf/kernel/core/strings.h"

#include <cstring>

namespace molsurf
{

// A multiplication carries to higher bits alone, a shift brings those back. Both steps can be
// undone, so that no two words give one state.
void ContentDigest::mix(std::uint64_t word)
{
    high_ = (high_ ^ word) * 0xff51afd7ed558ccd;
    high_ ^= high_ >> 32;
    low_ = (low_ ^ word) * 0xc4ceb9fe1a85ec53;
    low_ ^= low_ >> 29;
}

void ContentDigest::add(const void* bytes, std::size_t size)
{
    const auto* next = static_cast<const unsigned char*>(bytes);
    constexpr std::size_t whole = sizeof word_;
    while (size > 0) {
        if (size_ % whole == 0 && size >= whole) {
            std::uint64_t word;
            std::memcpy(&word, next, whole);
            mix(word);
            next += whole, size -= whole, size_ += whole;
            continue;
        }
        word_ |= std::uint64_t(*next) << (8 * (size_ % whole));
        ++next, --size, ++size_;
        if (size_ % whole == 0) {
            mix(word_);
            word_ = 0;
        }
    }
}

std::string ContentDigest::uuid() const
{
    ContentDigest last = *this;
    last.mix(word_);
    last.mix(size_);
    last.mix(last.high_ ^ last.low_); // the first bits of the last words reach all of the digest
    last.mix(last.high_ ^ last.low_);
    const auto part = [](std::uint64_t word, int shift) {
        return unsigned(word >> shift & 0xffff);
    };
    return formatted("%04x%04x-%04x-8%03x-%04x-%04x%04x%04x", part(last.high_, 48),
                     part(last.high_, 32), part(last.high_, 16), part(last.high_, 0) & 0xfff,
                     0x8000 | (part(last.low_, 48) & 0x3fff), part(last.low_, 32),
                     part(last.low_, 16), part(last.low_, 0));
}

} // namespace molsurf
