// SPDX-License-Identifier: MIT
#include "hyoryu/core/neighbours.hpp"

#include <algorithm>
#include <utility>

namespace hyoryu {

void PageStore::reset()
{
    for (Page& page : pages_) {
        page.used = 0;
    }
    current_ = 0;
}

std::byte* PageStore::take(std::size_t bytes)
{
    const std::size_t size = (bytes + 15) / 16 * 16;
    const std::lock_guard lock(one_at_a_time_);
    while (current_ < pages_.size() && pages_[current_].size - pages_[current_].used < size) {
        ++current_;
    }
    if (current_ == pages_.size()) {
        const std::size_t room = std::max(size, page_size);
        pages_.push_back({std::make_unique_for_overwrite<std::byte[]>(room), room, 0});
    }
    Page& page = pages_[current_];
    return page.memory.get() + std::exchange(page.used, page.used + size);
}

void PageStore::append(const ListBlock& block, std::vector<ListBlock>& blocks)
{
    const std::lock_guard lock(one_at_a_time_);
    blocks.push_back(block);
}

void PageStore::trim()
{
    std::size_t kept = std::min(current_ + 1, pages_.size());
    std::size_t spare = page_size;
    for (std::size_t k = 0; k < kept; ++k) {
        spare += pages_[k].size / 8;
    }
    for (; kept < pages_.size() && pages_[kept].size <= spare; ++kept) {
        spare -= pages_[kept].size;
    }
    pages_.resize(kept);
}

std::size_t PageStore::bytes() const
{
    std::size_t total = 0;
    for (const Page& page : pages_) {
        total += page.size;
    }
    return total;
}

} // namespace hyoryu
