// Texture maps: baked, or filled by the caller, and the asset that is made of them.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "formats/base/error.h"
#include "formats/files/texture_files.h"
#include "pipeline/maps/map_files.h"
#include "pipeline/maps/map_size.h"
#include "stages/bake/bake.h"
#include "stages/export/export.h"
#include "tools/python/arrays.h"
#include "tools/python/bindings.h"
#include "tools/python/work.h"

namespace lozenge::python {
namespace {

MapKind kind_of(const std::string& name) {
  std::string all;
  for (const MapTraits& traits : kMapKinds) {
    if (traits.option == name) return traits.kind;
    all += fmt::format("{}{}", all.empty() ? "" : ", ", traits.option);
  }
  throw Error(ExitCode::kUsage, fmt::format("'{}' is no map; there are {}", name, all));
}

std::shared_ptr<Maps> bake_maps(const Map& map, const GeometryImage& image, const std::vector<std::string>& names,
                                std::int32_t size, std::optional<std::int32_t> gutter, std::int32_t rays, int threads,
                                const py::object& progress) {
  BakeOptions options;
  for (const std::string& name : names) options.maps.push_back(kind_of(name));
  options.size = size;
  options.gutter = gutter;
  options.occlusion_rays = rays;
  const Progress listener = progress_to(progress);
  const Work work(threads);
  options = with_map_size(options, map.surface, image.layout);
  options.level = level_to_export(image, {});
  std::optional<TextureFiles> textures;
  if (!map.surface.images.empty()) {
    textures.emplace(map.surface, texture_roles(options, map.surface), TextureLimits{}, listener);
  }
  return std::make_shared<Maps>(
      Maps{bake(map.surface, map.map, image, options, listener, textures ? &*textures : nullptr), {}});
}

BakedMap* find(BakedMaps& maps, const std::string& name) {
  const MapKind kind = kind_of(name);
  const auto at = std::find_if(maps.maps.begin(), maps.maps.end(), [&](const BakedMap& m) { return m.kind == kind; });
  return at == maps.maps.end() ? nullptr : &*at;
}

/// The texels, to be read and written.
py::array texels_of(const py::object& self, const std::string& name) {
  BakedMap* map = find(self.cast<Maps&>(), name);
  if (map == nullptr) throw py::key_error(name);
  return view<float>(map->texels.data(), {map->height(), map->width(), map->channels}, self, {}, true);
}

/// The texels of the layout, a side, for one of a map of this height.
std::int32_t shrink_for(const MapLayout& layout, const py::array& values) {
  const auto rows = values.shape(0);
  const bool fits = rows > 0 && layout.height % rows == 0 && values.shape(1) * (layout.height / rows) == layout.width;
  if (fits) return static_cast<std::int32_t>(layout.height / rows);
  throw Error(ExitCode::kUsage, fmt::format("a map of {} x {} texels doesn't fit the atlas of {} x {}", values.shape(1),
                                            rows, layout.width, layout.height));
}

void set_texels(Maps& maps, const std::string& name, const py::array& given) {
  const MapTraits& traits = traits_of(kind_of(name));
  if (maps.maps.empty()) throw Error(ExitCode::kUsage, "there is no map whose atlas this one could be over");
  const std::int32_t channels = given.ndim() == 2   ? 1
                                : given.ndim() == 3 ? static_cast<std::int32_t>(given.shape(2))
                                                    : 0;
  if (!may_have_channels(traits, channels)) {
    throw Error(ExitCode::kUsage, fmt::format("{}: is an array [height, width, {}]", name, traits.channels));
  }
  const auto values = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(given);
  if (!values) throw py::error_already_set();
  const NumberRange range = range_of(traits.values);
  std::vector<float> texels(values.data(), values.data() + values.size());
  const auto is_wrong = [&](float v) { return !std::isfinite(v) || v < range.least || v > range.most; };
  if (std::any_of(texels.begin(), texels.end(), is_wrong)) {
    throw Error(ExitCode::kUnusableInput,
                fmt::format("{}: its numbers are finite, from {} to {}", name, range.least, range.most));
  }
  const BakedMap& first = maps.maps.front();
  BakedMap made = neutral_map(traits.kind, first.layout, first.level, shrink_for(first.layout, values), channels);
  made.texels = std::move(texels);
  if (BakedMap* old = find(maps, name)) {
    maps.replaced.push_back(std::move(old->texels));
    *old = std::move(made);
    return;
  }
  maps.maps.push_back(std::move(made));
  std::stable_sort(maps.maps.begin(), maps.maps.end(), [](const auto& a, const auto& b) { return a.kind < b.kind; });
}

std::vector<std::string> names_of(const Maps& maps) {
  std::vector<std::string> names;
  for (const BakedMap& map : maps.maps) names.emplace_back(traits_of(map.kind).option);
  return names;
}

py::dict export_maps(const std::filesystem::path& path, const Map& map, const GeometryImage& image, const Maps& maps,
                     std::int64_t triangle_budget, int coarser_levels, const std::string& finest, int threads) {
  ExportOptions options;
  options.triangle_budget = triangle_budget;
  options.max_coarser_levels = coarser_levels;
  options.coarser_levels = coarser_levels != 0;
  if (finest == "source") {
    options.finest = Finest::kSource;
  } else if (finest == "samples") {
    options.finest = Finest::kSamples;
  } else if (finest != "auto") {
    throw Error(ExitCode::kUsage, "finest: '" + finest + "' isn't auto, source or samples");
  }
  AssetFacts facts;
  {
    const Work work(threads);
    const SourceSurface source{&map.surface, &map.map};
    facts = export_asset(path, image, maps, options, &source);
  }
  py::dict made;
  made["triangles"] = facts.triangles;
  made["source_triangles"] = facts.source_triangles;
  made["vertices"] = facts.vertices;
  made["level_triangles"] = facts.level_triangles;
  return made;
}

void write_map_files(const Maps& maps, const std::filesystem::path& folder, const std::string& name, int bits) {
  const Work work;
  write_maps(folder, name, maps, {MapFormat::kPng, bits});
}

}  // namespace

void bind_maps(py::module_& module) {
  py::class_<Maps, std::shared_ptr<Maps>>(
      module, "Maps",
      "Texture maps by name, all over one atlas: `maps[\"normal\"]` is float32 [height, width, channels], a view that "
      "may be written to; `maps[\"base-color\"] = array` adds one or replaces it. Colours are linear, from 0 to 1; "
      "directions are unit vectors.")
      .def("__getitem__", texels_of)
      .def("__setitem__", set_texels)
      .def("__contains__", [](Maps& maps, const std::string& name) { return find(maps, name) != nullptr; })
      .def("__len__", [](const Maps& maps) { return maps.maps.size(); })
      .def("__iter__", [](const Maps& maps) { return py::iter(py::cast(names_of(maps))); })
      .def("keys", names_of, "The names of the maps.")
      .def("write", write_map_files, py::arg("folder"), py::arg("name"), py::kw_only(), py::arg("bits") = 8,
           "NAME.normal.png and so on; positions as .exr.");
  module.def("_bake", bake_maps);
  module.def("_export", export_maps);
}

}  // namespace lozenge::python
