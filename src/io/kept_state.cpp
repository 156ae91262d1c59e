// SPDX-License-Identifier: MIT
#include "hyoryu/io/kept_state.hpp"

#include "atomic_file.hpp"
#include "hyoryu/core/error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <span>
#include <type_traits>
#include <unistd.h>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

constexpr mode_t only_owner = 0600;

// For a file system that has no files without names, such as NFS.
int open_and_remove(const fs::path& folder)
{
    std::string name = (folder / ".hyoryu-kept-XXXXXX").string();
    const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor >= 0) {
        ::unlink(name.c_str());
    }
    return descriptor;
}

int open_without_name(const fs::path& folder)
{
    const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, only_owner);
    return descriptor >= 0 ? descriptor : open_and_remove(folder);
}

} // namespace

// An open file without a name.
class KeptState::File {
public:
    explicit File(const fs::path& folder)
        : name_(folder / "(state to return to)"), descriptor_(open_without_name(folder))
    {
        if (descriptor_ < 0) {
            throw_system_error("create", name_);
        }
    }
    ~File() { ::close(descriptor_); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    void write(std::span<const std::byte> bytes, std::uintmax_t offset) const
    {
        if (::lseek(descriptor_, static_cast<off_t>(offset), SEEK_SET) < 0) {
            throw_system_error("write", name_);
        }
        write_all(descriptor_, bytes, name_);
    }

    void read(std::span<std::byte> bytes, std::uintmax_t offset) const
    {
        while (!bytes.empty()) {
            const ssize_t got =
                ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
            if (got > 0) {
                bytes = bytes.subspan(static_cast<std::size_t>(got));
                offset += static_cast<std::uintmax_t>(got);
            } else if (got == 0) {
                throw IoError(fmt::format("cannot read `{}`: it is incomplete", name_.string()));
            } else if (errno != EINTR) {
                throw_system_error("read", name_);
            }
        }
    }

private:
    fs::path name_; // for messages
    int descriptor_;
};

KeptState::KeptState(const fs::path& folder, const StateOnDemand& state)
    : file_(std::make_unique<File>(folder))
{
    replace(state);
}

void KeptState::replace(const StateOnDemand& state)
{
    arrays_.clear();
    texts_ = state.texts;
    std::uintmax_t offset = 0;
    for (const auto& [name, size] : state.bytes) {
        Column column = state.array(name);
        Place place{.offset = offset};
        std::visit(
            [&](auto& values) {
                const auto bytes = std::as_bytes(std::span(values));
                file_->write(bytes, offset);
                offset += bytes.size();
                place.count = values.size();
                std::remove_reference_t<decltype(values)>().swap(values); // frees the memory
            },
            column.values);
        place.kind = std::move(column);
        arrays_.emplace(name, std::move(place));
    }
}

KeptState::~KeptState() = default;
KeptState::KeptState(KeptState&&) noexcept = default;
KeptState& KeptState::operator=(KeptState&&) noexcept = default;

Column KeptState::read(const Place& place) const
{
    Column column = place.kind;
    std::visit(
        [&](auto& values) {
            values.resize(place.count);
            file_->read(std::as_writable_bytes(std::span(values)), place.offset);
        },
        column.values);
    return column;
}

StateOnDemand KeptState::on_demand() const
{
    StateOnDemand state{.bytes = {}, .array = {}, .texts = texts_};
    for (const auto& [name, place] : arrays_) {
        state.bytes[name] = std::visit(
            [&](const auto& values) { return place.count * sizeof(values[0]); }, place.kind.values);
    }
    state.array = [this](const std::string& name) { return read(arrays_.at(name)); };
    return state;
}

Snapshot KeptState::snapshot() const
{
    Snapshot state{.arrays = {}, .texts = texts_};
    for (const auto& [name, place] : arrays_) {
        state.arrays.emplace(name, read(place));
    }
    return state;
}

} // namespace hyoryu
