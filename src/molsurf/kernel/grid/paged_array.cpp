// SPDX-License-Identifier: MPL-2.0
#include "molsurf/kernel/grid/paged_array.h"

#include <sys/mman.h>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <new>

namespace molsurf
{

namespace
{

constexpr std::size_t pageBytes = PagedMemory::pageBytes;
constexpr std::size_t lineBytes = 64;

/// Pages that no array has.
class FreePages
{
public:
    void* take()
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (pages_.empty()) grow();
        void* page = pages_.back();
        pages_.pop_back();
        return page;
    }
    void give(void* page)
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        pages_.push_back(page); // never grows: grow() has reserved
    }
    void release()
    {
        constexpr std::size_t few = 8; // as trimHeap() keeps
        const std::lock_guard<std::mutex> lock(mutex_);
        if (pages_.size() <= few) return;
        tbb::this_task_arena::isolate([&] { // nothing else begins here, which may ask for pages
            tbb::parallel_for(std::size_t(0), pages_.size(),
                              [&](std::size_t i) { madvise(pages_[i], pageBytes, MADV_DONTNEED); });
        });
    }

private:
    /// Asks for address space; memory comes page by page when it is written.
    void grow()
    {
        constexpr std::size_t pages = 16;
        pages_.reserve(total_ + pages);
        void* memory = mmap(nullptr, (pages + 1) * pageBytes, PROT_READ | PROT_WRITE,
                            MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (memory == MAP_FAILED) throw std::bad_alloc();
        const auto start = reinterpret_cast<std::uintptr_t>(memory);
        auto* first = static_cast<char*>(memory) + (pageBytes - start % pageBytes) % pageBytes;
#ifdef MADV_HUGEPAGE
        adviseHugePages(first, pages * pageBytes);
#endif
        for (std::size_t i = pages; i-- > 0;) pages_.push_back(first + i * pageBytes);
        total_ += pages;
    }

#ifdef MADV_HUGEPAGE
    /// Asks for huge pages as long as they come quickly: a virtual machine may have to collect them
    /// from its host, which takes longer than 512 small ones. Advice is a hint; that it is refused
    /// is no error.
    void adviseHugePages(char* first, std::size_t bytes)
    {
        using Clock = std::chrono::steady_clock;
        if (hugePages_) {
            madvise(first, bytes, MADV_HUGEPAGE);
            const auto start = Clock::now();
            *static_cast<volatile char*>(first) = 0;
            hugePages_ = Clock::now() - start < std::chrono::milliseconds(1);
        }
        if (!hugePages_) madvise(first, bytes, MADV_NOHUGEPAGE);
    }

    bool hugePages_ = true;
#endif
    std::mutex mutex_;
    std::vector<void*> pages_;
    std::size_t total_ = 0;
};

FreePages& freePages()
{
    static FreePages* pages = new FreePages; // outlives every array
    return *pages;
}

} // namespace

PagedMemory::PagedMemory(std::size_t bytes)
{
    if (bytes == 0) return;
    if (bytes < pageBytes) {
        pages_ = {std::aligned_alloc(lineBytes, (bytes + lineBytes - 1) / lineBytes * lineBytes)};
        if (!pages_[0]) throw std::bad_alloc();
        bytes_ = bytes;
        return;
    }
    const std::size_t count = (bytes + pageBytes - 1) / pageBytes;
    pages_.reserve(count);
    try {
        while (pages_.size() < count) pages_.push_back(freePages().take());
    } catch (const std::bad_alloc&) {
        for (void* page : pages_) freePages().give(page);
        throw;
    }
    bytes_ = bytes;
}

PagedMemory::~PagedMemory()
{
    if (bytes_ < pageBytes) {
        for (void* page : pages_) std::free(page);
    } else {
        for (void* page : pages_) freePages().give(page);
    }
}

void releasePages()
{
    freePages().release();
}

} // namespace molsurf
