// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Identifiers of what is written, so that equal content has equal bytes.

#include <cstddef>
#include <cstdint>
#include <string>

namespace molsurf
{

/// A digest of bytes, 128 bits; it tells contents apart and is no proof against forgery.
class ContentDigest
{
public:
    /// In whatever pieces the bytes come, the digest is the same.
    void add(const void* bytes, std::size_t size);

    /// A UUID by the bytes until now, of version 8 (RFC 9562), the bits of which are free.
    std::string uuid() const;

private:
    void mix(std::uint64_t word);

    std::uint64_t high_ = 0x9e3779b97f4a7c15, low_ = 0x6a09e667f3bcc909;
    std::uint64_t size_ = 0, word_ = 0; // word_ has the last size_ % 8 bytes
};

} // namespace molsurf
