#include "stages/info/describe_rig.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/surface/pose.h"
#include "stages/info/facts.h"

namespace lozenge {

namespace {

/// Those that have a name by it.
std::vector<std::string> names_of(const std::vector<MorphTarget>& targets) {
  std::vector<std::string> names;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    names.push_back(targets[t].name.empty() ? fmt::format("target {}", t) : targets[t].name);
  }
  return names;
}

}  // namespace

void add_rig(Facts& facts, const Rig& rig) {
  facts.add("rig", {{"nodes", rig.nodes.size()}, {"skins", rig.skins.size()}, {"animations", rig.animations.size()}},
            rig.empty() ? ""
                        : fmt::format("moved by     {} nodes, {} skins, {} animations", rig.nodes.size(),
                                      rig.skins.size(), rig.animations.size()));
  Json list = Json::array();
  for (std::size_t a = 0; a < rig.animations.size(); ++a) {
    const Animation& animation = rig.animations[a];
    const double seconds = time_range(animation).last;
    list.push_back({{"name", animation.name}, {"seconds", seconds}, {"channels", animation.channels.size()}});
    facts.line(fmt::format("animation {:<2} {}: {:.2f} s, {} channels", a, animation.name, seconds,
                           animation.channels.size()));
  }
  facts.add("moving_animations", list, "");
}

void add_bodies(Facts& facts, const Bodies& bodies) {
  Json list = Json::array();
  for (const Body& body : bodies.bodies) {
    const auto moving =
        std::count_if(body.places.begin(), body.places.end(), [](const BodyPlace& place) { return place.node >= 0; });
    const std::vector<std::string> targets = names_of(body.targets);
    list.push_back({{"name", body.name},
                    {"skin", body.skin},
                    {"places", body.places.size()},
                    {"moving", moving},
                    {"morph_targets", targets}});
    facts.line(fmt::format("body         {}: {}{}{}", body.name,
                           body.skin >= 0 ? "a skin"
                           : moving > 0   ? "moved by a node"
                                          : "stands still",
                           body.places.size() > 1 ? fmt::format(", in {} places", body.places.size()) : "",
                           targets.empty() ? "" : fmt::format(", morph targets {}", fmt::join(targets, ", "))));
  }
  facts.add("bodies", list, "");
}

}  // namespace lozenge
