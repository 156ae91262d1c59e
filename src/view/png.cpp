// SPDX-License-Identifier: MIT
#ifdef HYORYU_HAS_VTK
#include "png.hpp"

#include "hyoryu/core/error.hpp"

#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

namespace hyoryu {

std::string png_of(vtkRenderWindow& window)
{
    vtkNew<vtkWindowToImageFilter> image;
    image->SetInput(&window);
    image->ReadFrontBufferOff();
    image->ShouldRerenderOff();
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(image->GetOutputPort());
    writer->WriteToMemoryOn();
    writer->Write();
    vtkUnsignedCharArray* const bytes = writer->GetResult();
    if (bytes == nullptr || bytes->GetNumberOfValues() == 0) {
        throw IoError("VTK gave no picture");
    }
    const auto* const begin = reinterpret_cast<const char*>(bytes->GetPointer(0));
    return {begin, begin + bytes->GetNumberOfValues()};
}

} // namespace hyoryu
#endif
