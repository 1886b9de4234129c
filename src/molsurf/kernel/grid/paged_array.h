// SPDX-License-Identifier: MPL-2.0
#pragma once

/// @file
/// Large arrays in pages of 2 MiB that are kept, when an array goes, for the next one. Memory that
/// comes fresh from the system has to be cleared by it, a page fault each: a run makes some thirty
/// fields, of which few live at a time, and memory that malloc() has given back cannot always be
/// had again, for want of one piece that is large enough.

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace molsurf
{

/// The bytes of one array: pages, or a piece of its own size if that is less than a page.
class PagedMemory
{
public:
    static constexpr std::size_t pageBytes = std::size_t(1) << 21; ///< a huge page of x86-64

    PagedMemory() = default;
    /// @throws std::bad_alloc
    explicit PagedMemory(std::size_t bytes);
    ~PagedMemory();
    PagedMemory(PagedMemory&& other) noexcept { swap(other); }
    PagedMemory& operator=(PagedMemory&& other) noexcept
    {
        PagedMemory taken(std::move(other));
        swap(taken);
        return *this;
    }

    void* page(std::size_t i) const { return pages_[i]; }
    std::size_t bytes() const { return bytes_; }

private:
    void swap(PagedMemory& other) noexcept
    {
        pages_.swap(other.pages_);
        std::swap(bytes_, other.bytes_);
    }

    std::vector<void*> pages_;
    std::size_t bytes_ = 0;
};

/// Gives the pages that no array has back to the system where they are more than 16 MiB.
void releasePages();

/// An array that begins at a line of the cache, uninitialised when made.
template<typename T>
class PagedArray
{
    static_assert(std::is_trivially_copyable_v<T> && PagedMemory::pageBytes % sizeof(T) == 0);

public:
    PagedArray() = default;
    explicit PagedArray(std::size_t size) : memory_(size * sizeof(T)) {}

    T& operator[](std::size_t i) { return at(i); }
    const T& operator[](std::size_t i) const { return at(i); }
    std::size_t size() const { return memory_.bytes() / sizeof(T); }
    bool empty() const { return size() == 0; }

    /// Gives the same memory to values of another type; it holds the bytes of the old ones.
    template<typename U>
    PagedArray<U> reused() &&
    {
        PagedArray<U> out;
        out.memory_ = std::move(memory_);
        return out;
    }

private:
    template<typename>
    friend class PagedArray;

    static constexpr std::size_t perPage = PagedMemory::pageBytes / sizeof(T);

    T& at(std::size_t i) const { return static_cast<T*>(memory_.page(i / perPage))[i % perPage]; }

    PagedMemory memory_;
};

} // namespace molsurf
