#include "platform/egl_surface.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl31.h>

#include <cstdio>
#include <cstring>
#include <utility>

namespace ridgeline {
namespace {

bool has_word(const char* list, const char* word) {
  return list != nullptr && std::strstr(list, word) != nullptr;
}

EGLDisplay open_display() {
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (has_word(client, "EGL_MESA_platform_surfaceless")) {
    const EGLDisplay display =
        eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE) {
      return display;
    }
  }
  const EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE) {
    return display;
  }
  return EGL_NO_DISPLAY;
}

}  // namespace

Result<EglSurface> EglSurface::make() {
  EglSurface made;
  made.display_ = open_display();
  if (made.display_ == EGL_NO_DISPLAY) return Fault::egl_unavailable;
  if (eglBindAPI(EGL_OPENGL_ES_API) != EGL_TRUE) return Fault::egl_unavailable;
  const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE,
                           EGL_PBUFFER_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(made.display_, wanted, &config, 1, &count) != EGL_TRUE || count < 1) {
    return Fault::egl_unavailable;
  }
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 1, EGL_NONE};
  made.context_ = eglCreateContext(made.display_, config, EGL_NO_CONTEXT, version);
  if (made.context_ == EGL_NO_CONTEXT) return Fault::egl_unavailable;
  if (!has_word(eglQueryString(made.display_, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context")) {
    const EGLint size[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
    made.surface_ = eglCreatePbufferSurface(made.display_, config, size);
    if (made.surface_ == EGL_NO_SURFACE) return Fault::egl_unavailable;
  }
  const EGLSurface surface = made.surface_ == nullptr ? EGL_NO_SURFACE : made.surface_;
  if (eglMakeCurrent(made.display_, surface, surface, made.context_) != EGL_TRUE) {
    return Fault::egl_unavailable;
  }
  std::snprintf(made.description_, sizeof made.description_, "%s, %s",
                reinterpret_cast<const char*>(glGetString(GL_RENDERER)),
                reinterpret_cast<const char*>(glGetString(GL_VERSION)));
  return made;
}

EglSurface::EglSurface(EglSurface&& other) noexcept {
  *this = std::move(other);
}

EglSurface& EglSurface::operator=(EglSurface&& other) noexcept {
  if (this != &other) {
    release();
    display_ = std::exchange(other.display_, nullptr);
    context_ = std::exchange(other.context_, nullptr);
    surface_ = std::exchange(other.surface_, nullptr);
    std::memcpy(description_, other.description_, sizeof description_);
  }
  return *this;
}

EglSurface::~EglSurface() {
  release();
}

void EglSurface::release() {
  if (display_ == nullptr) return;
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (surface_ != nullptr) eglDestroySurface(display_, surface_);
  if (context_ != nullptr) eglDestroyContext(display_, context_);
  eglTerminate(display_);
  display_ = context_ = surface_ = nullptr;
}

void EglSurface::make_current() const {
  if (context_ == nullptr || eglGetCurrentContext() == context_) return;
  const EGLSurface surface = surface_ == nullptr ? EGL_NO_SURFACE : surface_;
  eglMakeCurrent(display_, surface, surface, context_);
}

TimerFunctions EglSurface::timer_functions() const {
  TimerFunctions functions;
  const auto* list = reinterpret_cast<const char*>(glGetString(GL_EXTENSIONS));
  if (!has_word(list, "GL_EXT_disjoint_timer_query")) return functions;
  functions.gen_queries =
      reinterpret_cast<decltype(functions.gen_queries)>(eglGetProcAddress("glGenQueriesEXT"));
  functions.query_counter =
      reinterpret_cast<decltype(functions.query_counter)>(eglGetProcAddress("glQueryCounterEXT"));
  functions.get_query_object_ui64 = reinterpret_cast<decltype(functions.get_query_object_ui64)>(
      eglGetProcAddress("glGetQueryObjectui64vEXT"));
  return functions;
}

}  // namespace ridgeline
