// SPDX-License-Identifier: MIT
// The results as JSON, and as a table to read.
#pragma once

#include "measure.hpp"

#include <nlohmann/json.hpp>

namespace hyoryu::bench {

struct Row {
    Scene scene;
    std::vector<Result> results;
};

/// Everything that was measured, with what it was measured by. NaN (a metric that the run did not
/// give) becomes null.
nlohmann::ordered_json to_json(const std::vector<Row>& rows, const std::vector<Engine>& engines,
                               const Plan& plan);

/// One scene as text: a line an engine and step, with the cost and the errors.
std::string table(const Row& row);

} // namespace hyoryu::bench
