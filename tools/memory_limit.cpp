// RLIMIT_DATA counts private writable memory; RLIMIT_AS would count files that are mapped and what allocators and
// threads merely reserve, too.
#include "tools/memory_limit.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "formats/base/error.h"
#include "formats/base/memory_budget.h"

namespace lozenge {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kHasShadowMemory = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kHasShadowMemory = true;
#else
constexpr bool kHasShadowMemory = false;
#endif
#else
constexpr bool kHasShadowMemory = false;
#endif

/// 0 where the system doesn't tell.
std::uint64_t memory_of_machine() {
  const long pages = sysconf(_SC_PHYS_PAGES);
  const long size = sysconf(_SC_PAGESIZE);
  return pages > 0 && size > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(size) : 0;
}

/// Less than this is no limit for a program, but its end.
constexpr std::uint64_t kLeast = 256'000'000;

/// In a thread of some library nobody may catch the exception. There is nothing left to be done then but to say it.
[[noreturn]] void end_without_memory() {
  if (const std::exception_ptr thrown = std::current_exception()) {
    try {
      std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
      constexpr std::string_view kMessage = "lozenge: out of memory; use a smaller input, or raise --max-memory\n";
      static_cast<void>(!write(STDERR_FILENO, kMessage.data(), kMessage.size()));
      std::_Exit(static_cast<int>(ExitCode::kLimit));
    } catch (...) {
    }
  }
  std::abort();
}

}  // namespace

void limit_memory(std::uint64_t bytes) {
  const std::uint64_t wanted = bytes > 0 ? std::max(bytes, kLeast) : memory_of_machine();
  rlimit limit{};
  if (kHasShadowMemory || wanted == 0 || getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = std::min({limit.rlim_cur, limit.rlim_max, static_cast<rlim_t>(wanted)});
  setrlimit(RLIMIT_DATA, &limit);
  std::set_terminate(end_without_memory);
}

void lift_memory_limit() {
  rlimit limit{};
  if (kHasShadowMemory || getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_DATA, &limit);
}

std::string memory_limit_in_words() {
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return "all there is";
  return readable_bytes(limit.rlim_cur);
}

}  // namespace lozenge
