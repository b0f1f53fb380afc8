#include "formats/surface/repeats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/base/error.h"

namespace lozenge {

namespace {

/// How far from a right angle a rounded rotation's axes may be, as a cosine; the glTF validator allows more.
constexpr double kMostShear = 1e-5;

Vec3d axis(const Placement& m, int i) { return {m[4 * i], m[4 * i + 1], m[4 * i + 2]}; }

double volume(const Placement& m) { return axis(m, 0).cross(axis(m, 1)).dot(axis(m, 2)); }

}  // namespace

Vec3f placed(const Placement& m, const Vec3f& p) {
  return Vec3f(axis(m, 0) * p.x + axis(m, 1) * p.y + axis(m, 2) * p.z + axis(m, 3));
}

bool is_mirroring(const Placement& placement) { return volume(placement) < 0; }

bool is_node_transform(const Placement& m) {
  if (!std::all_of(m.begin(), m.end(), [](double x) { return std::isfinite(x); })) return false;
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) return false;
  for (int i = 0; i < 3; ++i) {
    const Vec3d a = axis(m, i);
    const Vec3d b = axis(m, (i + 1) % 3);
    // (Also false where one of them is no number or has no length.)
    if (!(std::abs(a.dot(b)) < kMostShear * a.length() * b.length())) return false;
  }
  return true;
}

void require_sensible_copies(std::size_t triangles_of_mesh, std::size_t copies) {
  constexpr std::size_t kMost = 200'000'000;
  if (triangles_of_mesh == 0 || copies <= kMost / triangles_of_mesh) return;
  throw Error(ExitCode::kLimit, fmt::format("{} copies of {} triangles are too many to look at as one surface", copies,
                                            triangles_of_mesh));
}

std::optional<std::string> find_defect(const Repeats& repeats, std::size_t count) {
  if (repeats.owner.size() != (repeats.empty() ? 0 : count)) {
    return fmt::format("{} of {} know to which repeated mesh they belong", repeats.owner.size(), count);
  }
  const auto meshes = static_cast<std::int32_t>(repeats.meshes.size());
  for (std::size_t i = 0; i < repeats.owner.size(); ++i) {
    if (repeats.owner[i] < -1 || repeats.owner[i] >= meshes) {
      return fmt::format("number {} belongs to repeated mesh {} of {}", i, repeats.owner[i], meshes);
    }
  }
  for (std::size_t m = 0; m < repeats.meshes.size(); ++m) {
    const std::vector<Placement>& copies = repeats.meshes[m].copies;
    if (copies.empty()) return fmt::format("repeated mesh {} has no copies", m);
    const auto wrong = std::find_if_not(copies.begin(), copies.end(), is_node_transform);
    if (wrong != copies.end()) {
      return fmt::format("copy {} of repeated mesh {} is placed by what is no translation, rotation and scale",
                         wrong - copies.begin(), m);
    }
  }
  return std::nullopt;
}

}  // namespace lozenge
