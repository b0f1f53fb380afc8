#include "pipeline/quality/quality_report.h"

#include <fmt/format.h>

#include <bit>
#include <nlohmann/json.hpp>
#include <numbers>

#include "formats/base/atomic_file.h"
#include "formats/base/version.h"

namespace lozenge {
namespace {

using Json = nlohmann::ordered_json;

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

Json json_of(const SurfaceFacts& facts) {
  return {
      {"vertices", facts.vertices}, {"triangles", facts.triangles},           {"components", facts.components},
      {"euler", facts.euler},       {"boundary_loops", facts.boundary_loops}, {"boundary_edges", facts.boundary_edges}};
}

Json json_of(const InstanceFacts& facts) {
  return {{"placed", facts.placed}, {"repeated", facts.repeated}, {"copies", facts.copies}};
}

Json json_of(const RepairReport& report) {
  Json json = Json::object();
  for (std::size_t k = 0; k < kRepairKinds; ++k) {
    const auto kind = static_cast<RepairKind>(k);
    if (report[kind].count == 0) continue;
    Json where = Json::array();
    for (const Vec3f& p : report[kind].where) where.push_back({p.x, p.y, p.z});
    json[std::string(key_of(kind))] = {{"count", report[kind].count}, {"where", std::move(where)}};
  }
  return json;
}

Json json_of(const DomainFacts& facts) {
  Json json{
      {"triangles", facts.triangles}, {"vertices", facts.vertices}, {"irregular_vertices", facts.irregular_vertices}};
  if (facts.least_triangles > 0) json["least_triangles"] = facts.least_triangles;
  if (facts.asked[1] > 0) json["asked"] = facts.asked;
  if (!facts.parts_by_first_level.empty()) json["parts_by_first_level"] = facts.parts_by_first_level;
  return json;
}

Json json_of(const Distortion& distortion) {
  return {{"area", distortion.area},
          {"angle", distortion.angle},
          {"aggregate", distortion.aggregate},
          {"l2_stretch", distortion.l2_stretch},
          {"folded_triangles", distortion.folded_triangles},
          {"area_sum_error", distortion.area_sum_error}};
}

Json json_of(const PatchFacts& facts) {
  return {{"count", facts.count}, {"samples", facts.samples}, {"levels", facts.levels}};
}

Json json_of(const LevelQuality& level) {
  Json json{{"triangles", level.triangles}, {"vertices", level.vertices}};
  if (level.mean_distance_percent) json["mean_distance_percent"] = *level.mean_distance_percent;
  if (level.max_distance_percent) json["max_distance_percent"] = *level.max_distance_percent;
  if (level.normal_angle) json["normals_degrees"] = degrees(*level.normal_angle);
  return json;
}

Json json_of(const AssetQuality& asset) {
  Json triangles = Json::array();
  Json levels = Json::array();
  for (const LevelQuality& level : asset.level_qualities) {
    triangles.push_back(level.triangles);
    levels.push_back(json_of(level));
  }
  Json json = {{"triangles", asset.triangles},
               {"vertices", asset.vertices},
               {"source_triangles", asset.source_triangles},
               {"levels", asset.levels},
               {"level_triangles", std::move(triangles)},
               {"lods", std::move(levels)}};
  if (asset.mean_distance_percent) json["mean_distance_percent"] = *asset.mean_distance_percent;
  if (asset.max_distance_percent) json["max_distance_percent"] = *asset.max_distance_percent;
  if (asset.boundary_max_distance_percent) {
    json["boundary_max_distance_percent"] = *asset.boundary_max_distance_percent;
  }
  return json;
}

Json json_of(const BakeStatistics& bake) {
  Json json{{"texels", bake.texels},
            {"rays", bake.rays},
            {"rays_per_second", bake.rays_per_second},
            {"fallback_texels", bake.fallback_texels},
            {"unused_texels", bake.unused_texels},
            {"cage_distance", bake.cage_distance}};
  if (bake.map_size > 0) json["map_size"] = bake.map_size;
  if (bake.dark_share) json["dark_share"] = *bake.dark_share;
  for (const MapKind kind : bake.constant_maps) json["constant_maps"].push_back(traits_of(kind).option);
  return json;
}

Json json_of(const PosedFacts& facts) {
  Json levels = Json::array();
  for (const PosedLevel& level : facts.levels) {
    levels.push_back({{"rest_mean_percent", level.rest_percent},
                      {"worst_mean_percent", level.worst_percent},
                      {"animation", level.animation},
                      {"time", level.time}});
  }
  return {{"count", facts.poses}, {"levels", std::move(levels)}};
}

Json json_of(const std::vector<StageCost>& stages) {
  Json list = Json::array();
  for (const StageCost& stage : stages) {
    list.push_back({{"name", stage.name}, {"seconds", stage.seconds}, {"peak_memory_mb", stage.peak_memory_mb}});
  }
  return list;
}

/// "3 at scale 1, 20 at 1/2, 5 at 1/8"; nothing where all have the same.
std::string words_on_scales(const std::vector<std::int64_t>& parts_by_first_level) {
  if (parts_by_first_level.size() < 2) return "";
  std::string words;
  for (std::size_t k = 0; k < parts_by_first_level.size(); ++k) {
    if (parts_by_first_level[k] == 0) continue;
    words += fmt::format("{}{} at {}", words.empty() ? "" : ", ", parts_by_first_level[k],
                         k == 0 ? "scale 1" : fmt::format("1/{}", std::int64_t{1} << k));
  }
  return words;
}

/// "level 1     7200 triangles, 0.0329 % mean, 0.352 % largest, normals off by 4.6 degrees".
std::string words_on_level(std::size_t number, const LevelQuality& level) {
  std::string words = fmt::format("level {:<5} {} triangles", number, level.triangles);
  if (level.mean_distance_percent && level.max_distance_percent) {
    words +=
        fmt::format(", {:.4f} % mean, {:.3f} % largest", *level.mean_distance_percent, *level.max_distance_percent);
  }
  if (level.normal_angle) words += fmt::format(", normals off by {:.1f} degrees", degrees(*level.normal_angle));
  return words;
}

}  // namespace

DomainFacts domain_facts(const Domain& domain) {
  return {domain.size(), domain.vertex_count, count_irregular(domain), 0, {}, {}};
}

PatchFacts patch_facts(const PatchSet& patches) {
  // Samples a side halve from level to level until 2 are left: N = 2^k + 1 has k + 1 levels.
  const auto steps = static_cast<unsigned>(patches.layout.samples - 1);
  return {patches.size(), patches.layout.samples, std::bit_width(steps)};
}

PatchFacts patch_facts(const GeometryImage& image) {
  return {image.size(), image.layout.samples, static_cast<std::int64_t>(image.levels.size())};
}

AssetQuality asset_quality(const AssetFacts& facts) {
  return {facts.triangles, facts.vertices, facts.source_triangles, facts.levels, facts.level_qualities, {}, {}, {}};
}

std::string report_json(const QualityReport& report) {
  Json json = Json::object();
  if (report.source) json["source"] = json_of(*report.source);
  if (report.instances) json["instances"] = json_of(*report.instances);
  if (report.repairs) json["repairs"] = json_of(*report.repairs);
  if (report.domain) json["domain"] = json_of(*report.domain);
  if (report.distortion) json["distortion"] = json_of(*report.distortion);
  if (report.patches) json["patches"] = json_of(*report.patches);
  if (report.asset) json["asset"] = json_of(*report.asset);
  if (report.poses) json["poses"] = json_of(*report.poses);
  if (report.bake) json["bake"] = json_of(*report.bake);
  json["stages"] = json_of(report.stages);
  json["seconds"] = report.seconds;
  json["peak_memory_mb"] = report.peak_memory_mb;
  json["lozenge"] = version();
  json["input"] = report.input;
  // A name of a file may be any bytes; JSON is UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::vector<std::string> report_lines(const QualityReport& report) {
  std::vector<std::string> lines;
  if (const auto& s = report.source) {
    lines.push_back(fmt::format("source      {} triangles, {} vertices, {} component{}, Euler characteristic {}",
                                s->triangles, s->vertices, s->components, s->components == 1 ? "" : "s", s->euler));
    if (s->boundary_edges > 0) {
      lines.push_back(fmt::format("boundary    {} loop{} of {} edges", s->boundary_loops,
                                  s->boundary_loops == 1 ? "" : "s", s->boundary_edges));
    }
  }
  if (const auto& i = report.instances; i && i->repeated > 0) {
    lines.push_back(fmt::format(
        "instances   {} placements, {} of them of meshes that are placed more than once, {} of those copies", i->placed,
        i->repeated, i->copies));
  }
  if (const auto& d = report.domain) {
    const std::string asked =
        d->asked[1] > 0 ? fmt::format(", looked for from {} to {}", d->asked[0], d->asked[1]) : "";
    lines.push_back(fmt::format("domain      {} triangles{}, {} vertices, {} of them irregular", d->triangles, asked,
                                d->vertices, d->irregular_vertices));
    if (const std::string parts = words_on_scales(d->parts_by_first_level); !parts.empty()) {
      lines.push_back("parts       " + parts);
    }
  }
  if (const auto& d = report.distortion) {
    lines.push_back(fmt::format("distortion  area {:.4f}, angle {:.4f}, aggregate {:.4f}, L2 stretch {:.3f}, {} folded",
                                d->area, d->angle, d->aggregate, d->l2_stretch, d->folded_triangles));
  }
  if (const auto& p = report.patches) {
    lines.push_back(fmt::format("patches     {} of {} x {} samples, {} levels of detail", p->count, p->samples,
                                p->samples, p->levels));
  }
  if (const auto& a = report.asset) {
    const std::string own = a->source_triangles == 0 ? ""
                            : a->source_triangles == a->triangles
                                ? ", the source's own"
                                : fmt::format(", {} of the triangles the source's own", a->source_triangles);
    lines.push_back(fmt::format("asset       {} triangles, {} vertices{}", a->triangles, a->vertices, own));
    if (a->mean_distance_percent && a->max_distance_percent) {
      lines.push_back(fmt::format("distance    {:.4f} % mean, {:.3f} % largest, of the box diagonal",
                                  *a->mean_distance_percent, *a->max_distance_percent));
    }
    if (a->boundary_max_distance_percent) {
      lines.push_back(fmt::format("boundary    {:.4f} % largest distance", *a->boundary_max_distance_percent));
    }
  }
  if (report.asset && (report.asset->level_qualities.size() > 1 || !report.asset->mean_distance_percent)) {
    for (std::size_t l = 0; l < report.asset->level_qualities.size(); ++l) {
      lines.push_back(words_on_level(l, report.asset->level_qualities[l]));
    }
  }
  if (const auto& b = report.bake) {
    if (b->map_size > 0) lines.push_back(fmt::format("maps        {0} x {0} texels", b->map_size));
    std::string constant;
    for (const MapKind kind : b->constant_maps) {
      constant += fmt::format("{}{}", constant.empty() ? "" : ", ", traits_of(kind).option);
    }
    if (!constant.empty()) lines.push_back("no maps     " + constant + ": the same everywhere, so factors");
    lines.push_back(fmt::format("bake        {} texels, {} rays, {:.2f} million a second, {} fell back", b->texels,
                                b->rays, b->rays_per_second / 1e6, b->fallback_texels));
  }
  for (const StageCost& stage : report.stages) {
    lines.push_back(
        fmt::format("time        {:<13} {:8.2f} s {:8.0f} MB", stage.name, stage.seconds, stage.peak_memory_mb));
  }
  lines.push_back(fmt::format("total       {:.2f} s, {:.0f} MB", report.seconds, report.peak_memory_mb));
  return lines;
}

void write_report(const std::filesystem::path& path, const QualityReport& report) {
  write_file_whole(path, report_json(report) + "\n");
}

}  // namespace lozenge
