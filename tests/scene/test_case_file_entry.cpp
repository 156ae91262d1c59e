// SPDX-License-Identifier: MIT
// What is checked where a case enters, whatever it describes: its syntax, its files, its names and
// the magnitude of its numbers.
#include "test_case_file_support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>

#include <sys/stat.h>
#include <unistd.h>

namespace hyoryu::test_case_file_entry {

TEST(CaseFileEntry, SyntaxIsToldWithItsPlace)
{
    const auto twice = mistakes("seed = 1\nseed = 2\n");
    ASSERT_EQ(twice.size(), 1u);
    EXPECT_EQ(twice[0].line, 2);
    EXPECT_NE(twice[0].what.find("is defined twice"), std::string::npos);
    EXPECT_EQ(mistakes("a = [1,\n").size(), 1u);
    EXPECT_EQ(mistakes("a = 1e999\n").size(), 1u);
    EXPECT_EQ(mistakes("a = 99999999999999999999\n").size(), 1u);
}

TEST(CaseFileEntry, HostileFilesAreRefused)
{
    std::string dots = "a";
    for (int n = 0; n < 200000; ++n) {
        dots += ".a";
    }
    EXPECT_EQ(mistakes(dots + " = 1\n").size(), 1u);
    EXPECT_EQ(mistakes("[" + dots + "]\n").size(), 1u);
    EXPECT_EQ(mistakes("a = " + std::string(100000, '[')).size(), 1u);
    EXPECT_EQ(mistakes(std::string("\x7f"
                                   "ELF\x02\0\x01\xff\xfe",
                                   9))
                  .size(),
              1u);
    EXPECT_EQ(mistakes(std::string(1000, '\0')).size(), 1u);
    std::string many;
    for (int n = 0; n < 500; ++n) {
        many += "key" + std::to_string(n) + " = 1\n";
    }
    EXPECT_EQ(mistakes(many).size(), 101u);
}

TEST(CaseFileEntry, FilesThatCannotBeReadAreNamed)
{
    EXPECT_THROW(read_case("no_such_case.toml"), CaseError);
    EXPECT_THROW(read_case(testing::TempDir()), CaseError);
    const auto large = std::filesystem::path(testing::TempDir()) / "hyoryu_large.toml";
    std::ofstream(large) << "a";
    std::filesystem::resize_file(large, std::uintmax_t{100} << 20);
    try {
        read_case(large);
        FAIL();
    } catch (const CaseError& error) {
        EXPECT_EQ(error.diagnostics()[0].file, large.string());
    }
    std::filesystem::remove(large);
}

// E2: every key that names a file, with what is none. A device has no end, a pipe may have no
// writer: neither may be opened.
TEST(CaseFileEntry, E2NoReaderTakesWhatIsNoFile)
{
    const std::string pipe = testing::TempDir() + "/hyoryu_pipe_" + std::to_string(getpid());
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const std::string body = "[[body]]\ndensity = 500\nposition = [0, 0, 5]\n";
    const std::string mesh = "shape = \"mesh\"\nposition = [0, 0, 5]\nfile = ";
    const std::vector<std::array<std::string, 2>> keys = {
        {"body[0].file", body + "shape = \"mesh\"\nfile = "},
        {"body[0].file", body + "shape = \"particles\"\nfile = "},
        {"wall[0].file", "[[wall]]\n" + mesh},
        {"fluid.block[1].file", "[[fluid.block]]\n" + mesh},
        {"wall[0].motion.table", "[[wall]]\nshape = \"plane\"\n[wall.motion]\ntable = "}};
    const std::vector<std::array<std::string, 2>> files = {{"", "is empty"},
                                                           {".", "is a folder"},
                                                           {"/", "is a folder"},
                                                           {"/dev/zero", "is a device"},
                                                           {pipe, "is a pipe"},
                                                           {"none.stl", "does not exist"},
                                                           {"a\\u0000b", "control"},
                                                           {"a\\u001bb", "control"},
                                                           {"none/none.stl", "does not exist"}};
    for (const auto& [key, head] : keys) {
        for (const auto& [file, what] : files) {
            SCOPED_TRACE(key + " = " + file);
            const auto all = mistakes(short_case + head + "\"" + file + "\"\n");
            const Diagnostic d = mistake_at(all, key);
            EXPECT_NE(d.what.find(what), std::string::npos) << to_string(d);
        }
    }
    std::filesystem::remove(pipe);
}

// E3, E9: one rule wherever a name enters.
TEST(CaseFileEntry, E3E9NamesOfEverythingFollowOneRule)
{
    const std::string sphere = "[[body]]\nshape = \"sphere\"\nposition = [0, 0, 5]\n";
    const std::string gauge = "[[gauge]]\ntype = \"front\"\nname = ";
    const std::vector<std::array<std::string, 2>> keys = {
        {"body[0].name", sphere + "radius = 1\nmass = 1\nname = "},
        {"body[0].material", sphere + "radius = 1\nmass = 1\nmaterial = "},
        {"wall[0].name", "[[wall]]\nshape = \"plane\"\nname = "},
        {"wall[0].material", "[[wall]]\nshape = \"plane\"\nmaterial = "},
        {"gauge[0].name", gauge}};
    const std::vector<std::string> bad = {"x/L=0.5",
                                          ".",
                                          "..",
                                          "=1+1",
                                          "+a",
                                          "-a",
                                          "@a",
                                          " a",
                                          "a ",
                                          "a,b",
                                          "a;b",
                                          "a#b",
                                          "a\\\\b",
                                          "a\\\"b",
                                          "a\\tb",
                                          "a\\u001b[31m",
                                          "a\\u007f",
                                          "a\\u009bm",
                                          std::string(101, 'a')};
    const std::vector<std::string> good = {"a",        "a b", "a.b-c_d",
                                           "Übergang", "x=1", std::string(100, 'a')};
    for (const auto& [key, head] : keys) {
        for (const std::string& name : bad) {
            SCOPED_TRACE(key + " = " + name);
            const Diagnostic d =
                mistake_at(mistakes(short_case + head + "\"" + name + "\"\n"), key);
            EXPECT_NE(d.what.find("is not a valid name"), std::string::npos) << to_string(d);
        }
        for (const std::string& name : good) {
            SCOPED_TRACE(key + " = " + name);
            const std::string text = short_case + head + "\"" + name + "\"\n";
            EXPECT_TRUE(std::ranges::none_of(mistakes(text),
                                             [&](const Diagnostic& d) { return d.key == key; }));
        }
    }
    const Diagnostic time =
        mistake_at(mistakes(short_case + gauge + "\"time\"\n"), "gauge[0].name");
    EXPECT_NE(time.what.find("first column"), std::string::npos) << to_string(time);
    for (const std::string& title : {std::string("a\\u001b[31m"), std::string("=1+1")}) {
        mistake_at(mistakes("title = \"" + title + "\"\n" + short_case), "title");
    }
}

// E8: coordinates and speeds that are no place on Earth.
TEST(CaseFileEntry, E8MagnitudesAreBoundedByTheirUnit)
{
    const std::string ball = "[[body]]\nshape = \"sphere\"\nradius = 1\ndensity = 500\n";
    const std::vector<std::array<std::string, 3>> all = {
        {ball + "position = [", "0, 0, 5]", "body[0].position[0]"},
        {ball + "position = [0, 0, 5]\nvelocity = [", "0, 0, 0]", "body[0].velocity[0]"},
        {"[[wall]]\nshape = \"plane\"\npoint = [", "0, 0, 0]", "wall[0].point[0]"},
        {"[[wall]]\nshape = \"sphere\"\nposition = [0, 0, 0]\nradius = ", "1", "wall[0].radius"},
        {"[[wall]]\nshape = \"plane\"\n[wall.motion]\nvelocity = [", "0, 0, 0]",
         "wall[0].motion.velocity[0]"}};
    for (const auto& [head, good, key] : all) {
        for (const std::string& value : {std::string("1e300"), std::string("1e12")}) {
            const std::string rest = good.substr(std::min(good.find(','), good.size()));
            const Diagnostic d = mistake_at(mistakes(short_case + head + value + rest + "\n"), key);
            EXPECT_NE(d.what.find("is out of range, expected at most"), std::string::npos)
                << key << to_string(d);
        }
        EXPECT_EQ(mistake_at(mistakes(short_case + head + good + "\n"), key).key, "");
    }
}

// E11: a message without a hint leaves the user alone with it.
TEST(CaseFileEntry, E11EveryMistakeOfAValueHasAHint)
{
    const std::vector<std::string> values = {"nan",   "-1",        "true",     "[1]",
                                             "\"x\"", "{ a = 1 }", "1e30",     "\"\"",
                                             "[]",    "[[]]",      "\"1 kg\"", "1979-05-27"};
    const std::vector<std::string> keys = {
        "title",           "dimensions",    "gravity",           "seed",
        "time.end",        "time.step",     "particles.spacing", "domain.min",
        "domain.periodic", "fluid.density", "fluid.formulation", "fluid.viscosity.alpha",
        "fluid.viscosity", "output.every",  "output.fields",     "contact.restitution",
        "contact.method"};
    int told = 0;
    for (const std::string& key : keys) {
        for (const std::string& value : values) {
            SCOPED_TRACE(key + " = " + value);
            try {
                parse_case(short_case, "t.toml", {key + "=" + value});
            } catch (const CaseError& error) {
                for (const Diagnostic& d : error.diagnostics()) {
                    EXPECT_NE(d.hint, "") << to_string(d);
                    ++told;
                }
            }
        }
    }
    EXPECT_GT(told, 100);
}

// A hint says how to mend: what a key means is no hint where its value is right in itself.
TEST(CaseFileEntry, HintsSayWhatToDo)
{
    const std::string block = "[particles]\nspacing = 0.1\n[fluid]\n[[fluid.block]]\n";
    const std::string wall = "[[wall]]\nshape = \"basin\"\nmin = [0, 0, 0]\nmax = [2, 1, 1]\n";
    const std::string water = "shape = \"still_water\"\nlevel = 0.5\nseed = [9, 0.5]\n";
    const std::string box = "shape = \"box\"\nmin = [0, 0, 0]\nmax = [1, 1, 0.5]\n";
    const std::vector<std::array<std::string, 2>> all = {
        {block + water + wall, "move the seed"},
        {"gravity = [0, -9.81, 0]\n" + block + water + wall, "leave `gravity` out"},
        {block + "shape = \"box\"\nmin = [0, 0, 0.5]\nmax = [1, 1, 0]\n" + wall,
         "corner of the smallest"},
        {block + box + wall + "manning = 0.03\n[time.x]\n", "unknown"},
        {wall + "manning = 0.03\n", "remove it"},
        {"dimensions = 2\n" + wall +
             "[[wall]]\nname = \"t\"\nshape = \"terrain\"\nfile = \"t.asc\"\n",
         "`dimensions = 3`"},
        {"fluid = 3\n" + wall, "write [fluid]"},
        {"body = [1]\n" + wall, "write [[body]]"}};
    for (const auto& [text, hint] : all) {
        SCOPED_TRACE(text);
        const auto found = mistakes("time.end = 1.0\n" + text);
        ASSERT_FALSE(found.empty());
        const bool told = std::ranges::any_of(found, [&](const Diagnostic& d) {
            return (d.what + d.hint).find(hint) != std::string::npos;
        });
        EXPECT_TRUE(told) << hint << " in " << to_string(found.front());
    }
}

// E11: mistakes of syntax in words of ours, at the line, with what to write.
TEST(CaseFileEntry, E11SyntaxIsToldInPlainWordsAtItsLine)
{
    std::string parts;
    for (int k = 0; k < 80; ++k) {
        parts += ".a";
    }
    const std::vector<std::array<std::string, 3>> all = {
        {"end = 0,25", "decimal point, not a comma", "write end = 0.25"},
        {"end = 1.0 s", "must be in quotes", "write end = \"1.0 s\""},
        {"end = 5min", "must be in quotes", "write end = \"5 min\""},
        {"end = 1e400", "1e400 is too large", "1.8e308"},
        {"end = -2.5E+999", "is too large", "1.8e308"},
        {"end = .5", "needs a digit", "write end = 0.5"},
        {"end = 5.", "needs a digit", "write end = 5.0"},
        {"end = soon", "a text must be in quotes", "write end = \"soon\""},
        {"end = True", "lower case", "write end = true"},
        {"end = “1”", "typographic", "\""},
        {"end 1.0", "expected `=`", "key = value"},
        {"end =", "has no value", "key = value"},
        {"end = [1, 2", "list is not closed", "]"},
        {"end = \"abc", "text is not closed", "quote"},
        {"end = 'abc", "text is not closed", "quote"},
        {"end = \"a\\q\"", "backslash", "two"},
        {"end = 1.2.3", "number is invalid", "0.25"},
        {"end = 99999999999999999999", "whole number is too large", "1e20"},
        {"end = -9223372036854775809", "whole number is too large", "1e20"},
        {"end = 01", "leading zeros", "write 5"},
        {"end = {a = 1", "in braces", "{ key = value"},
        {"[tim", "header of a table", "[name]"},
        {"[time]", "\"time\" is defined twice", "one of them"},
        {"end = 1\nend = 2", "\"end\" is defined twice", "one of them"},
        {"= 3", "expected a key", "quotes"},
        {"title = \"caf\xe9\"", "not encoded in UTF-8", "save the file as UTF-8"},
        {"end = 1\rstep = 1", "carriage return", "line endings"},
        {"end = " + std::string(300, '['), "nested too deeply", "256"},
        {"end = " + std::string(2000, '1'), "number is too long", "17 digits"},
        {"end = 1 2", "expected the end of the line", "comment begins with #"},
        {"end = 2026-13-01", "date or time is invalid", "in quotes"},
        {"a" + parts + " = 1", "more than 64 parts", "in quotes"}};
    for (const auto& [line, what, hint] : all) {
        SCOPED_TRACE(line);
        const auto found = mistakes("[time]\n" + line + "\n");
        ASSERT_EQ(found.size(), 1U);
        const Diagnostic& d = found.front();
        EXPECT_NE(d.what.find(what), std::string::npos) << to_string(d);
        EXPECT_NE(d.hint.find(hint), std::string::npos) << to_string(d);
        EXPECT_EQ(d.what.find("parsing"), std::string::npos) << to_string(d);
        EXPECT_EQ(d.what.find("not understood"), std::string::npos) << to_string(d);
        EXPECT_TRUE(d.line == 2 || d.line == 3) << to_string(d);
        if (line.size() < 190) { // of longer lines the message shows none
            EXPECT_NE(to_string(d).find('^'), std::string::npos);
        }
    }
}

// E11: one pair of brackets too few, for every list of tables; nothing else is told of it.
TEST(CaseFileEntry, E11AListOfTablesInSingleBracketsIsToldWithItsHint)
{
    const std::string time = "[time]\nend = 1.0\n[particles]\nspacing = 0.1\n";
    const std::vector<std::pair<std::string, std::string>> all = {
        {"gauge", "name = \"level\"\ntype = \"front\"\n"},
        {"wall", "name = \"floor\"\nshape = \"plane\"\n"},
        {"body", "name = \"ball\"\nshape = \"sphere\"\nradius = 0.2\ndensity = 500\n"},
        {"fluid.block", "shape = \"box\"\nmin = [0, 0, 0]\nmax = [1, 1, 1]\n"},
        {"contact.pair", "materials = [\"a\", \"b\"]\nrestitution = 0.1\nfriction = 0.1\n"}};
    for (const auto& [name, keys] : all) {
        SCOPED_TRACE(name);
        const auto found = mistakes(time + "[" + name + "]\n" + keys);
        const auto told = std::ranges::find_if(found, [&](const Diagnostic& d) {
            return d.hint.find("write [[" + name + "]]") != std::string::npos;
        });
        ASSERT_NE(told, found.end());
        EXPECT_NE(told->what.find("expected a list of tables"), std::string::npos) << told->what;
        EXPECT_EQ(told->line, 5);
    }
}

// E11: who takes y for the vertical would see no gravity and no motion, without a word.
TEST(CaseFileEntry, E11ASpeedAlongYInTwoDimensionsIsToldAtItsPlace)
{
    const auto text = [](int dimensions, const std::string& gravity, const std::string& others) {
        return fmt::format("dimensions = {}\ngravity = {}\n[time]\nend = 1.0\n"
                           "[particles]\nspacing = 0.1\n[fluid]\nacceleration = {}\n"
                           "[[fluid.block]]\nshape = \"box\"\nmin = [0, -1, 0]\nmax = [1, 1, 1]\n"
                           "velocity = {}\n[[wall]]\nname = \"floor\"\nshape = \"box\"\n"
                           "min = [0, -1, -1]\nmax = [1, 1, -0.5]\n[wall.motion]\nvelocity = {}\n"
                           "[[body]]\nname = \"ball\"\nshape = \"sphere\"\nradius = 0.2\n"
                           "density = 500\nposition = [0, 0, 3]\nvelocity = {}\n",
                           dimensions, gravity, others, others, others, others);
    };
    for (const char* across : {"[0, -9.81, 0]", "[1, 1e-9, 2]"}) {
        const std::vector<Diagnostic> told = parse_case(text(2, across, across), "case").notices;
        ASSERT_EQ(told.size(), 5u) << across;
        for (std::size_t k = 0; k < told.size(); ++k) {
            EXPECT_NE(told[k].what.find("x-z plane"), std::string::npos) << told[k].what;
            EXPECT_EQ(told[k].severity, Diagnostic::Severity::warning);
        }
        std::vector<int> lines;
        std::ranges::transform(told, std::back_inserter(lines), &Diagnostic::line);
        std::ranges::sort(lines);
        EXPECT_EQ(lines, (std::vector<int>{2, 8, 13, 20, 27}));
        EXPECT_TRUE(parse_case(text(3, across, across), "case").notices.empty());
    }
    EXPECT_TRUE(parse_case(text(2, "[0, 0, -9.81]", "[1, 0, 2]"), "case").notices.empty());
}

TEST(CaseFileEntry, E11AHeightOfAnElevationGaugeIsToldToHaveNoEffect)
{
    const auto notices = [](const std::string& type, const std::string& at) {
        return parse_case("[time]\nend = 1.0\n[particles]\nspacing = 0.1\n[fluid]\n"
                          "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [1, 1, 1]\n"
                          "[[gauge]]\nname = \"g\"\ntype = \"" +
                              type + "\"\nat = " + at + "\n",
                          "case")
            .notices;
    };
    ASSERT_EQ(notices("elevation", "[0.2, 0.1, -0.3]").size(), 1u);
    EXPECT_EQ(notices("elevation", "[0.2, 0.1, -0.3]")[0].line, 13);
    EXPECT_TRUE(notices("elevation", "[0.2, 0.1, 0]").empty());
    EXPECT_TRUE(notices("elevation", "[0.2, 0.1]").empty());
    EXPECT_TRUE(notices("pressure", "[0.2, 0.1, 0.3]").empty());
}

} // namespace hyoryu::test_case_file_entry
