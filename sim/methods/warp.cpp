#include "sim/methods/warp.hpp"

#include <algorithm>
#include <cstdio>

#include "shaders/warp_frag.hpp"
#include "shaders/warp_shade_frag.hpp"
#include "shaders/warp_vert.hpp"
#include "sim/methods/setting_reader.hpp"
#include "sim/methods/warp_grid.hpp"

namespace ridgeline::sim {
namespace {

constexpr int positions_unit = 6, slopes_unit = 8;  // as in the shaders

/// Triangles in bands of a few columns, so that each vertex is made once or little more.
std::vector<std::uint32_t> grid_indices(int side) {
  constexpr int band = 15;  // cells: their vertices are fewer than a row's way in the cache
  std::vector<std::uint32_t> indices;
  const auto cells = static_cast<std::size_t>(side - 1);
  indices.reserve(6 * cells * cells);
  for (int first = 0; first + 1 < side; first += band) {
    for (int row = 0; row + 1 < side; ++row) {
      for (int column = first; column < std::min(first + band, side - 1); ++column) {
        const int sw = row * warp_stride(side) + column, se = sw + 1;
        const int nw = sw + warp_stride(side), ne = nw + 1;
        for (const int index : {sw, se, ne, sw, ne, nw}) {
          indices.push_back(static_cast<std::uint32_t>(index));
        }
      }
    }
  }
  return indices;
}

class Warp final : public Method {
 public:
  explicit Warp(const WarpSettings& settings) : grid_(settings) {}
  [[nodiscard]] std::string_view name() const override { return "warp"; }
  [[nodiscard]] std::string params() const override;
  Outcome build(const MethodTerrain& terrain, const RenderSizes& sizes) override;
  void draw(const RangeScene& scene) override;
  void finish_picture(const Renderer& renderer) override;
  [[nodiscard]] MethodFacts facts() override;

 private:
  Outcome make_mesh();
  Outcome make_picture(const RenderSizes& sizes);
  void draw_mesh() const;

  WarpGrid grid_;
  RasterTarget target_;
  Program program_;
  Buffer indices_;
  VertexArray vertices_;
  // Of pictures with detail.
  Program shade_;
  Texture picture_depth_;
  Framebuffer picture_;
  RenderSizes sizes_;
  bool any_unknown_ = false;
  GLsizei index_count_ = 0;
};

std::string Warp::params() const {
  const WarpSettings& s = grid_.settings();
  char text[192];
  std::snprintf(text, sizeof text, "%d x %d vertices, map %d x %d, edge %.2g px, %.2g a post%s%s",
                s.grid, s.grid, s.map, s.map, s.edge, s.posts, s.turn ? "" : ", north up",
                s.detail ? ", procedural detail: not the data" : "");
  return text;
}

Outcome Warp::build(const MethodTerrain& terrain, const RenderSizes& sizes) {
  if (Outcome made = target_.make(sizes); !made.ok()) return made;
  if (Outcome made = grid_.make(terrain); !made.ok()) return made;
  if (program_.name() != 0) return {};
  Outcome made = make_mesh();
  if (made.ok() && grid_.settings().detail) made = make_picture(sizes);
  return made;
}

Outcome Warp::make_picture(const RenderSizes& sizes) {
  sizes_ = sizes;
  auto depth = make_texture(GL_DEPTH_COMPONENT32F, sizes.width_px, sizes.height_px, 1, 4);
  if (!depth) return failed(depth.fault(), "method warp");
  picture_depth_ = std::move(depth).value();
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  picture_ = Framebuffer(name);
  return make_method_program("warp_shade", shader::warp_vert, shader::warp_shade_frag, shade_);
}

Outcome Warp::make_mesh() {
  Outcome made = make_method_program("warp", shader::warp_vert, shader::warp_frag, program_);
  if (!made.ok()) return made;
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  vertices_ = VertexArray(name);
  glBindVertexArray(name);
  const std::vector<std::uint32_t> indices = grid_indices(grid_.settings().grid);
  const std::size_t bytes = indices.size() * sizeof indices[0];
  made = make_method_buffer("warp", GL_ELEMENT_ARRAY_BUFFER, bytes, GL_STATIC_DRAW, indices_);
  if (!made.ok()) return made;
  glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(bytes), indices.data());
  glBindVertexArray(0);
  index_count_ = static_cast<GLsizei>(indices.size());
  return {};
}

void Warp::draw_mesh() const {
  glActiveTexture(GL_TEXTURE0 + positions_unit);
  glBindTexture(GL_TEXTURE_2D, grid_.positions());
  glBindVertexArray(vertices_.name());
  glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

void Warp::draw(const RangeScene& scene) {
  any_unknown_ = scene.report.window.void_posts > 0;
  grid_.warp(scene);
  target_.begin(scene.renderer);
  glUseProgram(program_.name());
  grid_.set_uniforms(any_unknown_, true);
  draw_mesh();
  target_.end();
}

/// First the depth of what is in front, then its light over the picture.
void Warp::finish_picture(const Renderer& renderer) {
  if (!grid_.settings().detail) return;
  glBindFramebuffer(GL_FRAMEBUFFER, picture_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                         renderer.names().colour, 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, picture_depth_.name(),
                         0);
  glViewport(0, 0, sizes_.width_px, sizes_.height_px);
  glUseProgram(shade_.name());
  grid_.set_uniforms(any_unknown_, false);
  glActiveTexture(GL_TEXTURE0 + slopes_unit);
  glBindTexture(GL_TEXTURE_2D, grid_.slopes());
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  const GLfloat far = 1.0f;
  glClearBufferfv(GL_DEPTH, 0, &far);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw_mesh();
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthFunc(GL_EQUAL);
  glEnable(GL_BLEND);
  glBlendFunc(GL_DST_COLOR, GL_SRC_COLOR);  // both factors: 2 * source * picture
  draw_mesh();
  glDisable(GL_BLEND);
  glDepthFunc(GL_LESS);
  glDisable(GL_DEPTH_TEST);
}

MethodFacts Warp::facts() {
  MethodFacts facts;
  facts.gpu_bytes = grid_.gpu_bytes() + target_.gpu_bytes() +
                    sizeof(std::uint32_t) * static_cast<std::size_t>(index_count_);
  if (picture_.name() != 0) facts.gpu_bytes += target_.gpu_bytes();
  return facts;
}

}  // namespace

std::unique_ptr<Method> make_warp(const MethodSpec& spec, std::string& problem) {
  WarpSettings settings;
  int detail = 0, turn = 1;
  SettingReader reader(spec);
  reader.whole("grid", settings.grid, 8, 2048);
  reader.whole("map", settings.map, 8, 1024);
  reader.number("edge", settings.edge, 0.1, 64.0);
  reader.number("posts", settings.posts, 0.25, 16.0);
  reader.whole("turn", turn, 0, 1);
  reader.whole("detail", detail, 0, 1);
  problem = reader.problem();
  if (!problem.empty()) return nullptr;
  settings.turn = turn == 1;
  settings.detail = detail == 1;
  return std::make_unique<Warp>(settings);
}

}  // namespace ridgeline::sim
