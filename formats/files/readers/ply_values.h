// The values of a PLY, one after the other, whatever way they are encoded.
#pragma once

#include <memory>
#include <string>

#include "formats/files/readers/ply_header.h"

namespace lozenge {

class PlyValues {
 public:
  virtual ~PlyValues() = default;

  /// The next value; a float as the nearest one to what a text says.
  /// \throws Error(kUnusableInput) where there is none
  virtual double next(const PlyProperty& property) = 0;
  /// The number of values of the list that comes next.
  /// \throws Error(kUnusableInput) where it is negative, or more than what is left of the file can hold
  virtual std::int64_t next_count(const PlyProperty& property) = 0;

  /// Where the next value begins: a line of a text, else a byte of the file.
  virtual std::int64_t place() = 0;
  virtual const char* unit() const = 0;
  [[noreturn]] virtual void refuse(const std::string& problem) = 0;
};

/// \param scanner  at the end of the header; outlives what is returned
std::unique_ptr<PlyValues> ply_values(TextScanner& scanner, PlyEncoding encoding);

}  // namespace lozenge
