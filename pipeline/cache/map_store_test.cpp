#include "pipeline/cache/map_store.h"

#include <gtest/gtest.h>

namespace lozenge {
namespace {

TEST(MapStore, FactsComeBackAsTheyWere) {
  QualityReport facts;
  facts.source = SurfaceFacts{10, 20, 1, 2, 3, 4};
  facts.instances = InstanceFacts{5, 4, 3};
  facts.repairs.emplace();
  facts.repairs->add(RepairKind::kFilledHoles, 7, {{0.1f, -2, 3e-20f}, {1, 2, 3}});
  facts.domain = DomainFacts{30, 17, 12, 8, {20, 40}, {1, 0, 2}};
  facts.distortion = Distortion{0.1, 0.2, 1.0 / 3, 1.25, 0, 1e-17};
  const std::vector<std::string> notes{"2 lights aren't taken", "\"ä\""};

  QualityReport read;
  std::vector<std::string> read_notes;
  read_map_facts(map_facts_text(facts, notes), read, read_notes);
  EXPECT_EQ(report_json(read), report_json(facts));
  EXPECT_EQ(read_notes, notes);
  EXPECT_EQ(read.distortion->aggregate, facts.distortion->aggregate);
}

}  // namespace
}  // namespace lozenge
