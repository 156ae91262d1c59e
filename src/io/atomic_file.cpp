// SPDX-License-Identifier: MIT
// Atomic replacement of files with POSIX calls, which report the cause of a failure.
#include "atomic_file.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/io/results.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace hyoryu {

namespace {

constexpr mode_t everyone_reads = 0666; // restricted by the umask of the user

int open_for_writing(const std::filesystem::path& file)
{
    return ::open(file.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, everyone_reads);
}

/// A rename is on the disk only when its folder is. File systems that cannot do this (network,
/// FUSE) say so with an error that loses nothing, hence ignored.
void sync_folder_of(const std::filesystem::path& file)
{
    const std::filesystem::path parent = file.parent_path();
    const int folder = ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_CLOEXEC);
    if (folder >= 0) {
        ::fsync(folder);
        ::close(folder);
    }
}

} // namespace

void throw_system_error(std::string_view verb, const std::filesystem::path& file)
{
    const int reason = errno;
    throw IoError(fmt::format("cannot {} `{}`: {}", verb, file.string(), std::strerror(reason)));
}

void write_all(int descriptor, std::span<const std::byte> bytes, const std::filesystem::path& file)
{
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written >= 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        } else if (errno != EINTR) {
            throw_system_error("write", file);
        }
    }
}

AtomicFile::AtomicFile(std::filesystem::path file)
    : file_(std::move(file)), temporary_(file_.string() + std::string(temporary_suffix)),
      descriptor_(open_for_writing(temporary_))
{
    if (descriptor_ < 0) {
        throw_system_error("create", file_);
    }
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
        ::close(std::exchange(descriptor_, -1));
        throw IoError(fmt::format("cannot create `{}`: `{}` is not a file", file_.string(),
                                  temporary_.string()));
    }
}

AtomicFile::~AtomicFile()
{
    if (descriptor_ >= 0) {
        ::close(descriptor_);
        ::unlink(temporary_.c_str());
    }
}

void AtomicFile::write(std::span<const std::byte> bytes)
{
    write_all(descriptor_, bytes, file_);
}

void AtomicFile::write(std::string_view text)
{
    write(std::as_bytes(std::span(text)));
}

void AtomicFile::reserve(std::uintmax_t bytes) const
{
    rlimit limit{};
    if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
        bytes > limit.rlim_cur) {
        errno = EFBIG;
        throw_system_error("write", file_);
    }
    if (::fallocate(descriptor_, FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(bytes)) != 0 &&
        (errno == ENOSPC || errno == EDQUOT || errno == EFBIG)) {
        throw_system_error("write", file_);
    }
}

void AtomicFile::read_from(std::uintmax_t place,
                           const std::function<void(std::span<const std::byte>)>& f) const
{
    std::vector<std::byte> block(std::size_t{1} << 20);
    while (true) {
        const ssize_t count =
            ::pread(descriptor_, block.data(), block.size(), static_cast<off_t>(place));
        if (count < 0 && errno != EINTR) {
            throw_system_error("read", file_);
        }
        if (count == 0) {
            return;
        }
        if (count > 0) {
            f(std::span(block).first(static_cast<std::size_t>(count)));
            place += static_cast<std::uintmax_t>(count);
        }
    }
}

void AtomicFile::commit()
{
    // Without this a power cut could leave the new name on a file without bytes. EINVAL: not a file
    // that can be synchronised, for instance a pipe.
    if (::fsync(descriptor_) != 0 && errno != EINVAL) {
        throw_system_error("write", file_);
    }
    if (::close(std::exchange(descriptor_, -1)) != 0 ||
        ::rename(temporary_.c_str(), file_.c_str()) != 0) {
        const int reason = errno;
        ::unlink(temporary_.c_str());
        errno = reason;
        throw_system_error("write", file_);
    }
    sync_folder_of(file_);
}

void write_text(const std::filesystem::path& file, const std::string& text)
{
    AtomicFile atomic(file);
    atomic.write(text);
    atomic.commit();
}

bool write_new_text(const std::filesystem::path& file, std::string_view text)
{
    const int descriptor =
        ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, everyone_reads);
    if (descriptor < 0 && errno == EEXIST) {
        return false;
    }
    if (descriptor < 0) {
        throw_system_error("create", file);
    }
    try {
        write_all(descriptor, std::as_bytes(std::span(text)), file);
    } catch (const IoError&) {
        ::close(descriptor);
        ::unlink(file.c_str());
        throw;
    }
    if (::close(descriptor) != 0) {
        const int reason = errno;
        ::unlink(file.c_str());
        errno = reason;
        throw_system_error("write", file);
    }
    return true;
}

} // namespace hyoryu
