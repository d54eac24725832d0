#include "platform/kms_card.hpp"

#include <drm_fourcc.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>
#include <xf86drm.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "config/limits.hpp"

namespace ridgeline {
namespace {

template <auto Release>
struct Releaser {
  template <typename T>
  void operator()(T* block) const {
    Release(block);
  }
};
using Resources = std::unique_ptr<drmModeRes, Releaser<drmModeFreeResources>>;
using Connector = std::unique_ptr<drmModeConnector, Releaser<drmModeFreeConnector>>;
using Encoder = std::unique_ptr<drmModeEncoder, Releaser<drmModeFreeEncoder>>;

Fault fault_of(int error) {
  switch (error) {
    case EACCES:
    case EPERM:
      return Fault::screen_not_ours;
    case ENODEV:
    case ENXIO:
    case EIO:
    case EBADF:
      return Fault::screen_lost;
    default:
      return Fault::screen_refused;
  }
}

double refresh_hz(const drmModeModeInfo& mode) {
  const double pixels = static_cast<double>(mode.htotal) * mode.vtotal;
  return pixels > 0 ? mode.clock * 1000.0 / pixels : 0;
}

bool fits(const drmModeModeInfo& mode, const ScreenSettings& settings) {
  if ((mode.flags & (DRM_MODE_FLAG_INTERLACE | DRM_MODE_FLAG_DBLSCAN)) != 0) return false;
  if (mode.hdisplay > limits::max_image_px || mode.vdisplay > limits::max_image_px) return false;
  if (settings.width_px == 0 && (mode.type & DRM_MODE_TYPE_PREFERRED) == 0) return false;
  if (settings.width_px != 0 &&
      (mode.hdisplay != settings.width_px || mode.vdisplay != settings.height_px)) {
    return false;
  }
  return settings.refresh_hz == 0 || std::abs(refresh_hz(mode) - settings.refresh_hz) <= 0.5;
}

const drmModeModeInfo* find_mode(const drmModeConnector& connector,
                                 const ScreenSettings& settings) {
  const drmModeModeInfo* best = nullptr;
  for (int i = 0; i < connector.count_modes; ++i) {
    const drmModeModeInfo& mode = connector.modes[i];
    if (!fits(mode, settings)) continue;
    if (best == nullptr || refresh_hz(mode) > refresh_hz(*best)) best = &mode;
  }
  return best;
}

/// Appends as much as there is room for.
template <typename... Values>
void add(ScreenDetail& detail, const char* format, Values... values) {
  const std::size_t used = std::strlen(detail.text);
  std::snprintf(detail.text + used, sizeof detail.text - used, format, values...);
}

void name_connector(const drmModeConnector& connector, char (&name)[32]) {
  const char* type = drmModeGetConnectorTypeName(connector.connector_type);
  std::snprintf(name, sizeof name, "%s-%u", type == nullptr ? "Unknown" : type,
                connector.connector_type_id);
}

/// A scanout engine that can feed the connector; 0: none.
std::uint32_t find_crtc(int file, const drmModeRes& resources, const drmModeConnector& connector) {
  for (int i = 0; i < connector.count_encoders; ++i) {
    const Encoder encoder(drmModeGetEncoder(file, connector.encoders[i]));
    if (encoder == nullptr) continue;
    if (encoder->crtc_id != 0) return encoder->crtc_id;  // the one that feeds it now
    for (int k = 0; k < resources.count_crtcs && k < 32; ++k) {
      if ((encoder->possible_crtcs & (1U << k)) != 0) return resources.crtcs[k];
    }
  }
  return 0;
}

}  // namespace

Result<std::unique_ptr<KmsCard>> KmsCard::open(const ScreenSettings& settings,
                                               ScreenDetail& detail) {
  std::unique_ptr<KmsCard> card(new KmsCard);
  card->file_ = ::open(settings.card, O_RDWR | O_CLOEXEC | O_NONBLOCK);
  if (card->file_ < 0) {
    add(detail, "%.100s: %s", settings.card, std::strerror(errno));
    return Fault::screen_missing;
  }
  std::uint64_t dumb = 0;
  if (drmGetCap(card->file_, DRM_CAP_DUMB_BUFFER, &dumb) != 0 || dumb == 0) {
    add(detail, "%.100s: not a card with mode setting", settings.card);
    return Fault::screen_missing;
  }
  if (drmSetMaster(card->file_) != 0) {
    add(detail, "%.100s: another program has it (%s)", settings.card, std::strerror(errno));
    return Fault::screen_not_ours;
  }
  if (const Status found = card->find_monitor(settings, detail); !found) return found.fault();
  return card;
}

Status KmsCard::find_monitor(const ScreenSettings& settings, ScreenDetail& detail) {
  const Resources resources(drmModeGetResources(file_));
  if (resources == nullptr) {
    add(detail, "%.100s: not a card with mode setting", settings.card);
    return Fault::screen_missing;
  }
  add(detail, "%.60s has", settings.card);
  for (int i = 0; i < resources->count_connectors; ++i) {
    const Connector connector(drmModeGetConnector(file_, resources->connectors[i]));
    if (connector == nullptr) continue;
    char name[32];
    name_connector(*connector, name);
    const bool plugged = connector->connection != DRM_MODE_DISCONNECTED;
    const bool meant = *settings.connector == '\0' || std::strcmp(settings.connector, name) == 0;
    if (plugged && meant) return take_monitor(*resources, *connector, settings, detail);
    add(detail, " %s%s", name, plugged ? "" : " (nothing connected)");
  }
  if (*settings.connector != '\0') add(detail, ", asked for: %.40s", settings.connector);
  return Fault::screen_no_monitor;
}

Status KmsCard::take_monitor(const drmModeRes& resources, const drmModeConnector& connector,
                             const ScreenSettings& settings, ScreenDetail& detail) {
  char name[32];
  name_connector(connector, name);
  detail = {};
  const drmModeModeInfo* mode = find_mode(connector, settings);
  if (mode == nullptr) {
    add(detail, "%s has", name);
    for (int i = 0; i < connector.count_modes; ++i) {
      const drmModeModeInfo& offered = connector.modes[i];
      add(detail, " %dx%d@%.2f", offered.hdisplay, offered.vdisplay, refresh_hz(offered));
    }
    return Fault::screen_no_mode;
  }
  mode_ = *mode;
  connector_ = connector.connector_id;
  crtc_ = find_crtc(file_, resources, connector);
  if (crtc_ == 0) {
    add(detail, "%s: nothing of the card can feed it", name);
    return Fault::screen_refused;
  }
  found_ = drmModeGetCrtc(file_, crtc_);
  watch_plug(name);
  std::snprintf(description_, sizeof description_, "kms %.60s %s %dx%d %.2f Hz", settings.card,
                name, width_px(), height_px(), refresh_hz(mode_));
  return {};
}

void KmsCard::watch_plug(const char* connector) {
  struct stat card {};
  if (::fstat(file_, &card) != 0) return;
  char path[96];
  std::snprintf(path, sizeof path, "/sys/class/drm/card%u-%s/status", minor(card.st_rdev),
                connector);
  plug_ = ::open(path, O_RDONLY | O_CLOEXEC);
}

bool KmsCard::plugged() const {
  char word[16] = {};
  if (plug_ < 0 || ::pread(plug_, word, sizeof word - 1, 0) <= 0) return true;
  return std::strncmp(word, "disconnected", 12) != 0;
}

KmsCard::~KmsCard() {
  if (plug_ >= 0) ::close(plug_);
  if (found_ != nullptr) {
    const bool shown = found_->mode_valid != 0 && found_->buffer_id != 0;
    drmModeSetCrtc(file_, crtc_, shown ? found_->buffer_id : 0, found_->x, found_->y,
                   shown ? &connector_ : nullptr, shown ? 1 : 0, shown ? &found_->mode : nullptr);
    drmModeFreeCrtc(found_);
  }
  if (file_ >= 0) ::close(file_);
}

Result<std::uint32_t> KmsCard::add_buffer(std::uint32_t handle, std::uint32_t stride_bytes) {
  const std::uint32_t handles[4] = {handle, 0, 0, 0};
  const std::uint32_t strides[4] = {stride_bytes, 0, 0, 0};
  const std::uint32_t offsets[4] = {0, 0, 0, 0};
  std::uint32_t buffer = 0;
  // Without a modifier: not every card takes them, and each knows the layout of its own buffers.
  const int refused = drmModeAddFB2(file_, mode_.hdisplay, mode_.vdisplay, DRM_FORMAT_XRGB8888,
                                    handles, strides, offsets, &buffer, 0);
  if (refused != 0) return Fault::screen_refused;
  return buffer;
}

void KmsCard::remove_buffer(std::uint32_t buffer) {
  drmModeRmFB(file_, buffer);
}

Status KmsCard::set_mode(std::uint32_t buffer) {
  if (drmIsMaster(file_) == 0 && drmSetMaster(file_) != 0) return Fault::screen_not_ours;
  if (drmModeSetCrtc(file_, crtc_, buffer, 0, 0, &connector_, 1, &mode_) == 0) return {};
  return fault_of(errno);
}

Status KmsCard::flip(std::uint32_t buffer, std::uint64_t picture) {
  // The number of the picture travels as the pointer that comes back with the event.
  auto* number = reinterpret_cast<void*>(static_cast<std::uintptr_t>(picture));
  if (drmModePageFlip(file_, crtc_, buffer, DRM_MODE_PAGE_FLIP_EVENT, number) == 0) return {};
  return fault_of(errno);
}

}  // namespace ridgeline
