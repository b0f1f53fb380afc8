// Edges wait in a queue by what their collapse costs: the area-weighted squared distance of the merged vertex, at its
// best place, to all planes of the source that either vertex stands for. Whether a collapse is allowed is asked when
// its turn comes; what was refused is tried again now and then, if anything happened since.
#include "stages/export/simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <queue>
#include <utility>

#include "formats/base/disjoint_sets.h"
#include "formats/surface/turned_triangles.h"
#include "stages/export/chart_lines.h"
#include "stages/export/collapsible_mesh.h"
#include "stages/export/quadric_metric.h"

namespace lozenge {
namespace {

/// How much more pieces of which nothing can go but corners cost: a box that isn't one any more is another thing.
constexpr double kWholeWeight = 16;

/// What was refused is tried again when so many collapses have happened as one in this many of the triangles left.
constexpr std::int64_t kRetry = 20;

/// The cosine of the angle by which a collapse may turn a triangle.
constexpr double kMostTurned = 0.6;

struct Candidate {
  double cost = 0;
  VertexId a = -1;
  VertexId b = -1;
  std::uint32_t version = 0;  ///< of both, added up: what has changed since is no longer meant

  /// Of a queue whose first is the cheapest.
  bool operator<(const Candidate& other) const {
    if (cost != other.cost) return cost > other.cost;
    return a != other.a ? a > other.a : b > other.b;
  }
};

/// How an edge would go.
struct Collapse {
  EdgeCollapse edge;
  MergedVertex merged;
  double cost = 0;
  bool keeps_squares = true;  ///< each patch goes on showing all that it has shown
};

}  // namespace

class Simplifier::Work {
 public:
  Work(ChartedSurface surface, const std::vector<ChartScale>& charts, double least_height,
       const SimplifierOptions& options)
      : mesh_(std::move(surface)),
        lines_(mesh_, options.lines),
        metric_(mesh_, options.importance, options.outline),
        charts_(charts),
        least_height_(least_height),
        version_(mesh_.vertex_count(), 0),
        slipped_(charts.size(), false) {
    find_whole_pieces();
    fill_queue();
  }

  void reduce_to(std::int64_t triangles) {
    while (mesh_.triangle_count() > triangles) {
      if (kRetry * (collapses_ - collapses_when_refused_) > mesh_.triangle_count()) try_refused_again();
      if (queue_.empty() && !try_refused_again()) return;
      const Candidate next = queue_.top();
      queue_.pop();
      if (next.version != version_[next.a] + version_[next.b]) continue;
      const auto collapse = plan(next.a, next.b);
      if (!collapse) continue;
      if (!is_allowed(*collapse)) {
        refused_.push_back(next);
        continue;
      }
      carry_out(*collapse);
    }
  }

  /// Those of the source, too.
  void mend_turned() {
    constexpr int kMostRounds = 8;
    for (int round = 0; round < kMostRounds; ++round) {
      bool is_mended = round == 0;
      for (const std::int32_t t : turned()) is_mended = (mesh_.is_left(t) && collapse_a_side(t, round)) || is_mended;
      if (!is_mended) return;
    }
  }

  const CollapsibleMesh& mesh() const { return mesh_; }
  const std::vector<bool>& slipped_patches() const { return slipped_; }

 private:
  // ---- The queue

  void fill_queue() {
    mesh_.for_each_edge([&](VertexId a, VertexId b, const EdgeTriangles&) { enqueue(a, b); });
  }

  void enqueue(VertexId a, VertexId b) {
    if (a > b) std::swap(a, b);
    if (const auto collapse = plan(a, b)) queue_.push({collapse->cost, a, b, version_[a] + version_[b]});
  }

  /// \return false where nothing has happened since they were refused
  bool try_refused_again() {
    if (refused_.empty() || collapses_ == collapses_when_refused_) return false;
    collapses_when_refused_ = collapses_;
    for (const Candidate& c : std::exchange(refused_, {})) {
      if (c.version == version_[c.a] + version_[c.b]) queue_.push(c);
    }
    return !queue_.empty();
  }

  // ---- One collapse

  /// Pieces of which nothing can go but corners, as boxes that are as simple as boxes get, stay what they are.
  void find_whole_pieces() {
    DisjointSets<VertexId> pieces(mesh_.vertex_count());
    for (const ChartedTriangle& t : mesh_.triangles()) {
      for (int k = 1; k < 3; ++k) pieces.join(t.corners[0].vertex, t.corners[k].vertex);
    }
    std::vector<std::uint8_t> is_whole(mesh_.vertex_count(), 1);
    is_whole_ = is_whole;
    are_all_whole_ = true;
    mesh_.for_each_edge([&](VertexId a, VertexId b, const EdgeTriangles&) {
      std::uint8_t& whole = is_whole[pieces.root(a)];
      if (whole == 0) return;
      const auto collapse = plan(a, b);
      if (collapse && is_allowed(*collapse)) whole = 0;
    });
    for (std::size_t v = 0; v < is_whole.size(); ++v) is_whole_[v] = is_whole[pieces.root(static_cast<VertexId>(v))];
    are_all_whole_ = std::all_of(is_whole_.begin(), is_whole_.end(), [](std::uint8_t whole) { return whole != 0; });
  }

  /// Nothing where the two ends are of different lines.
  std::optional<Collapse> plan(VertexId a, VertexId b) const {
    Collapse made;
    EdgeCollapse& edge = made.edge;
    edge.at = mesh_.triangles_at(a, b);
    if (edge.at.count < 1 || edge.at.count > 2) return std::nullopt;
    if (!lines_.may_go(a, b, edge.at, !are_all_whole_)) return std::nullopt;
    const bool stays_a = lines_.stays(a, b);
    edge.from = stays_a ? b : a;
    edge.to = stays_a ? a : b;
    made.keeps_squares = lines_.keeps_squares(a, b, edge.at);
    const bool may_slide = made.keeps_squares && lines_.is_same_kind(a, b);
    made.merged = metric_.merged(edge.from, edge.to, may_slide, lines_.stays_put(edge.to));
    made.cost = made.merged.cost;
    if (!made.keeps_squares) made.cost += metric_.slip(edge.from, edge.to);
    if (is_whole_[a] != 0) made.cost *= kWholeWeight;
    return made;
  }

  /// \param most_turned  cosine
  bool is_allowed(const Collapse& collapse, double most_turned = kMostTurned) const {
    if (!mesh_.keeps_topology(collapse.edge)) return false;
    bool good = true;
    for (const VertexId v : {collapse.edge.from, collapse.edge.to}) {
      mesh_.for_each_corner(v, [&](std::int32_t c) {
        if (good && !collapse.edge.at.has(c / 3)) good = stays_upright(c, collapse, most_turned);
      });
    }
    return good;
  }

  /// Triangles that face against all of their neighbours, by their numbers.
  std::vector<std::int32_t> turned() const {
    std::vector<std::int32_t> numbers;
    std::vector<std::array<VertexId, 3>> triangles;
    for (std::size_t t = 0; t < mesh_.triangles().size(); ++t) {
      if (!mesh_.is_left(static_cast<std::int32_t>(t))) continue;
      const auto& c = mesh_.triangles()[t].corners;
      numbers.push_back(static_cast<std::int32_t>(t));
      triangles.push_back({c[0].vertex, c[1].vertex, c[2].vertex});
    }
    const std::vector<Vec3f> positions(mesh_.positions().begin(), mesh_.positions().end());
    std::vector<std::int32_t> found;
    for (const TriangleId t : turned_triangles({positions, triangles})) found.push_back(numbers[t]);
    return found;
  }

  /// The cheapest of its three that is allowed. \param round  after the first, others may be turned by it
  bool collapse_a_side(std::int32_t t, int round) {
    const double most_turned = round == 0 ? kMostTurned : -1;
    std::optional<Collapse> best;
    for (int k = 0; k < 3; ++k) {
      const auto side = plan(mesh_.triangle(t).corners[k].vertex, mesh_.triangle(t).corners[(k + 1) % 3].vertex);
      if (side && (!best || side->cost < best->cost) && is_allowed(*side, most_turned)) best = side;
    }
    if (best) carry_out(*best);
    return best.has_value();
  }

  bool stays_upright(std::int32_t c, const Collapse& collapse, double most_turned) const {
    const ChartedTriangle& t = mesh_.triangle(c / 3);
    std::array<Vec3d, 3> p = mesh_.corners_of(t);
    std::array<Vec2d, 3> place{t.corners[0].place, t.corners[1].place, t.corners[2].place};
    const bool was_upright = is_upright_in_atlas(t.patch, place);
    const double area = twice_area(place);
    const Vec3d before = cross_of(p);
    p[c % 3] = collapse.merged.position;
    place[c % 3] = mesh_.place_after(c, collapse.edge, collapse.merged.share);
    const Vec3d after = cross_of(p);
    if (!(after.dot(before) > most_turned * after.length() * before.length())) return false;
    // What is no more than a line in the atlas from the start, where a border was cut close to a vertex, hinders
    // nothing that doesn't turn it further.
    return is_upright_in_atlas(t.patch, place) || (!was_upright && twice_area(place) >= area);
  }

  static double twice_area(const std::array<Vec2d, 3>& place) {
    return (place[1] - place[0]).cross(place[2] - place[0]);
  }

  bool is_upright_in_atlas(std::int32_t patch, const std::array<Vec2d, 3>& place) const {
    const Vec2d b = place[1] - place[0];
    const Vec2d c = place[2] - place[0];
    const double longest = std::sqrt(std::max({b.length2(), c.length2(), (c - b).length2()}));
    return b.cross(c) * charts_[patch].texels > least_height_ * longest;
  }

  void carry_out(const Collapse& collapse) {
    const VertexId from = collapse.edge.from;
    const VertexId to = collapse.edge.to;
    if (!collapse.keeps_squares) {
      mesh_.for_each_corner(from, [&](std::int32_t c) { slipped_[mesh_.triangle(c / 3).patch] = true; });
    }
    metric_.join(from, to, collapse.merged);
    lines_.join(from, to, collapse.keeps_squares);
    mesh_.collapse(collapse.edge, collapse.merged.position, collapse.merged.share);
    ++collapses_;
    ++version_[to];
    ++version_[from];
    for (const VertexId u : mesh_.neighbours(to)) enqueue(to, u);
  }

  CollapsibleMesh mesh_;
  ChartLines lines_;
  QuadricMetric metric_;
  const std::vector<ChartScale>& charts_;
  double least_height_;
  std::vector<std::uint32_t> version_;
  std::vector<std::uint8_t> is_whole_;  ///< [vertex] of a piece of which nothing can go but corners
  bool are_all_whole_ = false;
  std::vector<bool> slipped_;  ///< [patch]
  std::priority_queue<Candidate> queue_;
  std::vector<Candidate> refused_;
  std::int64_t collapses_ = 0;
  std::int64_t collapses_when_refused_ = -1;
};

Simplifier::Simplifier(ChartedSurface surface, const std::vector<ChartScale>& charts, double least_height,
                       const SimplifierOptions& options)
    : work_(std::make_unique<Work>(std::move(surface), charts, least_height, options)) {}
Simplifier::~Simplifier() = default;
void Simplifier::reduce_to(std::int64_t triangles) { work_->reduce_to(triangles); }
void Simplifier::mend_turned() { work_->mend_turned(); }
const std::vector<bool>& Simplifier::slipped_patches() const { return work_->slipped_patches(); }
std::int64_t Simplifier::triangle_count() const { return work_->mesh().triangle_count(); }
ChartedSurface Simplifier::surface(std::vector<VertexId>* origins) const { return work_->mesh().surface(origins); }

}  // namespace lozenge
