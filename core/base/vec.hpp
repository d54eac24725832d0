#pragma once
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace ridgeline {

struct Ecef {};  ///< Earth-centred, Earth-fixed: x to 0°N 0°E, z to the north pole
struct Enu {};   ///< local level frame at the eye: x east, y north, z up along the ellipsoid normal
struct CameraAxes {};  ///< x right, y down, z forward

/// A vector in a named frame; a vector of another frame does not convert to it.
template <typename Frame>
struct Vec3 {
  glm::dvec3 xyz{0.0};
  friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.xyz + b.xyz}; }
  friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.xyz - b.xyz}; }
  friend Vec3 operator*(double k, Vec3 a) { return {k * a.xyz}; }
};

/// A rotation that takes vectors of `From` to vectors of `To`; columns are the axes of From in To.
template <typename To, typename From>
struct Rotation {
  glm::dmat3 columns{1.0};
  friend Vec3<To> operator*(const Rotation& r, Vec3<From> v) { return {r.columns * v.xyz}; }
  [[nodiscard]] Rotation<From, To> inverse() const { return {glm::transpose(columns)}; }
};

/// Adjacent frame names cancel: ecef_from_enu * enu_from_camera is ecef_from_camera.
template <typename A, typename B, typename C>
Rotation<A, C> operator*(const Rotation<A, B>& ab, const Rotation<B, C>& bc) {
  return {ab.columns * bc.columns};
}

}  // namespace ridgeline
