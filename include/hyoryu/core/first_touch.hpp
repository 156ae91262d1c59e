// SPDX-License-Identifier: MIT
// Memory of large columns, placed near the threads that use it: on machines with several memory
// controllers a page belongs to the one whose processor writes it first.
#pragma once

#include "hyoryu/core/parallel.hpp"

#include <memory>
#include <vector>

namespace hyoryu {

/// An allocator whose pages are first written by the threads that `parallel_for` gives the rows to.
template <class T>
struct FirstTouch {
    using value_type = T;

    FirstTouch() = default;
    template <class U>
    FirstTouch(const FirstTouch<U>&)
    {
    }

    T* allocate(std::size_t count)
    {
        constexpr Index page = 4096;      // bytes
        constexpr Index worth_pages = 64; // smaller columns fit into the caches
        T* const first = std::allocator<T>().allocate(count);
        auto* const bytes = reinterpret_cast<std::byte*>(first);
        const auto size = static_cast<Index>(count * sizeof(T));
        if (size >= worth_pages * page) {
            parallel_for(
                0, (size + page - 1) / page, [&](Index k) { bytes[k * page] = std::byte(0); },
                worth_pages);
        }
        return first;
    }
    void deallocate(T* first, std::size_t count) { std::allocator<T>().deallocate(first, count); }

    friend bool operator==(const FirstTouch&, const FirstTouch&) { return true; }
};

/// A column of numbers or vectors by row.
template <class T>
using ColumnValues = std::vector<T, FirstTouch<T>>;

} // namespace hyoryu
