#include "pipeline/batch/batch_manifest.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "formats/base/atomic_file.h"
#include "formats/base/error.h"

namespace lozenge {
namespace {

using Json = nlohmann::ordered_json;

std::optional<double> number(const Json& json, const char* key) {
  return json.contains(key) ? std::optional<double>(json.at(key)) : std::nullopt;
}

[[noreturn]] void refuse(const std::filesystem::path& file) {
  throw Error(ExitCode::kSystem, file.string() + ": can't be written: " + std::strerror(errno));
}

}  // namespace

std::string row_text(const BatchRow& row) {
  Json json{{"asset", row.asset},         {"hash", row.hash},     {"options", row.options}, {"program", row.program},
            {"status", row.status},       {"code", row.code},     {"message", row.message}, {"seconds", row.seconds},
            {"memory_mb", row.memory_mb}, {"cached", row.cached}, {"output", row.output}};
  if (row.is_done()) {
    json["samples"] = row.samples;
    json["distortion"] = row.distortion;
    json["triangles"] = row.triangles;
    if (row.deviation) json["deviation"] = *row.deviation;
    if (row.largest_deviation) json["largest_deviation"] = *row.largest_deviation;
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<BatchRow> row_of(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    BatchRow row;
    row.asset = json.at("asset");
    row.hash = json.at("hash");
    row.options = json.at("options");
    row.program = json.at("program");
    row.status = json.at("status");
    row.code = json.at("code");
    row.message = json.at("message");
    row.seconds = json.at("seconds");
    row.memory_mb = json.at("memory_mb");
    row.cached = json.at("cached");
    row.output = json.at("output");
    if (!row.is_done()) return row;
    row.samples = json.at("samples");
    row.distortion = json.at("distortion");
    row.triangles = json.at("triangles").get<std::vector<std::int64_t>>();
    row.deviation = number(json, "deviation");
    row.largest_deviation = number(json, "largest_deviation");
    return row;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

std::map<std::string, BatchRow> read_manifest(const std::filesystem::path& file) {
  std::map<std::string, BatchRow> rows;
  std::ifstream stream(file, std::ios::binary);
  for (std::string line; std::getline(stream, line);) {
    if (auto row = row_of(line)) rows[row->output] = std::move(*row);
  }
  return rows;
}

void append_row(const std::filesystem::path& file, const BatchRow& row) {
  const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor < 0) refuse(file);
  const std::string line = row_text(row);
  // What a killed process left of a line is none of this one.
  char last = '\n';
  const off_t size = lseek(descriptor, 0, SEEK_END);
  if (size > 0 && pread(descriptor, &last, 1, size - 1) != 1) refuse(file);
  const std::string text = (last == '\n' ? "" : "\n") + line + "\n";
  const bool is_written = write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (close(descriptor) != 0 || !is_written) refuse(file);
}

void write_manifest(const std::filesystem::path& file, const std::vector<BatchRow>& rows) {
  std::string text;
  for (const BatchRow& row : rows) text += row_text(row) + "\n";
  write_file_whole(file, text);
}

}  // namespace lozenge
