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
#include "formats/surface/attribute.h"
#include "formats/surface/source_mesh.h"
#include "formats/surface/turned_triangles.h"
#include "stages/export/quadric.h"

namespace lozenge {
namespace {

/// Weight of the distance to the points of the source that a vertex stands for, against that to their planes: where
/// the surface is flat it keeps vertices in the middle of what is theirs, and where it isn't it hardly counts.
constexpr double kPointWeight = 1e-3;

/// Weight of lines that must stay (the surface's end, borders of groups), by their squared lengths.
constexpr double kLineWeight = 4;

/// Weight of the way that what the atlas shows slips on the surface, where a patch loses a part of its square, by the
/// area around.
constexpr double kSlipWeight = 0.003;

/// Weight of the way between a vertex and the point of the source that the atlas shows there, by the area around: what
/// has a direction of its own on a flat surface, as letters have, wavers by as much as vertices slide from theirs.
constexpr double kSlideWeight = 0.01;

/// How much more such slips cost that bring out what is hidden, by the square of how much less of it is seen: maps are
/// black there, or hold anything.
constexpr double kBaredWeight = 200;

/// How much more pieces of which nothing can go but corners cost: a box that isn't one any more is another thing.
constexpr double kWholeWeight = 16;

/// How far joints are taken to move what they hold away from what other ones hold, by the diagonal of the surface: a
/// vertex that takes over another's joints is off by that much in some pose.
constexpr double kJointReach = 0.1;

/// What was refused is tried again when so many collapses have happened as one in this many of the triangles left.
constexpr std::int64_t kRetry = 20;

/// The cosine of the angle by which a collapse may turn a triangle.
constexpr double kMostTurned = 0.6;

constexpr std::int32_t kNone = -1;

enum class VertexKind : std::uint8_t {
  kFree,    ///< inside of a patch
  kOnLine,  ///< on a border, or the surface's end: two edges at it are of that line
  kCorner,  ///< where borders of patches meet or turn, and lines that have a shape go on
  kFixed,   ///< where lines that have a shape meet or end
};

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

/// The one or two triangles of an edge.
struct EdgeTriangles {
  std::array<std::int32_t, 2> triangle{kNone, kNone};
  int count = 0;
};

/// How an edge would go.
struct Collapse {
  VertexId from = -1;  ///< goes
  VertexId to = -1;
  Vec3d position;
  Vec3d anchor;      ///< of what is left, see `anchors_`
  double share = 1;  ///< of the way from one to the other where the texture coordinates go
  EdgeTriangles at;
  double posed = 0;  ///< of its cost, what poses add
  double cost = 0;
  bool keeps_squares = true;  ///< each patch goes on showing all that it has shown
};

Vec3d cross_of(const Vec3d& a, const Vec3d& b, const Vec3d& c) { return (b - a).cross(c - a); }

}  // namespace

class Simplifier::Work {
 public:
  Work(ChartedSurface surface, const std::vector<ChartScale>& charts, double least_height,
       const SimplifierOptions& options)
      : surface_(std::move(surface)),
        charts_(charts),
        least_height_(least_height),
        lines_(options.lines),
        positions_(surface_.positions.begin(), surface_.positions.end()),
        anchors_(positions_),
        head_(positions_.size(), kNone),
        next_(3 * surface_.triangles.size(), kNone),
        alive_(surface_.triangles.size(), 1),
        left_(static_cast<std::int64_t>(surface_.triangles.size())),
        version_(positions_.size(), 0),
        kinds_(positions_.size(), VertexKind::kFree),
        has_feature_(positions_.size(), 0),
        quadrics_(positions_.size()),
        areas_(positions_.size(), 0.0),
        plain_areas_(positions_.size(), 0.0),
        slipped_(charts.size(), false),
        joint_reach_(kJointReach * diagonal(bounds_of(surface_.positions))) {
    for (std::int32_t c = static_cast<std::int32_t>(next_.size()) - 1; c >= 0; --c) {
      const VertexId v = corner(c).vertex;
      next_[c] = head_[v];
      head_[v] = c;
    }
    find_lines();
    add_quadrics(options.importance);
    add_outline(options.outline);
    add_walls();
    find_whole_pieces();
    fill_queue();
  }

  void reduce_to(std::int64_t triangles) {
    while (left_ > triangles) {
      if (kRetry * (collapses_ - collapses_when_refused_) > left_) try_refused_again();
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
      for (const std::int32_t t : turned()) is_mended = (alive_[t] != 0 && collapse_a_side(t, round)) || is_mended;
      if (!is_mended) return;
    }
  }

  std::int64_t triangle_count() const { return left_; }
  const std::vector<bool>& slipped_patches() const { return slipped_; }

  ChartedSurface surface(std::vector<VertexId>* origins) const {
    constexpr std::size_t kWidth = kInfluences.components;
    std::vector<VertexId> number(positions_.size(), kNone);
    ChartedSurface made;
    for (std::size_t t = 0; t < alive_.size(); ++t) {
      if (alive_[t] == 0) continue;
      ChartedTriangle& left = made.triangles.emplace_back(surface_.triangles[t]);
      for (ChartedCorner& c : left.corners) {
        const auto v = static_cast<std::size_t>(c.vertex);
        if (number[v] == kNone) {
          number[v] = static_cast<VertexId>(made.positions.size());
          if (origins != nullptr) origins->push_back(c.vertex);
          made.positions.push_back(without_negative_zeros(Vec3f(positions_[v])));
          if (!surface_.influences.empty()) {
            const auto first = surface_.influences.begin() + static_cast<std::ptrdiff_t>(kWidth * v);
            made.influences.insert(made.influences.end(), first, first + kWidth);
          }
        }
        c.vertex = number[v];
      }
    }
    return made;
  }

 private:
  // ---- The triangles around vertices

  ChartedCorner& corner(std::int32_t c) { return surface_.triangles[c / 3].corners[c % 3]; }
  const ChartedCorner& corner(std::int32_t c) const { return surface_.triangles[c / 3].corners[c % 3]; }
  const ChartedTriangle& triangle(std::int32_t t) const { return surface_.triangles[t]; }

  /// `visit(corner)` for each triangle of a vertex.
  template <typename Visit>
  void for_each_corner(VertexId v, Visit visit) const {
    for (std::int32_t c = head_[v]; c != kNone; c = next_[c]) {
      if (alive_[c / 3] != 0) visit(c);
    }
  }

  static int corner_with(const ChartedTriangle& t, VertexId v) {
    for (int k = 0; k < 3; ++k) {
      if (t.corners[k].vertex == v) return k;
    }
    return kNone;
  }

  EdgeTriangles triangles_at(VertexId a, VertexId b) const {
    EdgeTriangles found;
    for_each_corner(a, [&](std::int32_t c) {
      if (corner_with(triangle(c / 3), b) == kNone) return;
      if (found.count < 2) found.triangle[found.count] = c / 3;
      ++found.count;
    });
    return found;
  }

  /// Whether a vertex is the same place of the same chart and group in two of its triangles.
  bool goes_on_at(VertexId v, std::int32_t s, std::int32_t t) const {
    const ChartedTriangle& a = triangle(s);
    const ChartedTriangle& b = triangle(t);
    return a.patch == b.patch && a.group == b.group &&
           a.corners[corner_with(a, v)].place == b.corners[corner_with(b, v)].place;
  }

  /// Whether an edge is of a line that must stay: the surface's end, or where charts or groups meet.
  bool is_line(VertexId a, VertexId b, const EdgeTriangles& at) const {
    return at.count != 2 || !goes_on_at(a, at.triangle[0], at.triangle[1]) ||
           !goes_on_at(b, at.triangle[0], at.triangle[1]);
  }

  /// Whether its line is one that has a shape, not only a border of patches.
  bool is_feature(const EdgeTriangles& at) const {
    return at.count == 1 || (at.count == 2 && triangle(at.triangle[0]).group != triangle(at.triangle[1]).group);
  }

  /// `visit(a, b, triangles)` for each edge once.
  template <typename Visit>
  void for_each_edge(Visit visit) const {
    for (std::size_t t = 0; t < alive_.size(); ++t) {
      if (alive_[t] == 0) continue;
      for (int k = 0; k < 3; ++k) {
        const VertexId a = surface_.triangles[t].corners[k].vertex;
        const VertexId b = surface_.triangles[t].corners[(k + 1) % 3].vertex;
        const EdgeTriangles at = triangles_at(a, b);
        if (at.triangle[0] == static_cast<std::int32_t>(t)) visit(a, b, at);
      }
    }
  }

  void find_lines() {
    std::vector<std::uint8_t> lines(positions_.size(), 0);
    std::vector<std::uint8_t> features(positions_.size(), 0);
    const auto count = [](std::uint8_t& n) { n = static_cast<std::uint8_t>(std::min(3, n + 1)); };
    for_each_edge([&](VertexId a, VertexId b, const EdgeTriangles& at) {
      if (!is_line(a, b, at)) return;
      for (const VertexId v : {a, b}) {
        count(lines[v]);
        if (is_feature(at)) count(features[v]);
        if (at.count > 2) kinds_[v] = VertexKind::kFixed;
      }
    });
    for (std::size_t v = 0; v < lines.size(); ++v) {
      has_feature_[v] = features[v] != 0 ? 1 : 0;
      if (kinds_[v] == VertexKind::kFixed || lines[v] == 0) continue;
      const bool goes_on = features[v] == 0 || features[v] == 2;
      if (lines_ == Lines::kStay || !goes_on) kinds_[v] = VertexKind::kFixed;
      else kinds_[v] = lines[v] == 2 ? VertexKind::kOnLine : VertexKind::kCorner;
    }
    // Domain vertices of two patches look like places on a border, but borders turn there.
    for (const ChartedTriangle& t : surface_.triangles) {
      for (const ChartedCorner& c : t.corners) {
        const auto is_end = [](double x) { return std::abs(x) < 1e-9 || std::abs(x - 1) < 1e-9; };
        if (!is_end(c.place.x) || !is_end(c.place.y)) continue;
        const bool may_go = lines_ == Lines::kSimplify && kinds_[c.vertex] != VertexKind::kFixed;
        kinds_[c.vertex] = may_go ? VertexKind::kCorner : VertexKind::kFixed;
      }
    }
  }

  void add_quadrics(const std::vector<float>& importance) {
    for (std::size_t i = 0; i < surface_.triangles.size(); ++i) {
      const ChartedTriangle& t = surface_.triangles[i];
      const std::array<Vec3d, 3> p{positions_[t.corners[0].vertex], positions_[t.corners[1].vertex],
                                   positions_[t.corners[2].vertex]};
      const Vec3d normal = cross_of(p[0], p[1], p[2]);
      double area = normal.length() / 2;
      if (!(area > 0)) continue;
      const Vec3d unit = normal / (2 * area);
      for (const ChartedCorner& c : t.corners) plain_areas_[c.vertex] += area / 3;
      if (!importance.empty()) area *= importance[i];
      Quadric plane;
      plane.add_plane(unit, p[0], area / 3);
      for (int k = 0; k < 3; ++k) {
        Quadric& q = quadrics_[t.corners[k].vertex];
        q += plane;
        areas_[t.corners[k].vertex] += area / 3;
        q.add_point(p[k], kPointWeight * area / 3);
      }
    }
  }

  void add_outline(const std::vector<OutlineEdge>& outline) {
    for (const OutlineEdge& edge : outline) {
      const auto& corners = surface_.triangles[edge.triangle].corners;
      const VertexId a = corners[edge.side].vertex;
      const VertexId b = corners[(edge.side + 1) % 3].vertex;
      Quadric wall;
      for (const Vec3d& normal : edge.normals) wall.add_plane(normal, positions_[a], edge.weight / 6);
      quadrics_[a] += wall;
      quadrics_[b] += wall;
    }
  }

  void add_walls() {
    for_each_edge([&](VertexId a, VertexId b, const EdgeTriangles& at) {
      if (!is_feature(at)) return;
      const Vec3d along = positions_[b] - positions_[a];
      for (int k = 0; k < std::min(at.count, 2); ++k) {
        const auto& corners = triangle(at.triangle[k]).corners;
        const Vec3d normal =
            cross_of(positions_[corners[0].vertex], positions_[corners[1].vertex], positions_[corners[2].vertex]);
        const Vec3d beside = along.cross(normal);
        if (!(beside.length() > 0)) continue;
        Quadric wall;
        wall.add_plane(beside.normalized(), positions_[a], kLineWeight * along.length2());
        quadrics_[a] += wall;
        quadrics_[b] += wall;
      }
    });
  }

  // ---- The queue

  void fill_queue() {
    for_each_edge([&](VertexId a, VertexId b, const EdgeTriangles&) { enqueue(a, b); });
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
    DisjointSets<VertexId> pieces(positions_.size());
    for (const ChartedTriangle& t : surface_.triangles) {
      for (int k = 1; k < 3; ++k) pieces.join(t.corners[0].vertex, t.corners[k].vertex);
    }
    std::vector<std::uint8_t> is_whole(positions_.size(), 1);
    is_whole_ = is_whole;
    are_all_whole_ = true;
    for_each_edge([&](VertexId a, VertexId b, const EdgeTriangles&) {
      std::uint8_t& whole = is_whole[pieces.root(a)];
      if (whole == 0) return;
      const auto collapse = plan(a, b);
      if (collapse && is_allowed(*collapse)) whole = 0;
    });
    for (std::size_t v = 0; v < is_whole.size(); ++v) is_whole_[v] = is_whole[pieces.root(static_cast<VertexId>(v))];
    are_all_whole_ = std::all_of(is_whole_.begin(), is_whole_.end(), [](std::uint8_t whole) { return whole != 0; });
  }

  /// Whether an edge runs along a line that one of its ends moves along, or has an end that is on none: then each patch
  /// keeps showing all of its square.
  bool keeps_squares(VertexId a, VertexId b, const EdgeTriangles& at) const {
    const VertexKind freer = std::min(kinds_[a], kinds_[b]);
    return freer == VertexKind::kFree || (freer == VertexKind::kOnLine && is_line(a, b, at));
  }

  /// Whether the kinds of the ends of an edge let it go.
  bool may_go(VertexId a, VertexId b, const EdgeTriangles& at) const {
    if (std::min(kinds_[a], kinds_[b]) == VertexKind::kFixed) return false;
    // An edge from one place of a line that has a shape to another one of such a line would close what is between.
    if (has_feature_[a] != 0 && has_feature_[b] != 0 && !is_feature(at)) return false;
    if (keeps_squares(a, b, at)) return true;
    return lines_ == Lines::kSimplify && !are_all_whole_;
  }

  /// Which of the two stays: what is on a line that has a shape, and what is less free.
  bool stays(VertexId a, VertexId b) const {
    if (kinds_[a] == VertexKind::kFixed || kinds_[b] == VertexKind::kFixed) return kinds_[a] == VertexKind::kFixed;
    if (has_feature_[a] != has_feature_[b]) return has_feature_[a] > has_feature_[b];
    return kinds_[a] > kinds_[b];
  }

  /// Nothing where the two ends are of different lines.
  std::optional<Collapse> plan(VertexId a, VertexId b) const {
    Collapse made;
    made.at = triangles_at(a, b);
    if (made.at.count < 1 || made.at.count > 2) return std::nullopt;
    if (!may_go(a, b, made.at)) return std::nullopt;
    const bool stays_a = stays(a, b);
    made.from = stays_a ? b : a;
    made.to = stays_a ? a : b;
    made.keeps_squares = keeps_squares(a, b, made.at);
    place(made, made.keeps_squares && kinds_[a] == kinds_[b]);
    if (!made.keeps_squares) made.cost += slip(made.from, made.to);
    if (is_whole_[a] != 0) made.cost *= kWholeWeight;
    return made;
  }

  /// Where what is left of the two lies, in space and in the atlas, and what that costs.
  /// \param may_slide  in the atlas, too: anywhere from one to the other, not only to where the second is
  void place(Collapse& made, bool may_slide) const {
    Quadric sum = quadrics_[made.from];
    sum += quadrics_[made.to];
    const double slide_weight = kSlideWeight * (areas_[made.from] + areas_[made.to]);
    const Vec3d anchor = anchors_[made.from];
    const Vec3d slide = anchors_[made.to] - anchor;
    const double slide2 = slide.length2();
    Quadric held = sum;
    held.add_point(anchors_[made.to], slide_weight);
    if (may_slide && slide2 > 0) held.add_plane(slide / std::sqrt(slide2), anchors_[made.to], -slide_weight);
    made.position = held.least();
    const Vec3d start = positions_[made.from];
    const Vec3d way = positions_[made.to] - start;
    const bool is_far = !((made.position - (start + way * 0.5)).length2() <= 4 * way.length2());
    if (is_far) made.position = sum.at(start) < sum.at(positions_[made.to]) ? start : positions_[made.to];
    if (lines_ == Lines::kStay && kinds_[made.to] == VertexKind::kFixed) made.position = positions_[made.to];
    made.share = slide2 > 0 ? std::clamp((made.position - anchor).dot(slide) / slide2, 0.0, 1.0) : 1;
    if (!may_slide) made.share = 1;
    else if (!surface_.influences.empty()) made.share = made.share < 0.5 ? 0 : 1;
    made.anchor = anchor + slide * made.share;
    made.posed = surface_.influences.empty() ? 0 : error_in_poses(made);
    made.cost = sum.at(made.position) + made.posed + slide_weight * (made.position - made.anchor).length2();
  }

  /// What it costs that patches show another part of their squares around a corner.
  double slip(VertexId from, VertexId to) const {
    const double bared = std::max(0.0, seen(to) - seen(from));
    const double weight = kSlipWeight * (1 + kBaredWeight * bared * bared);
    return weight * (areas_[from] + areas_[to]) * (positions_[to] - positions_[from]).length2();
  }

  /// The mean importance of what it stands for.
  double seen(VertexId v) const { return plain_areas_[v] > 0 ? areas_[v] / plain_areas_[v] : 0; }

  /// What taking over joints and weights may cost, as a squared distance by area, as all costs are.
  double error_in_poses(const Collapse& collapse) const {
    const VertexId gone = collapse.share == 0 ? collapse.to : collapse.from;
    const VertexId kept = collapse.share == 0 ? collapse.from : collapse.to;
    constexpr std::size_t kWidth = kInfluences.components;
    const float* a = &surface_.influences[kWidth * static_cast<std::size_t>(gone)];
    const float* b = &surface_.influences[kWidth * static_cast<std::size_t>(kept)];
    constexpr std::size_t kMost = kWidth / 2;  // joints, then their weights
    double square = 0;
    for (std::size_t i = 0; i < kMost; ++i) {
      double there = 0;
      double only = b[kMost + i];
      for (std::size_t j = 0; j < kMost; ++j) {
        if (b[j] == a[i]) there += b[kMost + j];
        if (a[j] == b[i] && a[kMost + j] > 0) only = 0;
      }
      if (a[kMost + i] > 0) square += (a[kMost + i] - there) * (a[kMost + i] - there);
      square += only * only;
    }
    return areas_[gone] * square * joint_reach_ * joint_reach_;
  }

  /// \param most_turned  cosine
  bool is_allowed(const Collapse& collapse, double most_turned = kMostTurned) const {
    if (!keeps_topology(collapse)) return false;
    bool good = true;
    for (const VertexId v : {collapse.from, collapse.to}) {
      for_each_corner(v, [&](std::int32_t c) {
        if (good && c / 3 != collapse.at.triangle[0] && c / 3 != collapse.at.triangle[1])
          good = stays_upright(c, collapse, most_turned);
      });
    }
    return good;
  }

  /// Triangles that face against all of their neighbours, by their numbers.
  std::vector<std::int32_t> turned() const {
    std::vector<std::int32_t> numbers;
    std::vector<std::array<VertexId, 3>> triangles;
    for (std::size_t t = 0; t < alive_.size(); ++t) {
      if (alive_[t] == 0) continue;
      const auto& c = surface_.triangles[t].corners;
      numbers.push_back(static_cast<std::int32_t>(t));
      triangles.push_back({c[0].vertex, c[1].vertex, c[2].vertex});
    }
    const std::vector<Vec3f> positions(positions_.begin(), positions_.end());
    std::vector<std::int32_t> found;
    for (const TriangleId t : turned_triangles({positions, triangles})) found.push_back(numbers[t]);
    return found;
  }

  /// The cheapest of its three that is allowed. \param round  after the first, others may be turned by it
  bool collapse_a_side(std::int32_t t, int round) {
    const double most_turned = round == 0 ? kMostTurned : -1;
    std::optional<Collapse> best;
    for (int k = 0; k < 3; ++k) {
      const auto side = plan(triangle(t).corners[k].vertex, triangle(t).corners[(k + 1) % 3].vertex);
      if (side && (!best || side->cost < best->cost) && is_allowed(*side, most_turned)) best = side;
    }
    if (best) carry_out(*best);
    return best.has_value();
  }

  /// The two have no neighbours in common but those across from their edge (the link condition), and what is left is no
  /// double triangle.
  bool keeps_topology(const Collapse& collapse) const {
    std::vector<VertexId> across;
    for (int k = 0; k < collapse.at.count; ++k) {
      for (const ChartedCorner& c : triangle(collapse.at.triangle[k]).corners) {
        if (c.vertex != collapse.from && c.vertex != collapse.to) across.push_back(c.vertex);
      }
    }
    if (across.size() == 2 && across[0] == across[1]) return false;
    std::vector<VertexId> neighbours;
    for_each_corner(collapse.from, [&](std::int32_t c) {
      for (const ChartedCorner& other : triangle(c / 3).corners) neighbours.push_back(other.vertex);
    });
    bool good = true;
    for_each_corner(collapse.to, [&](std::int32_t c) {
      for (const ChartedCorner& other : triangle(c / 3).corners) {
        const VertexId u = other.vertex;
        if (u == collapse.from || u == collapse.to) continue;
        const bool common = std::find(neighbours.begin(), neighbours.end(), u) != neighbours.end();
        good = good && (!common || std::find(across.begin(), across.end(), u) != across.end());
      }
    });
    if (!good) return false;
    return std::all_of(across.begin(), across.end(), [&](VertexId u) { return can_lose_a_triangle(u); });
  }

  /// Vertices keep three edges, two at the surface's end.
  bool can_lose_a_triangle(VertexId v) const {
    int triangles = 0;
    std::vector<VertexId> others;  // each of them twice, but at the surface's end
    for_each_corner(v, [&](std::int32_t c) {
      ++triangles;
      others.push_back(corner(c / 3 * 3 + (c + 1) % 3).vertex);
      others.push_back(corner(c / 3 * 3 + (c + 2) % 3).vertex);
    });
    if (triangles > 3) return true;
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    const bool is_at_end = static_cast<int>(others.size()) > triangles;
    return is_at_end && triangles > 1;
  }

  /// The place that the vertex left over has in the chart of a triangle that stays: that of the edge's own triangle
  /// there. `c` is the corner of one of the edge's ends.
  Vec2d place_after(std::int32_t c, const Collapse& collapse) const {
    const VertexId v = corner(c).vertex;
    for (int k = 0; k < collapse.at.count; ++k) {
      const std::int32_t beside = collapse.at.triangle[k];
      if (!goes_on_at(v, c / 3, beside)) continue;
      const ChartedTriangle& t = triangle(beside);
      const Vec2d& from = t.corners[corner_with(t, collapse.from)].place;
      const Vec2d& to = t.corners[corner_with(t, collapse.to)].place;
      if (collapse.share == 1) return to;
      return collapse.share == 0 ? from : from + (to - from) * collapse.share;
    }
    return corner(c).place;  // of a fixed vertex, in a chart that the edge isn't in
  }

  bool stays_upright(std::int32_t c, const Collapse& collapse, double most_turned) const {
    const ChartedTriangle& t = triangle(c / 3);
    std::array<Vec3d, 3> p;
    std::array<Vec2d, 3> place;
    for (int k = 0; k < 3; ++k) {
      p[k] = positions_[t.corners[k].vertex];
      place[k] = t.corners[k].place;
    }
    const Vec3d before = cross_of(p[0], p[1], p[2]);
    p[c % 3] = collapse.position;
    place[c % 3] = place_after(c, collapse);
    const Vec3d after = cross_of(p[0], p[1], p[2]);
    if (!(after.dot(before) > most_turned * after.length() * before.length())) return false;
    return is_upright_in_atlas(t.patch, place);
  }

  bool is_upright_in_atlas(std::int32_t patch, const std::array<Vec2d, 3>& place) const {
    const Vec2d b = place[1] - place[0];
    const Vec2d c = place[2] - place[0];
    const double longest = std::sqrt(std::max({b.length2(), c.length2(), (c - b).length2()}));
    return b.cross(c) * charts_[patch].texels > least_height_ * longest;
  }

  void carry_out(const Collapse& collapse) {
    // Places first: they are told by the triangles that go.
    std::vector<std::pair<std::int32_t, Vec2d>> places;
    for (const VertexId v : {collapse.from, collapse.to}) {
      for_each_corner(v, [&](std::int32_t c) {
        if (!collapse.keeps_squares && v == collapse.from) slipped_[triangle(c / 3).patch] = true;
        if (c / 3 != collapse.at.triangle[0] && c / 3 != collapse.at.triangle[1])
          places.emplace_back(c, place_after(c, collapse));
      });
    }
    for (int k = 0; k < collapse.at.count; ++k) alive_[collapse.at.triangle[k]] = 0;
    left_ -= collapse.at.count;
    for (const auto& [c, place] : places) {
      corner(c).place = place;
      corner(c).vertex = collapse.to;
    }
    join_lists(collapse.from, collapse.to);
    positions_[collapse.to] = collapse.position;
    anchors_[collapse.to] = collapse.anchor;
    quadrics_[collapse.to] += quadrics_[collapse.from];
    quadrics_[collapse.to].c += collapse.posed;
    areas_[collapse.to] += areas_[collapse.from];
    plain_areas_[collapse.to] += plain_areas_[collapse.from];
    has_feature_[collapse.to] |= has_feature_[collapse.from];
    if (!collapse.keeps_squares) {
      kinds_[collapse.to] = std::max(kinds_[collapse.to], VertexKind::kCorner);
    }
    if (!surface_.influences.empty() && collapse.share == 0) take_influence(collapse.from, collapse.to);
    ++collapses_;
    ++version_[collapse.to];
    ++version_[collapse.from];
    std::vector<VertexId> rim;
    for_each_corner(collapse.to, [&](std::int32_t c) {
      for (const ChartedCorner& other : triangle(c / 3).corners) {
        if (other.vertex != collapse.to) rim.push_back(other.vertex);
      }
    });
    std::sort(rim.begin(), rim.end());
    rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
    for (const VertexId u : rim) enqueue(collapse.to, u);
  }

  void take_influence(VertexId from, VertexId to) {
    constexpr std::size_t kWidth = kInfluences.components;
    std::copy_n(&surface_.influences[kWidth * static_cast<std::size_t>(from)], kWidth,
                &surface_.influences[kWidth * static_cast<std::size_t>(to)]);
  }

  void join_lists(VertexId from, VertexId to) {
    std::int32_t first = kNone;
    for (const VertexId v : {from, to}) {
      for (std::int32_t c = head_[v]; c != kNone;) {
        const std::int32_t following = next_[c];
        if (alive_[c / 3] != 0) {
          next_[c] = first;
          first = c;
        }
        c = following;
      }
    }
    head_[from] = kNone;
    head_[to] = first;
  }

  ChartedSurface surface_;
  const std::vector<ChartScale>& charts_;
  double least_height_;
  Lines lines_;
  std::vector<Vec3d> positions_;
  std::vector<Vec3d> anchors_;      ///< [vertex] about the source's point at its place in the atlas
  std::vector<std::int32_t> head_;  ///< [vertex] first corner of its list
  std::vector<std::int32_t> next_;  ///< [corner]
  std::vector<std::uint8_t> alive_;
  std::int64_t left_;
  std::vector<std::uint32_t> version_;
  std::vector<VertexKind> kinds_;
  std::vector<std::uint8_t> has_feature_;  ///< [vertex] it is on a line that has a shape
  std::vector<std::uint8_t> is_whole_;     ///< [vertex] of a piece of which nothing can go but corners
  bool are_all_whole_ = false;
  std::vector<Quadric> quadrics_;
  std::vector<double> areas_;        ///< [vertex] of the source, that it stands for, weighed by importance
  std::vector<double> plain_areas_;  ///< the same, not weighed
  std::vector<bool> slipped_;        ///< [patch]
  double joint_reach_;
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
std::int64_t Simplifier::triangle_count() const { return work_->triangle_count(); }
ChartedSurface Simplifier::surface(std::vector<VertexId>* origins) const { return work_->surface(origins); }

}  // namespace lozenge
