// What became of each asset of a batch: a file of JSON objects, one a line, which grows while the batch runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lozenge {

/// A line of the manifest. Its keys are an interface: they are the names here.
struct BatchRow {
  std::string asset;
  std::string hash;     ///< of the asset and the files that it names
  std::string options;  ///< of the build, as they were given
  std::string program;  ///< a hash of it
  std::string status;   ///< "done", "failed", "timeout", "killed", or "lost": nobody came to it
  int code = 0;         ///< what building it ended with
  std::string message;  ///< what was wrong
  double seconds = 0;
  double memory_mb = 0;  ///< peak, in 10^6 bytes
  bool cached = false;
  std::string output;  ///< NAME of its outputs, below the output folder

  // Of what is done:
  std::int64_t samples = 0;             ///< N
  double distortion = 0;                ///< aggregate
  std::vector<std::int64_t> triangles;  ///< of each level of detail
  std::optional<double> deviation;      ///< mean distance to the source, in percent of its box diagonal
  std::optional<double> largest_deviation;

  bool is_done() const { return status == "done"; }
};

std::string row_text(const BatchRow& row);
/// \return nothing where the text isn't a row: what a killed process left of one isn't
std::optional<BatchRow> row_of(const std::string& text);

/// [output] its last row in the file; none where there is no file.
std::map<std::string, BatchRow> read_manifest(const std::filesystem::path& file);

/// Adds a row in one piece, so that several processes may write to one file. \throws Error(kSystem) where that fails
void append_row(const std::filesystem::path& file, const BatchRow& row);

/// Replaces the file by these rows.
void write_manifest(const std::filesystem::path& file, const std::vector<BatchRow>& rows);

}  // namespace lozenge
