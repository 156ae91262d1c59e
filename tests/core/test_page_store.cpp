// SPDX-License-Identifier: MIT
// Pages stay for lists that grow a little and go when they stay empty.
#include "hyoryu/core/neighbours.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace hyoryu::test_page_store {
namespace {

constexpr std::size_t page = std::size_t(1) << 20;

TEST(PageStore, GivesBackWhatStaysEmptyAndKeepsWhatIsFilled)
{
    PageStore store;
    for (int k = 0; k < 40; ++k) {
        store.take(page);
    }
    EXPECT_EQ(store.bytes(), 40 * page);
    store.reset();
    std::byte* const first = store.take(page);
    std::byte* last = first;
    for (int k = 1; k < 16; ++k) {
        last = store.take(page);
    }
    std::memset(first, 1, page);
    std::memset(last, 2, page);
    store.trim();
    // Sixteen are filled; an eighth of them and one more are kept for the next time.
    EXPECT_EQ(store.bytes(), (16 + 2 + 1) * page);
    EXPECT_EQ(first[page - 1], std::byte{1});
    EXPECT_EQ(last[page - 1], std::byte{2});
    store.take(page);
    EXPECT_EQ(store.bytes(), (16 + 2 + 1) * page) << "the next page was there";
}

} // namespace
} // namespace hyoryu::test_page_store
