// SPDX-License-Identifier: MIT
// results.h5 as h5py sees it: texts, tables and the frames behind external links.
#include "hyoryu/io/results.hpp"
#include "results_fixture.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>

namespace hyoryu::test_master {
namespace {

class Master : public test_help::ResultsTest {
protected:
    /// Runs Python lines with `f` the open master file; true if no assertion failed.
    bool python_agrees(const std::string& lines) const
    {
        const auto script = folder / "script.py";
        test_help::put_text_into(script, "import h5py, sys\nf = h5py.File(sys.argv[1])\n" + lines);
        const std::string command =
            "/usr/bin/python3 " + script.string() + " " + (folder / "results.h5").string();
        return std::system(command.c_str()) == 0;
    }
};

TEST_F(Master, LeadsToEverything)
{
    if (std::system("/usr/bin/python3 -c 'import h5py' 2> /dev/null") != 0) {
        GTEST_SKIP() << "python3-h5py is not installed";
    }
    FrameWriter writer(folder);
    for (std::int64_t index = 0; index < 3; ++index) {
        writer.write(test_help::make_cloud("fluid", index, 70000));
        writer.write(test_help::make_surface(index));
    }
    writer.write(test_help::make_cloud("walls", 0, 5), FramePlace::alone);
    writer.finish();
    {
        History history(folder, {"bodies", {{"time", "s"}, {"body", ""}, {"x", "m"}}});
        history.append(std::array{cell(0.0), cell("7"), cell(1.5)}); // a name, though a number
        history.append(std::array{cell(0.0), cell("timber"), cell(2.5)});
        history.append(std::array{cell(0.25), cell("big, old"), cell(-1.0 / 3.0)});
    }
    write_text(folder / "plan.json", "{\"on\": []}");
    write_master(folder, "dimensions = 3\ntitle = \"Bore\"\n", "0.1.0");
    EXPECT_TRUE(python_agrees(R"(
assert f.attrs['version'] == '0.1.0' and f.attrs['title'] == 'Bore', dict(f.attrs)
assert f['case'][()].decode().startswith('dimensions'), f['case'][()]
assert f['plan'][()].decode() == '{"on": []}'
assert list(f['times'][:]) == [0, 0.1, 0.2] and list(f['indices'][:]) == [0, 1, 2]
bodies = f['histories/bodies']
assert list(bodies['time'][:]) == [0, 0, 0.25] and bodies['time'].attrs['unit'] == 's'
assert list(bodies['x'][:]) == [1.5, 2.5, -1/3]
assert list(bodies['body'][:]) == [b'7', b'timber', b'big, old'], bodies['body'][:]
fluid = f['frames/000002/fluid']
assert fluid['Points'].shape == (70000, 3) and fluid['Points'][5, 0] == 7
assert fluid['PointData/Velocity'].attrs['unit'] == 'm/s'
assert fluid['PointData/Id'][69999] == 69999 << 33
assert f['frames/000001'].attrs['time'] == 0.1
assert f['frames/000001/surfaces/Types'][0] == 5
assert f['walls/Points'].shape == (5, 3)
)"));
}

TEST_F(Master, OfAnEmptyRunIsWritten)
{
    write_master(folder, "", "0.1.0");
    EXPECT_TRUE(std::filesystem::exists(folder / "results.h5"));
}

} // namespace
} // namespace hyoryu::test_master
