#include "formats/files/readers/gltf/mend_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "formats/files/readers/gltf/json.h"

namespace lozenge {

namespace {

using nlohmann::json;

using RequireAccessor = std::function<void(const GltfObject&, const char*)>;

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

bool is_list_of_numbers(const json& value, std::size_t count) {
  return value.is_array() && value.size() == count &&
         std::all_of(value.begin(), value.end(), [](const json& item) { return item.is_number(); });
}

class NodeMender {
 public:
  NodeMender(json& document, const std::vector<bool>& has_primitives, const RequireAccessor& require_accessor,
             const std::string& name, Deviations& deviations)
      : document_(document),
        has_primitives_(has_primitives),
        require_accessor_(require_accessor),
        name_(name),
        deviations_(deviations) {}

  void run() {
    const std::size_t count = size_of("nodes");
    parents_.resize(count);
    for (std::size_t n = 0; n < count; ++n) {
      json& node = document_["nodes"][n];
      mend_references(node, n);
      mend_transform(node, n);
      mend_instancing(node, n);
      mend_children(node, n);
    }
    cut_cycles();
    for (std::size_t s = 0; s < size_of("scenes"); ++s) mend_scene(document_["scenes"][s], s);
    if (document_.contains("scene") && !names_one_of(document_["scene"], size_of("scenes"))) {
      deviations_.add(Deviation::kNothingThere, name_ + ": scene is " + document_["scene"].dump() + ", but there are " +
                                                    std::to_string(size_of("scenes")));
      document_.erase("scene");
    }
  }

 private:
  std::size_t size_of(const char* key) const {
    const auto at = document_.find(key);
    return at == document_.end() ? 0 : at->size();
  }

  std::string place(std::size_t node) const { return name_ + ": node " + std::to_string(node); }

  static bool names_one_of(const json& value, std::size_t count) {
    return value.is_number_unsigned() && value.get<std::uint64_t>() < count;
  }

  void mend_references(json& node, std::size_t n) {
    constexpr std::array<std::pair<const char*, const char*>, 3> kReferences{
        {{"mesh", "meshes"}, {"skin", "skins"}, {"camera", "cameras"}}};
    for (const auto& [key, list] : kReferences) {
      if (!node.contains(key) || names_one_of(node[key], size_of(list))) continue;
      deviations_.lose(Deviation::kNothingThere, place(n) + ": " + key + " is " + node[key].dump() +
                                                     ", but there are " + std::to_string(size_of(list)));
      node.erase(key);
    }
    if (node.contains("mesh") && !has_primitives_[node["mesh"].get<std::size_t>()]) node.erase("mesh");
  }

  void mend_transform(json& node, std::size_t n) {
    constexpr std::array<std::pair<const char*, std::size_t>, 4> kProperties{
        {{"matrix", 16}, {"translation", 3}, {"rotation", 4}, {"scale", 3}}};
    for (const auto& [key, count] : kProperties) {
      if (!node.contains(key) || is_list_of_numbers(node[key], count)) continue;
      deviations_.add(Deviation::kWrongType,
                      place(n) + ": " + key + " is not a list of " + std::to_string(count) + " numbers");
      node.erase(key);
    }
    if (node.contains("matrix")) mend_matrix(node["matrix"], n);
    if (!node.contains("rotation")) return;
    double square = 0;
    for (const json& x : node["rotation"]) square += x.get<double>() * x.get<double>();
    if (square > 0 && std::isfinite(square)) return;
    deviations_.add(Deviation::kRotation, place(n) + ": its rotation is not a quaternion of unit length");
    node.erase("rotation");
  }

  /// A last row that isn't 0 0 0 1: exporters round 1, and viewers don't look at it.
  void mend_matrix(json& matrix, std::size_t n) {
    bool is_affine = true;
    for (std::size_t column = 0; column < 4; ++column) {
      json& last = matrix[4 * column + 3];
      const double right = column == 3 ? 1 : 0;
      if (last.get<double>() == right) continue;
      is_affine = false;
      last = right;
    }
    if (!is_affine) deviations_.add(Deviation::kMatrix, place(n) + ": its matrix is not affine");
  }

  /// Where instances stand isn't known when their attributes can't be read.
  void mend_instancing(json& node, std::size_t n) {
    const auto extensions = node.find("extensions");
    if (extensions == node.end()) return;
    if (!extensions->is_object()) {
      deviations_.add(Deviation::kWrongType, place(n) + ": extensions is not a JSON object");
      node.erase("extensions");
      return;
    }
    const auto at = extensions->find(kInstancing);
    if (at == extensions->end()) return;
    try {
      const auto attributes = GltfObject(*at, place(n) + ", " + kInstancing).object("attributes");
      if (!attributes)
        throw Error(ExitCode::kUnusableInput, place(n) + ", " + kInstancing + ": attributes are missing");
      for (const char* key : {"TRANSLATION", "ROTATION", "SCALE"}) {
        if (attributes->has(key)) require_accessor_(*attributes, key);
      }
    } catch (const Error& error) {
      if (error.code() != ExitCode::kUnusableInput) throw;
      deviations_.lose(Deviation::kBrokenPrimitive, error.what());
      extensions->erase(kInstancing);
      node.erase("mesh");
    }
  }

  /// Each node has one parent: the first that names it.
  void mend_children(json& node, std::size_t n) {
    const auto children = node.find("children");
    if (children == node.end()) return;
    if (!children->is_array()) {
      deviations_.add(Deviation::kWrongType, place(n) + ": children is not a list");
      node.erase(children);
      return;
    }
    std::erase_if(children->get_ref<json::array_t&>(), [&](const json& child) {
      if (!names_one_of(child, parents_.size())) {
        deviations_.add(Deviation::kNothingThere, place(n) + ": children names " + child.dump() + ", but there are " +
                                                      std::to_string(parents_.size()));
        return true;
      }
      const auto c = child.get<std::size_t>();
      if (parents_[c]) {
        deviations_.add(Deviation::kTree, place(c) + ": is a child of node " + std::to_string(*parents_[c]) +
                                              " and of node " + std::to_string(n) + "; nodes must form trees");
        return true;
      }
      parents_[c] = n;
      return false;
    });
    if (children->empty()) node.erase("children");
  }

  template <typename Visit>
  void walk_below(std::size_t top, const Visit& visit) const {
    std::vector<std::size_t> open{top};
    while (!open.empty()) {
      const std::size_t n = open.back();
      open.pop_back();
      if (!visit(n)) continue;
      const json& node = document_["nodes"][n];
      if (!node.contains("children")) continue;
      for (const json& child : node["children"]) open.push_back(child.get<std::size_t>());
    }
  }

  /// With one parent each, a node that no top leads to is below itself.
  void cut_cycles() {
    std::vector<bool> reached(parents_.size(), false);
    const auto reach = [&](std::size_t n) {
      const bool is_new = !reached[n];
      reached[n] = true;
      return is_new;
    };
    for (std::size_t n = 0; n < parents_.size(); ++n) {
      if (!parents_[n]) walk_below(n, reach);
    }
    for (std::size_t n = 0; n < parents_.size(); ++n) {
      if (reached[n]) continue;
      deviations_.add(Deviation::kTree, place(n) + ": is below itself; nodes must form trees");
      json& siblings = document_["nodes"][*parents_[n]]["children"];
      std::erase_if(siblings.get_ref<json::array_t&>(), [&](const json& child) { return child == n; });
      if (siblings.empty()) document_["nodes"][*parents_[n]].erase("children");
      parents_[n].reset();
      walk_below(n, reach);
    }
  }

  /// Its nodes exist, none twice, none below another one of them.
  void mend_scene(json& scene, std::size_t s) {
    const auto nodes = scene.find("nodes");
    if (nodes == scene.end()) return;
    const std::string where = name_ + ": scene " + std::to_string(s);
    if (!nodes->is_array()) {
      deviations_.add(Deviation::kWrongType, where + ": nodes is not a list");
      scene.erase(nodes);
      return;
    }
    auto& list = nodes->get_ref<json::array_t&>();
    std::vector<bool> is_root(parents_.size(), false);
    std::erase_if(list, [&](const json& node) {
      if (!names_one_of(node, parents_.size())) {
        deviations_.add(Deviation::kNothingThere,
                        where + ": nodes names " + node.dump() + ", but there are " + std::to_string(parents_.size()));
        return true;
      }
      const auto n = node.get<std::size_t>();
      if (is_root[n]) deviations_.add(Deviation::kTree, place(n) + ": is in the scene twice");
      const bool is_again = is_root[n];
      is_root[n] = true;
      return is_again;
    });
    const std::vector<bool> is_below = below_others(list);
    std::erase_if(list, [&](const json& node) {
      const auto n = node.get<std::size_t>();
      if (is_below[n]) deviations_.add(Deviation::kTree, place(n) + ": is in the scene twice");
      return is_below[n];
    });
    if (list.empty()) scene.erase("nodes");
  }

  /// [node] whether it is below one of the roots.
  std::vector<bool> below_others(const json::array_t& roots) const {
    std::vector<bool> is_below(parents_.size(), false);
    for (const json& root : roots) {
      const auto top = root.get<std::size_t>();
      // What is below another root is walked over from there.
      if (is_below[top]) continue;
      walk_below(top, [&](std::size_t n) {
        if (n == top) return true;
        const bool is_new = !is_below[n];
        is_below[n] = true;
        return is_new;
      });
    }
    return is_below;
  }

  json& document_;
  const std::vector<bool>& has_primitives_;
  const RequireAccessor& require_accessor_;
  const std::string& name_;
  Deviations& deviations_;
  std::vector<std::optional<std::size_t>> parents_;
};

}  // namespace

void mend_gltf_nodes(json& document, const std::vector<bool>& has_primitives, const RequireAccessor& require_accessor,
                     const std::string& name, Deviations& deviations) {
  NodeMender(document, has_primitives, require_accessor, name, deviations).run();
}

}  // namespace lozenge
