#include "formats/files/skinned_vertices.h"

#include <algorithm>
#include <cmath>

#include "formats/base/vector.h"

namespace lozenge {

namespace {

constexpr std::size_t kWidth = kInfluences.components;
constexpr std::size_t kMost = kWidth / 2;

double weight_of(const float* influence, float joint) {
  double weight = 0;
  for (std::size_t i = 0; i < kMost; ++i) weight += influence[i] == joint ? influence[kMost + i] : 0;
  return weight;
}

/// How much of `a` follows other joints than `b` does.
double share_apart(const float* a, const float* b) {
  double apart = 0;
  for (std::size_t i = 0; i < kMost; ++i) {
    if (a[kMost + i] > 0) apart += std::max(a[kMost + i] - weight_of(b, a[i]), 0.0);
  }
  return apart;
}

Vec3d offset_at(const AttributeStream& stream, std::size_t vertex) { return Vec3d(vector_at<Vec3f>(stream, vertex)); }

}  // namespace

std::int64_t repair_influences(std::vector<float>& values, std::size_t joints) {
  std::int64_t repaired = 0;
  for (std::size_t at = 0; at + kWidth <= values.size(); at += kWidth) {
    float* joint = &values[at];
    float* weight = joint + kMost;
    double total = 0;
    bool sound = true;
    for (std::size_t i = 0; i < kMost; ++i) {
      if (!(joint[i] < static_cast<float>(joints))) {
        sound = false;
        joint[i] = weight[i] = 0;
      }
      total += weight[i];
    }
    if (sound) continue;
    ++repaired;
    for (std::size_t i = 0; i < kMost && total > 0; ++i) weight[i] = static_cast<float>(weight[i] / total);
    if (!(total > 0)) weight[0] = 1;
  }
  return repaired;
}

MovesAlike::MovesAlike(const AttributeStreams& vertices) : influences_(find_stream(vertices, kInfluences)) {
  constexpr double kRounding = 1e-3;  // of the target's longest offset
  for (const AttributeStream& stream : vertices) {
    if (!(stream.kind == kMorphOffsets)) continue;
    double longest = 0;
    for (std::size_t v = 0; v < stream.count(); ++v) longest = std::max(longest, offset_at(stream, v).length2());
    offsets_.push_back({&stream, kRounding * kRounding * longest});
  }
}

bool MovesAlike::operator()(std::size_t a, std::size_t b) const {
  constexpr double kMostApart = 0.05;
  if (influences_ != nullptr && (share_apart(influences_->at(a), influences_->at(b)) > kMostApart ||
                                 share_apart(influences_->at(b), influences_->at(a)) > kMostApart)) {
    return false;
  }
  return std::all_of(offsets_.begin(), offsets_.end(), [&](const Offsets& offsets) {
    return (offset_at(*offsets.stream, a) - offset_at(*offsets.stream, b)).length2() <= offsets.most_apart;
  });
}

void share_offsets(const std::vector<unsigned int>& welded, AttributeStreams& vertices) {
  std::vector<std::size_t> first(welded.size(), welded.size());  // [number]
  for (std::size_t v = 0; v < welded.size(); ++v) {
    std::size_t& of_number = first[welded[v]];
    if (of_number == welded.size()) of_number = v;
    for (AttributeStream& stream : vertices) {
      if (stream.kind == kMorphOffsets) std::copy_n(stream.at(of_number), 3, stream.at(v));
    }
  }
}

}  // namespace lozenge
