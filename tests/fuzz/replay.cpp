// Stands in for libFuzzer where there is none: gives a target every file of some folders, and mutations of them that
// are the same in every run.
//
// Usage: replay_TARGET RUNS FOLDER...
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/mutator.h"

namespace {

namespace fs = std::filesystem;

/// How much longer than its seed an input may get.
constexpr std::size_t kGrowth = 4096;

std::minstd_rand& random_numbers() {
  static std::minstd_rand random(1);
  return random;
}

/// [seed] the files' bytes, in the order of their names.
std::vector<std::string> read_corpus(int folders, char** names) {
  std::vector<fs::path> files;
  for (int i = 0; i < folders; ++i) {
    if (!fs::is_directory(names[i])) continue;
    for (const auto& entry : fs::directory_iterator(names[i])) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> corpus;
  for (const fs::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return corpus;
}

void give(const std::string& input) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

std::string mutated(std::string input) {
  std::minstd_rand& random = random_numbers();
  std::size_t size = input.size();
  input.resize(size + kGrowth);
  auto* data = reinterpret_cast<std::uint8_t*>(input.data());
  const unsigned changes = 1 + random() % 4;
  for (unsigned k = 0; k < changes; ++k) {
    size = LLVMFuzzerCustomMutator != nullptr ? LLVMFuzzerCustomMutator(data, size, input.size(), random())
                                              : LLVMFuzzerMutate(data, size, input.size());
  }
  input.resize(size);
  return input;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size) {
  std::minstd_rand& random = random_numbers();
  if (size == 0) return 0;
  const std::size_t at = random() % size;
  switch (random() % 6) {
    case 0:  // another byte
      data[at] = static_cast<std::uint8_t>(random());
      return size;
    case 1:  // another bit
      data[at] ^= static_cast<std::uint8_t>(1U << (random() % 8));
      return size;
    case 2: {  // a number that is at some limit
      static constexpr std::array<std::uint32_t, 8> kNumbers{0,      1,          0xFF,       0xFFFF,
                                                             0x8000, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF};
      const std::uint32_t number = kNumbers[random() % kNumbers.size()];
      std::memcpy(data + at, &number, std::min<std::size_t>(4, size - at));
      return size;
    }
    case 3: {  // some bytes taken out
      const std::size_t count = std::min<std::size_t>(1 + random() % 16, size - at);
      std::memmove(data + at, data + at + count, size - at - count);
      return size - count;
    }
    case 4: {  // some bytes twice
      const std::size_t count = std::min<std::size_t>({1 + random() % 16, size - at, max_size - size});
      std::memmove(data + at + count, data + at, size - at);
      return size + count;
    }
    default:  // the end cut off
      return random() % 8 == 0 ? at : size;
  }
}

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "Usage: %s RUNS FOLDER...\n", argv[0]);
    return 2;
  }
  const std::vector<std::string> corpus = read_corpus(argc - 2, argv + 2);
  if (corpus.empty()) {
    std::fprintf(stderr, "%s: no files to start from\n", argv[0]);
    return 1;
  }
  for (const std::string& input : corpus) give(input);
  const long runs = std::strtol(argv[1], nullptr, 10);
  for (long i = 0; i < runs; ++i) give(mutated(corpus[static_cast<std::size_t>(i) % corpus.size()]));
  std::printf("%zu files and %ld mutations of them did no harm\n", corpus.size(), runs);
}
