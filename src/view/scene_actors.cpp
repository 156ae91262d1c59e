// SPDX-License-Identifier: MIT
// Fluid, bodies, structures and labels as VTK actors.
#ifdef HYORYU_HAS_VTK
#include "scene_actors.hpp"

#include "palette.hpp"

#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkFeatureEdges.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <span>

namespace hyoryu {

namespace {

constexpr double sharp_edge = 30; // degrees between two faces
constexpr double ink = 0.13;      // grey of texts

// A splat is a square; this makes it a ball that is lit from the upper left behind the camera.
constexpr const char* ball_shader = R"(//VTK::Color::Impl
float distance2 = dot(offsetVCVSOutput.xy, offsetVCVSOutput.xy);
if (distance2 > 1.0) { discard; }
vec3 normal = vec3(offsetVCVSOutput.xy, sqrt(1.0 - distance2));
float facing = max(dot(normal, normalize(vec3(-0.35, 0.60, 0.72))), 0.0);
float gleam = 0.10 * pow(facing, 24.0);
ambientColor = ambientColor * (0.42 + 0.62 * facing) + vec3(gleam);
diffuseColor = diffuseColor * (0.42 + 0.62 * facing) + vec3(gleam);
)";

vtkSmartPointer<vtkPolyData> points_of(std::span<const float> coordinates)
{
    vtkNew<vtkFloatArray> array;
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(static_cast<vtkIdType>(coordinates.size() / 3));
    std::copy(coordinates.begin(), coordinates.end(), array->GetPointer(0));
    vtkNew<vtkPoints> points;
    points->SetData(array);
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    return data;
}

vtkSmartPointer<vtkPolyData> mesh_of(const Surface& surface)
{
    auto data = points_of(surface.points);
    vtkNew<vtkCellArray> cells;
    for (std::size_t k = 0; k + 2 < surface.triangles.size(); k += 3) {
        cells->InsertNextCell(
            {surface.triangles[k], surface.triangles[k + 1], surface.triangles[k + 2]});
    }
    data->SetPolys(cells);
    return data;
}

/// Gives each point the colour of its index; points without an index take the first colour.
template <std::size_t N>
void paint(vtkPolyData& data, const std::vector<std::int32_t>& indices,
           const std::array<Rgb, N>& palette)
{
    vtkNew<vtkUnsignedCharArray> colours;
    colours->SetNumberOfComponents(3);
    colours->SetNumberOfTuples(data.GetNumberOfPoints());
    for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Rgb& colour = pick(palette, k < indices.size() ? indices[k] : 0);
        colours->SetTypedTuple(i, colour.data());
    }
    data.GetPointData()->SetScalars(colours);
}

vtkSmartPointer<vtkPointGaussianMapper> ball_mapper(vtkPolyData& data, double radius)
{
    auto mapper = vtkSmartPointer<vtkPointGaussianMapper>::New();
    mapper->SetInputData(&data);
    mapper->SetScaleFactor(radius);
    mapper->SetTriangleScale(1.5F); // the smallest that holds the whole disc
    mapper->EmissiveOff();
    mapper->SetSplatShaderCode(ball_shader);
    return mapper;
}

Actor actor_of(vtkMapper& mapper)
{
    auto actor = Actor::New();
    actor->SetMapper(&mapper);
    return actor;
}

Actor painted_balls(vtkPolyData& data, double radius)
{
    const auto mapper = ball_mapper(data, radius);
    mapper->SetScalarModeToUsePointData();
    mapper->SetColorModeToDirectScalars();
    return actor_of(*mapper);
}

/// Smooth where the mesh is smooth, sharp at edges; the order of corners is kept, because it tells
/// the outside.
Actor mesh_actor(vtkPolyData& data)
{
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(&data);
    normals->ConsistencyOff();
    normals->SplittingOn();
    normals->SetFeatureAngle(sharp_edge);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(normals->GetOutputPort());
    mapper->SetColorModeToDirectScalars();
    Actor actor = actor_of(*mapper);
    actor->GetProperty()->SetAmbient(0.55);
    actor->GetProperty()->SetDiffuse(0.65);
    return actor;
}

bool stands_before(const Vec3& point, const Box& inner, const Vec3& to_camera)
{
    for (int axis = 0; axis < 3; ++axis) {
        const bool beyond =
            to_camera[axis] > 0 ? point[axis] > inner.max()[axis] : point[axis] < inner.min()[axis];
        // A wall that is seen edge-on hides nothing, whatever side it is on.
        if (beyond && std::abs(to_camera[axis]) > 0.1) {
            return true;
        }
    }
    return false;
}

void set_text(vtkTextProperty& text, int size)
{
    text.SetFontFamilyToArial();
    text.SetFontSize(size);
    text.SetColor(ink, ink, ink);
    text.ItalicOff();
    text.ShadowOff();
    text.BoldOff();
}

} // namespace

vtkSmartPointer<vtkColorTransferFunction> water_colours(double from, double to)
{
    struct Stop {
        double at, r, g, b;
    };
    // Lightness grows evenly from stop to stop, so that equal steps of speed look equal.
    constexpr std::array<Stop, 6> stops{{{0.00, 0.03, 0.18, 0.42},
                                         {0.20, 0.04, 0.30, 0.58},
                                         {0.42, 0.06, 0.45, 0.70},
                                         {0.64, 0.22, 0.66, 0.81},
                                         {0.84, 0.62, 0.87, 0.92},
                                         {1.00, 1.00, 1.00, 1.00}}};
    auto colours = vtkSmartPointer<vtkColorTransferFunction>::New();
    colours->SetColorSpaceToLab();
    for (const Stop& stop : stops) {
        colours->AddRGBPoint(from + stop.at * (to - from), stop.r, stop.g, stop.b);
    }
    return colours;
}

Actor fluid_actor(const Cloud& cloud, const std::vector<float>& values, double radius,
                  vtkColorTransferFunction& colours)
{
    const auto data = points_of(cloud.points);
    vtkNew<vtkFloatArray> scalars;
    scalars->SetNumberOfTuples(data->GetNumberOfPoints());
    scalars->Fill(0);
    std::copy(values.begin(), values.end(), scalars->GetPointer(0));
    data->GetPointData()->SetScalars(scalars);
    const auto mapper = ball_mapper(*data, radius);
    mapper->SetLookupTable(&colours);
    mapper->UseLookupTableScalarRangeOn();
    return actor_of(*mapper);
}

Actor body_particles_actor(const Cloud& cloud, double radius)
{
    const auto data = points_of(cloud.points);
    paint(*data, indices_in(cloud.columns, "Body"), woods);
    return painted_balls(*data, radius);
}

Actor wall_particles_actor(const Cloud& cloud, double radius, const Box& inner,
                           const Vec3& to_camera)
{
    std::vector<float> shown;
    for (std::size_t i = 0; i + 2 < cloud.points.size(); i += 3) {
        const float* const p = &cloud.points[i];
        if (!stands_before(Eigen::Vector3f(p).cast<double>(), inner, to_camera)) {
            shown.insert(shown.end(), p, p + 3);
        }
    }
    const auto data = points_of(shown);
    paint(*data, {}, stones);
    return painted_balls(*data, radius);
}

Actor bodies_actor(const Surface& surface)
{
    const auto data = mesh_of(surface);
    paint(*data, indices_in(surface.columns, "Body"), woods);
    return mesh_actor(*data);
}

Actor structures_actor(const Surface& surface, Sides sides)
{
    const auto data = mesh_of(surface);
    paint(*data, indices_in(surface.columns, "Wall"), stones);
    Actor actor = mesh_actor(*data);
    actor->GetProperty()->SetBackfaceCulling(sides == Sides::facing_camera);
    return actor;
}

Actor edges_actor(const Surface& surface)
{
    constexpr double grey = 0.45;
    vtkNew<vtkCleanPolyData>
        joined; // corners that faces do not share would make every side an edge
    joined->SetInputData(mesh_of(surface));
    vtkNew<vtkFeatureEdges> edges;
    edges->SetInputConnection(joined->GetOutputPort());
    edges->SetFeatureAngle(sharp_edge);
    edges->ColoringOff();
    edges->NonManifoldEdgesOff();
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(edges->GetOutputPort());
    mapper->ScalarVisibilityOff();
    Actor actor = actor_of(*mapper);
    actor->GetProperty()->SetColor(grey, grey, grey);
    actor->GetProperty()->LightingOff();
    return actor;
}

vtkSmartPointer<vtkScalarBarActor> colour_scale(vtkColorTransferFunction& colours,
                                                int picture_height)
{
    auto bar = vtkSmartPointer<vtkScalarBarActor>::New();
    bar->SetLookupTable(&colours);
    bar->SetOrientationToHorizontal();
    bar->SetPosition(0.31, 0.02);
    bar->SetWidth(0.38);
    bar->SetHeight(0.065);
    bar->SetNumberOfLabels(5);
    bar->SetLabelFormat("%.4g");
    bar->UnconstrainedFontSizeOn();
    set_text(*bar->GetLabelTextProperty(), picture_height / 42);
    return bar;
}

vtkSmartPointer<vtkTextActor> scale_title(const std::string& title, int picture_height)
{
    auto label = vtkSmartPointer<vtkTextActor>::New();
    set_text(*label->GetTextProperty(), picture_height / 40);
    label->GetTextProperty()->SetJustificationToCentered();
    label->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    label->SetPosition(0.5, 0.092);
    label->SetInput(title.c_str());
    return label;
}

vtkSmartPointer<vtkTextActor> time_label(int picture_height)
{
    auto label = vtkSmartPointer<vtkTextActor>::New();
    set_text(*label->GetTextProperty(), picture_height / 30);
    label->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    label->SetPosition(0.02, 0.93);
    return label;
}

} // namespace hyoryu
#endif
