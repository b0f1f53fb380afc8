// What the benchmarks work on: a sphere with a relief, at each step of its way to the finished map.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"
#include "stages/parameterize/levels/removal.h"
#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/parameterize.h"

namespace lozenge::bench {

struct Size {
  const char* name;
  std::int32_t triangles;
  std::int32_t min_domain_faces;
  std::int32_t max_domain_faces;
};

/// The smallest is there to be run by a test, too, and so has few domain triangles, which are found sooner; yet more
/// than kSmallDomain, from where the domain is searched for at length. The others have the default's interval.
inline constexpr std::array<Size, 3> kSizes{
    {{"smallest", 5'000, 60, 60}, {"middle", 25'000, 100, 200}, {"largest", 125'000, 100, 200}}};

/// A sphere of radius 1 with waves of up to a quarter of that, so that its domain's vertices are not all alike.
SourceMesh relief_sphere(std::int32_t triangles);
/// The ring that `make_bench_mesh --torus` makes.
SourceMesh ring(std::int32_t triangles);

/// The steps of `parameterize` on the relief sphere of one size. Each is made when it is first asked for, from the one
/// before, and then kept: the same for all benchmarks, and for those that are filtered out none.
class Subject {
 public:
  explicit Subject(const Size& size) : size_(size) {}
  Subject(const Subject&) = delete;  // maps point into the mesh
  Subject& operator=(const Subject&) = delete;

  const Size& size() const { return size_; }
  ParameterizeOptions options() const;
  /// Triangles that `simplify_in_blocks` is to leave.
  std::int32_t proxy_triangles() const;

  const SourceMesh& mesh();

  /// The map of the simplified mesh, and the way back to the whole one.
  struct Coarse {
    WorkingMap map;
    Hierarchy hierarchy;
  };
  const Coarse& coarse();
  /// The map of the whole mesh, before it is optimized.
  const WorkingMap& refined();
  /// The same, optimized.
  const WorkingMap& optimized();

  /// What `certified` makes of it; the surface has more vertices where triangles had to be split.
  struct Certified {
    SourceMesh surface;
    Parameterization map;
  };
  const Certified& certified();

 private:
  Size size_;
  std::optional<SourceMesh> mesh_;
  std::optional<Coarse> coarse_;
  std::optional<WorkingMap> refined_;
  std::optional<WorkingMap> optimized_;
  std::optional<Certified> certified_;
};

}  // namespace lozenge::bench
