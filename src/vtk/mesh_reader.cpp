// SPDX-License-Identifier: MIT
// Reading with VTK.
#include "hyoryu/geometry/mesh.hpp"

#include "geometry/mesh_file.hpp"
#include "hyoryu/core/error.hpp"

#include <fmt/format.h>

#ifdef HYORYU_HAS_VTK
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>
#include <vtkTriangleFilter.h>
#include <vtksys/SystemTools.hxx>
#endif

#include <algorithm>
#include <string>
#include <utility>

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

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why)
{
    throw IoError(fmt::format("the mesh {} {}", file.string(), why));
}

/// The readers do not check corners and corner numbers; the code below relies on them.
void check_surface(vtkPolyData& surface, const std::filesystem::path& file)
{
    const vtkIdType count = surface.GetNumberOfPoints();
    for (vtkIdType k = 0; k < count; ++k) {
        if (!Eigen::Map<const Vec3>(surface.GetPoint(k)).allFinite()) {
            refuse(file, "has corners that are not finite numbers");
        }
    }
    vtkNew<vtkIdList> corners;
    vtkCellArray& faces = *surface.GetPolys();
    if (faces.GetNumberOfCells() == 0 || faces.GetNumberOfCells() > most_triangles) {
        refuse(file, fmt::format("has {} faces, expected 1 .. {}", faces.GetNumberOfCells(),
                                 most_triangles));
    }
    for (vtkIdType k = 0; k < faces.GetNumberOfCells(); ++k) {
        faces.GetCellAtId(k, corners);
        for (vtkIdType n = 0; n < corners->GetNumberOfIds(); ++n) {
            if (corners->GetId(n) < 0 || corners->GetId(n) >= count) {
                refuse(file, fmt::format("has a face with a corner beyond its {}", count));
            }
        }
    }
}

/// Before corners are merged.
void check_range(vtkPolyData& surface, const std::filesystem::path& file, double scale)
{
    for (vtkIdType k = 0; k < surface.GetNumberOfPoints(); ++k) {
        const Vec3 p = scale * Eigen::Map<const Vec3>(surface.GetPoint(k));
        if (!(p.cwiseAbs().maxCoeff() <= farthest_corner)) {
            refuse(file, fmt::format("has a corner at ({:.3g}, {:.3g}, {:.3g}) m, which is out of "
                                     "range: expected at most {:.0e} m; check the numbers of the "
                                     "file, and `scale`, the factor from them to metres",
                                     p.x(), p.y(), p.z(), farthest_corner));
        }
    }
}

/// VTK distinguishes text from binary by its own rule. If it takes a text file for binary, it reads
/// the number of triangles from the middle of the text and allocates memory for as many.
void check_text(const std::filesystem::path& file)
{
    using vtksys::SystemTools;
    if (SystemTools::DetectFileType(file.c_str()) != SystemTools::FileTypeText) {
        refuse(file, "is a text file with too many non-ASCII characters near its start: it "
                     "would be read as binary; use a plain name after `solid`");
    }
}

/// The faces of a file as the reader finds them.
template <class Reader>
vtkSmartPointer<vtkPolyData> read_surface(const std::filesystem::path& file)
{
    std::string message;
    vtkNew<vtkCallbackCommand> observer;
    observer->SetCallback(keep_message);
    observer->SetClientData(&message);
    vtkNew<Reader> reader;
    for (vtkObject* source :
         {static_cast<vtkObject*>(reader), static_cast<vtkObject*>(reader->GetExecutive())}) {
        source->AddObserver(vtkCommand::ErrorEvent, observer);
        source->AddObserver(vtkCommand::WarningEvent, observer);
    }
    reader->SetFileName(file.c_str());
    reader->Update();
    if (!message.empty()) {
        refuse(file, "cannot be read: it is damaged or of another type");
    }
    vtkSmartPointer<vtkPolyData> surface = reader->GetOutput();
    check_surface(*surface, file);
    return surface;
}

/// The largest coordinate, of any sign.
double farthest_of(vtkPolyData& surface)
{
    double farthest = 0;
    for (vtkIdType k = 0; k < surface.GetNumberOfPoints(); ++k) {
        const Eigen::Map<const Vec3> p(surface.GetPoint(k));
        farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
    }
    return farthest;
}

/// Makes triangles of the faces and merges coincident corners.
vtkSmartPointer<vtkPolyData> cleaned(vtkPolyData& surface)
{
    vtkNew<vtkTriangleFilter> triangulate;
    triangulate->SetInputData(&surface);
    triangulate->PassLinesOff();
    triangulate->PassVertsOff();
    vtkNew<vtkCleanPolyData> clean;
    clean->SetInputConnection(triangulate->GetOutputPort());
    constexpr double merging = 1e-7; // of the diagonal: merges corners rounded apart
    clean->SetTolerance(merging);
    clean->Update();
    return clean->GetOutput();
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
    if (kind == MeshKind::stl_text) {
        check_text(file);
    }
    const auto surface =
        kind == MeshKind::obj ? read_surface<vtkOBJReader>(file) : read_surface<vtkSTLReader>(file);
    check_range(*surface, file, scale);
    Mesh mesh = to_mesh(*cleaned(*surface), scale);
    if (mesh.triangles.empty()) {
        refuse(file,
               fmt::format("has no triangle whose corners differ when they are read in single "
                           "precision; its coordinates reach {:.7g}: move it near their "
                           "origin",
                           farthest_of(*surface)));
    }
    if (static_cast<long long>(mesh.triangles.size()) > most_triangles) {
        refuse(file, fmt::format("has {} triangles, expected 1 .. {}", mesh.triangles.size(),
                                 most_triangles));
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
