#include "formats/files/skinned_vertices.h"

#include <algorithm>
#include <cmath>

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

bool move_alike(const float* a, const float* b) {
  constexpr double kMostApart = 0.05;
  return share_apart(a, b) <= kMostApart && share_apart(b, a) <= kMostApart;
}

}  // namespace lozenge
