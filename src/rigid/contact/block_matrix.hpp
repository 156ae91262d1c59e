// SPDX-License-Identifier: MIT
// A sparse matrix of 6 x 6 blocks, one row and column of blocks for each body of a contact problem.
#pragma once

#include "hyoryu/core/types.hpp"

#include <Eigen/LU>

#include <utility>
#include <vector>

namespace hyoryu {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Blocks (i, j) and (j, i) of coupled pairs, and the fill-in of the elimination. Blocks are
/// numbered in the order of elimination.
struct BlockMatrix {
    std::vector<int> step_of;            // elimination step of each body
    std::vector<std::vector<int>> later; // the neighbours of each that are eliminated after it
    std::vector<Mat6> diagonal;
    std::vector<std::vector<Mat6>> right; // (k, later) of each k
    std::vector<std::vector<Mat6>> below; // (later, k)
    std::vector<Eigen::PartialPivLU<Mat6>> pivots;
    double products = 0; // products of blocks in the elimination: its cost

    /// The block (i, j), i and j in the order of elimination.
    Mat6& at(int i, int j);
};

/// Lays out a matrix of `count` bodies whose pairs are coupled. The body with the fewest neighbours
/// is eliminated first, so that a stack has no fill-in and a heap little (minimum degree, Tinney
/// and Walker 1967).
void order(BlockMatrix& matrix, int count, const std::vector<std::pair<int, int>>& pairs);

/// Sets all blocks to zero and the diagonal to one.
void set_identity(BlockMatrix& matrix);

/// Gaussian elimination by blocks, with pivots within the blocks of the diagonal.
void factorise(BlockMatrix& matrix);

/// Solves in place with the factorised matrix; `x` in the order of elimination.
void solve(const BlockMatrix& matrix, std::vector<Vec6>& x);

} // namespace hyoryu
