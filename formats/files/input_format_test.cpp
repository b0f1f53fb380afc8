#include "formats/files/input_format.h"

#include "formats/files/file_kind.h"
#include "formats/files/readers/input_file.h"
#include "formats/files/readers/reader_fixtures.h"

namespace lozenge {
namespace {

using namespace fixtures;

class Input : public ReaderTest {
 protected:
  std::string format_of(const std::string& name, const std::string& content) const {
    write_bytes(folder_ / name, content);
    const InputFormat* format = find_input_format(folder_ / name, start_of(folder_ / name));
    return format == nullptr ? "none" : std::string(format->name);
  }
};

TEST_F(Input, IsRecognisedByItsContentWhateverItsName) {
  for (const char* name : {"a.glb", "a.ply", "a.obj", "a.stl", "a.off", "a.txt", "a"}) {
    EXPECT_EQ(format_of(name, "glTF\2\0\0\0"), "glTF") << name;
    EXPECT_EQ(format_of(name, " \n{\"asset\": {}}"), "glTF") << name;
    EXPECT_EQ(format_of(name, "ply\nformat ascii 1.0\n"), "PLY") << name;
    EXPECT_EQ(format_of(name, "ply\r\nformat ascii 1.0\r\n"), "PLY") << name;
    EXPECT_EQ(format_of(name, "# v 1\nv 1 2 3\nvn 0 0 1\n"), "OBJ") << name;
    EXPECT_EQ(format_of(name, "\n\nmtllib v.mtl\n"), "OBJ") << name;
    EXPECT_EQ(format_of(name, "solid\nfacet"), "STL") << name;
    EXPECT_EQ(format_of(name, std::string(84, '\0')), "STL") << name << ": as long as its number of triangles says";
    EXPECT_EQ(format_of(name, "# off\nOFF\n1 2 3"), "OFF") << name;
    EXPECT_EQ(format_of(name, "STCNOFF 1 2 3"), "OFF") << name;
  }
}

TEST_F(Input, IsWhatItsNameSaysWhereItsContentCanNotTell) {
  const std::string bytes(200, '\1');
  const std::string numbers = "3 1 0\n0 0 0\n";
  EXPECT_EQ(format_of("a.glb", bytes), "glTF");
  EXPECT_EQ(format_of("a.gltf", bytes), "glTF");
  EXPECT_EQ(format_of("a.stl", bytes), "STL");
  EXPECT_EQ(format_of("a.ply", numbers), "PLY");
  EXPECT_EQ(format_of("a.OFF", numbers), "OFF");
  EXPECT_EQ(format_of("a.Obj", "# nothing but a comment\n"), "OBJ");
  EXPECT_EQ(format_of("a.obj", std::string("v 0 0 0\n\0", 9)), "none") << "no text";
  for (const char* name : {"a", "a.", "a.txt", "a.gl", "a.glb.bak", "stl"}) EXPECT_EQ(format_of(name, bytes), "none");
}

TEST_F(Input, OfNoFormatIsRefusedWithWhatIsRead) {
  expect_refused("a.txt", "hello world", "glTF, PLY, OFF, OBJ or STL");
  expect_refused("a.txt", "", "is empty");
  EXPECT_NE(complaint("a.fbx", "Kaydara FBX Binary  ", ExitCode::kUnsupported).find("FBX, which isn't read; export it"),
            std::string::npos);
  EXPECT_THROW(open_input(folder_ / "missing.ply"), Error);
  std::filesystem::create_directory(folder_ / "folder.ply");
  EXPECT_THROW(open_input(folder_ / "folder.ply"), Error);
}

TEST_F(Input, TakesItsSceneNameFromItsFile) {
  const InputAsset asset = open("statue of stone.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(asset.scene_name, "statue of stone");
  EXPECT_EQ(asset.origin, "statue of stone.obj");
  EXPECT_EQ(asset.file, "statue of stone.obj");
}

TEST_F(Input, IsAKindOfFile) {
  write_bytes(folder_ / "a.stl", "solid\n");
  EXPECT_EQ(recognise_file(folder_ / "a.stl"), FileKind::kForeignMesh);
  write_bytes(folder_ / "a.txt", "hello");
  EXPECT_THROW(recognise_file(folder_ / "a.txt"), Error);
}

}  // namespace
}  // namespace lozenge
