// SPDX-License-Identifier: MIT
// HDF5 in small pieces: handles that close themselves, one lock for the process, files that are
// built in memory. Every function throws IoError.
#pragma once

#include <cstddef>
#include <filesystem>
#include <hdf5.h>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyoryu::hdf5 {

/// Held around every use of HDF5: the solver may write a checkpoint while the writer thread writes
/// a frame, and not every HDF5 is built thread-safe. Also keeps HDF5 from printing its error stack.
class Session {
public:
    Session();
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

private:
    std::scoped_lock<std::mutex> lock_;
    H5E_auto2_t printer_ = nullptr;
    void* printer_data_ = nullptr;
};

/// Owns one HDF5 identifier.
class Handle {
public:
    using Close = herr_t (*)(hid_t);
    /// Throws IoError "cannot <action>: <message of HDF5>" if the identifier is invalid.
    Handle(hid_t id, Close close, std::string_view action);
    ~Handle();
    Handle(Handle&& other) noexcept;
    Handle& operator=(Handle&&) = delete;
    operator hid_t() const { return id_; }

private:
    hid_t id_;
    Close close_;
};

/// Throws IoError "cannot <action>: <message of HDF5>" if `status` is negative.
void check(herr_t status, std::string_view action);

/// A file that is built in memory. HDF5 never meets a disk that is full: it cannot close a file
/// that it failed to write, and its message hides the reason.
class FileImage {
public:
    /// `content`: expected size of the file in bytes. Memory for it is allocated in equal portions
    /// of 1 to 8 MiB, and each portion is touched as a whole.
    explicit FileImage(std::size_t content);
    operator hid_t() const { return file_; }
    /// The bytes of the finished file; they live as long as this object and no more may be added.
    std::span<const std::byte> bytes();

private:
    Handle access_;
    Handle file_;
};

/// A new HDF5 file on the disk, for data that must not be held in memory as a whole. Reserve the
/// disk space first: HDF5 cannot close a file that it failed to write. `skip`: size of the user
/// block, which HDF5 leaves free at the beginning of the file: 512 B or a larger power of two.
class DiskFile {
public:
    DiskFile(const std::filesystem::path& file, std::size_t skip);
    operator hid_t() const { return file_; }
    /// Flushes all buffers of HDF5 to the file. Throws IoError. Nothing may be added afterwards.
    void close();

private:
    Handle file_;
};

Handle open_file(const std::filesystem::path& file);
Handle open_group(hid_t parent, const std::string& name);
Handle create_group(hid_t parent, const std::string& name);
bool has_link(hid_t parent, const std::string& name);
/// Names of the links of a group, in the order of their names.
std::vector<std::string> link_names(hid_t group);

/// A text of variable length, which h5py hands over as a string.
void put_attribute(hid_t object, const std::string& name, const std::string& text);
/// A text of fixed length, which VTKHDF asks for.
void put_fixed_attribute(hid_t object, const std::string& name, const std::string& text);
void put_attribute(hid_t object, const std::string& name, double value);
/// An array of integers: VTKHDF asks for `Version` = [1, 0].
void put_attribute(hid_t object, const std::string& name, std::span<const std::int64_t> values);
/// A whole number, not an array of one.
void put_count_attribute(hid_t object, const std::string& name, std::int64_t count);
/// A text of variable length.
std::string text_attribute(hid_t object, const std::string& name);
double number_attribute(hid_t object, const std::string& name);

/// A text as a scalar dataset.
void put_text(hid_t parent, const std::string& name, const std::string& text);

} // namespace hyoryu::hdf5
