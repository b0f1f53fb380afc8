#include "stages/parameterize/parameterize.h"

#include <algorithm>
#include <string>
#include <utility>

#include "formats/base/error.h"
#include "stages/parameterize/part_by_part.h"

namespace lozenge {

namespace {

void require_sense(const ParameterizeOptions& o) {
  const bool follows_source = o.min_domain_faces == 0 && o.max_domain_faces == 0;
  if (!follows_source && (o.min_domain_faces < 4 || o.max_domain_faces < o.min_domain_faces)) {
    throw Error(ExitCode::kUsage, "the domain's range " + std::to_string(o.min_domain_faces) + ".." +
                                      std::to_string(o.max_domain_faces) + " is empty or starts below 4");
  }
  if (!(o.gamma >= 0)) throw Error(ExitCode::kUsage, "gamma must not be negative");
  if (!(o.star_conformality >= 0 && o.star_conformality <= 1)) {
    throw Error(ExitCode::kUsage, "the conformality of stars lies between 0 and 1");
  }
}

/// The cones that the user wants, each once. \throws Error(kUsage) where the mesh has no such vertex
std::vector<VertexId> checked_cones(const SourceMesh& mesh, const ParameterizeOptions& options) {
  std::vector<VertexId> cones = options.cones;
  std::sort(cones.begin(), cones.end());
  cones.erase(std::unique(cones.begin(), cones.end()), cones.end());
  const auto count = static_cast<VertexId>(mesh.positions.size());
  if (!cones.empty() && (cones.front() < 0 || cones.back() >= count)) {
    const VertexId wrong = cones.front() < 0 ? cones.front() : cones.back();
    throw Error(ExitCode::kUsage, "there is no vertex " + std::to_string(wrong) + " to be a cone: " + mesh.origin +
                                      " has vertices 0 to " + std::to_string(count - 1));
  }
  return cones;
}

}  // namespace

FaceRange domain_faces(const ParameterizeOptions& options, std::int64_t triangles) {
  if (options.max_domain_faces == 0) return faces_for_source(triangles);
  return {options.min_domain_faces, options.max_domain_faces};
}

ParameterizeResult parameterize(SourceMesh source, const ParameterizeOptions& options, const Progress& progress) {
  require_sense(options);
  const std::vector<VertexId> cones = checked_cones(source, options);
  const auto triangles = static_cast<std::int64_t>(source.triangles.size());
  // Hundreds of parts need not know what moves them.
  Rig rig = std::exchange(source.rig, {});
  ParameterizeResult made = parameterize_part_by_part(std::move(source), options, cones, progress);
  made.map.source_triangles = triangles;
  made.surface.rig = std::move(rig);
  return made;
}

std::string note_on_domain_size(const ParameterizeResult& made, const ParameterizeOptions& options) {
  const std::int32_t faces = made.map.domain.size();
  if (options.max_domain_faces == 0 || faces <= options.max_domain_faces) return {};
  const std::string asked = std::to_string(options.min_domain_faces) + ".." + std::to_string(options.max_domain_faces);
  const std::string least = std::to_string(made.least_domain_faces) + " at least";
  const std::string why = made.least_domain_faces <= options.max_domain_faces
                              ? "no smaller domain was found that leaves the map without folds"
                          : made.parts_as_they_are > 0
                              ? std::to_string(made.parts_as_they_are) +
                                    " of its parts are so small that they keep their own triangles, which makes " +
                                    least
                              : "its handles, holes and parts need " + least;
  return "the domain has " + std::to_string(faces) + " triangles, not " + asked + ": " + why + "; --domain-faces " +
         std::to_string(faces) + ".." + std::to_string(2 * faces) + " leaves more room";
}

}  // namespace lozenge
