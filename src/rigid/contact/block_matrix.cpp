// SPDX-License-Identifier: MIT
#include "block_matrix.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

void insert(std::vector<int>& sorted, int value)
{
    const auto place = std::ranges::lower_bound(sorted, value);
    if (place == sorted.end() || *place != value) {
        sorted.insert(place, value);
    }
}

// Neighbours of each body, sorted.
std::vector<std::vector<int>> neighbours(int count, const std::vector<std::pair<int, int>>& pairs)
{
    std::vector<std::vector<int>> of(static_cast<std::size_t>(count));
    for (const auto& [a, b] : pairs) {
        insert(of[a], b);
        insert(of[b], a);
    }
    return of;
}

// The body with the fewest neighbours among those that are left, the lowest number first.
int next_body(const std::vector<std::vector<int>>& of, const std::vector<int>& step_of)
{
    int best = -1;
    for (std::size_t k = 0; k < of.size(); ++k) {
        if (step_of[k] < 0 && (best < 0 || of[k].size() < of[best].size())) {
            best = static_cast<int>(k);
        }
    }
    return best;
}

// Removes the body from the graph and couples its neighbours to each other.
void eliminate(std::vector<std::vector<int>>& of, int body)
{
    const std::vector<int>& left = of[body];
    for (const int a : left) {
        std::vector<int>& list = of[a];
        list.erase(std::ranges::lower_bound(list, body));
        for (const int b : left) {
            if (b != a) {
                insert(list, b);
            }
        }
    }
}

} // namespace

Mat6& BlockMatrix::at(int i, int j)
{
    if (i == j) {
        return diagonal[i];
    }
    const auto first = static_cast<std::size_t>(std::min(i, j));
    const auto place =
        std::ranges::lower_bound(later[first], std::max(i, j)) - later[first].begin();
    return (i < j ? right : below)[first][place];
}

void order(BlockMatrix& matrix, int count, const std::vector<std::pair<int, int>>& pairs)
{
    const auto n = static_cast<std::size_t>(count);
    std::vector<std::vector<int>> of = neighbours(count, pairs);
    matrix.step_of.assign(n, -1);
    matrix.later.resize(n);
    for (int step = 0; step < count; ++step) {
        const int body = next_body(of, matrix.step_of);
        matrix.step_of[body] = step;
        eliminate(of, body);
        matrix.later[step] = of[body];
    }
    for (std::vector<int>& list : matrix.later) { // by step instead of by body
        for (int& body : list) {
            body = matrix.step_of[body];
        }
        std::ranges::sort(list);
    }
    matrix.diagonal.resize(n);
    matrix.right.resize(n);
    matrix.below.resize(n);
    matrix.pivots.resize(n);
}

void set_identity(BlockMatrix& matrix)
{
    for (std::size_t k = 0; k < matrix.diagonal.size(); ++k) {
        matrix.diagonal[k].setIdentity();
        matrix.right[k].assign(matrix.later[k].size(), Mat6::Zero());
        matrix.below[k].assign(matrix.later[k].size(), Mat6::Zero());
    }
}

void factorise(BlockMatrix& matrix)
{
    matrix.products = 0;
    for (std::size_t k = 0; k < matrix.diagonal.size(); ++k) {
        matrix.pivots[k].compute(matrix.diagonal[k]);
        const std::vector<int>& later = matrix.later[k];
        for (std::size_t j = 0; j < later.size(); ++j) {
            matrix.right[k][j] = matrix.pivots[k].solve(matrix.right[k][j]);
            for (std::size_t i = 0; i < later.size(); ++i) {
                matrix.at(later[i], later[j]).noalias() -= matrix.below[k][i] * matrix.right[k][j];
            }
        }
        matrix.products += static_cast<double>(1 + later.size() + later.size() * later.size());
    }
}

void solve(const BlockMatrix& matrix, std::vector<Vec6>& x)
{
    const std::size_t n = matrix.diagonal.size();
    for (std::size_t k = 0; k < n; ++k) {
        x[k] = matrix.pivots[k].solve(x[k]).eval();
        for (std::size_t i = 0; i < matrix.later[k].size(); ++i) {
            x[matrix.later[k][i]] -= matrix.below[k][i] * x[k];
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = 0; j < matrix.later[k].size(); ++j) {
            x[k] -= matrix.right[k][j] * x[matrix.later[k][j]];
        }
    }
}

} // namespace hyoryu
