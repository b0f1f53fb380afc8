// What a file does against its format's rules and is read all the same, or goes without. One table says of each kind
// what becomes of it; who reads says where it was found. Refused is only what leaves no surface, or could do harm.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lozenge {

enum class Deviation : std::uint8_t {
  kText,
  kNull,
  kWholeNumber,
  kMinusOne,
  kWrongType,
  kNoStride,
  kShortBuffer,
  kBrokenData,
  kBrokenAttribute,
  kBrokenPrimitive,
  kLeftOverCorners,
  kNoPrimitives,
  kNothingThere,
  kMatrix,
  kRotation,
  kTree,
  kUnreadable,
  kPicture,
};

struct DeviationKind {
  Deviation kind;
  std::string_view what;  ///< for the table of the documentation
  std::string_view fate;  ///< what becomes of it; ends notes
};

/// In the order of the enumeration. docs/formats-read.md shows it.
inline constexpr std::array kDeviationKinds{
    DeviationKind{Deviation::kText, "half a surrogate pair or bytes that are no UTF-8 in JSON, zeros behind it",
                  "read with U+FFFD in their place"},
    DeviationKind{Deviation::kNull, "a property that is null", "read as if it weren't there"},
    DeviationKind{Deviation::kWholeNumber, "a whole number that is written as a fraction, 708.0",
                  "read as that number"},
    DeviationKind{Deviation::kMinusOne, "an index of -1 that stands for none", "read as if it weren't there"},
    DeviationKind{Deviation::kWrongType, "a property of another type or length than glTF's",
                  "read as if it weren't there"},
    DeviationKind{Deviation::kNoStride, "a byteStride of 0", "its elements are read without gaps"},
    DeviationKind{Deviation::kShortBuffer, "a buffer that isn't there, or shorter than it says",
                  "what lies in the bytes that are there is read"},
    DeviationKind{Deviation::kBrokenData,
                  "a buffer view or accessor of which nothing can be read: past its end, of no elements",
                  "left out, with what uses it"},
    DeviationKind{Deviation::kBrokenAttribute, "an attribute other than POSITION of a wrong type, count or accessor",
                  "the mesh is read without it"},
    DeviationKind{Deviation::kBrokenPrimitive,
                  "a primitive without sound positions or indices, beside others that have them", "left out"},
    DeviationKind{Deviation::kLeftOverCorners, "corners that make no whole number of triangles",
                  "read as the whole triangles; the last corners are left out"},
    DeviationKind{Deviation::kNoPrimitives, "a mesh without primitives", "left out"},
    DeviationKind{Deviation::kNothingThere, "an index of something that isn't there: a material, mesh, node, scene",
                  "read as if it weren't there"},
    DeviationKind{Deviation::kMatrix, "a node's matrix whose last row isn't 0 0 0 1", "read as if it were"},
    DeviationKind{Deviation::kRotation, "a rotation of no length", "read as if it weren't there"},
    DeviationKind{Deviation::kTree, "a node below two others, below itself, or in the scene twice",
                  "read where it is first; a child that is also at the top, below its parent"},
    DeviationKind{Deviation::kUnreadable, "animations or cameras that can't be parsed", "left out"},
    DeviationKind{Deviation::kPicture,
                  "a picture of a texture that is missing, outside of the asset's folder, or broken",
                  "surfaces go without it"},
};

/// Of one file.
class Deviations {
 public:
  /// \param place_and_problem  "statue.glb: buffer view 0: byteStride is 0"
  /// \throws Error(kUnusableInput) with that text where none are allowed
  void add(Deviation kind, const std::string& place_and_problem);
  /// The same of a piece of surface that is left out for it.
  void lose(Deviation kind, const std::string& place_and_problem);

  /// From now on each is refused.
  void allow_none() { none_allowed_ = true; }

  bool none() const { return found_.empty(); }
  /// Why the first piece of surface was left out; empty where none was.
  const std::string& first_loss() const { return first_loss_; }
  /// A sentence for each kind that was found: its first place, how often, and what became of it; for each picture one.
  /// \param file  the file's name, which they go without
  std::vector<std::string> notes(const std::string& file) const;

 private:
  struct Found {
    Deviation kind;
    std::string first;
    std::int64_t count = 0;
  };
  std::vector<Found> found_;
  std::string first_loss_;
  bool none_allowed_ = false;
};

}  // namespace lozenge
