// SPDX-License-Identifier: MIT
// One mistake gives one message: what follows from a value that was refused is not told as well.
#include "own_folder.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/plan.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace hyoryu::test_one_mistake {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const fs::path& file)
{
    std::ifstream stream(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

std::string joined(const std::vector<std::string>& lines)
{
    std::string text;
    for (const std::string& line : lines) {
        text += line + '\n';
    }
    return text;
}

std::vector<Diagnostic> mistakes_of(const std::string& text, const fs::path& file)
{
    try {
        parse_case(text, file);
    } catch (const CaseError& error) {
        return error.diagnostics();
    }
    return {};
}

std::string told(const std::vector<Diagnostic>& mistakes)
{
    std::ostringstream text;
    for (const Diagnostic& mistake : mistakes) {
        text << "  line " << mistake.line << ": " << mistake.key << ": " << mistake.what << '\n';
    }
    return text.str();
}

// Every value of every shipped case is replaced, one at a time, by one of the wrong type; equal
// values of equal keys once. Names and materials that others refer to are among them, and ground
// and yards that buildings and debris stand on.
TEST(OneMistake, GivesOneMessageInEveryShippedCase)
{
    const std::regex header(R"(^\s*(\[\[?[\w.]+\]?\]).*)");
    const std::regex value(R"(^\s*([\w]+) = ((?!.*""").*))");
    std::set<std::string> seen;
    int tried = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(HYORYU_SOURCE_DIR) / "cases")) {
        const fs::path file = entry.path() / "case.toml";
        const std::vector<std::string> lines = lines_of(file);
        std::string table;
        for (std::size_t n = 0; n < lines.size(); ++n) {
            std::smatch m;
            if (std::regex_match(lines[n], m, header)) {
                table = m.str(1);
            } else if (std::regex_match(lines[n], m, value)) {
                const std::string given = m.str(2);
                const bool goes_on = given[0] == '[' && given.find(']') == std::string::npos;
                // true has a meaning of its own for `layers`
                if (goes_on || m.str(1) == "layers" ||
                    !seen.insert(table + m.str(1) + given).second) {
                    continue;
                }
                std::vector<std::string> mistaken = lines;
                mistaken[n] = m.str(1) + (given.starts_with("true") || given.starts_with("false")
                                              ? " = \"yes\""
                                              : " = true");
                const std::vector<Diagnostic> mistakes = mistakes_of(joined(mistaken), file);
                ++tried;
                EXPECT_EQ(mistakes.size(), 1U) << file << ", " << table << " " << lines[n] << '\n'
                                               << told(mistakes);
                EXPECT_TRUE(mistakes.empty() || mistakes.front().line == static_cast<int>(n) + 1)
                    << told(mistakes);
            }
        }
    }
    EXPECT_GT(tried, 500);
}

// What the plan finds wrong points at the value, of the file or of the command line, and not at the
// table that holds it.
TEST(OneMistake, OfThePlanPointsAtItsValue)
{
    const OwnFolder folder;
    const fs::path file = folder.put("case.toml", R"([time]
end = 1
step = 0.5
[particles]
spacing = 0.1
[domain]
min = [0, 0, 0]
max = [4, 1, 2]
[fluid]
[[fluid.block]]
shape = "box"
min = [0, 0, 0]
max = [4, 1, 1]
[[wall]]
shape = "basin"
min = [0, 0, 0]
max = [4, 1, 2]
open = ["+z", "-x", "+x"]
[[gauge]]
type = "pressure"
at = [9, 0.5, 0.5]
[[open]]
into = "+x"
min = [0.3, 0, 0]
max = [0.3, 1, 1]
kind = "absorb"
)");
    const auto lines = [&](const std::vector<std::string>& overrides) {
        const Scene scene = read_case(file, overrides);
        std::set<std::pair<std::string, int>> places;
        try {
            make_plan(scene, fill(scene));
        } catch (const CaseError& error) {
            for (const Diagnostic& mistake : error.diagnostics()) {
                places.emplace(mistake.key, mistake.line);
            }
        }
        return places;
    };
    using Places = std::set<std::pair<std::string, int>>;
    EXPECT_EQ(lines({}), (Places{{"time.step", 3}, {"gauge[0].at", 21}, {"open.open.1.min", 24}}));
    // A value of the command line has no line.
    EXPECT_EQ(lines({"time.step=0.4"}),
              (Places{{"time.step", 0}, {"gauge[0].at", 21}, {"open.open.1.min", 24}}));
}

} // namespace
} // namespace hyoryu::test_one_mistake
