// SPDX-License-Identifier: MIT
// State on its way to a file: named arrays without any knowledge of what produced them.
#pragma once

#include "hyoryu/core/types.hpp"

#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace hyoryu {

/// One named array of `rows` x `components` values, row after row.
struct Column {
    std::string name; // for instance "Velocity"
    std::string unit; // for instance "m/s"
    int components = 1;
    std::variant<std::vector<float>, std::vector<double>, std::vector<std::int32_t>,
                 std::vector<std::int64_t>, std::vector<std::uint8_t>>
        values;
};

/// A cloud of points at one moment: what one frame file holds.
struct Cloud {
    std::string name;            // "fluid", "bodies", "walls"
    double time = 0;             // [s]
    std::int64_t index = 0;      // number of the frame
    std::vector<float> points;   // x, y, z of each point [m]
    std::vector<Column> columns; // one value (or vector) a point
};

/// Description of a cloud whose points are in several files, one for each part.
struct CloudOfParts {
    std::string name;
    double time = 0;                  // [s]
    std::int64_t index = 0;           // number of the frame
    std::vector<std::int64_t> points; // of each part
    std::vector<Column> columns;      // name, unit and type of each; no values
};

/// Triangles at one moment: the surfaces of the bodies.
struct Surface {
    std::string name = "surfaces";
    double time = 0;
    std::int64_t index = 0;
    std::vector<float> points;           // x, y, z of each corner [m]
    std::vector<std::int32_t> triangles; // three corner numbers each
    std::vector<Column> columns;         // one value a corner
};

/// A table of numbers with a header: a history.
struct Table {
    struct Head {
        std::string name;
        std::string unit;
    };
    std::string name; // "bodies", "energy"
    std::vector<Head> heads;
};

/// Everything that a bit-exact restart needs: named arrays and named texts.
struct Snapshot {
    std::map<std::string, Column> arrays;
    std::map<std::string, std::string> texts;
};

/// A state whose arrays are created one at a time, so that it is never in memory as a whole.
struct StateOnDemand {
    std::map<std::string, std::size_t> bytes;        // size of each array, by name [B]
    std::function<Column(const std::string&)> array; // creates an array; call once for each name
    std::map<std::string, std::string> texts;
};

} // namespace hyoryu
