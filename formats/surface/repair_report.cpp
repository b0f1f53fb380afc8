#include "formats/surface/repair_report.h"

#include <fmt/format.h>

#include <algorithm>

namespace lozenge {

namespace {

struct Words {
  std::string_view key;
  std::string_view one;
  std::string_view many;
  std::string_view fate;
};

constexpr std::array<Words, kRepairKinds> kWords{{
    {"degenerate_triangles", "triangle", "triangles", "left out with two equal corners"},
    {"t_junctions", "vertex", "vertices", "joined that lay on another triangle's edge"},
    {"duplicate_triangles", "triangle", "triangles", "left out that lay on another one"},
    {"two_sided_triangles", "triangle", "triangles",
     "left out that lay the other way round on one that is shown from both sides instead"},
    {"layers", "triangle", "triangles", "parted that lay the other way round on one that looks otherwise"},
    {"flat_triangles", "triangle", "triangles", "left out without area"},
    {"turned_triangles", "triangle", "triangles", "turned over to face the way of the neighbours"},
    {"cut_edges", "edge", "edges", "cut because the surface is one-sided there"},
    {"crowded_edges", "edge", "edges", "of three or more triangles parted into sheets"},
    {"bow_tie_vertices", "vertex", "vertices", "parted where pieces touched in a point"},
    {"divided_edges", "edge", "edges", "divided in two where two edges had the same ends"},
    {"filled_holes", "hole", "holes", "filled"},
}};

}  // namespace

void RepairReport::add(RepairKind kind, const Vec3f& where) {
  Repair& repair = repairs_[static_cast<std::size_t>(kind)];
  ++repair.count;
  if (repair.where.size() < kMostPlaces) repair.where.push_back(where);
}

void RepairReport::add(RepairKind kind, std::int64_t count, const std::vector<Vec3f>& where) {
  Repair& repair = repairs_[static_cast<std::size_t>(kind)];
  repair.count += count;
  for (const Vec3f& place : where) {
    if (repair.where.size() < kMostPlaces) repair.where.push_back(place);
  }
}

bool RepairReport::none() const {
  return std::all_of(repairs_.begin(), repairs_.end(), [](const Repair& repair) { return repair.count == 0; });
}

std::string_view key_of(RepairKind kind) { return kWords[static_cast<std::size_t>(kind)].key; }

std::vector<std::string> repair_lines(const RepairReport& report) {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < kRepairKinds; ++k) {
    const Repair& repair = report[static_cast<RepairKind>(k)];
    if (repair.count == 0) continue;
    std::string line =
        fmt::format("{} {} {}", repair.count, repair.count == 1 ? kWords[k].one : kWords[k].many, kWords[k].fate);
    if (!repair.where.empty()) {
      const Vec3f& p = repair.where.front();
      line += fmt::format("{} ({:.7g}, {:.7g}, {:.7g})", repair.count == 1 ? ", at" : ", the first at", p.x, p.y, p.z);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace lozenge
