// SPDX-License-Identifier: MIT
// Composes a picture: surroundings once, fluid and bodies for each moment, labels above all.
#ifdef HYORYU_HAS_VTK
#include "picture.hpp"

#include "camera.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/io/results.hpp"
#include "offscreen_window.hpp"

#include <vtkCallbackCommand.h>
#include <vtkEDLShading.h>
#include <vtkLightKit.h>
#include <vtkNew.h>
#include <vtkOpenGLFXAAPass.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkPNGWriter.h>
#include <vtkProperty.h>
#include <vtkRenderStepsPass.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>
#include <vtk_glew.h>

#include <fmt/format.h>

namespace hyoryu {

namespace {

constexpr double default_azimuth = -60;  // degrees
constexpr double default_elevation = 30; // degrees
// Spheres of half the spacing leave gaps between them; a little more closes the surface. In a plane
// there are no spheres behind that would close it.
constexpr double radius_of_spacing = 0.62;
constexpr double radius_of_spacing_in_a_plane = 0.72;

/// Shows depth by eye-dome lighting: without it a cloud of spheres is one flat patch of colour. A
/// plane case has no depth to show.
void shade_depth(vtkRenderer& scene)
{
    vtkNew<vtkRenderStepsPass> steps;
    vtkNew<vtkEDLShading> depth_shade;
    depth_shade->SetDelegatePass(steps);
    vtkNew<vtkOpenGLFXAAPass> smooth_edges;
    smooth_edges->SetDelegatePass(depth_shade);
    scene.SetPass(smooth_edges);
}

vtkSmartPointer<vtkRenderer> make_scene(vtkRenderWindow& window)
{
    auto scene = vtkSmartPointer<vtkRenderer>::New();
    scene->SetBackground(0.96, 0.965, 0.97);
    scene->SetBackground2(0.74, 0.80, 0.86);
    scene->GradientBackgroundOn();
    scene->UseFXAAOn();
    vtkNew<vtkLightKit> lights;
    lights->SetKeyToFillRatio(2);
    lights->SetKeyToHeadRatio(1.5);
    lights->AddLightsToRenderer(scene);
    window.AddRenderer(scene);
    return scene;
}

/// The shading of depth leaves blending off; texts without it are coarse and bold.
void blend(vtkObject* labels, unsigned long, void*, void*)
{
    auto* const window =
        vtkOpenGLRenderWindow::SafeDownCast(vtkRenderer::SafeDownCast(labels)->GetRenderWindow());
    window->GetState()->vtkglEnable(GL_BLEND);
}

/// A layer of its own, which the shading of depth does not touch.
vtkSmartPointer<vtkRenderer> make_label_layer(vtkRenderWindow& window)
{
    auto labels = vtkSmartPointer<vtkRenderer>::New();
    window.SetNumberOfLayers(2);
    labels->SetLayer(1);
    vtkNew<vtkCallbackCommand> before_labels;
    before_labels->SetCallback(blend);
    labels->AddObserver(vtkCommand::StartEvent, before_labels);
    window.AddRenderer(labels);
    return labels;
}

std::string title_of(const std::string& colour, const std::string& unit)
{
    const std::string name = colour == "Velocity" ? "speed" : colour;
    return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

} // namespace

Picture::Picture(const std::filesystem::path& results, const Survey& survey,
                 const Surface& structures, const RenderSettings& settings)
    : survey_(survey), colour_(settings.colour),
      to_camera_(view_direction(settings.azimuth_deg.value_or(default_azimuth),
                                settings.elevation_deg.value_or(default_elevation))),
      window_(offscreen_window(settings.width, settings.height)), scene_(make_scene(*window_)),
      labels_(make_label_layer(*window_)),
      colours_(water_colours(survey.colour_min, survey.colour_max)),
      radius_(survey.spacing * (survey.flat ? radius_of_spacing_in_a_plane : radius_of_spacing))
{
    place_camera(settings);
    add_surroundings(results, structures);
    add_labels(settings);
}

void Picture::place_camera(const RenderSettings& settings)
{
    const double aspect = static_cast<double>(settings.width) / settings.height;
    vtkCamera& camera = *scene_->GetActiveCamera();
    if (survey_.flat) {
        to_camera_ = -Vec3::UnitY();
        aim_at_plane(camera, survey_.bounds, aspect);
    } else {
        shade_depth(*scene_);
        aim(camera, survey_.bounds, to_camera_, aspect);
    }
}

void Picture::add_surroundings(const std::filesystem::path& results, const Surface& structures)
{
    if (!structures.triangles.empty()) {
        set_structures(structures);
    } else if (std::filesystem::exists(results / "walls.hdf")) {
        scene_->AddActor(wall_particles_actor(read_frame(results / "walls.hdf"), radius_,
                                              survey_.inner, to_camera_));
    }
}

void Picture::set_structures(const Surface& structures)
{
    for (const Actor& actor : structures_) {
        scene_->RemoveActor(actor);
    }
    const Sides sides = survey_.flat ? Sides::all : Sides::facing_camera;
    structures_ = {structures_actor(structures, sides), edges_actor(structures)};
    put_into_plane(*structures_.front(), Layer::structures);
    for (const Actor& actor : structures_) {
        scene_->AddActor(actor);
    }
}

void Picture::add_labels(const RenderSettings& settings)
{
    time_ = time_label(settings.height);
    labels_->AddActor2D(time_);
    if (!survey_.unit.empty()) {
        const std::string title = title_of(settings.colour, survey_.unit);
        labels_->AddActor2D(colour_scale(*colours_, settings.height));
        labels_->AddActor2D(scale_title(title, settings.height));
    }
}

/// In a plane everything would lie at one depth, so each kind has its own; and a face that looks
/// straight at camera and lamps would be bleached, so colours stay as they are.
void Picture::put_into_plane(vtkActor& actor, Layer layer) const
{
    if (survey_.flat) {
        actor.SetPosition(0, -static_cast<int>(layer) * survey_.spacing, 0);
        actor.GetProperty()->LightingOff();
        actor.GetProperty()->SetAmbient(0);
        actor.GetProperty()->SetDiffuse(1);
    }
}

void Picture::add_for_this_moment(const Actor& actor)
{
    scene_->AddActor(actor);
    of_this_moment_.push_back(actor);
}

void Picture::show(const Moment& moment)
{
    for (const Actor& actor : of_this_moment_) {
        scene_->RemoveActor(actor);
    }
    of_this_moment_.clear();
    if (!moment.structures.empty()) {
        set_structures(read_surface(moment.structures));
    }
    if (!moment.fluid.empty()) {
        const Cloud fluid = read_frame(moment.fluid);
        add_for_this_moment(fluid_actor(fluid, magnitudes(fluid, colour_), radius_, *colours_));
    }
    if (!moment.surfaces.empty()) {
        const Surface bodies = read_surface(moment.surfaces);
        const Actor actor = bodies_actor(bodies);
        const Actor edges = edges_actor(bodies);
        put_into_plane(*actor, Layer::bodies);
        put_into_plane(*edges, Layer::edges);
        add_for_this_moment(actor);
        add_for_this_moment(edges);
    } else if (!moment.bodies.empty()) {
        add_for_this_moment(body_particles_actor(read_frame(moment.bodies), radius_));
    }
    time_->SetInput(fmt::format("t = {:.{}f} s", moment.time, survey_.time_digits).c_str());
}

std::string Picture::png_of(const Moment& moment)
{
    show(moment);
    scene_->ResetCameraClippingRange();
    window_->Render();
    vtkNew<vtkWindowToImageFilter> image;
    image->SetInput(window_);
    image->ReadFrontBufferOff();
    image->ShouldRerenderOff();
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(image->GetOutputPort());
    writer->WriteToMemoryOn();
    writer->Write();
    vtkUnsignedCharArray* const bytes = writer->GetResult();
    if (bytes == nullptr || bytes->GetNumberOfValues() == 0) {
        throw IoError("VTK returned no picture");
    }
    const auto* const begin = reinterpret_cast<const char*>(bytes->GetPointer(0));
    return {begin, begin + bytes->GetNumberOfValues()};
}

} // namespace hyoryu
#endif
