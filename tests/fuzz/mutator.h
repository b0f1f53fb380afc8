// The functions that libFuzzer and its targets call each other by. Without libFuzzer, replay.cpp stands in for it.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {
/// One input. \return 0
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
/// Changes `data` in place, a little and at random. \return its new size, at most `max_size`
std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);
/// The same, by who knows the format; not all targets have it.
__attribute__((weak)) std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                                          unsigned int seed);
}
