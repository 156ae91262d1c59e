// SPDX-License-Identifier: MIT
// Reading with VTK.
#include "hyoryu/geometry/mesh.hpp"

#include "hyoryu/core/error.hpp"
#include "mesh_file.hpp"

#include <fmt/format.h>

#ifdef HYORYU_HAS_VTK
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkCommand.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkTriangleFilter.h>
#endif

#include <algorithm>
#include <cmath>

namespace hyoryu {

#ifdef HYORYU_HAS_VTK

namespace {

/// Takes the place of VTK's printing to the terminal: the first message is kept.
void keep_message(vtkObject*, unsigned long, void* client, void* data)
{
    auto& message = *static_cast<std::string*>(client);
    if (message.empty()) {
        message = data != nullptr ? static_cast<const char*>(data) : "unknown";
    }
}

Mesh to_mesh(vtkPolyData& surface, double scale)
{
    Mesh mesh;
    for (vtkIdType k = 0; k < surface.GetNumberOfPoints(); ++k) {
        mesh.corners.push_back(scale * Eigen::Map<const Vec3>(surface.GetPoint(k)));
    }
    vtkNew<vtkIdList> corners;
    vtkCellArray& triangles = *surface.GetPolys();
    for (vtkIdType k = 0; k < triangles.GetNumberOfCells(); ++k) {
        triangles.GetCellAtId(k, corners);
        if (corners->GetNumberOfIds() == 3) {
            mesh.triangles.push_back({static_cast<int>(corners->GetId(0)),
                                      static_cast<int>(corners->GetId(1)),
                                      static_cast<int>(corners->GetId(2))});
        }
    }
    return mesh;
}

/// Runs a reader, makes triangles of its faces and merges coincident corners.
template <class Reader>
Mesh run_reader(const std::filesystem::path& file, double scale)
{
    std::string message;
    vtkNew<vtkCallbackCommand> observer;
    observer->SetCallback(keep_message);
    observer->SetClientData(&message);
    vtkNew<Reader> reader;
    vtkNew<vtkTriangleFilter> triangulate;
    vtkNew<vtkCleanPolyData> clean;
    for (vtkAlgorithm* stage : {static_cast<vtkAlgorithm*>(reader), static_cast<vtkAlgorithm*>(triangulate),
                                static_cast<vtkAlgorithm*>(clean)}) {
        stage->AddObserver(vtkCommand::ErrorEvent, observer);
        stage->AddObserver(vtkCommand::WarningEvent, observer);
    }
    reader->SetFileName(file.c_str());
    triangulate->SetInputConnection(reader->GetOutputPort());
    triangulate->PassLinesOff();
    triangulate->PassVertsOff();
    clean->SetInputConnection(triangulate->GetOutputPort());
    constexpr double merging = 1e-7; // of the diagonal: what rounding to float tears apart
    clean->SetTolerance(merging);
    clean->Update();
    if (!message.empty()) {
        throw IoError(fmt::format("the mesh {} cannot be read: it is damaged or of another kind", file.string()));
    }
    return to_mesh(*clean->GetOutput(), scale);
}

void turn_if_inside_out(Mesh& mesh)
{
    if (solid_properties(mesh).volume < 0) {
        for (auto& triangle : mesh.triangles) {
            std::swap(triangle[1], triangle[2]);
        }
    }
}

} // namespace

Mesh read_mesh(const std::filesystem::path& file, double scale)
{
    const MeshKind kind = mesh_kind(file);
    Mesh mesh = kind == MeshKind::obj ? run_reader<vtkOBJReader>(file, scale)
                                      : run_reader<vtkSTLReader>(file, scale);
    const auto finite = [](const Vec3& corner) { return corner.allFinite(); };
    if (mesh.triangles.empty()) {
        throw IoError(fmt::format("the mesh {} has no triangles", file.string()));
    }
    if (static_cast<long long>(mesh.triangles.size()) > most_triangles) {
        throw IoError(fmt::format("the mesh {} has {} triangles, at most {} are read", file.string(),
                                  mesh.triangles.size(), most_triangles));
    }
    if (!std::all_of(mesh.corners.begin(), mesh.corners.end(), finite)) {
        throw IoError(fmt::format("the mesh {} has corners that are no finite numbers", file.string()));
    }
    turn_if_inside_out(mesh);
    return mesh;
}

#else

Mesh read_mesh(const std::filesystem::path& file, double)
{
    mesh_kind(file);
    throw IoError(fmt::format("the mesh {} cannot be read: this build has no VTK", file.string()));
}

#endif

} // namespace hyoryu
