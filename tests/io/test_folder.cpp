// SPDX-License-Identifier: MIT
// The results folder: nothing that a run did not write is ever removed.
#include "hyoryu/core/error.hpp"
#include "hyoryu/io/results.hpp"
#include "results_fixture.hpp"

namespace hyoryu::test_folder {
namespace {

namespace fs = std::filesystem;
using test_help::content_of;
using test_help::make_cloud;
using test_help::put_text_into;

class Folder : public test_help::ResultsTest {
protected:
    /// One of everything that the program writes.
    void fill()
    {
        prepare_results(folder, Existing::extend);
        FrameWriter writer(folder);
        writer.write(make_cloud("fluid", 0, 3));
        writer.write(make_cloud("walls", 0, 3), FramePlace::alone);
        writer.finish();
        for (const char* name : {"bodies", "contacts", "energy", "gauges"}) {
            const History history(folder, {name, {{"time", "s"}}});
        }
        for (const char* name :
             {"case.toml", "plan.json", "summary.json", "run.log", "report.html"}) {
            write_text(folder / name, "x");
        }
        write_checkpoint(folder, Snapshot{});
        write_checkpoint(folder, Snapshot{});
        write_master(folder, "", "0");
        put_text_into(folder / "pictures/frame_000000.png", "");
        put_text_into(folder / "pictures/animation.mp4", "");
        put_text_into(folder / "frames/fluid_000001.hdf.tmp", "torn");
    }
};

TEST_F(Folder, IsMadeWithItsParents)
{
    prepare_results(folder / "a/b", Existing::refuse);
    EXPECT_TRUE(fs::is_directory(folder / "a/b/frames"));
}

TEST_F(Folder, ThatIsEmptyIsTaken)
{
    EXPECT_NO_THROW(prepare_results(folder, Existing::refuse));
}

TEST_F(Folder, ThatIsNotEmptyIsRefusedByDefault)
{
    put_text_into(folder / "frames/fluid_000000.hdf", "");
    EXPECT_THROW(prepare_results(folder, Existing::refuse), CaseError);
}

TEST_F(Folder, OfOursIsReplaced)
{
    fill();
    prepare_results(folder, Existing::replace);
    EXPECT_EQ(content_of(folder), std::vector<std::string>{"frames"});
}

// `run case.toml -o . --force` must not delete the case that the user wrote.
TEST_F(Folder, WithNothingButACaseIsNotOurs)
{
    put_text_into(folder / "case.toml", "title = \"mine\"");
    EXPECT_THROW(prepare_results(folder, Existing::replace), CaseError);
    EXPECT_TRUE(fs::exists(folder / "case.toml"));
}

TEST_F(Folder, WithForeignFilesIsLeftAlone)
{
    for (const char* foreign : {"thesis.tex", "frames/notes.txt", "pictures/me.png", "my/file",
                                "paddle.csv", "frames/deep/fluid_000000.hdf"}) {
        fill();
        put_text_into(folder / foreign, "precious");
        const auto before = content_of(folder);
        EXPECT_THROW(prepare_results(folder, Existing::replace), CaseError) << foreign;
        EXPECT_EQ(content_of(folder), before) << foreign;
        fs::remove(folder / foreign);
        fs::remove(folder / "my");
        fs::remove(folder / "frames/deep");
    }
}

TEST_F(Folder, IsNotReplacedThroughALink)
{
    fill();
    put_text_into(folder / "elsewhere.txt", "x");
    fs::rename(folder / "elsewhere.txt", folder.string() + ".elsewhere");
    fs::remove(folder / "run.log");
    fs::create_symlink(folder.string() + ".elsewhere", folder / "run.log");
    EXPECT_THROW(prepare_results(folder, Existing::replace), CaseError);
    EXPECT_TRUE(fs::exists(folder.string() + ".elsewhere"));
    fs::remove(folder.string() + ".elsewhere");
}

TEST_F(Folder, ToGoOnWithLosesOnlyTornFiles)
{
    fill();
    auto expected = content_of(folder);
    std::erase(expected, "frames/fluid_000001.hdf.tmp");
    prepare_results(folder, Existing::extend);
    EXPECT_EQ(content_of(folder), expected);
}

TEST_F(Folder, BelongsToOneRunAtATime)
{
    fill();
    const auto before = content_of(folder);
    {
        const FolderLock lock(folder);
        for (const Existing existing : {Existing::refuse, Existing::replace, Existing::extend}) {
            EXPECT_THROW(prepare_results(folder, existing), CaseError);
        }
        EXPECT_EQ(content_of(folder), before);
    }
    EXPECT_NO_THROW(prepare_results(folder, Existing::extend));
}

TEST_F(Folder, ThatIsAFileIsRefused)
{
    put_text_into(folder / "file", "x");
    for (const Existing existing : {Existing::refuse, Existing::replace, Existing::extend}) {
        EXPECT_THROW(prepare_results(folder / "file", existing), CaseError);
        EXPECT_THROW(prepare_results(folder / "file/below", existing), IoError);
    }
}

} // namespace
} // namespace hyoryu::test_folder
