#include "platform/egl_context.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl31.h>

#include <array>
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

EGLDisplay open_display(const EglPlace& place) {
  if (place.platform == 0) return open_display();
  const EGLDisplay display = eglGetPlatformDisplay(place.platform, place.native, place.details);
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
    return EGL_NO_DISPLAY;
  }
  return display;
}

/// How a context on this display is asked whether the driver was reset.
EglContext::ResetStatus reset_question() {
  const auto* list = reinterpret_cast<const char*>(glGetString(GL_EXTENSIONS));
  const char* name = has_word(list, "GL_KHR_robustness")   ? "glGetGraphicsResetStatusKHR"
                     : has_word(list, "GL_EXT_robustness") ? "glGetGraphicsResetStatusEXT"
                                                           : nullptr;
  if (name == nullptr) return nullptr;
  return reinterpret_cast<EglContext::ResetStatus>(eglGetProcAddress(name));
}

}  // namespace

Result<EglContext> EglContext::make() {
  return make(EglPlace{});
}

Result<EglContext> EglContext::make(const EglPlace& place) {
  EglContext made;
  made.display_ = open_display(place);
  if (made.display_ == EGL_NO_DISPLAY) return Fault::egl_unavailable;
  if (eglBindAPI(EGL_OPENGL_ES_API) != EGL_TRUE) return Fault::egl_unavailable;
  if (const Status chosen = made.choose_config(place); !chosen) return chosen.fault();
  if (!has_word(eglQueryString(made.display_, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context")) {
    const EGLint size[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
    made.surface_ = eglCreatePbufferSurface(made.display_, made.config_, size);
    if (made.surface_ == EGL_NO_SURFACE) return Fault::egl_unavailable;
  }
  if (const Status opened = made.open_context(); !opened) return opened.fault();
  return made;
}

Status EglContext::choose_config(const EglPlace& place) {
  // No depth or stencil: the picture is copied to its place when it is finished.
  const EGLint wanted[] = {EGL_RENDERABLE_TYPE,
                           EGL_OPENGL_ES3_BIT,
                           EGL_SURFACE_TYPE,
                           place.visual != 0     ? EGL_WINDOW_BIT
                           : place.platform == 0 ? EGL_PBUFFER_BIT
                                                 : 0,
                           EGL_RED_SIZE,
                           8,
                           EGL_GREEN_SIZE,
                           8,
                           EGL_BLUE_SIZE,
                           8,
                           EGL_NONE};
  std::array<EGLConfig, 128> configs{};
  EGLint count = 0;
  if (eglChooseConfig(display_, wanted, configs.data(), static_cast<EGLint>(configs.size()),
                      &count) != EGL_TRUE) {
    return Fault::egl_unavailable;
  }
  for (EGLint i = 0; i < count; ++i) {
    EGLint native = 0;
    eglGetConfigAttrib(display_, configs[static_cast<std::size_t>(i)], EGL_NATIVE_VISUAL_ID,
                       &native);
    if (place.visual != 0 && static_cast<std::uint32_t>(native) != place.visual) continue;
    config_ = configs[static_cast<std::size_t>(i)];
    return {};
  }
  return Fault::egl_unavailable;
}

Status EglContext::open_context() {
  const char* able = eglQueryString(display_, EGL_EXTENSIONS);
  const EGLint telling[] = {EGL_CONTEXT_MAJOR_VERSION,
                            3,
                            EGL_CONTEXT_MINOR_VERSION,
                            1,
                            EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT,
                            EGL_LOSE_CONTEXT_ON_RESET_EXT,
                            EGL_NONE};
  const EGLint plain[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 1, EGL_NONE};
  if (has_word(able, "EGL_EXT_create_context_robustness")) {
    context_ = eglCreateContext(display_, config_, EGL_NO_CONTEXT, telling);
  }
  if (context_ == EGL_NO_CONTEXT) {
    context_ = eglCreateContext(display_, config_, EGL_NO_CONTEXT, plain);
  }
  if (context_ == EGL_NO_CONTEXT) return Fault::egl_unavailable;
  if (eglMakeCurrent(display_, surface_, surface_, context_) != EGL_TRUE) {
    return Fault::egl_unavailable;
  }
  lost_ = false;
  reset_status_ = reset_question();
  std::snprintf(description_, sizeof description_, "%s, %s",
                reinterpret_cast<const char*>(glGetString(GL_RENDERER)),
                reinterpret_cast<const char*>(glGetString(GL_VERSION)));
  return {};
}

EglContext::EglContext(EglContext&& other) noexcept {
  *this = std::move(other);
}

EglContext& EglContext::operator=(EglContext&& other) noexcept {
  if (this != &other) {
    release();
    display_ = std::exchange(other.display_, nullptr);
    config_ = std::exchange(other.config_, nullptr);
    context_ = std::exchange(other.context_, nullptr);
    surface_ = std::exchange(other.surface_, nullptr);
    reset_status_ = std::exchange(other.reset_status_, nullptr);
    lost_ = std::exchange(other.lost_, false);
    std::memcpy(description_, other.description_, sizeof description_);
  }
  return *this;
}

EglContext::~EglContext() {
  release();
}

void EglContext::close_context() {
  if (display_ == nullptr) return;
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (context_ != nullptr) eglDestroyContext(display_, context_);
  context_ = nullptr;
}

void EglContext::release() {
  if (display_ == nullptr) return;
  close_context();
  if (surface_ != nullptr) eglDestroySurface(display_, surface_);
  eglTerminate(display_);
  display_ = surface_ = config_ = nullptr;
}

Status EglContext::renew() {
  close_context();
  return open_context();
}

Status EglContext::open_window(void* native_window) {
  const EGLSurface window =
      eglCreatePlatformWindowSurface(display_, config_, native_window, nullptr);
  if (window == EGL_NO_SURFACE) return Fault::egl_unavailable;
  if (eglMakeCurrent(display_, window, window, context_) != EGL_TRUE) {
    eglDestroySurface(display_, window);
    return Fault::egl_unavailable;
  }
  if (surface_ != nullptr) eglDestroySurface(display_, surface_);
  surface_ = window;
  eglSwapInterval(display_, 0);  // a frame must not wait for a server
  return {};
}

Status EglContext::swap() {
  if (eglSwapBuffers(display_, surface_) == EGL_TRUE) return {};
  return eglGetError() == EGL_CONTEXT_LOST ? Fault::gl_context_lost : Fault::screen_lost;
}

void EglContext::make_current() const {
  if (context_ == nullptr || eglGetCurrentContext() == context_) return;
  eglMakeCurrent(display_, surface_, surface_, context_);
}

bool EglContext::lost() {
  if (!lost_ && reset_status_ != nullptr) lost_ = reset_status_() != GL_NO_ERROR;
  return lost_;
}

TimerFunctions EglContext::timer_functions() const {
  TimerFunctions functions;
  const auto* list = reinterpret_cast<const char*>(glGetString(GL_EXTENSIONS));
  if (!has_word(list, "GL_EXT_disjoint_timer_query")) return functions;
  // A driver may have the extension and no clock behind it.
  constexpr GLenum timestamp_ext = 0x8E28, query_counter_bits_ext = 0x8864;
  const auto query =
      reinterpret_cast<void (*)(GLenum, GLenum, GLint*)>(eglGetProcAddress("glGetQueryivEXT"));
  GLint bits = 0;
  if (query != nullptr) query(timestamp_ext, query_counter_bits_ext, &bits);
  if (bits == 0) return functions;
  functions.gen_queries =
      reinterpret_cast<decltype(functions.gen_queries)>(eglGetProcAddress("glGenQueriesEXT"));
  functions.query_counter =
      reinterpret_cast<decltype(functions.query_counter)>(eglGetProcAddress("glQueryCounterEXT"));
  functions.get_query_object_ui64 = reinterpret_cast<decltype(functions.get_query_object_ui64)>(
      eglGetProcAddress("glGetQueryObjectui64vEXT"));
  return functions;
}

}  // namespace ridgeline
