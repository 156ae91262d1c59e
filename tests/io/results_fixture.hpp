// SPDX-License-Identifier: MIT
// A folder of its own for each test, and small frames to fill it with.
#pragma once

#include "own_folder.hpp"

#include "hyoryu/core/snapshot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace hyoryu::test_help {

inline std::string text_of(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

inline void put_text_into(const std::filesystem::path& file, const std::string& text)
{
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
}

/// Every path below the folder, relative to it, sorted.
inline std::vector<std::string> content_of(const std::filesystem::path& folder)
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        names.push_back(entry.path().lexically_relative(folder).generic_string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

class ResultsTest : public ::testing::Test {
protected:
    OwnFolder own;
    std::filesystem::path folder = own.path();
};

/// `count` points with one column of every type; all values depend on the frame.
inline Cloud make_cloud(std::string name, std::int64_t index, std::size_t count)
{
    Cloud cloud{.name = std::move(name),
                .time = 0.1 * static_cast<double>(index),
                .index = index,
                .points = {},
                .columns = {}};
    std::vector<float> velocity;
    std::vector<double> pressure;
    std::vector<std::int32_t> body;
    std::vector<std::int64_t> id;
    std::vector<std::uint8_t> kind;
    for (std::size_t i = 0; i < count; ++i) {
        const float x = static_cast<float>(i) + static_cast<float>(index);
        for (const float part : {x, 0.5F * x, -x}) {
            cloud.points.push_back(part);
            velocity.push_back(2 * part);
        }
        pressure.push_back(1.0 / (1.0 + static_cast<double>(i)));
        body.push_back(-static_cast<std::int32_t>(i));
        id.push_back(static_cast<std::int64_t>(i) << 33U);
        kind.push_back(static_cast<std::uint8_t>(i % 3));
    }
    cloud.columns = {{"Body", "", 1, body},
                     {"Id", "", 1, id},
                     {"Kind", "", 1, kind},
                     {"Pressure", "Pa", 1, pressure},
                     {"Velocity", "m/s", 3, velocity}};
    return cloud;
}

/// A square of two triangles.
inline Surface make_surface(std::int64_t index)
{
    const float z = static_cast<float>(index);
    return {.name = "surfaces",
            .time = 0.1 * static_cast<double>(index),
            .index = index,
            .points = {0, 0, z, 1, 0, z, 1, 1, z, 0, 1, z},
            .triangles = {0, 1, 2, 0, 2, 3},
            .columns = {{"Body", "", 1, std::vector<std::int32_t>{0, 0, 0, 0}}}};
}

} // namespace hyoryu::test_help
