// SPDX-License-Identifier: MIT
// Frames of the fluid: VTKHDF files, read with the HDF5 library.
#include "scene.hpp"

#include <hdf5.h>

#include <algorithm>
#include <stdexcept>

namespace witness {

namespace {

// Closes what it holds, whatever kind of HDF5's objects it is.
class Handle {
public:
    explicit Handle(hid_t id) : id_(id) {}
    ~Handle()
    {
        if (id_ >= 0) {
            H5Idec_ref(id_);
        }
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    operator hid_t() const { return id_; }

private:
    hid_t id_;
};

template <class T>
std::vector<T> array_of(hid_t file, const std::string& name, hid_t type)
{
    if (H5Lexists(file, name.c_str(), H5P_DEFAULT) <= 0) {
        return {};
    }
    const Handle data(H5Dopen2(file, name.c_str(), H5P_DEFAULT));
    const Handle space(H5Dget_space(data));
    std::vector<T> values(
        static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space))));
    if (!values.empty() && H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
        throw std::runtime_error("the array " + name + " cannot be read");
    }
    return values;
}

std::vector<double> numbers_of(hid_t file, const std::string& name)
{
    return array_of<double>(file, "VTKHDF/" + name, H5T_NATIVE_DOUBLE);
}

std::vector<Vec3> vectors_of(hid_t file, const std::string& name)
{
    const std::vector<double> n = numbers_of(file, name);
    std::vector<Vec3> vectors;
    for (std::size_t k = 0; k + 2 < n.size(); k += 3) {
        vectors.emplace_back(n[k], n[k + 1], n[k + 2]);
    }
    return vectors;
}

} // namespace

std::vector<std::filesystem::path> frame_files(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> files;
    if (std::filesystem::is_directory(folder / "frames")) {
        for (const auto& entry : std::filesystem::directory_iterator(folder / "frames")) {
            const std::string name = entry.path().filename().string();
            if (name.starts_with("fluid_") && entry.path().extension() == ".hdf") {
                files.push_back(entry.path());
            }
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

Frame read_frame(const std::filesystem::path& file)
{
    const Handle open(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
    if (open < 0) {
        throw std::runtime_error(file.string() + ": cannot be opened");
    }
    Frame frame;
    const std::vector<double> time = numbers_of(open, "FieldData/TimeValue");
    if (time.size() != 1) {
        throw std::runtime_error(file.string() + ": has no time");
    }
    frame.time = time[0];
    frame.points = vectors_of(open, "Points");
    frame.velocities = vectors_of(open, "PointData/Velocity");
    frame.densities = numbers_of(open, "PointData/Density");
    frame.volumes = numbers_of(open, "PointData/Volume");
    frame.masses = numbers_of(open, "PointData/Mass");
    frame.ids = array_of<std::int64_t>(open, "VTKHDF/PointData/Id", H5T_NATIVE_INT64);
    if (frame.ids.size() != frame.points.size() || frame.velocities.size() != frame.points.size()) {
        throw std::runtime_error(file.string() + ": its columns differ in length");
    }
    return frame;
}

} // namespace witness
