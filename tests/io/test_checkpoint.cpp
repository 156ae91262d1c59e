// SPDX-License-Identifier: MIT
// The checkpoint: every bit survives, and every damage is noticed before anything is read.
#include "hyoryu/core/error.hpp"
#include "hyoryu/core/state.hpp"
#include "hyoryu/io/results.hpp"
#include "results_fixture.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace hyoryu::test_checkpoint {
namespace {

using test_help::put_text_into;
using test_help::text_of;

class Checkpoint : public test_help::ResultsTest {};

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
    write_checkpoint(folder, Snapshot{{}, {{"step", "2"}}});
    EXPECT_EQ(read_checkpoint(folder).texts.at("step"), "2");
    EXPECT_EQ(test_help::content_of(folder),
              (std::vector<std::string>{"checkpoint.h5", "checkpoint.previous.h5"}));
}

TEST_F(Checkpoint, KeepsTwoGenerations)
{
    for (const char* step : {"1", "2", "3"}) {
        write_checkpoint(folder, Snapshot{{}, {{"step", step}}});
    }
    const NewestCheckpoint newest = read_newest_checkpoint(folder);
    EXPECT_EQ(newest.snapshot.texts.at("step"), "3");
    EXPECT_EQ(newest.passed_over, "");
    EXPECT_EQ(test_help::content_of(folder),
              (std::vector<std::string>{"checkpoint.h5", "checkpoint.previous.h5"}));
    std::filesystem::rename(folder / "checkpoint.previous.h5", folder / "checkpoint.h5");
    EXPECT_EQ(read_checkpoint(folder).texts.at("step"), "2");
}

TEST_F(Checkpoint, ThatIsDamagedGivesWayToTheOneBefore)
{
    write_checkpoint(folder, Snapshot{{}, {{"step", "1"}}});
    write_checkpoint(folder, Snapshot{{}, {{"step", "2"}}});
    put_text_into(folder / "checkpoint.h5", "torn");
    const NewestCheckpoint newest = read_newest_checkpoint(folder);
    EXPECT_EQ(newest.snapshot.texts.at("step"), "1");
    EXPECT_NE(newest.passed_over.find("is not a checkpoint"), std::string::npos);
    // Without this the next checkpoint would keep the torn one as the older generation.
    take_previous_checkpoint(folder);
    write_checkpoint(folder, Snapshot{{}, {{"step", "3"}}});
    put_text_into(folder / "checkpoint.h5", "torn");
    EXPECT_EQ(read_newest_checkpoint(folder).snapshot.texts.at("step"), "1");
    std::filesystem::remove(folder / "checkpoint.h5");
    EXPECT_EQ(read_newest_checkpoint(folder).snapshot.texts.at("step"), "1");
    put_text_into(folder / "checkpoint.previous.h5", "torn as well");
    EXPECT_THROW(read_newest_checkpoint(folder), IoError);
    std::filesystem::remove(folder / "checkpoint.previous.h5");
    EXPECT_THROW(read_newest_checkpoint(folder), IoError);
}

// One in parts, of which each has its number and that of the checkpoint.
void write_in_parts(const std::filesystem::path& folder, double number, int count)
{
    const std::int64_t set = next_part_set(folder);
    std::vector<CheckpointPart> parts;
    for (int part = 0; part < count; ++part) {
        Snapshot own;
        own.arrays["number"] = {"", "", 1, std::vector<double>{number, 1.0 * part}};
        parts.push_back(write_checkpoint_part(folder, set, part, on_demand(std::move(own))));
    }
    write_checkpoint(folder, Snapshot{{}, {{"step", std::to_string(number)}}}, parts);
}

// The number of a checkpoint, of which all parts must be.
double number_of(const std::filesystem::path& folder, const NewestCheckpoint& newest)
{
    double number = -1;
    for (std::size_t part = 0; part < newest.parts.size(); ++part) {
        const Snapshot own = read_checkpoint_part(folder, newest.parts[part]);
        const auto& values = std::get<std::vector<double>>(own.arrays.at("number").values);
        EXPECT_EQ(values.at(1), static_cast<double>(part));
        EXPECT_TRUE(part == 0 || values.at(0) == number);
        number = values.at(0);
    }
    return number;
}

TEST_F(Checkpoint, InPartsKeepsTwoGenerationsAndNoOtherParts)
{
    for (const int count : {1, 4, 2, 3}) {
        write_in_parts(folder, count, count);
        const NewestCheckpoint newest = read_newest_checkpoint(folder);
        EXPECT_EQ(newest.parts.size(), static_cast<std::size_t>(count));
        EXPECT_EQ(number_of(folder, newest), count);
        EXPECT_EQ(newest.snapshot.texts.size(), 1U);
        EXPECT_THROW(read_checkpoint(folder), IoError); // its particles are elsewhere
    }
    EXPECT_EQ(test_help::content_of(folder).size(), 2U + 2 + 3);
    // Whatever a kill leaves of a set that was never named does not hinder the next one.
    write_checkpoint_part(folder, next_part_set(folder), 0, on_demand(Snapshot{}));
    write_in_parts(folder, 7, 2);
    EXPECT_EQ(number_of(folder, read_newest_checkpoint(folder)), 7);
    EXPECT_EQ(test_help::content_of(folder).size(), 2U + 3 + 2);
    write_checkpoint(folder, make_snapshot());
    write_checkpoint(folder, make_snapshot());
    EXPECT_EQ(test_help::content_of(folder).size(), 2U);
}

TEST_F(Checkpoint, WithAPartThatIsNotItsOwnGivesWayToTheOneBefore)
{
    const auto part_of = [&](int part) {
        return folder /
               read_newest_checkpoint(folder).parts.at(static_cast<std::size_t>(part)).name;
    };
    for (const char* const fault : {"missing", "torn", "of another checkpoint", "cut"}) {
        for (int part = 0; part < 3; ++part) {
            write_in_parts(folder, 1, 3);
            const std::filesystem::path old = part_of(part);
            write_in_parts(folder, 2, 3);
            const std::filesystem::path bad = part_of(part);
            if (std::string_view(fault) == "missing") {
                std::filesystem::remove(bad);
            } else if (std::string_view(fault) == "torn") {
                put_text_into(bad, "torn");
            } else if (std::string_view(fault) == "cut") {
                std::filesystem::resize_file(bad, std::filesystem::file_size(bad) - 1);
            } else {
                std::filesystem::copy_file(old, bad,
                                           std::filesystem::copy_options::overwrite_existing);
            }
            const NewestCheckpoint newest = read_newest_checkpoint(folder);
            EXPECT_EQ(number_of(folder, newest), 1) << fault;
            EXPECT_NE(newest.passed_over.find(bad.filename().string()), std::string::npos)
                << newest.passed_over;
        }
    }
}

// Of names that lead elsewhere nothing is read.
TEST_F(Checkpoint, NamesNoPartsOutOfItsFolder)
{
    for (const char* const name :
         {"../checkpoint.000001.0000.h5", "/etc/passwd", "case.toml", ""}) {
        write_checkpoint(folder, Snapshot{}, {{name, 10, 1}});
        try {
            read_newest_checkpoint(folder);
            ADD_FAILURE() << name;
        } catch (const IoError& error) {
            EXPECT_NE(std::string(error.what()).find("it names"), std::string::npos)
                << error.what();
        }
        std::filesystem::remove(folder / "checkpoint.h5");
    }
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
} // namespace hyoryu::test_checkpoint
