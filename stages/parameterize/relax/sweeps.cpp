// The order of the vertices, along the domain's triangles and in each along its list or a curve, is cut into blocks. A
// sweep relaxes the vertices inside of blocks, then the colours between them, one after the other, and the next sweep
// goes back the same way. Vertices stay at home meanwhile, even where they leave it, so that nothing but positions is
// written; after each sweep those that have left are brought home.
#include "stages/parameterize/relax/sweeps.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>

#include "formats/base/parallel.h"
#include "stages/parameterize/map/boundary.h"
#include "stages/parameterize/map/compact_map.h"
#include "stages/parameterize/map/homes.h"
#include "stages/parameterize/map/walk.h"

namespace lozenge {

namespace {

constexpr std::size_t kBlock = 512;  // vertices: some hundred kilobytes of map, what a core keeps near
/// Fewer vertices than this are not worth waking threads for.
constexpr std::size_t kLeastForThreads = 2 * kBlock;

/// Consecutive batches of a list, each to be worked on by one thread at a time.
struct Batches {
  std::vector<VertexId> vertices;
  std::vector<std::size_t> begins;  ///< and the end

  std::size_t count() const { return begins.size() - 1; }
  void end_batch() {
    if (begins.empty() || begins.back() != vertices.size()) begins.push_back(vertices.size());
  }
};

class Sweeper {
 public:
  /// \param order  every vertex, near ones near each other
  Sweeper(WorkingMap& map, const std::vector<VertexId>& order) : map_(map) {
    threads_ = order.size() >= kLeastForThreads;
    std::vector<std::int32_t> block(map.home.size(), -1);
    for_each_part(order.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) block[order[i]] = static_cast<std::int32_t>(i / kBlock);
    });
    std::vector<Block> blocks((order.size() + kBlock - 1) / kBlock);
    for_each_index(blocks.size(), threads_, [&](std::size_t b) {
      const auto begin = order.begin() + static_cast<std::ptrdiff_t>(b * kBlock);
      const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(order.size(), (b + 1) * kBlock));
      blocks[b] = sort_out({begin, end}, block);
    });
    inner_.begins.push_back(0);
    std::vector<VertexId> between;
    for (const Block& b : blocks) {
      inner_.vertices.insert(inner_.vertices.end(), b.inner.begin(), b.inner.end());
      inner_.end_batch();
      between.insert(between.end(), b.between.begin(), b.between.end());
    }
    colour(between);
  }

  struct Gain {
    double fallen = 0;
    double excess = 0;
  };

  Gain sweep(bool backwards) {
    before_.resize(map_.at.size());
    for_each_part(before_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) before_[v] = map_.at[v];
    });
    Gain total;
    if (!backwards) {
      total = relax_batches(inner_, backwards);
      for (const Batches& batches : colours_) add(total, relax_batches(batches, backwards));
    } else {
      for (auto batches = colours_.rbegin(); batches != colours_.rend(); ++batches)
        add(total, relax_batches(*batches, backwards));
      add(total, relax_batches(inner_, backwards));
    }
    go_home(map_, before_);
    return total;
  }

 private:
  static void add(Gain& total, const Gain& more) {
    total.fallen += more.fallen;
    total.excess += more.excess;
  }

  /// The vertices of a block that move: those whose neighbours all lie in it, and the others.
  struct Block {
    std::vector<VertexId> inner, between;
  };

  /// \param block  [vertex] the number of its block
  Block sort_out(std::span<const VertexId> vertices, const std::vector<std::int32_t>& block) const {
    Block sorted;
    for (const VertexId v : vertices) {
      if (map_.pin[v] >= 0) continue;
      bool inside = true;
      for_each_neighbour(map_.mesh, v, [&](VertexId w) { inside = inside && block[w] == block[v]; });
      (inside ? sorted.inner : sorted.between).push_back(v);
    }
    return sorted;
  }

  /// Greedily, in order; each colour in batches.
  void colour(const std::vector<VertexId>& between) {
    constexpr std::size_t kBatch = 128;  // vertices: what a thread takes at a time
    std::vector<std::int32_t> colour_of(map_.home.size(), -1);
    std::vector<bool> taken;
    std::vector<std::size_t> filled;
    for (const VertexId v : between) {
      taken.assign(colours_.size() + 1, false);
      for_each_neighbour(map_.mesh, v, [&](VertexId w) {
        if (const std::int32_t c = colour_of[w]; c >= 0) taken[c] = true;
      });
      const auto c = static_cast<std::size_t>(std::find(taken.begin(), taken.end(), false) - taken.begin());
      if (c == colours_.size()) colours_.push_back({{}, {0}});
      colour_of[v] = static_cast<std::int32_t>(c);
      colours_[c].vertices.push_back(v);
      if (colours_[c].vertices.size() % kBatch == 0) colours_[c].end_batch();
    }
    for (Batches& batches : colours_) batches.end_batch();
  }

  Gain relax_batches(const Batches& batches, bool backwards) {
    std::vector<Gain> gains(batches.count());
    const double scale = map_.scale();
    for_each_index(batches.count(), threads_, [&](std::size_t batch) {
      Gain gain;  // not in the list while it grows: threads would fight for its memory
      Wedges wedges;
      const std::size_t begin = batches.begins[batch];
      const std::size_t count = batches.begins[batch + 1] - begin;
      for (std::size_t i = 0; i < count; ++i) {
        const VertexId v = batches.vertices[backwards ? begin + count - 1 - i : begin + i];
        gain.fallen += relax_at_home(map_, v, scale, wedges, gain.excess);
      }
      gains[batch] = gain;
    });
    Gain total;
    for (const Gain& gain : gains) add(total, gain);
    return total;
  }

  WorkingMap& map_;
  bool threads_ = false;
  Batches inner_;
  std::vector<Batches> colours_;
  std::vector<Vec2d> before_;
};

}  // namespace

namespace {

/// Whether a vertex lies outside of its home; one on the boundary, whether it may have left its line.
bool is_astray(const WorkingMap& map, VertexId v) {
  if (map.home[v] < 0 || map.pin[v] >= 0) return false;
  if (map.mesh.on_boundary(v)) return true;
  const auto w = barycentrics(map.at[v]);
  return !(w[0] >= 0 && w[1] >= 0 && w[2] >= 0);
}

}  // namespace

void go_home(WorkingMap& map, const std::vector<Vec2d>& before) {
  // Few are: all threads look for them, and one brings them home, in order.
  std::vector<char> astray(map.home.size(), 0);
  for_each_part(astray.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) astray[v] = is_astray(map, static_cast<VertexId>(v));
  });
  for (VertexId v = 0; v < map.mesh.vertex_count(); ++v) {
    if (!astray[v]) continue;
    if (map.mesh.on_boundary(v)) {
      const Vec2d to = map.at[v];
      map.at[v] = before[v];
      slide_to(map, v, to);
      continue;
    }
    const auto walked = walk(map.domain, map.home[v], before[v], map.at[v]);
    if (walked) move_home(map, v, walked->home, walked->at, walked->back);
    else map.at[v] = before[v];
  }
}

namespace {

/// Every vertex, near ones near each other.
std::vector<VertexId> vertices_in_order(const WorkingMap& map) {
  if (!map.is_compact) return vertices_by_triangle(map);
  std::vector<VertexId> vertices(map.home.size());
  std::iota(vertices.begin(), vertices.end(), 0);
  return vertices;
}

double relax_in_order(WorkingMap& map, const std::vector<VertexId>& order, const RelaxOptions& options) {
  Sweeper sweeper(map, order);
  double fallen = 0;
  for (int i = 0; i < options.most_sweeps; ++i) {
    const Sweeper::Gain gain = sweeper.sweep(i % 2 == 1);
    fallen += gain.fallen;
    // A triangle is visited from each of its corners.
    if (gain.fallen <= options.tolerance * gain.excess / 3) break;
  }
  return fallen;
}

}  // namespace

double relax_all(WorkingMap& map, const RelaxOptions& options) {
  return on_compact_copy(map, [&](WorkingMap& near) { return relax_in_order(near, vertices_in_order(near), options); });
}

}  // namespace lozenge
