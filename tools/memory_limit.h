// A limit on the memory of the process: beyond it, allocations fail cleanly, where the system would kill something.
#pragma once

#include <cstdint>
#include <string>

namespace lozenge {

/// From now on std::bad_alloc is thrown where the process' memory would exceed `bytes`; 0: all memory of the machine.
/// It is a net below the estimates that are made before memory is taken: the program, its libraries and threads need
/// some memory before they do anything, and get 256 MB in any case. Where a library can't stand the exception, the
/// process ends at once with the exit code of a limit. Does nothing where the process has a sanitizer's shadow memory,
/// or already has a tighter limit.
void limit_memory(std::uint64_t bytes);

/// Ends the limit, so that an error can be told and cleaned up after.
void lift_memory_limit();

/// The limit that holds: "8.0 GB".
std::string memory_limit_in_words();

}  // namespace lozenge
