#include "pipeline/cache/map_store.h"

#include <nlohmann/json.hpp>

#include "formats/base/error.h"
#include "formats/base/scratch_folder.h"
#include "formats/files/parameterization_file.h"

namespace lozenge {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kMapPart = "map.glb";
constexpr const char* kFactsPart = "facts.json";

std::vector<Vec3f> places_in(const Json& json) {
  std::vector<Vec3f> places;
  for (const Json& p : json) places.emplace_back(p.at(0), p.at(1), p.at(2));
  return places;
}

/// Where the map's file is, while it is read or written.
ScratchFolder scratch_beside(const Cache& cache) {
  fs::create_directories(cache.folder());
  return {cache.folder(), ".map-"};
}

}  // namespace

void take_facts_of_map(const QualityReport& facts, QualityReport& report) {
  report.source = facts.source;
  report.instances = facts.instances;
  report.repairs = facts.repairs;
  report.domain = facts.domain;
  report.distortion = facts.distortion;
}

std::string map_facts_text(const QualityReport& facts, const std::vector<std::string>& notes) {
  QualityReport report;
  take_facts_of_map(facts, report);
  Json json = Json::parse(report_json(report));
  json["notes"] = notes;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void read_map_facts(const std::string& text, QualityReport& facts, std::vector<std::string>& notes) {
  const Json json = Json::parse(text);
  const Json& source = json.at("source");
  facts.source = SurfaceFacts{source.at("vertices"), source.at("triangles"),      source.at("components"),
                              source.at("euler"),    source.at("boundary_loops"), source.at("boundary_edges")};
  const Json& instances = json.at("instances");
  facts.instances = InstanceFacts{instances.at("placed"), instances.at("repeated"), instances.at("copies")};
  facts.repairs.emplace();
  for (std::size_t k = 0; k < kRepairKinds; ++k) {
    const auto kind = static_cast<RepairKind>(k);
    const auto found = json.at("repairs").find(std::string(key_of(kind)));
    if (found == json.at("repairs").end()) continue;
    facts.repairs->add(kind, found->at("count"), places_in(found->at("where")));
  }
  const Json& domain = json.at("domain");
  facts.domain = DomainFacts{domain.at("triangles"),
                             domain.at("vertices"),
                             domain.at("irregular_vertices"),
                             domain.value("least_triangles", std::int64_t{0}),
                             {},
                             {}};
  if (domain.contains("asked")) facts.domain->asked = domain.at("asked");
  if (domain.contains("parts_by_first_level")) {
    facts.domain->parts_by_first_level = domain.at("parts_by_first_level").get<std::vector<std::int64_t>>();
  }
  const Json& distortion = json.at("distortion");
  facts.distortion = Distortion{distortion.at("area"),
                                distortion.at("angle"),
                                distortion.at("aggregate"),
                                distortion.at("l2_stretch"),
                                distortion.at("folded_triangles"),
                                distortion.at("area_sum_error")};
  notes = json.at("notes").get<std::vector<std::string>>();
}

std::optional<StoredMap> MapStore::find() const {
  const std::optional<CacheEntry> entry = cache_.find(key_);
  if (!entry) return std::nullopt;
  try {
    const ScratchFolder scratch = scratch_beside(cache_);
    const fs::path file = scratch.path() / kMapPart;
    const std::optional<std::string> text = entry->text(kFactsPart);
    if (text && entry->extract(kMapPart, file)) {
      StoredMap stored;
      read_map_facts(*text, stored.facts, stored.notes);
      std::tie(stored.surface, stored.map) = read_parameterization(file);
      return stored;
    }
    cache_.discard(key_);
  } catch (const Error&) {
  } catch (const fs::filesystem_error&) {
  } catch (const nlohmann::json::exception&) {
    cache_.discard(key_);
  }
  return std::nullopt;
}

void MapStore::store(const SourceMesh& surface, const Parameterization& map, const QualityReport& facts,
                     const std::vector<std::string>& notes) const {
  try {
    const ScratchFolder scratch = scratch_beside(cache_);
    const fs::path file = scratch.path() / kMapPart;
    write_parameterization(file, surface, map);
    cache_.store(key_, {{{kMapPart, file}}, {{kFactsPart, map_facts_text(facts, notes)}}});
  } catch (const Error&) {
  } catch (const fs::filesystem_error&) {
  }
}

}  // namespace lozenge
