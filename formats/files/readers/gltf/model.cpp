// The file is read and checked here; tinygltf then parses a document of which nothing is left to go wrong: it gets
// neither buffers nor images, which are filled in afterwards.
#include "formats/files/readers/gltf/model.h"

#include <tiny_gltf.h>

#include "formats/base/utf8.h"
#include "formats/files/readers/gltf/buffers.h"
#include "formats/files/readers/gltf/check.h"
#include "formats/files/readers/gltf/draco.h"
#include "formats/files/readers/gltf/json.h"
#include "formats/files/readers/gltf/mend_structure.h"
#include "formats/files/readers/gltf/mend_text.h"
#include "formats/files/readers/gltf/mend_values.h"
#include "formats/files/readers/gltf/meshopt.h"

namespace lozenge {

namespace {

using nlohmann::json;

tinygltf::Image image_of(const GltfObject& object) {
  tinygltf::Image image;
  image.name = object.text("name");
  image.mimeType = object.text("mimeType");
  const std::string uri = object.text("uri");
  // What can't be decoded has no bytes, which its reader notes. The document's JSON is larger, and was paid for.
  if (uri.starts_with("data:")) image.image = decode_data_uri(uri);
  else image.uri = uri;
  if (const auto view = object.whole("bufferView")) image.bufferView = static_cast<int>(*view);
  return image;
}

/// \return what tinygltf says where it can't; empty where it can
std::string parse(const json& document, const std::string& name, tinygltf::Model& model) {
  const std::string text = document.dump();
  if (text.size() > UINT32_MAX) throw Error(ExitCode::kLimit, name + ": its JSON is longer than 4 GB");
  tinygltf::TinyGLTF reader;
  std::string error;
  std::string warning;
  bool good = false;
  model = {};
  try {
    good = reader.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned int>(text.size()), "",
                                      tinygltf::NO_REQUIRE);
  } catch (const std::exception& e) {
    error = e.what();
  }
  if (good) return {};
  while (!error.empty() && error.back() == '\n') error.pop_back();
  return name + ": tinygltf can't parse it: " + error;
}

/// What no surface needs may be what can't be parsed.
void parse_what_can_be(json& document, const std::string& name, tinygltf::Model& model, Deviations& deviations) {
  std::string problem = parse(document, name, model);
  for (const char* key : {"animations", "cameras"}) {
    if (problem.empty()) return;
    if (document.erase(key) == 0) continue;
    deviations.add(Deviation::kUnreadable, problem);
    problem = parse(document, name, model);
  }
  if (!problem.empty()) throw Error(ExitCode::kUnusableInput, problem);
}

/// What is parsed here has neither buffers nor images: they are filled in afterwards.
void fill_in(json document, GltfBytes buffers, GltfFile& file, Deviations& deviations) {
  std::vector<tinygltf::Image> images;
  for (const GltfObject& image : GltfObject(document, file.name).list("images", file.name + ": ", "image")) {
    images.push_back(image_of(image));
  }
  document.erase("buffers");
  document.erase("images");
  parse_what_can_be(document, file.name, *file.model, deviations);
  file.model->images = std::move(images);
  for (auto& bytes : buffers) file.model->buffers.emplace_back().data = std::move(bytes);
}

}  // namespace

GltfFile::GltfFile() = default;
GltfFile::GltfFile(GltfFile&&) noexcept = default;
GltfFile& GltfFile::operator=(GltfFile&&) noexcept = default;
GltfFile::~GltfFile() = default;

GltfDocument::GltfDocument() = default;
GltfDocument::GltfDocument(GltfDocument&&) noexcept = default;
GltfDocument& GltfDocument::operator=(GltfDocument&&) noexcept = default;
GltfDocument::~GltfDocument() = default;

namespace {

/// \param kept  gets the document where not null
GltfFile open(const std::filesystem::path& path, const InputLimits& limits, Deviations* found,
              std::unique_ptr<json>* kept) {
  GltfFile file;
  Deviations none;
  none.allow_none();
  Deviations& deviations = found != nullptr ? *found : none;
  MemoryBudget budget(limits.max_memory);
  file.name = valid_utf8(path.filename().string());
  file.folder = path.parent_path();
  file.model = std::make_unique<tinygltf::Model>();

  GltfContainer container = read_gltf_container(path, file.name, budget);
  mend_gltf_text(container.json, file.name, deviations);
  json document = parse_gltf_json(container.json, file.name);
  container.json = {};
  check_gltf_needs(document, file.name);
  mend_gltf_values(document, file.name, deviations);
  GltfDefects defects;
  auto buffers = load_gltf_buffers(document, container, path.parent_path(), file.name, budget, defects, deviations);
  decode_meshopt_views(document, buffers, file.name, budget, defects, deviations);
  decode_draco_primitives(document, buffers, file.name, budget, limits.max_triangles, defects);
  std::vector<std::uint64_t> sizes;
  for (const auto& buffer : buffers) sizes.push_back(buffer.size());
  mend_gltf_structure(document, sizes, defects, file.name, deviations);

  if (kept != nullptr) *kept = std::make_unique<json>(document);
  fill_in(std::move(document), std::move(buffers), file, deviations);
  file.memory = budget.taken();
  return file;
}

}  // namespace

GltfFile open_gltf(const std::filesystem::path& path, const InputLimits& limits, Deviations* deviations) {
  return open(path, limits, deviations, nullptr);
}

GltfDocument open_gltf_document(const std::filesystem::path& path, const InputLimits& limits, Deviations* deviations) {
  GltfDocument document;
  document.file = open(path, limits, deviations, &document.json);
  return document;
}

GltfDocument make_gltf_document(json document, GltfBytes buffers, const std::string& name) {
  GltfDocument made;
  made.file.name = name;
  made.file.model = std::make_unique<tinygltf::Model>();
  made.json = std::make_unique<json>(document);
  Deviations none;
  none.allow_none();
  fill_in(std::move(document), std::move(buffers), made.file, none);
  return made;
}

}  // namespace lozenge
