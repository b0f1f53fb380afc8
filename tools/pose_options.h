// At which time of which animation a file is looked at.
#pragma once

#include <optional>

#include "formats/surface/pose.h"
#include "tools/command_line.h"

namespace lozenge {

struct PoseArguments {
  std::optional<double> time;
  int animation = 0;

  /// Nothing: at rest.
  std::optional<Pose> pose() const { return time ? std::optional<Pose>({animation, *time}) : std::nullopt; }
};

void declare_pose(Options& options, PoseArguments& arguments);

}  // namespace lozenge
