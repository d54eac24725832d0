#include "core/render/renderer.hpp"

#include <array>
#include <utility>

#include "core/render/text_bands.hpp"
#include "shaders/count_comp.hpp"
#include "shaders/present_frag.hpp"
#include "shaders/present_vert.hpp"
#include "shaders/ray_cast_frag.hpp"
#include "shaders/ray_cast_vert.hpp"
#include "shaders/shade_frag.hpp"
#include "shaders/shade_vert.hpp"
#include "shaders/sky_frag.hpp"
#include "shaders/sky_vert.hpp"
#include "shaders/sweep_comp.hpp"
#include "shaders/words_frag.hpp"
#include "shaders/words_vert.hpp"

namespace ridgeline {
namespace {

/// What the passes are compiled for: with the number of levels a constant, loops over them unroll.
constexpr std::array<std::string_view, max_levels + 1> level_defines{"",
                                                                     "#define level_count 1\n",
                                                                     "#define level_count 2\n",
                                                                     "#define level_count 3\n",
                                                                     "#define level_count 4\n",
                                                                     "#define level_count 5\n",
                                                                     "#define level_count 6\n"};
static_assert(max_levels == 6);
constexpr std::array<std::string_view, shading_count> shade_defines{
    "#define shading 0\n", "#define shading 1\n", "#define shading 2\n", "#define shading 3\n"};

/// Two sets of lines, one after the other.
struct JoinedDefines {
  std::array<char, 64> text{};
  std::size_t size = 0;

  JoinedDefines(std::string_view first, std::string_view second) {
    RL_ASSERT(first.size() + second.size() <= text.size());
    size = first.copy(text.data(), first.size());
    size += second.copy(text.data() + size, second.size());
  }
  [[nodiscard]] std::string_view view() const { return {text.data(), size}; }
};

GLuint groups(int count, int size) {
  return static_cast<GLuint>((count + size - 1) / size);
}

void bind_texture(int unit, const Texture& texture) {
  glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
  glBindTexture(GL_TEXTURE_2D, texture.name());
}

void write_buffer(GLenum target, const Buffer& buffer, const void* data, std::size_t bytes) {
  glBindBuffer(target, buffer.name());
  glBufferSubData(target, 0, static_cast<GLsizeiptr>(bytes), data);
}

GLint limit(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

/// Puts posts into the array texture that is bound.
void put_posts(const float* posts, int x, int y, int level, int width, int height) {
  glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, x, y, level, width, height, 1, GL_RED, GL_FLOAT, posts);
}

/// Takes the value out of a result or hands its fault to the caller.
template <typename T>
Status take(Result<T> result, T& target) {
  if (!result) return result.fault();
  target = std::move(result).value();
  return {};
}

Result<Framebuffer> make_target(const Texture& texture) {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  Framebuffer target(name);
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) return Fault::gl_error;
  return target;
}

}  // namespace

Result<Renderer> Renderer::make(const RenderSizes& sizes, const TimerFunctions& timer,
                                ShaderLog log) {
  const int largest = limit(GL_MAX_TEXTURE_SIZE);
  float point_px[2] = {};
  glGetFloatv(GL_ALIASED_POINT_SIZE_RANGE, point_px);
  if (sizes.window.columns() > largest || sizes.window.rows() > largest || sizes.planes > largest ||
      sizes.rows > largest || point_px[1] < static_cast<float>(largest_square_px) ||
      sizes.window.levels > limit(GL_MAX_ARRAY_TEXTURE_LAYERS) ||
      limit(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS) < 3 || limit(GL_MAX_COMPUTE_IMAGE_UNIFORMS) < 1) {
    return Fault::gl_limit_too_small;
  }
  Renderer renderer;
  renderer.sizes_ = sizes;
  if (const Status made = renderer.make_programs(log); !made) return made.fault();
  if (const Status made = renderer.make_storage(); !made) return made.fault();
  renderer.timer_.make(timer);
  return renderer;
}

std::string_view Renderer::march_defines() const {
  return level_defines[static_cast<std::size_t>(sizes_.window.levels)];
}

void Renderer::exchange_marches(Program& sweep, Program& ray_cast) {
  std::swap(sweep_, sweep);
  std::swap(ray_cast_, ray_cast);
}

Status Renderer::make_programs(ShaderLog log) {
  const std::string_view defines = march_defines();
  struct Entry {
    Program* program;
    std::string_view name, source;
  };
  for (const Entry& entry :
       {Entry{&sweep_, "sweep", shader::sweep_comp}, Entry{&count_, "count", shader::count_comp}}) {
    const Status made =
        take(make_compute_program(entry.name, entry.source, log, defines), *entry.program);
    if (!made) return made;
  }
  struct Drawn {
    Program* program;
    std::string_view name, vertex, fragment;
  };
  for (const Drawn& entry :
       {Drawn{&ray_cast_, "ray_cast", shader::ray_cast_vert, shader::ray_cast_frag},
        Drawn{&present_, "present", shader::present_vert, shader::present_frag},
        Drawn{&sky_, "sky", shader::sky_vert, shader::sky_frag},
        Drawn{&words_, "words", shader::words_vert, shader::words_frag}}) {
    const Status made = take(
        make_draw_program(entry.name, entry.vertex, entry.fragment, log, defines), *entry.program);
    if (!made) return made;
  }
  for (std::size_t k = 0; k < shading_count; ++k) {
    const JoinedDefines both(defines, shade_defines[k]);
    const Status made =
        take(make_draw_program("shade", shader::shade_vert, shader::shade_frag, log, both.view()),
             shade_[k]);
    if (!made) return made;
  }
  return {};
}

Status Renderer::make_storage() {
  const int w = sizes_.window.columns(), h = sizes_.window.rows(), levels = sizes_.window.levels;
  Status s = take(make_texture_array(GL_R32F, w + 1, h + 1, levels, 4), posts_);
  const glm::ivec2 nodes = nodes_texels(w, h);
  if (s) s = take(make_texture_array(GL_R32F, nodes.x, nodes.y, levels, 4), highest_);
  if (s) s = take(make_texture(GL_R32F, sizes_.planes, sizes_.rows, 1, 4), nodes_);
  if (s) s = take(make_texture(GL_R32F, sizes_.rows, 1, 1, 4), slopes_);
  if (s) s = take(make_texture(GL_R32UI, rays_width(), rays_height(), 1, 4), range_);
  if (s) s = take(make_texture(GL_RGBA8, rays_width(), rays_height(), 1, 4), shaded_);
  if (s) s = take(make_texture(GL_RGBA8, sizes_.width_px, sizes_.height_px, 1, 4), colour_);
  if (s) s = take(make_texture(GL_R8, sizes_.width_px, sizes_.height_px, 1, 1), text_);
  constexpr GLenum ubo = GL_UNIFORM_BUFFER, ssbo = GL_SHADER_STORAGE_BUFFER;
  if (s) s = take(make_buffer(ubo, sizeof(shader::FrameBlock), GL_DYNAMIC_DRAW), frame_block_);
  if (s) s = take(make_buffer(ubo, sizeof(shader::GridBlock), GL_DYNAMIC_DRAW), grid_block_);
  if (s) s = take(make_buffer(ubo, sizeof(shader::StyleBlock), GL_DYNAMIC_DRAW), style_block_);
  if (s) s = take(make_buffer(ssbo, sizes_.planes * sizeof(PlaneRecord), GL_DYNAMIC_DRAW), planes_);
  if (s) s = take(make_buffer(ssbo, counter_bytes, GL_DYNAMIC_READ), counters_);
  if (s) s = take(make_target(range_), range_target_);
  if (s) s = take(make_target(shaded_), shaded_target_);
  if (s) s = take(make_target(colour_), colour_target_);
  return s ? make_tiles() : s;
}

Status Renderer::make_tiles() {
  blended_ = make_sampler(GL_LINEAR);
  blocky_ = make_sampler(GL_NEAREST);
  const int columns = most_tiles(sizes_.width_px), rows = most_tiles(sizes_.height_px);
  const int most = columns * rows, squares = most_squares(columns, rows);
  constexpr int bands = static_cast<int>(most_text_bands);
  Status s = take(TileList::make(most, squares), tiles_);
  if (s) s = take(TileList::make(most, squares), single_tiles_);
  if (s)
    s = take(TileList::make(bands, bands * (columns + ray_tile_px) + sizes_.width_px), word_tiles_);
  if (!s) return s;
  const TileAxis across{sizes_.width_px, 0};
  std::array<RayTile, most_tiles(limits::max_image_px)> row{};
  for (int y = 0; y < sizes_.height_px; y += ray_tile_px) {
    const int height = std::min(ray_tile_px, sizes_.height_px - y);
    const int count = put_tiles(across, {height, 0}, row);
    for (RayTile& tile : row) {
      tile.origin = RayTile::pair(tile.x(), y);
      tile.rays = tile.origin;
    }
    single_tiles_.write(single_count_, std::span(row).first(static_cast<std::size_t>(count)));
    single_count_ += count;
  }
  return {};
}

Renderer::TileRange Renderer::all_tiles() const {
  const auto shown = static_cast<int>(tiles_shown_.tiles.size());
  return {0, shown == 0 ? single_count_ : shown};
}

Renderer::TileRange Renderer::ground_tiles() const {
  return {0, tiles_shown_.tiles.empty() ? single_count_ : tiles_shown_.ground};
}

void Renderer::write_frame_block(const FrameBlocks& blocks) {
  shader::FrameBlock frame = blocks.frame;
  frame.window.w = all_tiles().count;
  frame.ray_target = {
      1.0F / static_cast<float>(rays_width()), 1.0F / static_cast<float>(rays_height()),
      1.0F / static_cast<float>(sizes_.planes), 1.0F / static_cast<float>(sizes_.rows)};
  write_buffer(GL_UNIFORM_BUFFER, frame_block_, &frame, sizeof frame);
  glBindBufferBase(GL_UNIFORM_BUFFER, shader::frame_block_binding, frame_block_.name());
}

void Renderer::upload_block(const TerrainBlock& block, const BlockSlot& slot) {
  const int level = block.id.level;
  glActiveTexture(GL_TEXTURE0 + shader::posts_unit);
  glBindTexture(GL_TEXTURE_2D_ARRAY, posts_.name());
  put_posts(block.posts.data(), slot.column * block_posts, slot.row * block_posts, level,
            block_posts, block_posts);
  // The first column and row stand behind the last as well: cells there have posts on both sides.
  const int columns = sizes_.window.columns(), rows = sizes_.window.rows();
  glPixelStorei(GL_UNPACK_ROW_LENGTH, block_posts);
  if (slot.column == 0) {
    put_posts(block.posts.data(), columns, slot.row * block_posts, level, 1, block_posts);
  }
  if (slot.row == 0) {
    put_posts(block.posts.data(), slot.column * block_posts, rows, level, block_posts, 1);
  }
  if (slot.column == 0 && slot.row == 0) {
    put_posts(block.posts.data(), columns, rows, level, 1, 1);
  }
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glActiveTexture(GL_TEXTURE0 + shader::highest_unit);
  glBindTexture(GL_TEXTURE_2D_ARRAY, highest_.name());
  const float* nodes = block.highest.data();
  for (int k = 1; k <= block_levels; ++k) {
    const glm::ivec2 corner = pyramid_corner(k);
    const int side = block_posts >> k;
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, corner.x + slot.column * side,
                    corner.y + slot.row * side, level, side, side, 1, GL_RED, GL_FLOAT, nodes);
    nodes += static_cast<std::ptrdiff_t>(side) * side;
  }
}

glm::ivec2 Renderer::pyramid_corner(int level) const {
  const int w = sizes_.window.columns(), h = sizes_.window.rows();
  return level < 2 ? glm::ivec2(0) : glm::ivec2(w / 2, h / 2 - (h >> (level - 1)));
}

void Renderer::bind_window() const {
  glActiveTexture(GL_TEXTURE0 + shader::posts_unit);
  glBindTexture(GL_TEXTURE_2D_ARRAY, posts_.name());
  glActiveTexture(GL_TEXTURE0 + shader::highest_unit);
  glBindTexture(GL_TEXTURE_2D_ARRAY, highest_.name());
}

void Renderer::begin_range(const FrameBlocks& blocks) {
  use_single_rays();
  begin_rays(blocks);
}

void Renderer::begin_rays(const FrameBlocks& blocks) {
  constexpr GLenum ubo = GL_UNIFORM_BUFFER, ssbo = GL_SHADER_STORAGE_BUFFER;
  const std::uint32_t zeros[8] = {};
  write_frame_block(blocks);
  write_buffer(ubo, grid_block_, &blocks.grid, sizeof blocks.grid);
  write_buffer(ssbo, counters_, zeros, sizeof zeros);
  glBindBufferBase(ubo, shader::grid_block_binding, grid_block_.name());
  glBindBufferBase(ssbo, shader::counters_buffer, counters_.name());
  bind_window();
  timer_.stamp(static_cast<int>(Pass::grid));
}

void Renderer::end_range() {
  bind_texture(shader::range_unit, range_);
  tile_list().bind();
  glUseProgram(count_.name());
  glDispatchCompute(groups(all_tiles().count, 8), 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
}

void Renderer::draw_terrain(const FrameBlocks& blocks, std::span<const PlaneRecord> planes,
                            std::span<const float> slopes, const RayTiles& tiles) {
  begin_terrain(blocks, planes, slopes, tiles);
  draw_tiles(range_target_, ray_cast_, all_tiles());
  end_range();
}

void Renderer::begin_terrain(const FrameBlocks& blocks, std::span<const PlaneRecord> planes,
                             std::span<const float> slopes, const RayTiles& tiles) {
  constexpr GLenum ssbo = GL_SHADER_STORAGE_BUFFER;
  tiles_shown_ = tiles;
  tiles_.write(0, tiles.tiles);
  write_buffer(ssbo, planes_, planes.data(), planes.size_bytes());
  glBindBufferBase(ssbo, shader::planes_buffer, planes_.name());
  bind_texture(shader::slopes_unit, slopes_);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, static_cast<GLsizei>(slopes.size()), 1, GL_RED, GL_FLOAT,
                  slopes.data());
  begin_rays(blocks);
  bind_texture(shader::nodes_unit, nodes_);
  if (!planes.empty()) {
    glUseProgram(sweep_.name());
    glBindImageTexture(shader::target_image, nodes_.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
    glDispatchCompute(groups(static_cast<int>(planes.size()), 32), 1, 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  }
  timer_.stamp(static_cast<int>(Pass::ray_cast));
}

void Renderer::cast_tiles(int first, int count) const {
  RL_ASSERT(first >= 0 && count >= 0 && first + count <= all_tiles().count);
  draw_tiles(range_target_, ray_cast_, {first, count});
}

void Renderer::replace_tiles(const FrameBlocks& blocks, const RayTiles& tiles) {
  tiles_shown_ = tiles;
  tiles_.write(0, tiles.tiles);
  write_frame_block(blocks);
}

void Renderer::draw_tiles(const Framebuffer& target, const Program& program, const TileRange& tiles,
                          float kept) const {
  const bool whole = &target == &colour_target_;
  glBindFramebuffer(GL_FRAMEBUFFER, target.name());
  glViewport(0, 0, whole ? sizes_.width_px : rays_width(),
             whole ? sizes_.height_px : rays_height());
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_DITHER);
  if (kept < 1.0F) blend_dimmed(kept, GL_ZERO);
  glUseProgram(program.name());
  const TileFace face = whole ? TileFace::pixels : TileFace::rays;
  const TileRange squares = squares_of(tiles, face);
  tile_list().draw(face, squares.first, squares.count);
  glDisable(GL_BLEND);
}

Renderer::TileRange Renderer::squares_of(const TileRange& tiles, TileFace face) const {
  const std::span<const RayTile> shown = tiles_shown_.tiles;
  if (shown.empty()) return {0, single_tiles_.squares(face)};
  TileRange squares;
  for (int k = 0; k < tiles.first + tiles.count; ++k) {
    const int count = square_count(shown[static_cast<std::size_t>(k)], face);
    (k < tiles.first ? squares.first : squares.count) += count;
  }
  return squares;
}

void Renderer::upload_text(std::span<const std::uint8_t> layer) {
  RL_ASSERT(layer.size() == static_cast<std::size_t>(sizes_.width_px) * sizes_.height_px);
  bind_texture(shader::text_unit, text_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, sizes_.width_px);
  const auto bands = text_bands(layer, sizes_.width_px, sizes_.height_px);
  for (const RayTile& band : bands.view()) {  // nothing else of the layer is drawn
    const auto first = static_cast<std::size_t>(band.y()) * sizes_.width_px + band.x();
    glTexSubImage2D(GL_TEXTURE_2D, 0, band.x(), band.y(), band.width(), band.height(), GL_RED,
                    GL_UNSIGNED_BYTE, layer.data() + first);
  }
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  word_count_ = static_cast<int>(bands.size());
  word_tiles_.write(0, bands.view());
}

void Renderer::draw_words(float kept) const {
  if (word_count_ == 0) return;
  blend_dimmed(kept, GL_ONE_MINUS_SRC_ALPHA);
  glUseProgram(words_.name());
  word_tiles_.draw(TileFace::pixels, 0, word_tiles_.squares(TileFace::pixels));
  glDisable(GL_BLEND);
}

void Renderer::shade(const FrameBlocks& blocks, const shader::StyleBlock& style, Shading shading,
                     const Dimming& dimming) {
  constexpr GLenum ubo = GL_UNIFORM_BUFFER;
  write_frame_block(blocks);
  write_buffer(ubo, style_block_, &style, sizeof style);
  glBindBufferBase(ubo, shader::style_block_binding, style_block_.name());
  bind_window();
  bind_texture(shader::range_unit, range_);
  bind_texture(shader::text_unit, text_);
  timer_.stamp(static_cast<int>(Pass::shade));
  const int ground = ground_tiles().count, sky_tiles = all_tiles().count - ground;
  draw_tiles(shaded_target_, shade_[static_cast<std::size_t>(shading)], ground_tiles());
  bind_texture(shader::shaded_unit, shaded_);
  // Colours between rays are blended, but for the picture that has to be had fast.
  const Sampler& taken = shading == Shading::facets ? blocky_ : blended_;
  glBindSampler(shader::shaded_unit, taken.name());
  draw_tiles(colour_target_, present_, ground_tiles(), dimming.picture);
  glBindSampler(shader::shaded_unit, 0);
  if (sky_tiles > 0) draw_tiles(colour_target_, sky_, {ground, sky_tiles}, dimming.picture);
  draw_words(dimming.words);
  timer_.stamp(pass_count);
  glFlush();
}

}  // namespace ridgeline
