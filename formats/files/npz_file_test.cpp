#include "formats/files/npz_file.h"

#include <gtest/gtest.h>
#include <zip.h>

#include <cstring>
#include <filesystem>
#include <numeric>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"

namespace lozenge {
namespace {

std::vector<NamedArray> some_arrays() {
  std::vector<float> floats(2 * 3 * 5);
  std::iota(floats.begin(), floats.end(), -7.5F);
  return {{"about", {}, std::string("{\"kind\": \"text\"}")},
          {"floats", {2, 3, 5}, floats},
          {"doubles.1", {2}, std::vector<double>{0.1, -1e300}},
          {"integers", {3, 1}, std::vector<std::int32_t>{-1, 0, 1 << 30}},
          {"truths", {4}, Truths{{0, 1, 1, 0}}},
          {"nothing", {0, 3}, std::vector<float>{}}};
}

/// A member of an archive, and what else the archive says of it.
struct Member {
  std::string name;
  std::string bytes;
  bool is_stored = false;
};

std::vector<Member> members_of(const std::filesystem::path& path) {
  std::vector<Member> members;
  zip_t* const archive = zip_open(path.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, nullptr);
  if (archive == nullptr) return members;
  for (zip_int64_t n = 0; n < zip_get_num_entries(archive, 0); ++n) {
    zip_stat_t facts;
    zip_stat_index(archive, static_cast<zip_uint64_t>(n), 0, &facts);
    std::string bytes(facts.size, '\0');
    zip_file_t* const file = zip_fopen_index(archive, static_cast<zip_uint64_t>(n), 0);
    EXPECT_EQ(zip_fread(file, bytes.data(), bytes.size()), static_cast<zip_int64_t>(bytes.size()));
    zip_fclose(file);
    members.push_back({facts.name, bytes, facts.comp_method == ZIP_CM_STORE});
  }
  zip_discard(archive);
  return members;
}

TEST(NpzFile, HoldsEachArrayAsNumPyWritesIt) {
  const fixtures::TestFolder folder;
  write_npz(folder / "some.npz", some_arrays());
  const std::vector<Member> members = members_of(folder / "some.npz");
  const std::vector<std::string> names = {"about.npy",    "floats.npy", "doubles.1.npy",
                                          "integers.npy", "truths.npy", "nothing.npy"};
  // As numpy.lib.format writes them.
  const std::vector<std::string> heads = {"{'descr': '|S16', 'fortran_order': False, 'shape': (), }",
                                          "{'descr': '<f4', 'fortran_order': False, 'shape': (2,3,5,), }",
                                          "{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }",
                                          "{'descr': '<i4', 'fortran_order': False, 'shape': (3,1,), }",
                                          "{'descr': '|b1', 'fortran_order': False, 'shape': (4,), }",
                                          "{'descr': '<f4', 'fortran_order': False, 'shape': (0,3,), }"};
  const std::vector<std::size_t> sizes = {16, 4 * 30, 8 * 2, 4 * 3, 4, 0};
  ASSERT_EQ(members.size(), names.size());
  for (std::size_t n = 0; n < names.size(); ++n) {
    const std::string& bytes = members[n].bytes;
    EXPECT_EQ(members[n].name, names[n]);
    EXPECT_TRUE(members[n].is_stored);
    EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
    EXPECT_EQ(bytes.substr(10, heads[n].size()), heads[n]);
    const std::size_t begin = 10U + static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
    EXPECT_EQ(begin % 64, 0U);
    EXPECT_EQ(bytes[begin - 1], '\n');
    EXPECT_EQ(bytes.size() - begin, sizes[n]);
  }
  float last = 0;
  std::memcpy(&last, members[1].bytes.data() + members[1].bytes.size() - sizeof(last), sizeof(last));
  EXPECT_EQ(last, -7.5F + 29);
}

TEST(NpzFile, HasTheSameBytesWheneverItIsWritten) {
  const fixtures::TestFolder folder;
  setenv("TZ", "America/New_York", 1);
  write_npz(folder / "here.npz", some_arrays());
  setenv("TZ", "Asia/Tokyo", 1);
  write_npz(folder / "there.npz", some_arrays());
  unsetenv("TZ");
  EXPECT_EQ(fixtures::bytes_of(folder / "here.npz"), fixtures::bytes_of(folder / "there.npz"));
}

TEST(NpzFile, IsWholeOrAbsent) {
  const fixtures::TestFolder folder;
  try {
    write_npz(folder / "missing/some.npz", some_arrays());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
  }
  write_npz(folder / "some.npz", some_arrays());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace lozenge
