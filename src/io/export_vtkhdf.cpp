// SPDX-License-Identifier: MIT
// One temporal VTKHDF 2.0 file over the frames: its arrays are virtual datasets, so that nothing is
// copied. Layout: "VTKHDF File Format" of VTK's documentation, temporal unstructured grids.
#include "atomic_file.hpp"
#include "hdf5.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"
#include "hyoryu/io/convert.hpp"
#include "packed_array.hpp"
#include "virtual_array.hpp"
#include "vtkhdf.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

constexpr const char* content = "index of frames";

using Shapes = std::map<std::string, ArrayShape>;

/// One frame file, which is a part of a time step.
struct Part {
    std::string file;  // relative to the folder of the index
    Shapes grid;       // Points, Connectivity, Offsets, Types
    Shapes point_data; // by name
};

struct Step {
    double time = 0;
    std::vector<Part> parts;
};

/// The shapes of a frame whose arrays have the lengths that belong together.
Part part_of(const fs::path& source, std::string name_in_index)
{
    Part part{std::move(name_in_index), {}, {}};
    const hdf5::Handle file = hdf5::open_file(source);
    try {
        const hdf5::Handle root = hdf5::open_group(file, "VTKHDF");
        for (const char* name : {"Points", "Connectivity", "Offsets", "Types"}) {
            part.grid[name] = shape_of(root, name);
        }
        const hsize_t points = part.grid["Points"].rows;
        expect(part.grid["Points"].components == 3, "its points are not rows of three numbers");
        expect(part.grid["Offsets"].rows == part.grid["Types"].rows + 1,
               "its cells and their offsets differ in number");
        const hdf5::Handle data = hdf5::open_group(root, "PointData");
        for (const std::string& name : hdf5::link_names(data)) {
            part.point_data[name] = shape_of(data, name);
            expect(part.point_data[name].rows == points,
                   "an array does not have one row per point");
        }
    } catch (const std::exception& error) {
        throw IoError(fmt::format("`{}` is not a frame of Hyoryu, or is damaged: {}",
                                  source.string(), error.what()));
    }
    return part;
}

std::string relative_name(const fs::path& source, const fs::path& index)
{
    const fs::path folder = fs::weakly_canonical(fs::absolute(index)).parent_path();
    return fs::weakly_canonical(fs::absolute(source)).lexically_relative(folder).generic_string();
}

/// Frames of one number form one step; fixed sets are a part of every step.
std::vector<Step> steps_of(const fs::path& results, const std::vector<FrameSet>& sets,
                           const fs::path& index)
{
    std::map<std::string, Step> steps;
    std::vector<Part> still;
    for (const FrameSet& set : sets) {
        for (const SeriesEntry& entry : set.frames) {
            for (const fs::path& source : files_of_frame(results / entry.file)) {
                Part part = part_of(source, relative_name(source, index));
                if (set.moves) {
                    Step& step = steps[frame_number(entry)];
                    step.time = entry.time;
                    step.parts.push_back(std::move(part));
                } else {
                    still.push_back(std::move(part));
                }
            }
        }
    }
    if (steps.empty() && !still.empty()) {
        steps["000000"] = {};
    }
    std::vector<Step> in_order;
    for (auto& [number, step] : steps) {
        step.parts.insert(step.parts.end(), still.begin(), still.end());
        in_order.push_back(std::move(step));
    }
    return in_order;
}

using PartShape = const ArrayShape* (*)(const Part& part, const std::string& name);

const ArrayShape* grid_shape(const Part& part, const std::string& name)
{
    return &part.grid.at(name);
}

const ArrayShape* data_shape(const Part& part, const std::string& name)
{
    const auto found = part.point_data.find(name);
    return found == part.point_data.end() ? nullptr : &found->second;
}

/// The array of that name over all parts of all steps. A part without it has a row a point.
void put_virtual(hid_t group, const std::vector<Step>& steps, const std::string& name,
                 const std::string& path, PartShape shape_in)
{
    hsize_t rows = 0;
    std::optional<ArrayShape> shape;
    for (const Step& step : steps) {
        for (const Part& part : step.parts) {
            const ArrayShape* own = shape_in(part, name);
            rows += own != nullptr ? own->rows : part.grid.at("Points").rows;
            if (own != nullptr && !shape) {
                shape = *own;
            }
            if (own != nullptr &&
                (own->type != shape->type || own->components != shape->components)) {
                throw IoError(fmt::format("the array `{}` of `{}` has another type than in earlier "
                                          "frames",
                                          name, part.file));
            }
        }
    }
    VirtualArray array(shape.value(), rows);
    for (const Step& step : steps) {
        for (const Part& part : step.parts) {
            if (const ArrayShape* own = shape_in(part, name); own != nullptr) {
                array.append(part.file, path, own->rows);
            } else {
                array.skip(part.grid.at("Points").rows);
            }
        }
    }
    array.put(group, name);
}

void put_numbers(hid_t group, const std::string& name, const std::vector<std::int64_t>& values)
{
    put_array(group, name, raw(view_of(std::span(values), 1)), "");
}

/// VTK wants one column a kind of cells, of which this grid has one.
void put_column(hid_t group, const std::string& name, const std::vector<std::int64_t>& values)
{
    ArrayView view = view_of(std::span(values), 1);
    view.dims.push_back(1);
    put_array(group, name, raw(view), "");
}

std::set<std::string> names_of_point_data(const std::vector<Step>& steps)
{
    std::set<std::string> names;
    for (const Step& step : steps) {
        for (const Part& part : step.parts) {
            for (const auto& [name, shape] : part.point_data) {
                names.insert(name);
            }
        }
    }
    return names;
}

/// Counts of each part, and the virtual arrays of the grid.
void put_grid(hid_t root, const std::vector<Step>& steps)
{
    std::vector<std::int64_t> points;
    std::vector<std::int64_t> cells;
    std::vector<std::int64_t> corners;
    for (const Step& step : steps) {
        for (const Part& part : step.parts) {
            points.push_back(static_cast<std::int64_t>(part.grid.at("Points").rows));
            cells.push_back(static_cast<std::int64_t>(part.grid.at("Types").rows));
            corners.push_back(static_cast<std::int64_t>(part.grid.at("Connectivity").rows));
        }
    }
    put_numbers(root, "NumberOfPoints", points);
    put_numbers(root, "NumberOfCells", cells);
    put_numbers(root, "NumberOfConnectivityIds", corners);
    for (const std::string name : {"Points", "Connectivity", "Offsets", "Types"}) {
        put_virtual(root, steps, name, "/VTKHDF/" + name, grid_shape);
    }
}

/// Where each step begins in the arrays, and its time.
void put_steps(hid_t root, const std::vector<Step>& steps, const std::set<std::string>& data)
{
    std::vector<double> times;
    std::vector<std::int64_t> parts;
    std::vector<std::int64_t> first_part;
    std::vector<std::int64_t> first_point;
    std::vector<std::int64_t> first_cell;
    std::vector<std::int64_t> first_corner;
    std::array<std::int64_t, 4> before{};
    for (const Step& step : steps) {
        times.push_back(step.time);
        parts.push_back(static_cast<std::int64_t>(step.parts.size()));
        first_part.push_back(before[0]);
        first_point.push_back(before[1]);
        first_cell.push_back(before[2]);
        first_corner.push_back(before[3]);
        for (const Part& part : step.parts) {
            before[0] += 1;
            before[1] += static_cast<std::int64_t>(part.grid.at("Points").rows);
            before[2] += static_cast<std::int64_t>(part.grid.at("Types").rows);
            before[3] += static_cast<std::int64_t>(part.grid.at("Connectivity").rows);
        }
    }
    const hdf5::Handle group = hdf5::create_group(root, "Steps");
    hdf5::put_count_attribute(group, "NSteps", static_cast<std::int64_t>(steps.size()));
    put_array(group, "Values", raw(view_of(std::span<const double>(times), 1)), "s");
    put_numbers(group, "NumberOfParts", parts);
    put_numbers(group, "PartOffsets", first_part);
    put_numbers(group, "PointOffsets", first_point);
    put_column(group, "CellOffsets", first_cell);
    put_column(group, "ConnectivityIdOffsets", first_corner);
    const hdf5::Handle offsets = hdf5::create_group(group, "PointDataOffsets");
    for (const std::string& name : data) {
        put_numbers(offsets, name, first_point);
    }
}

} // namespace

std::size_t export_vtkhdf(const fs::path& results, const std::vector<FrameSet>& sets,
                          const fs::path& file)
{
    AtomicFile atomic(file);
    const hdf5::Session session;
    const std::vector<Step> steps = steps_of(results, sets, file);
    const std::set<std::string> data = names_of_point_data(steps);
    constexpr std::size_t bytes_of_a_reference = 256;
    hdf5::FileImage image(steps.size() * sets.size() * (data.size() + 4) * bytes_of_a_reference);
    {
        const hdf5::Handle root = hdf5::create_group(image, "VTKHDF");
        hdf5::put_attribute(root, "Version", std::array<std::int64_t, 2>{2, 0});
        hdf5::put_fixed_attribute(root, "Type", "UnstructuredGrid");
        put_grid(root, steps);
        const hdf5::Handle group = hdf5::create_group(root, "PointData");
        for (const std::string& name : data) {
            put_virtual(group, steps, name, "/VTKHDF/PointData/" + name, data_shape);
        }
        put_steps(root, steps, data);
        const hdf5::Handle meta = hdf5::create_group(image, "meta");
        hdf5::put_attribute(meta, "program", std::string("hyoryu"));
        hdf5::put_attribute(meta, "content", std::string(content));
    }
    atomic.write(image.bytes());
    atomic.commit();
    return steps.size();
}

bool is_exported_vtkhdf(const fs::path& file)
{
    if (!why_unreadable(file).empty()) {
        return false;
    }
    const hdf5::Session session;
    try {
        const hdf5::Handle open = hdf5::open_file(file);
        const hdf5::Handle meta = hdf5::open_group(open, "meta");
        return hdf5::text_attribute(meta, "content") == content;
    } catch (const IoError&) {
        return false;
    }
}

} // namespace hyoryu
