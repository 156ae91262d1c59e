// SPDX-License-Identifier: MIT
// A folder with files written by hand, for tests that read them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace hyoryu::testing {

class OnDisk : public ::testing::Test {
protected:
    void SetUp() override
    {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        folder = std::filesystem::temp_directory_path() /
                 (std::string("hyoryu-verify-") + test->test_suite_name() + "-" + test->name());
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    void put(const std::string& name, const std::string& text) const
    {
        std::ofstream(folder / name) << text;
    }

    std::filesystem::path folder;
};

} // namespace hyoryu::testing
