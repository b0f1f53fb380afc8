// The map of a source, kept from one build to the next: what import and parameterize made. Finding it is most of the
// work that doesn't depend on the options of samples and maps.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"
#include "pipeline/cache/cache.h"
#include "pipeline/quality/quality_report.h"

namespace lozenge {

/// What a build knows once it has the map.
struct StoredMap {
  SourceMesh surface;
  Parameterization map;
  QualityReport facts;  ///< source, instances, repairs, domain, distortion
  std::vector<std::string> notes;
};

/// Makes the facts of the map those of `report`.
void take_facts_of_map(const QualityReport& facts, QualityReport& report);

class MapStore {
 public:
  /// \param key  of the asset, and all options of import and parameterize
  MapStore(const Cache& cache, std::string key) : cache_(cache), key_(std::move(key)) {}

  std::optional<StoredMap> find() const;
  /// Where that fails, the map is found again another time.
  void store(const SourceMesh& surface, const Parameterization& map, const QualityReport& facts,
             const std::vector<std::string>& notes) const;

 private:
  const Cache& cache_;
  std::string key_;
};

/// The facts and notes as JSON, and back. \throws nlohmann::json::exception where the text isn't such
std::string map_facts_text(const QualityReport& facts, const std::vector<std::string>& notes);
void read_map_facts(const std::string& text, QualityReport& facts, std::vector<std::string>& notes);

}  // namespace lozenge
