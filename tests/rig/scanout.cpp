#include "tests/rig/scanout.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <unistd.h>
#include <xf86drm.h>
#include <xf86drmMode.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

namespace ridgeline::test {
namespace {

constexpr const char* debug_folder = "/sys/kernel/debug";

[[noreturn]] void give_up(const char* why) {
  std::fprintf(stderr, "scanout: %s\n", why);
  std::exit(1);
}

bool simulated(int file) {
  drmVersion* version = drmGetVersion(file);
  const bool is = version != nullptr && std::strcmp(version->name, "vkms") == 0;
  drmFreeVersion(version);
  return is;
}

/// As the kernel's crc32_le(): no inversion before or after.
std::uint32_t crc32(std::uint32_t crc, const std::uint8_t* data, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) {
    crc ^= data[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xEDB88320U : 0U);
  }
  return crc;
}

}  // namespace

Scanout::Scanout() {
  for (int number = 0; number < 16 && file_ < 0; ++number) {
    card_ = "/dev/dri/card" + std::to_string(number);
    file_ = ::open(card_.c_str(), O_RDWR | O_CLOEXEC);
    if (file_ < 0 || simulated(file_)) continue;
    ::close(file_);
    file_ = -1;
  }
  if (file_ < 0) give_up("no simulated graphics card");
  drmDropMaster(file_);  // who opens a free card first has it
  drmModeRes* resources = drmModeGetResources(file_);
  drmModeConnector* connector = drmModeGetConnector(file_, resources->connectors[0]);
  connector_ = std::string(drmModeGetConnectorTypeName(connector->connector_type)) + "-" +
               std::to_string(connector->connector_type_id);
  drmModeFreeConnector(connector);
  drmModeFreeResources(resources);
  ::mount("debugfs", debug_folder, "debugfs", 0, nullptr);  // where it is not yet
}

Scanout::~Scanout() {
  ::close(file_);
}

std::uint32_t Scanout::crtc() const {
  drmModeRes* resources = drmModeGetResources(file_);
  const std::uint32_t first = resources->crtcs[0];
  drmModeFreeResources(resources);
  return first;
}

Scanout::Picture Scanout::picture() const {
  Picture shown;
  drmModeCrtc* state = drmModeGetCrtc(file_, crtc());
  if (state->mode_valid != 0) {
    shown.width_px = state->mode.hdisplay;
    shown.height_px = state->mode.vdisplay;
    shown.buffer = state->buffer_id;
  }
  drmModeFreeCrtc(state);
  if (shown.buffer == 0) return shown;
  drmModeFB* buffer = drmModeGetFB(file_, shown.buffer);
  if (buffer == nullptr || buffer->bpp != 32) give_up("the buffer cannot be looked into");
  drm_mode_map_dumb map{};
  map.handle = buffer->handle;
  if (drmIoctl(file_, DRM_IOCTL_MODE_MAP_DUMB, &map) != 0) give_up("the buffer cannot be mapped");
  const std::size_t bytes = static_cast<std::size_t>(buffer->pitch) * buffer->height;
  void* pixels =
      ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, file_, static_cast<off_t>(map.offset));
  if (pixels == MAP_FAILED) give_up("the buffer cannot be mapped");
  for (int y = 0; y < shown.height_px; ++y) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(
        static_cast<const char*>(pixels) + static_cast<std::size_t>(y) * buffer->pitch);
    shown.rows.insert(shown.rows.end(), row, row + shown.width_px);
  }
  ::munmap(pixels, bytes);
  drm_gem_close close{};
  close.handle = buffer->handle;
  drmIoctl(file_, DRM_IOCTL_GEM_CLOSE, &close);
  drmModeFreeFB(buffer);
  return shown;
}

std::optional<std::uint32_t> Scanout::checksum() const {
  const std::string number = card_.substr(std::strlen("/dev/dri/card"));
  const std::string folder = std::string(debug_folder) + "/dri/" + number + "/crtc-0/crc/";
  std::ofstream(folder + "control") << "auto";
  std::ifstream data(folder + "data");
  std::string frame, sum;
  // The first may still be of the picture before.
  for (int skipped = 0; skipped < 3; ++skipped) {
    if (!(data >> frame >> sum)) return std::nullopt;
  }
  return static_cast<std::uint32_t>(std::strtoul(sum.c_str(), nullptr, 16));
}

std::uint32_t Scanout::checksum(const Picture& picture) {
  std::uint32_t crc = 0;
  for (const std::uint32_t pixel : picture.rows) {
    // The card composes in 16 bits a channel: alpha, red, green, blue.
    std::array<std::uint16_t, 4> composed{0xFFFF, 0, 0, 0};
    for (std::size_t channel = 1; channel < 4; ++channel) {
      composed[channel] = static_cast<std::uint16_t>(257 * ((pixel >> (24 - 8 * channel)) & 0xFF));
    }
    std::array<std::uint8_t, sizeof composed> bytes{};
    std::memcpy(bytes.data(), composed.data(), sizeof composed);
    crc = crc32(crc, bytes.data(), bytes.size());
  }
  return crc;
}

bool Scanout::take() const {
  return drmSetMaster(file_) == 0;
}

void Scanout::give_back() const {
  drmDropMaster(file_);
}

void Scanout::plug(bool in) const {
  const std::string number = card_.substr(std::strlen("/dev/dri/"));
  std::ofstream("/sys/class/drm/" + number + "-" + connector_ + "/status")
      << (in ? "detect" : "off");
}

int Scanout::file_of_screen() const {
  DIR* folder = ::opendir("/proc/self/fd");
  int found = -1;
  while (const dirent* entry = ::readdir(folder)) {
    const int file = std::atoi(entry->d_name);
    std::array<char, 64> target{};
    const std::string link = std::string("/proc/self/fd/") + entry->d_name;
    if (::readlink(link.c_str(), target.data(), target.size() - 1) <= 0) continue;
    if (file != file_ && card_ == target.data() && drmIsMaster(file) != 0) found = file;
  }
  ::closedir(folder);
  if (found < 0) give_up("no screen has the card");
  return found;
}

void Scanout::switch_off() const {
  drmModeSetCrtc(file_of_screen(), crtc(), 0, 0, 0, nullptr, 0, nullptr);
}

}  // namespace ridgeline::test
