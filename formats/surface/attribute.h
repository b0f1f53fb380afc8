// What a vertex of a file, or a corner of a surface, carries besides its position, as streams of floats: one table says
// of each kind how files call it, how it is made fit, how it lies between others and what transforms do to it. All else
// handles streams without asking what they mean (formats/surface/attribute_streams.h).
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace lozenge {

/// How a value between others is made of them.
enum class Interpolation {
  kLinear,     ///< their weighted mean
  kDirection,  ///< the same, made of unit length again; zeros where they cancel
  /// The first half are joints, the second their weights: the heaviest of all that are named, four, or as many as one
  /// of those has that it is made of.
  kJointsAndWeights,
  kNearest,  ///< the one of the greatest weight, the first of equal ones
};

/// Which values make sense, and what becomes of others.
enum class ValueRange {
  kFinite,        ///< one with a component that isn't becomes the neutral value
  kUnitInterval,  ///< components are clamped to [0, 1]; those that aren't finite become neutral
};

/// How it moves when the surface does.
enum class Movement {
  kNone,
  kNormal,  ///< as `NormalTransform` says; it is negated where its triangle is turned over and it faced outward
  kOffset,  ///< the first three components are a difference of two places: turned and scaled, but not shifted
};

/// What glTF files may hold it as besides floats (specification of glTF 2.0, Sec. 3.7.2.1; KHR_mesh_quantization).
enum class Integers {
  kQuantized,              ///< any, where the file is a quantized one
  kNormalized,             ///< unsigned normalized ones
  kNormalizedOrQuantized,  ///< both
};

/// A row of the table.
struct AttributeKind {
  std::string_view semantic;  ///< glTF's name, without the number of a set
  std::string_view label;     ///< for people: "normals"
  int components = 1;
  Interpolation interpolation = Interpolation::kLinear;
  float neutral = 0;  ///< each component where a primitive has none of it, but another has
  ValueRange range = ValueRange::kFinite;
  Movement movement = Movement::kNone;
  /// Isn't carried along by corners: vertices of a file at one position are joined only where it is equal, too.
  bool tells_vertices_apart = false;

  bool numbered = false;      ///< whether files number its sets: TEXCOORD_0
  int sets = 1;               ///< how many sets readers take along
  int fewest_components = 0;  ///< where files may leave out the last ones, which are neutral then; or 0
  Integers integers = Integers::kQuantized;
  std::string_view loose_semantic =
      {};  ///< its name in our files where directions aren't all of unit length, or nothing

  bool operator==(const AttributeKind& other) const { return semantic == other.semantic; }
};

inline constexpr AttributeKind kNormals{.semantic = "NORMAL",
                                        .label = "normals",
                                        .components = 3,
                                        .interpolation = Interpolation::kDirection,
                                        .movement = Movement::kNormal,
                                        .loose_semantic = "_LOZENGE_NORMAL"};

/// The direction of growing u of what directions in textures are told by, and the sign of the bitangent; zeros where a
/// vertex has none. Taken along only where a material asks for it. Under its own name in glTF it would have to be of
/// unit length, which interpolated ones aren't.
inline constexpr AttributeKind kTangents{.semantic = "TANGENT",
                                         .label = "tangents",
                                         .components = 4,
                                         .movement = Movement::kOffset,
                                         .loose_semantic = "_LOZENGE_TANGENT"};

/// In glTF's convention: v runs down.
inline constexpr AttributeKind kTextureCoordinates{.semantic = "TEXCOORD",
                                                   .label = "texture coordinates",
                                                   .components = 2,
                                                   .numbered = true,
                                                   .sets = 4,
                                                   .integers = Integers::kNormalizedOrQuantized};

/// Linear RGBA.
inline constexpr AttributeKind kColors{.semantic = "COLOR",
                                       .label = "colours",
                                       .components = 4,
                                       .neutral = 1,
                                       .range = ValueRange::kUnitInterval,
                                       .numbered = true,
                                       .fewest_components = 3,
                                       .integers = Integers::kNormalized};

/// Joints that files keep together as one set.
inline constexpr int kJointsOfSet = 4;
/// Those that move a vertex, at most; readers take four unless they are asked for more.
inline constexpr int kMostJoints = 8;

/// Which joints of its body's skin move a vertex, and how much of its movement is theirs: eight joints, then their
/// weights, which add up to 1; of fewer, the last ones weigh 0. All zeros on bodies without a skin. In files two
/// accessors for each set that is needed (formats/files/readers/gltf/influences.h).
inline constexpr AttributeKind kInfluences{.semantic = "_LOZENGE_INFLUENCES",
                                           .label = "joints and weights",
                                           .components = 2 * kMostJoints,
                                           .interpolation = Interpolation::kJointsAndWeights};

/// How many sets elements of `kInfluences` need: 1, or 2 where any has a fifth joint.
int sets_of_joints(const std::vector<float>& influences);

/// Whether an element of `kInfluences` is one: joints are whole numbers, weights add up to 1 (or nothing moves it).
bool is_influence(const float* element);
/// Whether nothing moves it: all zeros.
bool is_unmoved(const float* element);

/// Morph targets of a body that are kept at most; a face with all of its muscles has some hundred.
inline constexpr int kMostMorphTargets = 256;

/// How far a morph target of its body moves a vertex; the set is the target's number in its body.
inline constexpr AttributeKind kMorphOffsets{.semantic = "_LOZENGE_MORPH_OFFSET",
                                             .label = "morph offsets",
                                             .components = 3,
                                             .movement = Movement::kOffset,
                                             .numbered = true,
                                             .sets = kMostMorphTargets};

/// The normal that a morph target gives a vertex; zeros where it leaves it as it is.
inline constexpr AttributeKind kMorphNormals{.semantic = "_LOZENGE_MORPH_NORMAL",
                                             .label = "morph normals",
                                             .components = 3,
                                             .interpolation = Interpolation::kDirection,
                                             .movement = Movement::kNormal,
                                             .numbered = true,
                                             .sets = kMostMorphTargets};

/// The number of vertices before this one at its position that are others of the surface.
inline constexpr AttributeKind kSheets{.semantic = "_LOZENGE_SHEET",
                                       .label = "sheets",
                                       .interpolation = Interpolation::kNearest,
                                       .tells_vertices_apart = true};

/// All that is read and carried along, in the order in which it is stored.
inline constexpr std::array kAttributeKinds{kNormals,    kTangents,     kTextureCoordinates, kColors,
                                            kInfluences, kMorphOffsets, kMorphNormals,       kSheets};

/// "NORMAL", "TEXCOORD_0".
std::string attribute_name(const AttributeKind& kind, int set);

/// One set of one kind, for all vertices or all corners.
struct AttributeStream {
  AttributeKind kind;
  int set = 0;
  std::vector<float> values;  ///< [element * kind.components + component]

  std::size_t count() const { return values.size() / static_cast<std::size_t>(kind.components); }
  const float* at(std::size_t element) const { return &values[element * static_cast<std::size_t>(kind.components)]; }
  float* at(std::size_t element) { return &values[element * static_cast<std::size_t>(kind.components)]; }
};

/// At most one for each kind and set, all of as many elements.
using AttributeStreams = std::vector<AttributeStream>;

/// The value of an element as a vector of so many components.
template <typename Vector>
Vector vector_at(const AttributeStream& stream, std::size_t element) {
  Vector vector;
  const float* from = stream.at(element);
  for (unsigned c = 0; c < Vector::dimensions(); ++c) vector[static_cast<int>(c)] = from[c];
  return vector;
}

/// Null where there is none.
const AttributeStream* find_stream(const AttributeStreams& streams, const AttributeKind& kind, int set = 0);

}  // namespace lozenge
