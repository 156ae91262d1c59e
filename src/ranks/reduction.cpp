// SPDX-License-Identifier: MIT
#include "hyoryu/ranks/reduction.hpp"

namespace hyoryu {

void Reduction::add(std::span<FixedSum> sums)
{
    for (FixedSum& sum : comm_ != nullptr ? sums : std::span<FixedSum>()) {
        sums_.push_back(&sum);
    }
}

void Reduction::largest(std::span<double> numbers)
{
    for (double& number : comm_ != nullptr ? numbers : std::span<double>()) {
        largest_.push_back(&number);
    }
}

void Reduction::run()
{
    if (comm_ == nullptr) {
        return;
    }
    std::vector<Joined> numbers;
    numbers.reserve(sums_.size() + largest_.size());
    for (const FixedSum* const sum : sums_) {
        numbers.push_back({.sum = *sum});
    }
    for (const double* const number : largest_) {
        numbers.push_back({.largest = *number});
    }
    comm_->join(numbers);
    auto next = numbers.begin();
    for (FixedSum* const sum : sums_) {
        *sum = (next++)->sum;
    }
    for (double* const number : largest_) {
        *number = (next++)->largest;
    }
}

void largest_of_all(Comm* comm, std::span<double> numbers)
{
    Reduction all(comm);
    all.largest(numbers);
    all.run();
}

} // namespace hyoryu
