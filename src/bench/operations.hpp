// SPDX-License-Identifier: MIT
// A number that records the operations on it, so that the operations of a formula are counted from
// its source.
#pragma once

#include "hyoryu/core/vec.hpp"

#include <map>
#include <tuple>
#include <vector>

namespace hyoryu::bench {

/// The operations recorded so far. Equal ones count once, as after common subexpression
/// elimination.
class Operations {
public:
    /// A value from outside: a field of a particle, or a parameter.
    int input() { return add('i', next_input_++, 0); }
    int apply(char operation, int a, int b) { return add(operation, a, b); }

    /// Arithmetic operations that the result needs.
    int needed_for(const std::vector<int>& results) const
    {
        std::vector<bool> needed(nodes_.size(), false);
        for (const int result : results) {
            needed[result] = true;
        }
        int count = 0;
        for (std::size_t k = nodes_.size(); k-- > 0;) { // operands come before their result
            const auto [operation, a, b] = nodes_[k];
            if (needed[k] && operation != 'i') {
                needed[a] = true;
                needed[b] = true;
                count += 1;
            }
        }
        return count;
    }

private:
    using Node = std::tuple<char, int, int>;
    int add(char operation, int a, int b)
    {
        const auto [place, is_new] =
            known_.try_emplace({operation, a, b}, static_cast<int>(nodes_.size()));
        if (is_new) {
            nodes_.push_back(place->first);
        }
        return place->second;
    }

    int next_input_ = 0;
    std::vector<Node> nodes_;
    std::map<Node, int> known_;
};

} // namespace hyoryu::bench

namespace hyoryu {

/// Stands where a real or a pack stands in a term. Beside the namespace of vectors, where terms
/// look for the functions of their number.
class Counted {
public:
    Counted() = default;
    /// A constant.
    Counted(double) {}
    static Counted input(bench::Operations& all)
    {
        Counted value;
        value.all_ = &all;
        value.node_ = all.input();
        return value;
    }
    int node() const { return node_; }

    friend Counted operator+(const Counted& a, const Counted& b) { return apply('+', a, b); }
    friend Counted operator-(const Counted& a, const Counted& b) { return apply('-', a, b); }
    friend Counted operator*(const Counted& a, const Counted& b) { return apply('*', a, b); }
    friend Counted operator/(const Counted& a, const Counted& b) { return apply('/', a, b); }
    friend Counted operator-(const Counted& a) { return a; } // a sign comes with the next operation
    Counted& operator+=(const Counted& b) { return *this = *this + b; }
    friend Counted square_root(const Counted& a) { return apply('r', a, a); }
    friend Counted positive(const Counted& a) { return apply('p', a, a); }

private:
    static Counted apply(char operation, const Counted& a, const Counted& b)
    {
        Counted result;
        result.all_ = a.all_ != nullptr ? a.all_ : b.all_;
        if (result.all_ != nullptr) { // else constants, which the loop does not work out
            result.node_ =
                result.all_->apply(operation, a.known(*result.all_), b.known(*result.all_));
        }
        return result;
    }
    int known(bench::Operations& all) const { return all_ != nullptr ? node_ : all.input(); }

    bench::Operations* all_ = nullptr;
    int node_ = 0;
};

} // namespace hyoryu
