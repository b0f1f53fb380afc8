#include "stages/parameterize/allotment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "formats/domain/distortion.h"
#include "formats/domain/parameterization.h"

namespace lozenge {

namespace {

/// How many levels above a density of one triangle for each unit of area these are.
double levels_of_density(double faces, double area) { return std::log2(faces / area) / 2; }

std::int32_t nearest_level(double levels) {
  return static_cast<std::int32_t>(std::clamp(std::round(levels), 0.0, static_cast<double>(kMostFirstLevel)));
}

/// What a part's share of the domain grows with, were all as distorted by it as each other: were the distortion of a
/// part its area times some measure D of its shape by the root of its domain triangles (as with the paper's eq. 6), the
/// sum is least where these go with (area D)^(2/3). A part that is long or thin has no room for large triangles.
double weight_of(const PartFacts& part) {
  if (!(part.area > 0)) return 0;
  constexpr double kLongest = 1000;
  const double slender = std::clamp(part.extent * part.extent / part.area, 1.0, kLongest);
  return std::pow(part.area * std::sqrt(slender), 2.0 / 3);
}

/// The domain triangles that a part may want.
FaceRange sensible(const PartFacts& part) {
  constexpr std::int32_t kFewest = 3;
  constexpr std::int32_t kFiner = 2;  // than the source itself: each of its triangles is cut into a dozen then
  const std::int32_t least = std::max(kFewest, part.least);
  return {least, std::max(least, kFiner * part.triangles)};
}

/// By weight, each part within its bounds. \return [part] 0 of those that are `left_out`
std::vector<double> shared_out(const std::vector<PartFacts>& parts, const std::vector<double>& weights,
                               const std::vector<char>& left_out, const Budget& budget) {
  std::vector<double> shares(parts.size(), 0);
  const auto taken_at = [&](double per_weight) {
    double sum = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      if (left_out[p]) continue;
      const FaceRange bounds = sensible(parts[p]);
      shares[p] = std::clamp<double>(per_weight * weights[p], bounds.least, bounds.most);
      sum += budget.taken(parts[p], shares[p]);
    }
    return sum;
  };
  double weight = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) weight += left_out[p] ? 0 : weights[p];
  // Bounds take from some and give to others: the factor is looked for between none at all and more than anyone gets.
  constexpr int kHalvings = 60;
  constexpr double kMost = 1e5;  // domain triangles
  double low = 0;
  double high = weight > 0 ? kMost / weight : 0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2;
    (taken_at(middle) < budget.amount ? low : high) = middle;
  }
  taken_at(low);
  return shares;
}

/// What cutting may add to the parts that bring no domain along.
double most_cuts(const std::vector<PartFacts>& parts, const std::vector<char>& is_own) {
  constexpr double kLeast = 0.3;  // of what they might add, were they alone
  double all = 0;
  double others = 0;
  double own = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    all += parts[p].triangles;
    if (is_own[p]) own += parts[p].own.cuts;
    else others += parts[p].triangles;
  }
  return std::max(most_added(all) - own, kLeast * most_added(others));
}

double middle_of(const FaceRange& faces) { return 0.5 * (faces.least + faces.most); }

/// About so many domain triangles, and not fewer than the topology needs.
FaceRange around(double faces, std::int32_t least) {
  constexpr double kEitherWay = 0.05;  // room for the search, and an area of triangles that nobody tells apart
  // Closed surfaces have even numbers of triangles only: two at least in each interval.
  const auto low = std::max(least, static_cast<std::int32_t>(std::floor(faces * (1 - kEitherWay))));
  return {low, std::max(low + 1, static_cast<std::int32_t>(std::ceil(faces * (1 + kEitherWay))))};
}

}  // namespace

double mismatch_of_areas(const std::vector<PartFacts>& parts, const std::vector<double>& faces,
                         const std::vector<std::int32_t>& first_levels) {
  double image = 0;
  double area = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    image += faces[p] * area_at_level(first_levels[p]);
    area += parts[p].area;
  }
  double sum = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (!(parts[p].area > 0)) continue;
    const double ratio = faces[p] * area_at_level(first_levels[p]) / image * area / parts[p].area;
    sum += parts[p].area / area * ((ratio + 1 / ratio) / 2 - 1);
  }
  return sum;
}

std::vector<std::int32_t> even_levels(const std::vector<PartFacts>& parts, const std::vector<double>& faces) {
  constexpr double kStep = 1.0 / 16;  // of a level: a twentieth of the distance between samples
  std::vector<std::int32_t> best(parts.size(), kMostFirstLevel);
  std::vector<std::pair<std::size_t, double>> densities;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (!(parts[p].area > 0)) continue;
    densities.emplace_back(p, levels_of_density(faces[p], parts[p].area));
    low = std::min(low, densities.back().second);
    high = std::max(high, densities.back().second);
  }
  double least = std::numeric_limits<double>::infinity();
  std::vector<std::int32_t> levels = best;
  for (double density = low - 0.5; density <= high + 0.5; density += kStep) {
    for (const auto& [p, own] : densities) levels[p] = nearest_level(own - density);
    const double mismatch = mismatch_of_areas(parts, faces, levels);
    if (!(mismatch < least * (1 - 1e-9))) continue;
    least = mismatch;
    best = levels;
  }
  const std::int32_t first = *std::min_element(best.begin(), best.end());
  for (std::int32_t& level : best) level -= first;
  return best;
}

Allotments::Allotments(std::vector<PartFacts> parts, const std::optional<FaceRange>& asked)
    : parts_(std::move(parts)), is_own_(parts_.size(), 0) {
  for (const PartFacts& part : parts_) weights_.push_back(weight_of(part));
  const double middle = asked ? std::sqrt(static_cast<double>(asked->least) * asked->most) : 0;
  if (asked) wanted_ = shared_out(parts_, weights_, is_own_, {middle});
  double own = 0;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    is_own_[p] = parts_[p].own.is_best && (!asked || wanted_[p] <= parts_[p].own.faces);
    if (is_own_[p]) own += parts_[p].own.faces;
    else if (leader_ < 0 || parts_[p].area > parts_[leader_].area) leader_ = static_cast<std::int32_t>(p);
  }
  constexpr double kOfOthers = 0.25;  // what is left for them at least
  budget_ =
      asked ? Budget{std::max(middle - own, kOfOthers * middle), false} : Budget{most_cuts(parts_, is_own_), true};
  share_out([&] {
    levels_ = even_levels(parts_, wanted_);
    return leader_ < 0 ? 0 : density_with(wanted_[leader_]);
  });
}

void Allotments::share_out(const std::function<double()>& density) {
  // The even density may take up to twice what is wanted of a part, or leave half of it.
  constexpr double kLess = 0.93;
  constexpr double kMore = 1.05;
  constexpr int kTries = 12;
  Budget target = budget_;
  for (int i = 0; i < kTries; ++i, target.amount *= kLess) {
    wanted_ = shared_out(parts_, weights_, is_own_, target);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (is_own_[p]) wanted_[p] = parts_[p].own.faces;
    }
    const std::vector<Allotment> shares = at_density(density());
    if (leader_ < 0) break;
    double taken = 0;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (!is_own_[p]) taken += budget_.taken(parts_[p], middle_of(shares[p].faces));
    }
    if (taken <= kMore * budget_.amount) break;
  }
}

FaceRange Allotments::faces_of_leader() const {
  const double wanted = wanted_[leader_];
  const double least = std::max<double>(parts_[leader_].least, wanted / std::sqrt(2.0));
  return {static_cast<std::int32_t>(std::ceil(least)),
          static_cast<std::int32_t>(std::max(std::ceil(least) + 1, wanted * std::sqrt(2.0)))};
}

double Allotments::density_with(double faces_of_leader) const {
  if (leader_ < 0 || !(parts_[leader_].area > 0)) return 0;
  return faces_of_leader * area_at_level(levels_[leader_]) / parts_[leader_].area;
}

std::vector<Allotment> Allotments::allot(double faces_of_leader) const {
  return at_density(density_with(faces_of_leader));
}

std::vector<Allotment> Allotments::at_density(double density) const {
  // Beyond the levels that there are, a part stays denser or less dense than the others, but not by more than that.
  constexpr double kAtLeast = 0.25;
  constexpr double kAtMost = 4;
  std::vector<Allotment> shares(parts_.size());
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const PartFacts& part = parts_[p];
    double faces = wanted_[p];
    shares[p].first_level = levels_[p];
    if (density > 0 && part.area > 0) {
      const std::int32_t level = nearest_level(levels_of_density(faces, density * part.area));
      shares[p].first_level = level;
      faces = std::clamp(density * part.area / area_at_level(level), kAtLeast * faces, kAtMost * faces);
    }
    shares[p].is_own = is_own_[p] != 0;
    shares[p].faces = is_own_[p] ? FaceRange{part.own.faces, part.own.faces} : around(faces, part.least);
  }
  return shares;
}

namespace {

/// What is thought to come of a part with its domain on another level.
struct Choice {
  std::int32_t level = 0;
  double faces = 0;
  double distortion = 0;  ///< weighed by its area
  double taken = 0;       ///< of the budget
  bool is_own = false;
};

/// The one of least distortion, where a triangle costs so much of it.
const Choice& best_of(const std::vector<Choice>& choices, double price) {
  return *std::min_element(choices.begin(), choices.end(), [&](const Choice& a, const Choice& b) {
    return a.distortion + price * a.taken < b.distortion + price * b.taken;
  });
}

/// The lowest price at which the best choices take no more than there is, or the highest.
double price_within(const std::vector<std::vector<Choice>>& choices, double amount, double highest) {
  constexpr double kStep = 1.2;
  constexpr double kLowest = 1e-9;  // of the highest: changes nothing
  double price = kLowest * highest;
  for (; price < highest; price *= kStep) {
    double taken = 0;
    for (const std::vector<Choice>& part : choices) taken += part.empty() ? 0 : best_of(part, price).taken;
    if (taken <= amount) break;
  }
  return std::min(price, highest);
}

}  // namespace

std::vector<Allotment> Allotments::revised(const std::vector<MadePart>& made) const {
  const double density = density_with(made[leader_].faces);
  std::vector<Allotment> shares = at_density(density);
  double area = 0;
  double triangles = 0;
  for (const PartFacts& part : parts_) {
    area += part.area;
    triangles += part.triangles;
  }
  double amount = budget_.amount;
  std::vector<std::vector<Choice>> choices(parts_.size());
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const PartFacts& part = parts_[p];
    if (is_own_[p] || !(part.area > 0)) continue;
    if (budget_.is_of_cuts) amount -= made[p].triangles - part.triangles;
    const FaceRange bounds = sensible(part);
    // A level below the leader's leaves room where it can do with fewer itself.
    for (std::int32_t level = -1; level < kMostFirstLevel; ++level) {
      const double more = std::pow(4.0, level - shares[p].first_level);
      const double faces = made[p].faces * more;
      if (more != 1 && (faces < bounds.least || faces > bounds.most)) continue;
      PartFacts as_made = part;
      as_made.triangles = static_cast<std::int32_t>(made[p].triangles);
      // More triangles halve what they can where a part has hardly room; fewer may leave it none.
      const double less = more > 1 ? more : more * more;
      choices[p].push_back(
          {level, faces, part.area / area * made[p].distortion / less, budget_.taken(as_made, faces), false});
    }
    if (part.own.faces > 0) {
      choices[p].push_back({0, static_cast<double>(part.own.faces), part.area / area * part.own.distortion,
                            budget_.is_of_cuts ? part.own.cuts : part.own.faces, true});
    }
  }
  // What the source may be cut into is a wish: where small parts take all of it, as many triangles again as the source
  // has are worth this much of the distortion. What the user asks for is to be kept.
  constexpr double kWorth = 0.5;
  constexpr double kAnything = 1e6;
  const double price = price_within(choices, amount, budget_.is_of_cuts ? kWorth / triangles : kAnything);
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    if (choices[p].empty()) continue;
    const Choice& best = best_of(choices[p], price);
    shares[p].is_own = best.is_own;
    if (best.is_own) {
      shares[p].faces = {parts_[p].own.faces, parts_[p].own.faces};
      continue;
    }
    if (best.level == shares[p].first_level) continue;
    shares[p].first_level = best.level;
    shares[p].faces = around(density * parts_[p].area * std::pow(4.0, best.level), parts_[p].least);
  }
  return shares;
}

double Allotments::weighed_whole(const TraceRow& row) const {
  const std::vector<Allotment> shares = allot(row.domain_faces);
  std::vector<double> faces;
  std::vector<std::int32_t> levels;
  for (std::size_t p = 0; p < shares.size(); ++p) {
    faces.push_back(static_cast<std::int32_t>(p) == leader_ ? row.domain_faces : middle_of(shares[p].faces));
    levels.push_back(shares[p].first_level);
  }
  const double aggregate = aggregate_of((1 + row.area) * (1 + mismatch_of_areas(parts_, faces, levels)), 1 + row.angle);
  return weighed_by_size(aggregate, std::accumulate(faces.begin(), faces.end(), 0.0));
}

}  // namespace lozenge
