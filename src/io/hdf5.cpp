// SPDX-License-Identifier: MIT
// HDF5 handles, the lock of the process, files in memory, attributes and texts.
#include "hdf5.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <utility>

#include <sys/mman.h>

namespace hyoryu::hdf5 {

namespace {

/// HDF5 is one library for the process, so its lock cannot belong to any object of ours.
std::mutex& process_lock()
{
    static std::mutex mutex;
    return mutex;
}

/// The innermost entry of the error stack names the cause.
herr_t keep_first(unsigned position, const H5E_error2_t* entry, void* text)
{
    if (position == 0 && entry->desc != nullptr) {
        *static_cast<std::string*>(text) = entry->desc;
    }
    return 0;
}

std::string last_error()
{
    std::string text;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &text);
    return text.empty() ? "HDF5 gives no reason" : text;
}

Handle in_memory_access(std::size_t content)
{
    Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "prepare an HDF5 file");
    // Few reallocations, little waste: HDF5 fills a portion with zeros before anything is in it,
    // so equal portions are chosen that together hold what is expected.
    constexpr std::size_t around_content = std::size_t{64} << 10; // headers, groups, attributes
    constexpr std::size_t mebi = std::size_t{1} << 20;
    const std::size_t expected = content + around_content;
    const std::size_t largest = std::clamp(expected / 32, mebi, 8 * mebi);
    const std::size_t portions = (expected + largest - 1) / largest;
    const std::size_t growth = (expected + portions - 1) / portions;
    check(H5Pset_fapl_core(access, growth, false), "prepare an HDF5 file");
    // The oldest file format that can hold the content is the one that most programs read.
    check(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST),
          "prepare an HDF5 file");
    return access;
}

Handle created(const std::filesystem::path& file, std::size_t skip)
{
    const std::string action = fmt::format("write `{}`", file.string());
    const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, action);
    check(H5Pset_userblock(creation, skip), action);
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, action);
    check(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST), action);
    return {H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose, action};
}

Handle string_type(std::size_t length)
{
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a string type");
    check(H5Tset_size(type, length), "size a string type");
    if (length == H5T_VARIABLE) {
        check(H5Tset_cset(type, H5T_CSET_UTF8), "set UTF-8");
    }
    return type;
}

Handle scalar_space()
{
    return {H5Screate(H5S_SCALAR), H5Sclose, "make a scalar"};
}

void write_attribute(hid_t object, const std::string& name, hid_t type, hid_t space,
                     const void* data)
{
    const std::string action = fmt::format("write the attribute `{}`", name);
    const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose, action);
    check(H5Awrite(attribute, type, data), action);
}

herr_t keep_name(hid_t, const char* name, const H5L_info_t*, void* names)
{
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
    return 0;
}

Handle open_attribute(hid_t object, const std::string& name)
{
    return {H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose,
            fmt::format("read the attribute `{}`", name)};
}

// HDF5 1.10 crashes, or waits for ever, where it cannot get memory for its own tables. Asked for
// and given back before it is called, memory that is not there is an exception instead. Its tables
// take some 6 MB.
void expect_memory(std::size_t bytes)
{
    constexpr std::size_t tables = std::size_t{24} << 20;
    const std::size_t asked = bytes + tables;
    void* const block =
        ::mmap(nullptr, asked, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (block == MAP_FAILED) {
        throw std::bad_alloc();
    }
    ::munmap(block, asked);
}

// The lock, taken when there is memory.
std::mutex& lock_with_memory()
{
    expect_memory(0);
    return process_lock();
}

} // namespace

Session::Session() : lock_(lock_with_memory())
{
    // All files are closed by those who opened them, but for one that HDF5 could not write, which
    // it would try to close again at the end of the program, and crash.
    static const herr_t once = H5dont_atexit();
    static_cast<void>(once);
    H5Eget_auto2(H5E_DEFAULT, &printer_, &printer_data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Session::~Session()
{
    H5Eset_auto2(H5E_DEFAULT, printer_, printer_data_);
}

Handle::Handle(hid_t id, Close close, std::string_view action) : id_(id), close_(close)
{
    if (id < 0) {
        throw IoError(fmt::format("cannot {}: {}", action, last_error()));
    }
}

Handle::~Handle()
{
    if (id_ >= 0) {
        close_(id_);
    }
}

Handle::Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}

void check(herr_t status, std::string_view action)
{
    if (status < 0) {
        throw IoError(fmt::format("cannot {}: {}", action, last_error()));
    }
}

FileImage::FileImage(std::size_t content)
    : access_((expect_memory(content), in_memory_access(content))),
      file_(H5Fcreate("image", H5F_ACC_TRUNC, H5P_DEFAULT, access_), H5Fclose,
            "build an HDF5 file in memory")
{
}

std::span<const std::byte> FileImage::bytes()
{
    check(H5Fflush(file_, H5F_SCOPE_LOCAL), "build an HDF5 file in memory");
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    check(size < 0 ? -1 : 0, "size an HDF5 file in memory");
    // The driver's own buffer: a copy would double the memory that a checkpoint needs.
    void* buffer = nullptr;
    check(H5Fget_vfd_handle(file_, access_, &buffer), "reach an HDF5 file in memory");
    return {*static_cast<const std::byte* const*>(buffer), static_cast<std::size_t>(size)};
}

DiskFile::DiskFile(const std::filesystem::path& file, std::size_t skip)
    : file_((expect_memory(0), created(file, skip)))
{
}

void DiskFile::close()
{
    check(H5Fflush(file_, H5F_SCOPE_LOCAL), "write an HDF5 file");
}

Handle open_file(const std::filesystem::path& file)
{
    const std::string why = why_unreadable(file);
    if (!why.empty()) {
        throw IoError(fmt::format("`{}` {}", file.string(), why));
    }
    return {H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose,
            fmt::format("read `{}`", file.string())};
}

Handle open_group(hid_t parent, const std::string& name)
{
    return {H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose,
            fmt::format("open the group `{}`", name)};
}

Handle create_group(hid_t parent, const std::string& name)
{
    return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
            fmt::format("create the group `{}`", name)};
}

bool has_link(hid_t parent, const std::string& name)
{
    return H5Lexists(parent, name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> link_names(hid_t group)
{
    std::vector<std::string> names;
    check(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, keep_name, &names),
          "list a group");
    return names;
}

void put_attribute(hid_t object, const std::string& name, const std::string& text)
{
    const char* const letters = text.c_str();
    write_attribute(object, name, string_type(H5T_VARIABLE), scalar_space(),
                    static_cast<const void*>(&letters));
}

void put_fixed_attribute(hid_t object, const std::string& name, const std::string& text)
{
    write_attribute(object, name, string_type(text.size()), scalar_space(), text.c_str());
}

void put_attribute(hid_t object, const std::string& name, double value)
{
    write_attribute(object, name, H5T_NATIVE_DOUBLE, scalar_space(), &value);
}

void put_attribute(hid_t object, const std::string& name, std::span<const std::int64_t> values)
{
    const hsize_t size = values.size();
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose,
                       fmt::format("write the attribute `{}`", name));
    write_attribute(object, name, H5T_NATIVE_INT64, space, values.data());
}

void put_count_attribute(hid_t object, const std::string& name, std::int64_t count)
{
    write_attribute(object, name, H5T_NATIVE_INT64, scalar_space(), &count);
}

std::string text_attribute(hid_t object, const std::string& name)
{
    const Handle attribute = open_attribute(object, name);
    const Handle stored(H5Aget_type(attribute), H5Tclose, "read an attribute");
    if (H5Tis_variable_str(stored) <= 0) {
        throw IoError(fmt::format(
            "cannot read the attribute `{}`: it is not a text of variable length", name));
    }
    char* letters = nullptr;
    check(H5Aread(attribute, stored, static_cast<void*>(&letters)), "read an attribute");
    const std::string text = letters == nullptr ? "" : letters;
    H5free_memory(letters);
    return text;
}

double number_attribute(hid_t object, const std::string& name)
{
    const Handle attribute = open_attribute(object, name);
    double value = 0;
    check(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value), "read an attribute");
    return value;
}

void put_text(hid_t parent, const std::string& name, const std::string& text)
{
    const std::string action = fmt::format("write the text `{}`", name);
    const Handle type = string_type(H5T_VARIABLE);
    const Handle space = scalar_space();
    const Handle dataset(
        H5Dcreate2(parent, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Dclose, action);
    const char* const letters = text.c_str();
    check(
        H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, static_cast<const void*>(&letters)),
        action);
}

} // namespace hyoryu::hdf5
