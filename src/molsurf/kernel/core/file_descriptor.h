// SPDX-License-Identifier: MPL-2.0
#pragma once

#include <unistd.h>

#include <utility>

namespace molsurf
{

/// A descriptor of the system that is closed with its owner; it may be none.
class FileDescriptor
{
public:
    /// Takes over what open() gave; less than 0 is none.
    explicit FileDescriptor(int descriptor = -1) : descriptor_(descriptor) {}
    ~FileDescriptor()
    {
        if (*this) close(descriptor_);
    }
    FileDescriptor(FileDescriptor&& other) noexcept
        : descriptor_(std::exchange(other.descriptor_, -1))
    {
    }
    FileDescriptor& operator=(FileDescriptor&& other) noexcept
    {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }

    explicit operator bool() const { return descriptor_ >= 0; }
    int get() const { return descriptor_; }

private:
    int descriptor_;
};

} // namespace molsurf
