#include "sim/methods/embree.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "sim/methods/setting_reader.hpp"
#include "sim/methods/workers.hpp"

namespace ridgeline::sim {
namespace {

constexpr float sky = 1e30f;
constexpr double deg = std::numbers::pi / 180.0;
constexpr int packet_columns = 4, packet_rows = 2;
constexpr int packet = packet_columns * packet_rows;

struct Settings {
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  bool robust = true, coherent = true;
};

/// One frame as the rays need it: origin and directions in the axes of the vertices.
struct Frame {
  glm::vec3 eye{};
  glm::dvec3 first{}, right{}, down{};  ///< ray of pixel (0, 0), and its change per pixel
  float range_m = 0;
};

/// The position of a post, ECEF minus `origin`.
class PostPlaces {
 public:
  PostPlaces(const PostLattice& lattice, const PostRect& rect, const glm::dvec3& origin)
      : lattice_(lattice), rect_(rect), origin_(origin) {
    if (lattice.polar()) return;
    for (std::int32_t c = rect.west; c <= rect.east; ++c) {
      const double longitude = lattice.longitude_deg(c) * deg;
      meridians_.push_back({std::cos(longitude), std::sin(longitude)});
    }
  }
  /// Row by row: `row` first, then its columns.
  void begin_row(std::int32_t row) {
    row_ = row;
    if (lattice_.polar()) return;
    constexpr double a = 6'378'137.0, f = 1.0 / 298.257223563, e2 = f * (2.0 - f);
    const double latitude = lattice_.latitude_deg(row) * deg;
    sine_ = std::sin(latitude);
    cosine_ = std::cos(latitude);
    normal_m_ = a / std::sqrt(1.0 - e2 * sine_ * sine_);
    axial_m_ = normal_m_ * (1.0 - e2);
  }
  [[nodiscard]] glm::vec3 at(std::int32_t column, double height_m) const {
    if (lattice_.polar()) {
      const GroundPlace place = lattice_.place_of(column, row_);
      return glm::vec3(ecef_from_geodetic({place.latitude_deg, place.longitude_deg, height_m}).xyz -
                       origin_);
    }
    const glm::dvec2 meridian = meridians_[static_cast<std::size_t>(column - rect_.west)];
    const double across = (normal_m_ + height_m) * cosine_;
    return glm::vec3(
        glm::dvec3(across * meridian.x, across * meridian.y, (axial_m_ + height_m) * sine_) -
        origin_);
  }

 private:
  const PostLattice& lattice_;
  PostRect rect_;
  glm::dvec3 origin_;
  std::vector<glm::dvec2> meridians_;
  std::int32_t row_ = 0;
  double sine_ = 0, cosine_ = 0, normal_m_ = 0, axial_m_ = 0;
};

class Embree final : public Method {
 public:
  explicit Embree(const Settings& settings) : settings_(settings), workers_(settings.threads) {}
  ~Embree() override { release(); }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  [[nodiscard]] std::string_view name() const override { return "embree"; }
  [[nodiscard]] std::string params() const override;
  Outcome build(const MethodTerrain& terrain, const RenderSizes& sizes) override;
  void draw(const RangeScene& scene) override;
  /// Embree's traversal tells nothing of its steps.
  [[nodiscard]] RaySteps ray_steps() const override { return RaySteps::not_counted; }
  [[nodiscard]] MethodFacts facts() override;

 private:
  void release();
  Outcome build_scene(const MethodTerrain& terrain);
  void put_vertices(const MethodTerrain& terrain, float* vertices);
  void put_grids(RTCGrid* grids) const;
  void trace_strip(int strip);
  [[nodiscard]] float value_of(const RTCRayHit8& rays, int k) const;
  [[nodiscard]] bool unknown_at(unsigned grid, float u, float v) const;

  Settings settings_;
  Workers workers_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  std::atomic<std::int64_t> library_bytes_{0};
  glm::dvec3 origin_{0.0};
  PostRect rect_;
  int levels_ = 1, width_px_ = 0, height_px_ = 0;
  int block_columns_ = 0, block_rows_ = 0;
  std::vector<bool> unknown_;  ///< of every post; empty: none is
  std::vector<std::uint32_t> words_;
  Frame frame_;
};

bool count_bytes(void* counter, ssize_t bytes, bool) {
  *static_cast<std::atomic<std::int64_t>*>(counter) += bytes;
  return true;
}

std::string Embree::params() const {
  return std::string("grid, ") + (settings_.robust ? "robust, " : "") + "packets of 8, " +
         std::to_string(settings_.threads) + " threads" +
         (levels_ > 1 ? ", finest level only" : "");
}

void Embree::release() {
  if (scene_ != nullptr) rtcReleaseScene(scene_);
  if (device_ != nullptr) rtcReleaseDevice(device_);
  scene_ = nullptr;
  device_ = nullptr;
}

Outcome Embree::build(const MethodTerrain& terrain, const RenderSizes& sizes) {
  release();
  rect_ = terrain.view.drawable[0];
  levels_ = terrain.view.sizes.levels;
  width_px_ = sizes.width_px;
  height_px_ = sizes.height_px;
  words_.resize(static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_));
  const GroundPlace eye =
      terrain.view.lattice.place_of(terrain.view.eye_column, terrain.view.eye_row);
  origin_ = ecef_from_geodetic({eye.latitude_deg, eye.longitude_deg, terrain.highest_m}).xyz;
  char config[48];
  std::snprintf(config, sizeof config, "threads=%d,user_threads=0", settings_.threads);
  device_ = rtcNewDevice(config);
  if (device_ == nullptr) return {Fault::file_unreadable, "embree: no device"};
  rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &library_bytes_);
  return build_scene(terrain);
}

Outcome Embree::build_scene(const MethodTerrain& terrain) {
  scene_ = rtcNewScene(device_);
  if (settings_.robust) rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  if (!rect_.empty()) {
    const auto columns = static_cast<std::size_t>(rect_.east - rect_.west) + 1;
    const auto rows = static_cast<std::size_t>(rect_.north - rect_.south) + 1;
    block_columns_ = (rect_.east - rect_.west + block_posts - 1) / block_posts;
    block_rows_ = (rect_.north - rect_.south + block_posts - 1) / block_posts;
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_GRID);
    void* const vertices = rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), columns * rows);
    void* const grids = rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid),
        static_cast<std::size_t>(block_columns_) * static_cast<std::size_t>(block_rows_));
    if (vertices != nullptr && grids != nullptr) {
      put_vertices(terrain, static_cast<float*>(vertices));
      put_grids(static_cast<RTCGrid*>(grids));
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene_, geometry);
    }
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene_);
  const RTCError error = rtcGetDeviceError(device_);
  if (error == RTC_ERROR_NONE) return {};
  return {Fault::file_unreadable,
          "embree: error " + std::to_string(static_cast<int>(error)) + " while it built the scene"};
}

void Embree::put_vertices(const MethodTerrain& terrain, float* vertices) {
  const int columns = terrain.view.sizes.columns(), rows = terrain.view.sizes.rows();
  const auto width = static_cast<std::size_t>(rect_.east - rect_.west) + 1;
  PostPlaces places(terrain.view.lattice, rect_, origin_);
  unknown_.clear();
  for (std::int32_t row = rect_.south; row <= rect_.north; ++row) {
    places.begin_row(row);
    const float* posts = terrain.posts.data() + static_cast<std::size_t>(wrapped(row, rows)) *
                                                    static_cast<std::size_t>(columns);
    for (std::int32_t column = rect_.west; column <= rect_.east; ++column) {
      float height_m = posts[wrapped(column, columns)];
      if (height_m < void_threshold_m) {
        height_m += void_offset_m;
        if (unknown_.empty()) unknown_.resize(width * (rect_.north - rect_.south + 1));
        unknown_[static_cast<std::size_t>(row - rect_.south) * width +
                 static_cast<std::size_t>(column - rect_.west)] = true;
      }
      const glm::vec3 place = places.at(column, static_cast<double>(height_m));
      *vertices++ = place.x;
      *vertices++ = place.y;
      *vertices++ = place.z;
    }
  }
}

void Embree::put_grids(RTCGrid* grids) const {
  const auto width = static_cast<unsigned>(rect_.east - rect_.west) + 1;
  for (int row = 0; row < block_rows_; ++row) {
    for (int column = 0; column < block_columns_; ++column) {
      const int west = column * block_posts, south = row * block_posts;
      RTCGrid& grid = grids[row * block_columns_ + column];
      grid.startVertexID = static_cast<unsigned>(south) * width + static_cast<unsigned>(west);
      grid.stride = width;
      grid.width =
          static_cast<unsigned short>(std::min(block_posts, rect_.east - rect_.west - west) + 1);
      grid.height =
          static_cast<unsigned short>(std::min(block_posts, rect_.north - rect_.south - south) + 1);
    }
  }
}

bool Embree::unknown_at(unsigned grid, float u, float v) const {
  if (unknown_.empty()) return false;
  const int west = static_cast<int>(grid) % block_columns_ * block_posts;
  const int south = static_cast<int>(grid) / block_columns_ * block_posts;
  const int width = rect_.east - rect_.west, height = rect_.north - rect_.south;
  const int cells_x = std::min(block_posts, width - west);
  const int cells_y = std::min(block_posts, height - south);
  const int x =
      west + std::clamp(static_cast<int>(u * static_cast<float>(cells_x)), 0, cells_x - 1);
  const int y =
      south + std::clamp(static_cast<int>(v * static_cast<float>(cells_y)), 0, cells_y - 1);
  const std::size_t first = static_cast<std::size_t>(y) * (static_cast<std::size_t>(width) + 1) +
                            static_cast<std::size_t>(x);
  const std::size_t above = first + static_cast<std::size_t>(width) + 1;
  return unknown_[first] || unknown_[first + 1] || unknown_[above] || unknown_[above + 1];
}

float Embree::value_of(const RTCRayHit8& rays, int k) const {
  if (rays.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) return sky;
  const float t = rays.ray.tfar[k];
  return unknown_at(rays.hit.primID[k], rays.hit.u[k], rays.hit.v[k]) ? -t : t;
}

void Embree::trace_strip(int strip) {
  alignas(32) int valid[packet];
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = settings_.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                     : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  // Double up to the start of a row, float along it: a direction is rounded to float anyway.
  std::array<glm::vec3, packet_rows> starts;
  for (int r = 0; r < packet_rows; ++r) {
    const double v = strip * packet_rows + r;
    starts[static_cast<std::size_t>(r)] = glm::vec3(frame_.first + v * frame_.down);
  }
  const glm::vec3 right(frame_.right);
  RTCRayHit8 rays{};
  for (int left = 0; left < width_px_; left += packet_columns) {
    for (int k = 0; k < packet; ++k) {
      const int u = left + k % packet_columns, v = strip * packet_rows + k / packet_columns;
      valid[k] = u < width_px_ && v < height_px_ ? -1 : 0;
      const glm::vec3 way =
          starts[static_cast<std::size_t>(k / packet_columns)] + static_cast<float>(u) * right;
      const float scale = 1.0F / std::sqrt(glm::dot(way, way));
      rays.ray.org_x[k] = frame_.eye.x;
      rays.ray.org_y[k] = frame_.eye.y;
      rays.ray.org_z[k] = frame_.eye.z;
      rays.ray.dir_x[k] = way.x * scale;
      rays.ray.dir_y[k] = way.y * scale;
      rays.ray.dir_z[k] = way.z * scale;
      rays.ray.tnear[k] = 0;
      rays.ray.tfar[k] = frame_.range_m;
      rays.ray.mask[k] = ~0U;
      rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect8(valid, scene_, &context, &rays);
    for (int k = 0; k < packet; ++k) {
      if (valid[k] == 0) continue;
      const int u = left + k % packet_columns, v = strip * packet_rows + k / packet_columns;
      words_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_px_) +
             static_cast<std::size_t>(u)] = std::bit_cast<std::uint32_t>(value_of(rays, k));
    }
  }
}

void Embree::draw(const RangeScene& scene) {
  const LocalFrame& local = scene.report.local;
  const Camera& camera = scene.report.camera;
  const glm::dmat3 axes = (local.ecef_from_enu * camera.enu_from_camera).columns;
  frame_.eye = glm::vec3(local.eye_ecef.xyz - origin_);
  frame_.right = axes[0] / camera.fx;
  frame_.down = axes[1] / camera.fy;
  frame_.first = (local.ecef_from_enu * camera.ray(0.5, 0.5)).xyz;
  frame_.range_m = static_cast<float>(scene.report.range_m);
  const auto strip = [](void* self, int k) { static_cast<Embree*>(self)->trace_strip(k); };
  workers_.run(strip, this, (height_px_ + packet_rows - 1) / packet_rows);
  glActiveTexture(GL_TEXTURE0 + shader::range_unit);
  glBindTexture(GL_TEXTURE_2D, scene.renderer.names().range);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_px_, height_px_, GL_RED_INTEGER, GL_UNSIGNED_INT,
                  words_.data());
}

MethodFacts Embree::facts() {
  MethodFacts facts;
  facts.ray_cast_share = 1.0;
  facts.heap_bytes = static_cast<std::size_t>(std::max<std::int64_t>(library_bytes_, 0)) +
                     unknown_.capacity() / 8 + words_.capacity() * sizeof words_[0];
  return facts;
}

}  // namespace

std::unique_ptr<Method> make_embree(const MethodSpec& spec, std::string& problem) {
  Settings settings;
  SettingReader reader(spec);
  reader.whole("threads", settings.threads, 1, 256);
  reader.flag("robust", settings.robust);
  reader.flag("coherent", settings.coherent);
  problem = reader.problem();
  if (!problem.empty()) return nullptr;
  return std::make_unique<Embree>(settings);
}

}  // namespace ridgeline::sim
