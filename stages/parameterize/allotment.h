// The domain's triangles, shared out between parts: how many each gets, and at which scale.
//
// Nothing couples two parts that don't touch but the distance between samples, which shall be the same on both. A part
// of few triangles, or a plain one, needs few domain triangles, whatever its size; scaled by 2^-k they are as dense as
// those of the others. So each part gets about the number that its shape and its source ask for, the scale that comes
// nearest to an even density with it, and then the number that makes it exact.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "stages/parameterize/domain_size.h"
#include "stages/parameterize/search/trace.h"

namespace lozenge {

/// A domain that a part brings along (`own_domain.h`).
struct OwnDomain {
  std::int32_t faces = 0;  ///< 0: there is none
  bool is_best = false;    ///< a box's, or one of so few triangles that any other would be cut into more
  double cuts = 0;         ///< what cutting the part's triangles along its patches adds
  double distortion = 0;   ///< as MadePart's
};

/// What is known of a part before it has a map.
struct PartFacts {
  double area = 0;
  double extent = 0;           ///< diagonal of its box
  std::int32_t triangles = 0;  ///< of the source
  std::int32_t least = 0;      ///< domain triangles that its topology needs
  OwnDomain own;               ///< that it brings along
};

/// What a part's domain shall be.
struct Allotment {
  FaceRange faces;
  std::int32_t first_level = 0;
  bool is_own = false;  ///< the domain that it brings along
};

/// What is shared out between parts, and how much of it domain triangles take.
struct Budget {
  double amount = 0;
  bool is_of_cuts = false;  ///< triangles that cutting the source's adds; else domain triangles

  double taken(const PartFacts& part, double faces) const {
    return is_of_cuts ? added_by_cutting(part.triangles, faces) : faces;
  }
};

/// What a part's domain has become.
struct MadePart {
  double faces = 0;
  double distortion = 0;  ///< of its map by itself: three times that of areas and that of angles
  double triangles = 0;   ///< of its surface: some edges stay split
};

/// A plan for all parts.
class Allotments {
 public:
  /// \param asked  the domain triangles of all parts together; nothing: as many as the source's own triangles can be
  /// cut along without becoming too many
  Allotments(std::vector<PartFacts> parts, const std::optional<FaceRange>& asked);

  /// The part whose domain is looked for first, and sets the density of all; -1 where all bring their domains along.
  std::int32_t leader() const { return leader_; }
  /// What is looked for on it.
  FaceRange faces_of_leader() const;

  /// What each part gets, [part], were the leader's domain of so many triangles.
  std::vector<Allotment> allot(double faces_of_leader) const;

  /// The same once all have maps: where these show that a part needs more or can do with fewer by a level or more, with
  /// that. \param made  [part]
  std::vector<Allotment> revised(const std::vector<MadePart>& made) const;

  /// What the weighed distortion (paper, eq. 6) of the whole would be, were the leader's domain the one of a row of its
  /// trace. Within themselves the others are taken to be as distorted as the leader.
  double weighed_whole(const TraceRow& row) const;

 private:
  /// Looks for what each part wants, within the budget. \param density  that comes of it
  void share_out(const std::function<double()>& density);
  double density_with(double faces_of_leader) const;
  /// \param density  domain triangles of the largest scale for each unit of area
  std::vector<Allotment> at_density(double density) const;

  std::vector<PartFacts> parts_;
  std::vector<double> weights_;  ///< [part] what shares grow with
  Budget budget_;
  std::vector<double> wanted_;  ///< [part] domain triangles; of those that bring theirs, so many
  std::vector<char> is_own_;
  std::vector<std::int32_t> levels_;  ///< [part] were all to get what they want
  std::int32_t leader_ = -1;
};

/// The first levels that make the densities of parts as even as can be. \param faces  [part] of their domains
/// \return [part]; the least is 0
std::vector<std::int32_t> even_levels(const std::vector<PartFacts>& parts, const std::vector<double>& faces);

/// The distortion of areas that comes of domain triangles that are larger on one part than on another.
double mismatch_of_areas(const std::vector<PartFacts>& parts, const std::vector<double>& faces,
                         const std::vector<std::int32_t>& first_levels);

}  // namespace lozenge
