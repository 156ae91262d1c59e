// SPDX-License-Identifier: MIT
// Off-screen windows: EGL without a surface (Debian's VTK is built for X alone, so it is made
// here), or X.
#ifdef HYORYU_HAS_VTK
#include "offscreen_window.hpp"

#include "hyoryu/core/error.hpp"

#include <vtkGenericOpenGLRenderWindow.h>

#include <array>
#include <cstdlib>
#include <dlfcn.h>
#include <string>

// GLEW first: it refuses to come after any other OpenGL header.
#include <GL/glew.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace hyoryu {

namespace {

EGLDisplay surfaceless_display()
{
    const char* const extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (extensions == nullptr ||
        std::string(extensions).find("EGL_MESA_platform_surfaceless") == std::string::npos) {
        return EGL_NO_DISPLAY;
    }
    return eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

/// A context of OpenGL 3.2, as VTK requires; none if EGL cannot provide it.
EGLContext context_on(EGLDisplay display)
{
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE ||
        eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) {
        return EGL_NO_CONTEXT;
    }
    constexpr std::array<EGLint, 3> config_wish{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    constexpr std::array<EGLint, 7> context_wish{EGL_CONTEXT_MAJOR_VERSION,
                                                 3,
                                                 EGL_CONTEXT_MINOR_VERSION,
                                                 2,
                                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                 EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    // Without a surface the kind of surface is of no importance, and surfaceless configurations
    // offer none of the default kind.
    constexpr std::array<EGLint, 5> any_surface{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, config_wish[0],
                                                config_wish[1], EGL_NONE};
    if (eglChooseConfig(display, any_surface.data(), &config, 1, &count) == EGL_FALSE ||
        count == 0) {
        return EGL_NO_CONTEXT;
    }
    return eglCreateContext(display, config, EGL_NO_CONTEXT, context_wish.data());
}

/// Draws into a framebuffer of VTK's own; the context has no surface at all.
class SurfacelessWindow : public vtkGenericOpenGLRenderWindow {
public:
    static SurfacelessWindow* New()
    {
        auto* const window = new SurfacelessWindow; // VTK's smart pointers own it from here
        window->InitializeObjectBase();
        return window;
    }
    SurfacelessWindow(const SurfacelessWindow&) = delete;
    SurfacelessWindow& operator=(const SurfacelessWindow&) = delete;

    bool is_usable() const { return usable_; }
    void MakeCurrent() override
    {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
    }
    bool IsCurrent() override { return eglGetCurrentContext() == context_; }
    int SupportsOpenGL() override { return 1; }
    vtkTypeBool IsDirect() override { return 1; }
    void Frame() override {} // there is no screen to show it on

protected:
    SurfacelessWindow() : display_(surfaceless_display()), context_(context_on(display_))
    {
        usable_ = context_ != EGL_NO_CONTEXT &&
                  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
        SetFrameBlitModeToNoBlit();
        SetMultiSamples(0);
    }
    ~SurfacelessWindow() override
    {
        if (usable_) {
            Finalize();
            eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        }
        if (context_ != EGL_NO_CONTEXT) {
            eglDestroyContext(display_, context_);
        }
    }
    void OpenGLInitContext() override
    {
        // Debian's GLEW asks for GLX at its end, which is not there and not needed: all OpenGL
        // functions are loaded by then.
        const GLenum status = glewInit();
        Initialized = status == GLEW_OK || status == GLEW_ERROR_NO_GLX_DISPLAY;
    }

private:
    EGLDisplay display_;
    EGLContext context_;
    bool usable_ = false;
};

/// Whether DISPLAY leads to a server that answers. VTK aborts the process if it does not, so Xlib
/// is asked first; it is loaded by hand because nothing else here needs it.
bool x_server_answers()
{
    if (std::getenv("DISPLAY") == nullptr) {
        return false;
    }
    void* const xlib = dlopen("libX11.so.6", RTLD_LAZY);
    if (xlib == nullptr) {
        return false;
    }
    using OpenDisplay = void* (*)(const char*);
    using CloseDisplay = int (*)(void*);
    const auto open_display = reinterpret_cast<OpenDisplay>(dlsym(xlib, "XOpenDisplay"));
    const auto close_display = reinterpret_cast<CloseDisplay>(dlsym(xlib, "XCloseDisplay"));
    void* const display = open_display(nullptr);
    if (display != nullptr) {
        close_display(display);
    }
    return display != nullptr;
}

} // namespace

vtkSmartPointer<vtkRenderWindow> offscreen_window(int width, int height)
{
    vtkSmartPointer<vtkRenderWindow> window;
    const auto surfaceless = vtkSmartPointer<SurfacelessWindow>::New();
    if (surfaceless->is_usable()) {
        window = surfaceless;
    } else if (x_server_answers()) {
        window = vtkSmartPointer<vtkRenderWindow>::New();
    } else {
        throw IoError(
            "cannot render: EGL provides no off-screen context (libegl1 with Mesa is needed) and "
            "no X server is available; start the program with `xvfb-run`");
    }
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0); // many samples a pixel double the time; FXAA smooths the edges
    window->SetSize(width, height);
    return window;
}

} // namespace hyoryu
#endif
