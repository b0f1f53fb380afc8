#include "formats/files/readers/gltf/images.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <filesystem>
#include <memory>
#include <system_error>

#include "formats/base/error.h"
#include "formats/files/picture_header.h"
#include "formats/files/readers/gltf/buffers.h"
#include "formats/files/readers/gltf/container.h"

namespace lozenge {

namespace {

using Bytes = std::vector<unsigned char>;

constexpr std::int32_t kUnread = -2;

Bytes bytes_of_file(const GltfFile& file, const tinygltf::Image& image, const std::string& what, MemoryBudget& budget) {
  const std::filesystem::path path = resolve_gltf_uri(image.uri, file.folder, what);
  std::error_code error;
  const std::uint64_t size =
      std::filesystem::is_regular_file(path, error) ? std::filesystem::file_size(path, error) : 0;
  if (error || size == 0) throw Error(ExitCode::kUnusableInput, what + ": there is no such file, or it is empty");
  budget.take(size, what + ": reading it");
  return read_file_start(path, size, what);
}

Bytes bytes_of(const GltfFile& file, const tinygltf::Image& image, const std::string& what, MemoryBudget& budget) {
  if (image.bufferView < 0 && image.image.empty()) return bytes_of_file(file, image, what, budget);
  if (image.bufferView < 0) {
    budget.take(image.image.size(), what + ": reading it");
    return image.image;
  }
  const tinygltf::BufferView& view = file.model->bufferViews[image.bufferView];
  budget.take(view.byteLength, what + ": reading it");
  const Bytes& buffer = file.model->buffers[view.buffer].data;
  const auto begin = buffer.begin() + static_cast<std::ptrdiff_t>(view.byteOffset);
  return {begin, begin + static_cast<std::ptrdiff_t>(view.byteLength)};
}

}  // namespace

GltfImages::GltfImages(const GltfFile& file, MemoryBudget& budget, Deviations& deviations,
                       std::vector<std::string>& notes)
    : file_(file),
      budget_(budget),
      deviations_(deviations),
      notes_(notes),
      found_(file.model->images.size(), kUnread) {}

std::int32_t GltfImages::find(int image) {
  if (image < 0 || image >= static_cast<int>(found_.size())) return -1;
  if (found_[image] == kUnread) found_[image] = read(image);
  return found_[image];
}

std::int32_t GltfImages::read(int index) {
  const tinygltf::Image& image = file_.model->images[index];
  const std::string name = image.name.empty() ? image.uri : image.name;
  const std::string what =
      name.empty() ? fmt::format("image {}", index) : fmt::format("image {} ({:.60})", index, name);
  try {
    Bytes bytes = bytes_of(file_, image, file_.name + ": " + what, budget_);
    if (is_ktx2(bytes)) {
      notes_.push_back(what + " is a KTX2 texture, which isn't read: surfaces go without it");
      return -1;
    }
    if (const auto defect = find_texture_defect(bytes)) {
      deviations_.add(Deviation::kPicture, fmt::format("{}: {} {}", file_.name, what, *defect));
      return -1;
    }
    const std::string mime_type(read_picture_header(bytes)->mime_type);
    images_.push_back({image.name, mime_type, std::make_shared<const Bytes>(std::move(bytes))});
  } catch (const Error& error) {
    if (error.code() == ExitCode::kLimit) throw;
    deviations_.add(Deviation::kPicture, error.what());
    return -1;
  }
  return static_cast<std::int32_t>(images_.size()) - 1;
}

}  // namespace lozenge
