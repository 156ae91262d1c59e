// SPDX-License-Identifier: MIT
// Frames: what is written comes back, series name what is there, and a disk that refuses loses
// nothing.
#include "hyoryu/core/error.hpp"
#include "hyoryu/io/results.hpp"
#include "io/hdf5.hpp"

#include "results_fixture.hpp"

#include <fmt/format.h>

#include <array>
#include <csignal>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hyoryu::test_frames {
namespace {

namespace fs = std::filesystem;
using test_help::content_of;
using test_help::make_cloud;
using test_help::make_surface;

class Frames : public test_help::ResultsTest {};

void expect_equal(const Cloud& a, const Cloud& b)
{
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.time, b.time);
    EXPECT_EQ(a.index, b.index);
    EXPECT_EQ(a.points, b.points);
    ASSERT_EQ(a.columns.size(), b.columns.size());
    for (std::size_t k = 0; k < a.columns.size(); ++k) {
        EXPECT_EQ(a.columns[k].name, b.columns[k].name);
        EXPECT_EQ(a.columns[k].unit, b.columns[k].unit);
        EXPECT_EQ(a.columns[k].components, b.columns[k].components);
        EXPECT_TRUE(a.columns[k].values == b.columns[k].values) << a.columns[k].name;
    }
}

// None, few (stored as they are), one chunk, one full chunk and one row, several chunks.
TEST_F(Frames, ComeBackAtEverySize)
{
    FrameWriter writer(folder);
    std::vector<Cloud> clouds;
    for (const std::size_t count : {0UL, 1UL, 1000UL, 30000UL, 65536UL, 65537UL, 150000UL}) {
        clouds.push_back(make_cloud("fluid", static_cast<std::int64_t>(clouds.size()), count));
        writer.write(clouds.back());
    }
    writer.finish();
    for (const Cloud& cloud : clouds) {
        expect_equal(read_frame(folder / fmt::format("frames/fluid_{:06}.hdf", cloud.index)),
                     cloud);
    }
}

TEST_F(Frames, OfSurfacesComeBack)
{
    FrameWriter writer(folder);
    const Surface surface = make_surface(3);
    writer.write(surface);
    writer.write(surface, FramePlace::alone);
    writer.finish();
    for (const char* file : {"frames/surfaces_000003.hdf", "surfaces.hdf"}) {
        const Surface read = read_surface(folder / file);
        EXPECT_EQ(read.points, surface.points);
        EXPECT_EQ(read.triangles, surface.triangles);
        EXPECT_EQ(read.time, surface.time);
        EXPECT_EQ(read.columns.size(), 1U);
    }
}

TEST_F(Frames, AreNamedInTheirSeries)
{
    FrameWriter writer(folder);
    for (std::int64_t index = 0; index < 5; ++index) {
        writer.write(make_cloud("fluid", index, 10));
        writer.write(make_cloud("bodies", index, 4));
        writer.write(make_surface(index));
    }
    writer.write(make_cloud("walls", 0, 7), FramePlace::alone);
    writer.finish();
    for (const char* name : {"fluid", "bodies", "surfaces"}) {
        const auto entries = read_series(folder / (std::string(name) + ".hdf.series"));
        ASSERT_EQ(entries.size(), 5U);
        EXPECT_EQ(entries[2].file, fs::path(fmt::format("frames/{}_000002.hdf", name)));
        EXPECT_DOUBLE_EQ(entries[2].time, 0.2);
    }
    EXPECT_EQ(read_frame(folder / "walls.hdf").points.size(), 21U);
    for (const std::string& file : content_of(folder)) {
        EXPECT_FALSE(file.ends_with(".tmp")) << file;
    }
}

TEST_F(Frames, OfAnEarlierRunAreContinued)
{
    {
        FrameWriter first(folder);
        for (std::int64_t index = 0; index < 6; ++index) {
            first.write(make_cloud("fluid", index, 10));
        }
    }
    FrameWriter second(folder);
    second.forget_after(0.2);
    EXPECT_EQ(read_series(folder / "fluid.hdf.series").size(), 3U);
    EXPECT_FALSE(fs::exists(folder / "frames/fluid_000003.hdf"));
    second.write(make_cloud("fluid", 3, 20));
    second.finish();
    const auto entries = read_series(folder / "fluid.hdf.series");
    ASSERT_EQ(entries.size(), 4U);
    EXPECT_EQ(read_frame(folder / entries[3].file).points.size(), 60U);
}

TEST_F(Frames, ThatSomebodyRemovedAreFound)
{
    {
        FrameWriter first(folder);
        for (std::int64_t index = 0; index < 4; ++index) {
            first.write(make_cloud("fluid", index, 10));
            first.write(make_cloud("bodies", index, 2));
        }
    }
    EXPECT_TRUE(FrameWriter(folder).missing().empty());
    fs::remove(folder / "frames/fluid_000001.hdf");
    fs::remove(folder / "frames/bodies_000003.hdf");
    FrameWriter second(folder);
    const std::vector<fs::path> gone{"frames/bodies_000003.hdf", "frames/fluid_000001.hdf"};
    EXPECT_EQ(second.missing(), gone);
    EXPECT_EQ(read_series(folder / "fluid.hdf.series").size(), 4U);
}

// A frame that is written again takes the place of the old one instead of standing there twice.
TEST_F(Frames, ReplaceOlderOnesOfTheSameIndex)
{
    FrameWriter writer(folder);
    writer.write(make_cloud("fluid", 0, 10));
    writer.write(make_cloud("fluid", 0, 12));
    writer.finish();
    EXPECT_EQ(read_series(folder / "fluid.hdf.series").size(), 1U);
    EXPECT_EQ(read_frame(folder / "frames/fluid_000000.hdf").points.size(), 36U);
}

TEST_F(Frames, ThatAreMissingOrForeignAreErrors)
{
    EXPECT_THROW(read_frame(folder / "none.hdf"), IoError);
    EXPECT_THROW(read_series(folder / "none.hdf.series"), IoError);
    test_help::put_text_into(folder / "foreign.hdf", "not HDF5 at all");
    EXPECT_THROW(read_frame(folder / "foreign.hdf"), IoError);
    test_help::put_text_into(folder / "foreign.hdf.series", "{\"files\": 3}");
    EXPECT_THROW(read_series(folder / "foreign.hdf.series"), IoError);
    write_checkpoint(folder, Snapshot{});
    EXPECT_THROW(read_frame(folder / "checkpoint.h5"), IoError);
}

/// What the child of the test below does: exit code 0 if all went as promised.
int write_until_the_disk_is_full(const fs::path& folder)
{
    std::signal(SIGXFSZ, SIG_IGN); // without it the limit kills instead of failing the write
    FrameWriter writer(folder);
    for (std::int64_t index = 0; index < 3; ++index) {
        writer.write(make_cloud("fluid", index, 100));
    }
    writer.finish();
    const rlimit limit{200000, 200000};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
        writer.write(make_cloud("fluid", 3, 100000));
        writer.finish();
        return 1;
    } catch (const IoError& error) {
        if (std::string(error.what()).find("File too large") == std::string::npos) {
            return 2;
        }
    }
    try {
        writer.write(make_cloud("fluid", 4, 100));
        return 3;
    } catch (const IoError&) {
        return 0;
    }
}

// A limit on the size of files stands for the full disk: the system refuses in the same place.
TEST_F(Frames, SurviveADiskThatRefuses)
{
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        ::_exit(write_until_the_disk_is_full(folder));
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0);
    const std::vector<std::string> expected{"fluid.hdf.series", "frames", "frames/fluid_000000.hdf",
                                            "frames/fluid_000001.hdf", "frames/fluid_000002.hdf"};
    EXPECT_EQ(content_of(folder), expected);
    for (const SeriesEntry& entry : read_series(folder / "fluid.hdf.series")) {
        EXPECT_EQ(read_frame(folder / entry.file).points.size(), 300U);
    }
}

TEST_F(Frames, TellWhyAFolderCannotBeWritten)
{
    test_help::put_text_into(folder / "file", "");
    EXPECT_THROW(FrameWriter(folder / "file"), IoError);
    try {
        write_text(folder / "missing/x.json", "{}");
        FAIL();
    } catch (const IoError& error) {
        EXPECT_NE(std::string(error.what()).find("No such file or directory"), std::string::npos);
    }
}

/// Puts an array of `rows` x 3 numbers, of which the file holds none, in the place of an array.
void claim_rows(const fs::path& file, const std::string& dataset, hsize_t rows)
{
    const hdf5::Session session;
    const hdf5::Handle open(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "open");
    hdf5::check(H5Ldelete(open, dataset.c_str(), H5P_DEFAULT), "remove");
    const std::array<hsize_t, 2> dims{rows, 3};
    const std::array<hsize_t, 2> chunk{std::min<hsize_t>(rows, 1024), 3};
    const hdf5::Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "prepare");
    hdf5::check(H5Pset_chunk(creation, 2, chunk.data()), "prepare");
    const hdf5::Handle space(H5Screate_simple(2, dims.data(), nullptr), H5Sclose, "size");
    const hdf5::Handle array(H5Dcreate2(open, dataset.c_str(), H5T_NATIVE_FLOAT, space, H5P_DEFAULT,
                                        creation, H5P_DEFAULT),
                             H5Dclose, "create");
}

std::string fault_of(const fs::path& file)
{
    try {
        read_frame(file);
    } catch (const IoError& error) {
        return error.what();
    }
    return "none";
}

TEST_F(Frames, ThatClaimWhatTheyDoNotHoldAreErrors)
{
    FrameWriter writer(folder);
    writer.write(make_cloud("fluid", 0, 10));
    writer.write(make_cloud("fluid", 1, 10));
    writer.finish();
    const fs::path file = folder / "frames/fluid_000000.hdf";
    // 1.6 GB that are nowhere, and a product of dimensions that no integer holds.
    claim_rows(file, "/VTKHDF/Points", hsize_t{1} << 27);
    EXPECT_NE(fault_of(file).find("contains less data than it declares"), std::string::npos)
        << fault_of(file);
    claim_rows(file, "/VTKHDF/Points", hsize_t{1} << 62);
    EXPECT_NE(fault_of(file).find("it declares"), std::string::npos) << fault_of(file);
    // An array for other points than those of the frame.
    claim_rows(folder / "frames/fluid_000001.hdf", "/VTKHDF/PointData/Velocity", 11);
    EXPECT_NE(fault_of(folder / "frames/fluid_000001.hdf").find("not have one row per point"),
              std::string::npos);
}

} // namespace
} // namespace hyoryu::test_frames
