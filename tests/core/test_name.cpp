// SPDX-License-Identifier: MIT
// Names that users type, and what a terminal is shown of them.
#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"
#include "hyoryu/core/name.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include <unistd.h>

namespace hyoryu::test_name {
namespace {

TEST(Names, EveryControlCharacterIsRefusedAndShownAsItsCode)
{
    for (int code = 0; code < 256; ++code) {
        const std::string one(1, static_cast<char>(code));
        const bool control = code < 0x20 || code == 0x7f;
        EXPECT_EQ(has_control_characters("a" + one + "b"), control) << code;
        EXPECT_EQ(name_fault("a" + one + "b").find("control") != std::string::npos, control)
            << code;
        EXPECT_EQ(printable(one) == one, !control || one == "\n") << code;
    }
    for (int code = 0x80; code < 0x100; ++code) { // in UTF-8: C1 below U+00A0, letters above
        const std::string one{static_cast<char>(code < 0xc0 ? 0xc2 : 0xc3),
                              static_cast<char>(code < 0xc0 ? code : code - 0x40)};
        EXPECT_EQ(has_control_characters(one), code < 0xa0) << code;
        EXPECT_EQ(printable(one) == one, code >= 0xa0) << code;
    }
    EXPECT_EQ(printable("a\x1b[31m"), "a\\x1b[31m");
}

TEST(Names, AMessageDoesNotSteerTheTerminal)
{
    const std::string text = to_string(Diagnostic{.file = "a\x1b.toml",
                                                  .line = 1,
                                                  .column = 1,
                                                  .key = "b\x07",
                                                  .what = "c\x9b",
                                                  .hint = "\x1b]0;d",
                                                  .source = "e\r"});
    EXPECT_EQ(text.find('\x1b'), std::string::npos);
    EXPECT_EQ(text.find('\x07'), std::string::npos);
    EXPECT_EQ(text.find('\r'), std::string::npos);
    EXPECT_NE(text.find("a\\x1b.toml"), std::string::npos);
}

TEST(InputFiles, SayWhyTheyCannotBeRead)
{
    const std::string file = testing::TempDir() + "/hyoryu_input_" + std::to_string(getpid());
    std::ofstream(file) << "0123456789";
    EXPECT_EQ(why_unreadable(file), "");
    EXPECT_EQ(why_unreadable(file, 10), "");
    EXPECT_NE(why_unreadable(file, 9), "");
    EXPECT_EQ(bytes_of_file(file), "0123456789");
    EXPECT_EQ(why_unreadable(testing::TempDir()), "is a folder, expected a file");
    EXPECT_EQ(why_unreadable("/dev/zero"), "is a device, expected a file");
    EXPECT_EQ(why_unreadable(file + ".none"), "does not exist");
    EXPECT_THROW(bytes_of_file("/dev/zero"), IoError);
    std::filesystem::remove(file);
}

} // namespace
} // namespace hyoryu::test_name
