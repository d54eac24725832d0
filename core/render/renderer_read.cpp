// What is read back of a finished frame: counters for its proof; ranges and colours for dumps.
#include <bit>
#include <limits>

#include "core/base/assert.hpp"
#include "core/render/renderer.hpp"

namespace ridgeline {
namespace {

constexpr float sky = 1e30f;

}  // namespace

void Renderer::read_range(std::span<float> range_m, std::span<std::uint32_t> scratch) {
  const auto width = static_cast<std::size_t>(sizes_.width_px);
  RL_ASSERT(range_m.size() == width * static_cast<std::size_t>(sizes_.height_px));
  RL_ASSERT(scratch.size() >= scratch_words(sizes_.width_px, sizes_.height_px));
  const auto row = static_cast<std::size_t>(rays_width());
  glBindFramebuffer(GL_FRAMEBUFFER, range_target_.name());
  glReadPixels(0, 0, rays_width(), rays_height(), GL_RGBA_INTEGER, GL_UNSIGNED_INT, scratch.data());
  const auto shown = [&](int x, int y) {
    const float value = std::bit_cast<float>(
        scratch[4 * (static_cast<std::size_t>(y) * row + static_cast<std::size_t>(x))]);
    return value < 0      ? std::numeric_limits<float>::quiet_NaN()
           : value >= sky ? std::numeric_limits<float>::infinity()
                          : value;
  };
  const RayTile all{0, 0, RayTile::pair(sizes_.width_px, sizes_.height_px), RayTile::pair(1, 1)};
  const std::span<const RayTile> whole(&all, 1);
  const bool tiled = !tiles_shown_.tiles.empty();
  int before = 0;
  for (const RayTile& tile : tiled ? tiles_shown_.tiles : whole) {
    const bool plain_sky = tiled && before++ >= tiles_shown_.ground;  // coloured without its ray
    const BlockShape block = tile.shape();
    for (int y = 0; y < tile.height(); ++y) {
      for (int x = 0; x < tile.width(); ++x) {
        const auto pixel =
            static_cast<std::size_t>(tile.y() + y) * width + static_cast<std::size_t>(tile.x() + x);
        range_m[pixel] =
            plain_sky ? std::numeric_limits<float>::infinity()
                      : shown(tile.rays_x() + x / block.width, tile.rays_y() + y / block.height);
      }
    }
  }
}

void Renderer::read_colour(std::span<std::uint8_t> rgba) {
  const auto row_bytes = static_cast<std::size_t>(sizes_.width_px) * 4;
  RL_ASSERT(rgba.size() == row_bytes * sizes_.height_px);
  glBindFramebuffer(GL_FRAMEBUFFER, colour_target_.name());
  for (int row = 0; row < sizes_.height_px; ++row) {
    glReadPixels(0, sizes_.height_px - 1 - row, sizes_.width_px, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                 rgba.data() + row_bytes * row);
  }
}

RenderCounters Renderer::read_counters() {
  RenderCounters result;
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, counters_.name());
  const void* data = glMapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, counter_bytes, GL_MAP_READ_BIT);
  if (data == nullptr) {
    result.unresolved = 1;  // an unreadable counter is no proof
    return result;
  }
  const auto* counters = static_cast<const std::uint32_t*>(data);
  result = {counters[0], counters[1]};
  glUnmapBuffer(GL_SHADER_STORAGE_BUFFER);
  return result;
}

}  // namespace ridgeline
