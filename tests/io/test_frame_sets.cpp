// SPDX-License-Identifier: MIT
// The sets of frames in a results folder whose lists are damaged or missing.
#include "hyoryu/core/error.hpp"
#include "hyoryu/io/convert.hpp"

#include "results_fixture.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace hyoryu::test_frame_sets {
namespace {

using FrameSets = test_help::ResultsTest;

TEST_F(FrameSets, SeriesThatLeadAwayAreDamage)
{
    for (const char* name : {"../../etc/passwd", "/etc/passwd", "frames/bodies_000000.hdf",
                             "frames/fluid_000000.hdf/../../x.hdf", "frames/fluid_0.hdf"}) {
        test_help::put_text_into(
            folder / "fluid.hdf.series",
            fmt::format(R"({{"files": [{{"name": "{}", "time": 0}}]}})", name));
        EXPECT_THROW(frame_sets(folder), IoError) << name;
    }
    test_help::put_text_into(folder / "fluid.hdf.series",
                             R"({"files": [{"name": "frames/fluid_000001.hdf", "time": 1},
                                         {"name": "frames/fluid_000000.hdf", "time": 0}]})");
    EXPECT_THROW(frame_sets(folder), IoError);
}

TEST_F(FrameSets, ASeriesThatIsMissingIsDamage)
{
    for (const char* name : {"fluid", "bodies", "surfaces"}) {
        const auto put = [&](int frame) {
            const auto place = folder / "frames" / fmt::format("{}_{:06d}.hdf", name, frame);
            std::filesystem::create_directories(place.parent_path());
            test_help::put_text_into(place, "");
        };
        put(0);
        EXPECT_TRUE(frame_sets(folder).empty()) << "a run that begins";
        put(1);
        EXPECT_THROW(frame_sets(folder), IoError) << name;
        std::filesystem::remove_all(folder / "frames");
    }
}

} // namespace
} // namespace hyoryu::test_frame_sets
