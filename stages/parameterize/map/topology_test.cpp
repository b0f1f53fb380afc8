#include "stages/parameterize/map/topology.h"

#include <gtest/gtest.h>

#include "stages/parameterize/parameterize.h"
#include "stages/parameterize/surface_fixtures.h"

namespace lozenge {
namespace {

Topology topology_of_mesh(const SourceMesh& mesh) {
  return topology_of(make_halfedge_mesh(mesh.triangles, static_cast<std::int32_t>(mesh.positions.size())));
}

TEST(Topology, CountsHandlesAndLoops) {
  const auto flat = [](const Vec3d&) { return 0.0; };
  const Topology sphere = topology_of_mesh(test::sphere(3, flat));
  EXPECT_EQ(sphere.genus, 0);
  EXPECT_EQ(sphere.loops, 0);
  const Topology torus = topology_of_mesh(test::torus(8, 6, 0.4, [](double, double) { return 0.0; }));
  EXPECT_EQ(torus.genus, 1);
  EXPECT_EQ(torus.loops, 0);
  EXPECT_EQ(topology_of_mesh(test::sheet(3, flat)).loops, 1);
  const Topology band = topology_of_mesh(test::band(5, 2, 1));
  EXPECT_EQ(band.genus, 0);
  EXPECT_EQ(band.loops, 2);
}

TEST(LeastDomainFaces, AreThoseOfTheSmallestTriangulations) {
  EXPECT_EQ(least_domain_faces({0, 0}), 4);   // a tetrahedron
  EXPECT_EQ(least_domain_faces({1, 0}), 14);  // the torus of seven vertices
  EXPECT_EQ(least_domain_faces({2, 0}), 24);  // ten vertices
  EXPECT_EQ(least_domain_faces({3, 0}), 28);
  EXPECT_EQ(least_domain_faces({0, 1}), 1);  // a triangle
  EXPECT_EQ(least_domain_faces({0, 2}), 6);  // a prism's sides
  EXPECT_EQ(least_domain_faces({1, 1}), 8);  // the torus of seven vertices without one of them
}

TEST(NoteOnDomainSize, SaysWhyAndWhatToAskFor) {
  ParameterizeOptions options;
  options.min_domain_faces = 4;
  options.max_domain_faces = 10;
  const SourceMesh torus = test::torus(16, 10, 0.4, [](double, double) { return 0.0; });
  const ParameterizeResult made = parameterize(torus, options, {});
  EXPECT_EQ(made.least_domain_faces, 14);
  EXPECT_GE(made.map.domain.size(), 14);
  const std::string note = note_on_domain_size(made, options);
  EXPECT_NE(note.find("not 4..10"), std::string::npos) << note;
  EXPECT_NE(note.find("need 14 at least"), std::string::npos) << note;
  EXPECT_NE(note.find("--domain-faces "), std::string::npos) << note;
  options.max_domain_faces = 60;
  EXPECT_EQ(note_on_domain_size(made, options), "");
}

TEST(NoteOnDomainSize, TellsOfPartsThatKeepTheirTriangles) {
  ParameterizeOptions options;
  options.min_domain_faces = 4;
  options.max_domain_faces = 10;
  ParameterizeResult made;
  made.map.domain.triangles.resize(24);  // two boxes
  made.least_domain_faces = 24;
  made.parts_as_they_are = 2;
  const std::string note = note_on_domain_size(made, options);
  EXPECT_NE(note.find("2 of its parts are so small that they keep their own triangles"), std::string::npos) << note;
  EXPECT_EQ(note.find("handles"), std::string::npos) << note;
}

}  // namespace
}  // namespace lozenge
