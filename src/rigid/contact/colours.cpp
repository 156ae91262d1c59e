// SPDX-License-Identifier: MIT
#include "colours.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace hyoryu {

namespace {

constexpr int most_colours = 63; // and one for groups without a free colour
constexpr std::uint64_t all_colours = ~std::uint64_t(0) >> 1;

// The lowest colour free at both bodies of the row; at walls and immovable bodies all are free.
int take_colour(const Row& row, const std::vector<Response>& bodies,
                std::vector<std::uint64_t>& taken)
{
    const auto colours_of = [&](int body) -> std::uint64_t {
        return body >= 0 && bodies[body].movable ? taken[body] : 0;
    };
    const std::uint64_t used = colours_of(row.a) | colours_of(row.b);
    const int colour = used == all_colours ? most_colours : std::countr_one(used);
    for (const int body : {row.a, row.b}) {
        if (body >= 0 && colour < most_colours) {
            taken[body] |= std::uint64_t(1) << colour;
        }
    }
    return colour;
}

void find_groups(std::span<const Row> rows, std::vector<std::size_t>& start)
{
    start.clear();
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (k == 0 || rows[k].a != rows[k - 1].a || rows[k].b != rows[k - 1].b) {
            start.push_back(k);
        }
    }
    start.push_back(rows.size());
}

// Moves the groups to the places that `order` gives them.
void move_groups(std::span<Row> rows, std::span<const std::size_t> order, Colours& colours)
{
    const std::vector<Row> unsorted(rows.begin(), rows.end());
    std::vector<std::size_t> start{0};
    for (const std::size_t g : order) {
        const auto first = static_cast<std::ptrdiff_t>(colours.group_start[g]);
        const auto last = static_cast<std::ptrdiff_t>(colours.group_start[g + 1]);
        const auto to = static_cast<std::ptrdiff_t>(start.back());
        std::copy(unsorted.begin() + first, unsorted.begin() + last, rows.begin() + to);
        start.push_back(static_cast<std::size_t>(to + last - first));
    }
    colours.group_start = std::move(start);
}

} // namespace

void sort_by_colour(std::span<Row> rows, const std::vector<Response>& bodies, Colours& colours)
{
    colours = {{0, rows.size()}, {0, 1}};
    if (rows.size() < worth_colouring) {
        return;
    }
    find_groups(rows, colours.group_start);
    const std::size_t groups = colours.group_start.size() - 1;
    std::vector<std::uint64_t> taken(bodies.size(), 0);
    std::vector<int> colour(groups);
    for (std::size_t g = 0; g < groups; ++g) {
        colour[g] = take_colour(rows[colours.group_start[g]], bodies, taken);
    }
    std::vector<std::size_t> order(groups);
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::ranges::stable_sort(order, {}, [&](std::size_t g) { return colour[g]; });
    move_groups(rows, order, colours);
    colours.colour_start = {0};
    for (std::size_t k = 1; k < groups; ++k) {
        if (colour[order[k]] != colour[order[k - 1]]) {
            colours.colour_start.push_back(k);
        }
    }
    colours.colour_start.push_back(groups);
    colours.last_alone = colour[order.back()] == most_colours;
}

} // namespace hyoryu
