#include "allocations.h"

#include <atomic>
#include <cstdlib>

namespace {

std::atomic<std::size_t> count{0};

}  // namespace

// operator new ends here too, in every library that is loaded. The name is that of the C library.
// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) noexcept {
  count.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}

std::size_t frontseat_driver::bench::allocations() { return count.load(std::memory_order_relaxed); }
