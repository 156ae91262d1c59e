// SPDX-License-Identifier: MIT
// The window, the lights and the fixed objects of every picture of a run.
#pragma once

#include "hyoryu/view/render.hpp"
#include "moments.hpp"
#include "scene_actors.hpp"

#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

namespace hyoryu {

class Picture {
public:
    Picture(const std::filesystem::path& results, const Survey& survey, const Surface& structures,
            const RenderSettings& settings);
    /// The moment as the bytes of a PNG file.
    std::string png_of(const Moment& moment);

private:
    /// From back to front in a plane case; the fluid lies at 0.
    enum class Layer { structures = -1, bodies = 1, edges = 2 };

    void place_camera(const RenderSettings& settings);
    void add_surroundings(const std::filesystem::path& results, const Surface& structures);
    void set_structures(const Surface& structures);
    void add_labels(const RenderSettings& settings);
    void show(const Moment& moment);
    void put_into_plane(vtkActor& actor, Layer layer) const;
    void add_for_this_moment(const Actor& actor);

    Survey survey_;
    std::string colour_;
    Vec3 to_camera_;
    vtkSmartPointer<vtkRenderWindow> window_;
    vtkSmartPointer<vtkRenderer> scene_;
    vtkSmartPointer<vtkRenderer> labels_;
    vtkSmartPointer<vtkColorTransferFunction> colours_;
    double radius_; // of a particle [m]
    vtkSmartPointer<vtkTextActor> time_;
    std::vector<Actor> structures_; // of the start until a moment has its own
    std::vector<Actor> of_this_moment_;
};

} // namespace hyoryu
