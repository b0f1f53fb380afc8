#include "tools/pose_options.h"

namespace lozenge {

void declare_pose(Options& options, PoseArguments& arguments) {
  options.number("--time S", arguments.time, {0}, "As it stands S seconds into an animation; without it, at rest");
  options
      .number("--animation K", arguments.animation, {0},
              "Which animation, of those that move something; 0 is the first (`info` lists them)")
      .shows_default();
}

}  // namespace lozenge
