// SPDX-License-Identifier: MIT
// The checkpoint: every bit survives, and every damage is noticed before anything is read.
#include "hyoryu/core/error.hpp"
#include "hyoryu/io/results.hpp"
#include "results_fixture.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace hyoryu {
namespace {

using testing::put_text_into;
using testing::text_of;

class Checkpoint : public testing::ResultsTest {};

Snapshot make_snapshot()
{
    std::vector<double> positions(999);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        positions[i] = std::sin(static_cast<double>(i)) * 1e-3;
    }
    positions[7] = std::numeric_limits<double>::quiet_NaN();
    positions[8] = std::bit_cast<double>(0xfff8'dead'beef'0001U); // a NaN with a payload and a sign
    positions[9] = -0.0;
    positions[10] = 5e-324;
    Snapshot snapshot;
    snapshot.arrays["fluid/position"] = {"position", "m", 3, positions};
    snapshot.arrays["fluid"] = {"", "", 1, std::vector<std::int64_t>{1, -2}};
    snapshot.arrays["."] = {"100 %/s", "%", 1, std::vector<std::uint8_t>{}};
    snapshot.arrays["a%2Fb"] = {"x", "", 3, std::vector<float>{}};
    snapshot.texts["case"] = std::string("title = \"x\"\n\0\0", 14);
    snapshot.texts["empty"] = "";
    return snapshot;
}

std::vector<std::uint64_t> bits(const Column& column)
{
    std::vector<std::uint64_t> result;
    for (const double value : std::get<std::vector<double>>(column.values)) {
        result.push_back(std::bit_cast<std::uint64_t>(value));
    }
    return result;
}

TEST_F(Checkpoint, KeepsEveryBit)
{
    const Snapshot written = make_snapshot();
    write_checkpoint(folder, written);
    const Snapshot read = read_checkpoint(folder);
    EXPECT_EQ(read.texts, written.texts);
    ASSERT_EQ(read.arrays.size(), written.arrays.size());
    EXPECT_EQ(bits(read.arrays.at("fluid/position")), bits(written.arrays.at("fluid/position")));
    for (const auto& [name, column] : written.arrays) {
        const Column& back = read.arrays.at(name);
        EXPECT_EQ(back.name, column.name);
        EXPECT_EQ(back.unit, column.unit);
        EXPECT_EQ(back.components, column.components);
        EXPECT_EQ(back.values.index(), column.values.index());
    }
    EXPECT_TRUE(read.arrays.at("fluid").values == written.arrays.at("fluid").values);
}

TEST_F(Checkpoint, IsReplacedWhole)
{
    write_checkpoint(folder, make_snapshot());
    write_checkpoint(folder, {{}, {{"step", "2"}}});
    EXPECT_EQ(read_checkpoint(folder).texts.at("step"), "2");
    EXPECT_EQ(testing::content_of(folder),
              (std::vector<std::string>{"checkpoint.h5", "checkpoint.previous.h5"}));
}

TEST_F(Checkpoint, KeepsTwoGenerations)
{
    for (const char* step : {"1", "2", "3"}) {
        write_checkpoint(folder, {{}, {{"step", step}}});
    }
    const NewestCheckpoint newest = read_newest_checkpoint(folder);
    EXPECT_EQ(newest.snapshot.texts.at("step"), "3");
    EXPECT_EQ(newest.passed_over, "");
    EXPECT_EQ(testing::content_of(folder),
              (std::vector<std::string>{"checkpoint.h5", "checkpoint.previous.h5"}));
    std::filesystem::rename(folder / "checkpoint.previous.h5", folder / "checkpoint.h5");
    EXPECT_EQ(read_checkpoint(folder).texts.at("step"), "2");
}

TEST_F(Checkpoint, ThatIsDamagedGivesWayToTheOneBefore)
{
    write_checkpoint(folder, {{}, {{"step", "1"}}});
    write_checkpoint(folder, {{}, {{"step", "2"}}});
    put_text_into(folder / "checkpoint.h5", "torn");
    const NewestCheckpoint newest = read_newest_checkpoint(folder);
    EXPECT_EQ(newest.snapshot.texts.at("step"), "1");
    EXPECT_NE(newest.passed_over.find("is not a checkpoint"), std::string::npos);
    // Without this the next checkpoint would keep the torn one as the older generation.
    take_previous_checkpoint(folder);
    write_checkpoint(folder, {{}, {{"step", "3"}}});
    put_text_into(folder / "checkpoint.h5", "torn");
    EXPECT_EQ(read_newest_checkpoint(folder).snapshot.texts.at("step"), "1");
    std::filesystem::remove(folder / "checkpoint.h5");
    EXPECT_EQ(read_newest_checkpoint(folder).snapshot.texts.at("step"), "1");
    put_text_into(folder / "checkpoint.previous.h5", "torn as well");
    EXPECT_THROW(read_newest_checkpoint(folder), IoError);
    std::filesystem::remove(folder / "checkpoint.previous.h5");
    EXPECT_THROW(read_newest_checkpoint(folder), IoError);
}

TEST_F(Checkpoint, NoticesAFlippedBitAnywhere)
{
    write_checkpoint(folder, make_snapshot());
    const std::string good = text_of(folder / "checkpoint.h5");
    constexpr std::size_t header = 512; // every byte of it, and places all over the rest
    constexpr std::size_t positions = 1024;
    for (std::size_t k = 0; k < positions; ++k) {
        std::string bad = good;
        const std::size_t place = k < header ? k : k * (good.size() - 1) / (positions - 1);
        bad[place] = static_cast<char>(bad[place] ^ (1 << (k % 8)));
        put_text_into(folder / "checkpoint.h5", bad);
        EXPECT_THROW(read_checkpoint(folder), IoError) << "byte " << place;
    }
    put_text_into(folder / "checkpoint.h5", good);
    EXPECT_NO_THROW(read_checkpoint(folder));
}

TEST_F(Checkpoint, ThatIsMissingTornOrForeignIsAnError)
{
    EXPECT_THROW(read_checkpoint(folder), IoError);
    write_checkpoint(folder, make_snapshot());
    const std::string good = text_of(folder / "checkpoint.h5");
    constexpr std::size_t lengths = 200;
    for (std::size_t k = 0; k < lengths; ++k) {
        const std::size_t size = k * (good.size() - 1) / (lengths - 1);
        put_text_into(folder / "checkpoint.h5", good.substr(0, size));
        EXPECT_THROW(read_checkpoint(folder), IoError) << size;
    }
    put_text_into(folder / "checkpoint.h5", good + "x");
    EXPECT_THROW(read_checkpoint(folder), IoError);
    std::string newer = good;
    newer.replace(newer.find("format "), 8, "format 0");
    put_text_into(folder / "checkpoint.h5", newer);
    try {
        read_checkpoint(folder);
        FAIL();
    } catch (const IoError& error) {
        EXPECT_NE(std::string(error.what()).find("another format"), std::string::npos);
    }
}

} // namespace
} // namespace hyoryu
