#include "tools/command_input.h"

#include <fmt/format.h>

#include <optional>

#include "formats/files/source_mesh_file.h"
#include "tools/options.h"

namespace lozenge {
namespace {

struct KindInWords {
  FileKind kind;
  const char* what;
  const char* maker;  ///< the command that makes one
};

constexpr KindInWords kKinds[] = {{FileKind::kSourceMesh, "asset", "import"},
                                  {FileKind::kForeignMesh, "asset", "import"},
                                  {FileKind::kParameterization, "map", "parameterize"},
                                  {FileKind::kAsset, "asset", "export"},
                                  {FileKind::kPatchSet, "patch set", "sample"},
                                  {FileKind::kGeometryImage, "geometry image", "pack"},
                                  {FileKind::kGeometryImageJson, "table of a geometry image", "pack"},
                                  {FileKind::kMapPng, "texture", "bake"},
                                  {FileKind::kMapExr, "texture", "bake"},
                                  {FileKind::kMapKtx2, "texture with mips", "bake"},
                                  {FileKind::kPicture, "picture", "render"}};

const KindInWords& in_words(FileKind kind) {
  for (const KindInWords& each : kKinds) {
    if (each.kind == kind) return each;
  }
  throw Error(ExitCode::kInternal, "a kind of file has no name");
}

std::string with_article(const std::string& noun) { return (noun.front() == 'a' ? "an " : "a ") + noun; }

std::string what_is(const std::string& file, FileKind kind) {
  return with_article(kind == FileKind::kSourceMesh && is_source_mesh_file(file) ? "surface" : in_words(kind).what);
}

/// Nothing where the file is none that we know, or broken.
std::optional<FileKind> kind_of(const std::string& file) {
  try {
    return recognise_file(file);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

void refuse_other_kind(const std::string& file, FileKind needed, std::string_view command) {
  const std::optional<FileKind> kind = kind_of(file);
  if (!kind || *kind == needed) return;
  const KindInWords& wanted = in_words(needed);
  throw Error(ExitCode::kUnusableInput,
              fmt::format("{}: is {}; `lozenge {}` makes the {} that `{}` needs", file_name(file), what_is(file, *kind),
                          wanted.maker, wanted.what, command));
}

}  // namespace lozenge
