// SPDX-License-Identifier: MIT
// From a results folder to pictures and an animation.
#include "hyoryu/view/render.hpp"

#include "hyoryu/core/error.hpp"

#ifdef HYORYU_HAS_VTK
#include "animation.hpp"
#include "hyoryu/io/claim.hpp"
#include "hyoryu/io/results.hpp"
#include "moments.hpp"
#include "picture.hpp"

#include <fmt/format.h>

#include <regex>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

/// `frame_000000.png` or the animation; a user may keep other pictures beside them.
bool is_picture_of_ours(const std::string& name)
{
    static const std::regex pattern(R"(frame_[0-9]{6,}\.png|animation\.mp4)");
    return std::regex_match(name, pattern);
}

/// A folder without pictures of ours: those of an earlier call would slip into the animation.
/// Counts them in `removed`.
fs::path emptied_pictures(const fs::path& results, int& removed)
{
    const fs::path pictures = results / "pictures";
    try {
        fs::create_directories(pictures);
        for (const std::string& name : owned_names(pictures, is_picture_of_ours)) {
            removed += fs::remove(pictures / name) ? 1 : 0;
        }
    } catch (const fs::filesystem_error& error) {
        throw IoError(
            fmt::format("cannot prepare `{}`: {}", pictures.string(), error.code().message()));
    }
    return pictures;
}

Surface structures_in(const fs::path& results)
{
    const fs::path file = results / "structures.hdf";
    return fs::exists(file) ? read_surface(file) : Surface{};
}

} // namespace

RenderResult render(const fs::path& results, const RenderSettings& settings)
{
    const std::vector<Moment> moments = moments_of(results, settings.times);
    const Surface structures = structures_in(results);
    const Survey survey = survey_of(moments, structures, settings.colour);
    Picture picture(results, survey, structures, settings);
    RenderResult result;
    const fs::path folder = emptied_pictures(results, result.removed);
    for (const Moment& moment : moments) {
        const fs::path file = folder / fmt::format("frame_{}.png", moment.number);
        write_text(file, picture.png_of(moment));
        result.pictures.push_back(file);
    }
    if (result.pictures.size() < 2) {
        result.note = "there is only one picture";
        return result;
    }
    result.note = animate(folder, settings.fps);
    if (result.note.empty()) {
        result.animation = folder / "animation.mp4";
    }
    return result;
}

} // namespace hyoryu

#else

namespace hyoryu {

RenderResult render(const std::filesystem::path&, const RenderSettings&)
{
    throw IoError("cannot render: this program was built without VTK (HYORYU_VTK=OFF)");
}

} // namespace hyoryu

#endif
