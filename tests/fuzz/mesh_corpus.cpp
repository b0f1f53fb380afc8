#include "tests/fuzz/mesh_corpus.h"

#include <array>
#include <cstdint>
#include <string>

#include "formats/base/file_fixtures.h"
#include "formats/base/vector.h"

namespace lozenge::fuzz {

namespace {

namespace fs = std::filesystem;
using fixtures::write_bytes;

/// A tetrahedron.
constexpr std::array<std::array<int, 3>, 4> kPoints{{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}};
constexpr std::array<std::array<std::uint32_t, 3>, 4> kTriangles{{{0, 1, 3}, {0, 2, 1}, {0, 3, 2}, {1, 2, 3}}};

template <typename T>
std::string numbers(const std::array<T, 3>& values) {
  return std::to_string(values[0]) + " " + std::to_string(values[1]) + " " + std::to_string(values[2]);
}

template <typename T>
void add(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

std::array<float, 3> position(std::uint32_t point) {
  const auto& [x, y, z] = kPoints[point];
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

const std::string kPlyElements =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\n"
    "property float nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
    "property float s\nproperty float t\nelement face 4\nproperty list uchar int vertex_indices\n"
    "property list uchar float texcoord\nend_header\n";

std::string text_ply() {
  std::string ply = "ply\nformat ascii 1.0\ncomment by hand\n" + kPlyElements;
  for (const auto& point : kPoints) ply += numbers(point) + " 0 0 1 255 128 0 255 0 0.5\n";
  for (const auto& triangle : kTriangles) ply += "3 " + numbers(triangle) + " 6 0 0 1 0 0 1\n";
  return ply;
}

std::string little_endian_ply() {
  std::string ply = "ply\nformat binary_little_endian 1.0\n" + kPlyElements;
  for (std::uint32_t p = 0; p < kPoints.size(); ++p) {
    add(ply, position(p));
    add(ply, std::array<float, 3>{0, 0, 1});
    ply += "\xff\x80\x01\xff";
    add(ply, std::array<float, 2>{0, 0.5F});
  }
  for (const auto& triangle : kTriangles) {
    ply += '\3';
    add(ply, triangle);
    ply += '\0';
  }
  return ply;
}

std::string big_endian_ply() {
  return "ply\r\nformat binary_big_endian 1.0\r\nelement vertex 3\r\nproperty uchar x\r\nproperty uchar y\r\n"
         "property uchar z\r\nelement face 1\r\nproperty list uchar ushort vertex_index\r\nend_header\r\n" +
         std::string("\0\0\0\1\0\0\0\1\0\3\0\0\0\1\0\2", 16);
}

std::string whole_obj() {
  std::string obj = "mtllib a.mtl\no tetrahedron\nvt 0 0\nvt 1 0.5\nvn 0 0 1\n";
  for (const auto& point : kPoints) obj += "v " + numbers(point) + " 1 0.5 0\n";
  return obj + "usemtl stone\nf 1/1/1 2/2 3//1 4\nusemtl moss\nf -4/-1 -3//-1 -2/1/1\nusemtl stone\nf 4 3 2\n";
}

const std::string kOddObj = "v 0 0 0\r\nv 2 0 0 1\r\nv .5 .5 0\r\nv 0 2 0\r\nf 1 2 \\\r\n3 4\r\nl 1 2\r\ncurv 0 1\r\n";

std::string text_stl() {
  std::string stl = "solid a\n";
  for (const auto& triangle : kTriangles) {
    stl += "facet normal 0 0 1\nouter loop\n";
    for (const std::uint32_t p : triangle) stl += "vertex " + numbers(kPoints[p]) + "\n";
    stl += "endloop\nendfacet\n";
  }
  return stl + "endsolid a\n";
}

std::string binary_stl() {
  std::string stl(80, ' ');
  add(stl, std::uint32_t{kTriangles.size()});
  for (const auto& triangle : kTriangles) {
    add(stl, std::array<float, 3>{0, 0, 1});
    for (const std::uint32_t p : triangle) add(stl, position(p));
    add(stl, std::uint16_t{0});
  }
  return stl;
}

std::string whole_off() {
  std::string off = "STCNOFF\n4 4 6\n";
  for (const auto& point : kPoints) off += numbers(point) + " 0 0 1 255 128 0 255 0 0.5\n";
  for (const auto& triangle : kTriangles) off += "3 " + numbers(triangle) + " 255 0 0\n";
  return off;
}

}  // namespace

void write_mesh_corpus(const fs::path& root) {
  for (const char* format : {"ply", "obj", "mtl", "stl", "off"}) fs::create_directories(root / format);
  write_bytes(root / "ply" / "text.ply", text_ply());
  write_bytes(root / "ply" / "little.ply", little_endian_ply());
  write_bytes(root / "ply" / "big.ply", big_endian_ply());
  write_bytes(root / "obj" / "whole.obj", whole_obj());
  write_bytes(root / "obj" / "odd.obj", kOddObj);
  write_bytes(root / "mtl" / "whole.mtl",
              "# two\nnewmtl stone\nKa 1 1 1\nKd 0.5 0.25 1\nKe 0 0 1\nNs 20\nd 0.5\nPr .3\nPm 1\nmap_Kd -s 2 3 -o .5 "
              ".25 -clamp on -bm 2 a picture.png\nnewmtl moss\nTr 0.25\nmap_Ke ..\\up.png\nnorm C:\\maps\\n.png\n"
              "map_Bump b.png\nillum 2\n");
  write_bytes(root / "stl" / "text.stl", text_stl());
  write_bytes(root / "stl" / "bytes.stl", binary_stl());
  write_bytes(root / "off" / "whole.off", whole_off());
  write_bytes(root / "off" / "plain.off", "4 1 0 # no keyword\n0 0 0\n2 0 0\n.5 .5 0\n0 2 0\n4 0 1 2 3\n");
}

}  // namespace lozenge::fuzz
