#include "formats/surface/distinct_positions.h"

#include <algorithm>
#include <array>
#include <bit>
#include <set>

#include "formats/base/parallel.h"

namespace lozenge {

namespace {

using Bits = std::array<std::uint32_t, 3>;

Bits bits_of(const Vec3f& p) {
  return {std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y), std::bit_cast<std::uint32_t>(p.z)};
}

Vec3f position_of(const Bits& bits) {
  return {std::bit_cast<float>(bits[0]), std::bit_cast<float>(bits[1]), std::bit_cast<float>(bits[2])};
}

/// The float `steps` floats further from zero, or nearer where there are no more.
float stepped(float x, std::uint32_t steps) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const bool fits = (bits & 0x7FFFFFFF) + steps < 0x7F800000;
  return std::bit_cast<float>(fits ? bits + steps : bits - steps);
}

/// Position number `n` of those around p, 0 being p itself: its bits, dealt to the three axes in turn, are the steps
/// along each, so that the first n fill a cube and stay near.
Vec3f nudged(const Vec3f& p, std::uint32_t n) {
  std::array<std::uint32_t, 3> steps{};
  for (int bit = 0; bit < 32; ++bit) steps[bit % 3] |= ((n >> bit) & 1) << (bit / 3);
  return {stepped(p.x, steps[0]), stepped(p.y, steps[1]), stepped(p.z, steps[2])};
}

}  // namespace

NumberedPosition numbered(const Vec3f& position, std::int32_t number) { return {bits_of(position), number}; }

std::vector<MovedPosition> moved_apart(const std::vector<NumberedPosition>& places) {
  std::vector<MovedPosition> moves;
  std::set<Bits> taken;  // by those that were moved
  const auto is_free = [&](const Bits& bits) {
    const auto at = std::lower_bound(places.begin(), places.end(), NumberedPosition{bits, 0});
    return (at == places.end() || at->bits != bits) && !taken.contains(bits);
  };
  std::uint32_t tried = 0;  // of the positions around the current one
  for (std::size_t n = 1; n < places.size(); ++n) {
    if (places[n].bits != places[n - 1].bits) {
      tried = 0;
      continue;
    }
    const Vec3f here = position_of(places[n].bits);
    Vec3f moved = here;
    while (!is_free(bits_of(moved))) moved = nudged(here, ++tried);
    taken.insert(bits_of(moved));
    moves.push_back({places[n].number, moved});
  }
  return moves;
}

std::int64_t make_distinct(std::vector<Vec3f>& positions) {
  std::vector<NumberedPosition> places;
  places.reserve(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    places.push_back(numbered(positions[v], static_cast<std::int32_t>(v)));
  }
  sort_on_all_threads(places);
  const std::vector<MovedPosition> moves = moved_apart(places);
  for (const MovedPosition& move : moves) positions[move.number] = move.position;
  return static_cast<std::int64_t>(moves.size());
}

}  // namespace lozenge
