// SPDX-License-Identifier: MIT
// checkpoint.h5: a text header of 512 bytes (format, length, checksum), then an HDF5 file, for
// which the header is a user block. The checksum covers every byte, so HDF5 never sees a damaged
// file. Of several processes the particles are in parts, files of the same form that are complete
// before checkpoint.h5 names them, with length and checksum.
#include "atomic_file.hpp"
#include "hdf5.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"
#include "hyoryu/core/state.hpp"
#include "hyoryu/io/results.hpp"
#include "link_names.hpp"
#include "packed_array.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <fstream>
#include <functional>
#include <regex>
#include <set>
#include <sstream>

namespace hyoryu {

namespace {

constexpr int format_version = 8;
constexpr int format_with_parts = 9; // earlier versions would miss the particles
constexpr const char* parts_text = "parts";
constexpr std::size_t header_size = 512; // the first place after 0 where HDF5 looks for a file
constexpr std::string_view magic = "hyoryu checkpoint";

std::filesystem::path checkpoint_file(const std::filesystem::path& folder)
{
    return folder / "checkpoint.h5";
}

std::filesystem::path previous_file(const std::filesystem::path& folder)
{
    return folder / "checkpoint.previous.h5";
}

std::string header(int format, std::uintmax_t bytes, std::uint32_t checksum)
{
    std::string text =
        fmt::format("{}\nformat {}\nbytes {}\ncrc32 {:08x}\n", magic, format, bytes, checksum);
    text.resize(header_size, '\0');
    return text;
}

/// Texts as bytes: a string type of HDF5 would lose zero bytes at their end.
void put_state(hid_t file, const StateOnDemand& state)
{
    const hdf5::Handle arrays = hdf5::create_group(file, "arrays");
    for (const auto& [name, bytes] : state.bytes) {
        expects(!name.empty());
        const Column column = state.array(name);
        const hdf5::Handle dataset =
            put_array(arrays, link_name(name), raw(view_of(column)), column.unit);
        hdf5::put_attribute(dataset, "name", column.name);
        const std::array<std::int64_t, 1> components{column.components};
        hdf5::put_attribute(dataset, "components", components);
    }
    const hdf5::Handle texts = hdf5::create_group(file, "texts");
    for (const auto& [name, text] : state.texts) {
        expects(!name.empty());
        const std::vector<std::uint8_t> bytes(text.begin(), text.end());
        put_array(texts, link_name(name), raw(view_of(std::span(bytes), 1)), "");
    }
}

std::size_t stored_bytes(const StateOnDemand& state)
{
    std::size_t total = 0;
    for (const auto& [name, bytes] : state.bytes) {
        total += bytes;
    }
    for (const auto& [name, text] : state.texts) {
        total += text.size();
    }
    return total;
}

Snapshot get_snapshot(hid_t file)
{
    Snapshot snapshot;
    const hdf5::Handle arrays = hdf5::open_group(file, "arrays");
    for (const std::string& link : hdf5::link_names(arrays)) {
        Column column = get_column(arrays, link);
        const hdf5::Handle dataset(H5Dopen2(arrays, link.c_str(), H5P_DEFAULT), H5Dclose,
                                   "read a checkpoint");
        column.name = hdf5::text_attribute(dataset, "name");
        column.components = static_cast<int>(hdf5::number_attribute(dataset, "components"));
        snapshot.arrays[name_of(link)] = std::move(column);
    }
    const hdf5::Handle texts = hdf5::open_group(file, "texts");
    for (const std::string& link : hdf5::link_names(texts)) {
        const Column column = get_column(texts, link);
        const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&column.values);
        if (bytes == nullptr) {
            throw IoError(fmt::format("`{}` of the checkpoint is not text", link));
        }
        snapshot.texts[name_of(link)] = std::string(bytes->begin(), bytes->end());
    }
    return snapshot;
}

/// Gives the newest checkpoint its second name while it keeps the first. File systems without hard
/// links can only move it: a kill right after that leaves the previous one alone, which is read.
void keep_as_previous(const std::filesystem::path& folder)
{
    const std::filesystem::path newest = checkpoint_file(folder);
    const std::filesystem::path link =
        previous_file(folder).string() + std::string(temporary_suffix);
    std::error_code fault;
    if (!std::filesystem::exists(newest, fault)) {
        return;
    }
    std::filesystem::remove(link, fault); // of a kill
    std::filesystem::create_hard_link(newest, link, fault);
    std::filesystem::rename(fault ? newest : link, previous_file(folder), fault);
    if (fault) {
        throw IoError(fmt::format("cannot keep the previous checkpoint `{}`: {}",
                                  previous_file(folder).string(), fault.message()));
    }
}

bool begins_with_format(const std::string& stored, int format)
{
    return stored.starts_with(fmt::format("{}\nformat {}\n", magic, format));
}

/// Reads the whole file once and compares length and checksum with the header.
CheckpointPart verified(const std::filesystem::path& file)
{
    const std::string why = why_unreadable(file);
    if (!why.empty()) {
        throw IoError(fmt::format("`{}` {}", file.string(), why));
    }
    std::ifstream stream(file, std::ios::binary);
    std::string stored(header_size, '\0');
    stream.read(stored.data(), header_size);
    if (!stored.starts_with(magic)) {
        throw IoError(fmt::format("`{}` is not a checkpoint", file.string()));
    }
    const bool in_parts = begins_with_format(stored, format_with_parts);
    if (!in_parts && !begins_with_format(stored, format_version)) {
        throw IoError(fmt::format("`{}` is a checkpoint of another format; this version reads "
                                  "formats {} and {}",
                                  file.string(), format_version, format_with_parts));
    }
    std::uint32_t checksum = 0;
    std::uintmax_t bytes = 0;
    std::vector<char> block(std::size_t{1} << 20);
    while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) ||
           stream.gcount() > 0) {
        const auto count = static_cast<std::size_t>(stream.gcount());
        checksum = libdeflate_crc32(checksum, block.data(), count);
        bytes += count;
    }
    if (stored != header(in_parts ? format_with_parts : format_version, bytes, checksum)) {
        throw IoError(fmt::format("the checkpoint `{}` is damaged: its checksum or length is wrong",
                                  file.string()));
    }
    return {file.filename().string(), bytes, checksum};
}

Snapshot read_verified(const std::filesystem::path& file)
{
    const hdf5::Session session;
    return get_snapshot(hdf5::open_file(file));
}

/// Whether the length of a file is that in its header.
bool has_its_length(const std::filesystem::path& file)
{
    if (!why_unreadable(file).empty()) {
        return false;
    }
    std::string stored(header_size, '\0');
    std::ifstream(file, std::ios::binary).read(stored.data(), header_size);
    std::error_code fault;
    const std::uintmax_t size = std::filesystem::file_size(file, fault);
    return !fault && stored.starts_with(magic) &&
           stored.find(fmt::format("\nbytes {}\n", size - header_size)) != std::string::npos;
}

std::string text_of(const std::vector<CheckpointPart>& parts)
{
    std::string text;
    for (const CheckpointPart& part : parts) {
        text += fmt::format("{} {} {:08x}\n", part.name, part.bytes, part.checksum);
    }
    return text;
}

const std::regex& part_names()
{
    static const std::regex names(R"(checkpoint\.([0-9]{6,12})\.[0-9]{4}\.h5)");
    return names;
}

/// Any other name would lead out of the folder.
std::vector<CheckpointPart> parts_of(const std::string& text)
{
    std::vector<CheckpointPart> parts;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        CheckpointPart part;
        words >> part.name >> part.bytes >> std::hex >> part.checksum;
        if (!words || !std::regex_match(part.name, part_names())) {
            throw IoError(fmt::format("the checkpoint is damaged: it names `{}`", line));
        }
        parts.push_back(part);
    }
    return parts;
}

void expect_written(const std::filesystem::path& folder, const CheckpointPart& part)
{
    const CheckpointPart found = verified(folder / part.name);
    if (found.bytes != part.bytes || found.checksum != part.checksum) {
        throw IoError(fmt::format("`{}` belongs to another checkpoint than the one that refers to "
                                  "it",
                                  (folder / part.name).string()));
    }
}

NewestCheckpoint read_generation(const std::filesystem::path& file)
{
    verified(file);
    NewestCheckpoint found{read_verified(file), {}, {}};
    if (const auto text = found.snapshot.texts.extract(parts_text); !text.empty()) {
        found.parts = parts_of(text.mapped());
    }
    for (const CheckpointPart& part : found.parts) {
        expect_written(file.parent_path(), part);
    }
    return found;
}

/// Writes a file; `before` is called just before the file is renamed. The arrays are written one by
/// one, since an image of the file would need as much memory as the state. The disk space is
/// reserved first, since HDF5 cannot close a file that it failed to write.
CheckpointPart write_file(const std::filesystem::path& file, int format, const StateOnDemand& state,
                          const std::function<void()>& before)
{
    AtomicFile atomic(file);
    {
        const hdf5::Session session;
        hdf5::DiskFile target(atomic.temporary(), header_size);
        atomic.reserve(header_size + stored_bytes(state));
        put_state(target, state);
        target.close();
    }
    std::uint32_t checksum = 0;
    std::uint64_t bytes = 0;
    atomic.read_from(header_size, [&](std::span<const std::byte> block) {
        checksum = libdeflate_crc32(checksum, block.data(), block.size());
        bytes += block.size();
    });
    // Over the space that HDF5 left: nothing was written through `atomic` before.
    atomic.write(header(format, bytes, checksum));
    before();
    atomic.commit();
    return {file.filename().string(), bytes, checksum};
}

std::vector<std::string> part_files(const std::filesystem::path& folder)
{
    std::vector<std::string> names;
    std::error_code fault;
    for (const auto& entry : std::filesystem::directory_iterator(folder, fault)) {
        std::string name = entry.path().filename().string();
        if (std::regex_match(name, part_names())) {
            names.push_back(std::move(name));
        }
    }
    return names;
}

/// The parts that a checkpoint names; none if it cannot be read.
std::vector<CheckpointPart> named_parts(const std::filesystem::path& file)
{
    try {
        const hdf5::Session session;
        const hdf5::Handle open = hdf5::open_file(file);
        const hdf5::Handle texts = hdf5::open_group(open, "texts");
        if (!hdf5::has_link(texts, parts_text)) {
            return {};
        }
        const Column column = get_column(texts, parts_text);
        const auto& bytes = std::get<std::vector<std::uint8_t>>(column.values);
        return parts_of(std::string(bytes.begin(), bytes.end()));
    } catch (const std::exception&) {
        return {};
    }
}

void remove_other_parts(const std::filesystem::path& folder)
{
    const std::vector<std::string> files = part_files(folder);
    if (files.empty()) {
        return;
    }
    std::set<std::string> named;
    for (const auto& file : {checkpoint_file(folder), previous_file(folder)}) {
        for (const CheckpointPart& part : named_parts(file)) {
            named.insert(part.name);
        }
    }
    for (const std::string& name : files) {
        std::error_code gone_already;
        if (!named.contains(name)) {
            std::filesystem::remove(folder / name, gone_already);
        }
    }
}

} // namespace

std::int64_t next_part_set(const std::filesystem::path& folder)
{
    std::int64_t last = 0;
    for (const std::string& name : part_files(folder)) {
        std::smatch match;
        std::regex_match(name, match, part_names());
        last = std::max<std::int64_t>(last, std::stoll(match[1].str()));
    }
    return last + 1;
}

CheckpointPart write_checkpoint_part(const std::filesystem::path& folder, std::int64_t set,
                                     int part, const StateOnDemand& state)
{
    return write_file(folder / fmt::format("checkpoint.{:06}.{:04}.h5", set, part), format_version,
                      state, [] {});
}

void write_checkpoint(const std::filesystem::path& folder, StateOnDemand state,
                      const std::vector<CheckpointPart>& parts)
{
    if (!parts.empty()) {
        state.texts[parts_text] = text_of(parts);
    }
    write_file(checkpoint_file(folder), parts.empty() ? format_version : format_with_parts, state,
               [&] { keep_as_previous(folder); });
    remove_other_parts(folder);
}

void write_checkpoint(const std::filesystem::path& folder, Snapshot snapshot,
                      const std::vector<CheckpointPart>& parts)
{
    write_checkpoint(folder, on_demand(std::move(snapshot)), parts);
}

Snapshot read_checkpoint_part(const std::filesystem::path& folder, const CheckpointPart& part)
{
    expect_written(folder, part);
    return read_verified(folder / part.name);
}

Snapshot read_checkpoint(const std::filesystem::path& folder)
{
    NewestCheckpoint found = read_generation(checkpoint_file(folder));
    if (!found.parts.empty()) {
        throw IoError(fmt::format("the checkpoint `{}` is in several files",
                                  checkpoint_file(folder).string()));
    }
    return std::move(found.snapshot);
}

UsableCheckpoint find_checkpoint(const std::filesystem::path& folder)
{
    const auto is_whole = [&](const std::filesystem::path& file) {
        return has_its_length(file) &&
               std::ranges::all_of(named_parts(file), [&](const CheckpointPart& part) {
                   return has_its_length(folder / part.name);
               });
    };
    if (is_whole(checkpoint_file(folder))) {
        return UsableCheckpoint::newest;
    }
    return is_whole(previous_file(folder)) ? UsableCheckpoint::previous : UsableCheckpoint::none;
}

NewestCheckpoint read_newest_checkpoint(const std::filesystem::path& folder)
{
    std::error_code fault;
    if (std::filesystem::is_directory(checkpoint_file(folder), fault)) {
        throw IoError(fmt::format("`{}` is a folder, but this name is reserved for the checkpoint "
                                  "of the run: move it away to resume",
                                  checkpoint_file(folder).string()));
    }
    std::string passed_over;
    try {
        return read_generation(checkpoint_file(folder));
    } catch (const IoError& error) {
        passed_over = error.what();
    }
    if (!std::filesystem::exists(previous_file(folder), fault)) {
        throw IoError(passed_over + "; an older checkpoint does not exist");
    }
    try {
        NewestCheckpoint older = read_generation(previous_file(folder));
        older.passed_over = passed_over;
        return older;
    } catch (const IoError& error) {
        throw IoError(
            fmt::format("{}; error of the older checkpoint: {}", passed_over, error.what()));
    }
}

void take_previous_checkpoint(const std::filesystem::path& folder)
{
    std::error_code fault;
    std::filesystem::rename(previous_file(folder), checkpoint_file(folder), fault);
    if (fault) {
        throw IoError(
            fmt::format("cannot rename `{}`: {}", previous_file(folder).string(), fault.message()));
    }
}

} // namespace hyoryu
