#pragma once

#include <cstddef>

namespace frontseat_driver::bench {

/// How often this program has asked the heap for memory, by operator new or by malloc.
std::size_t allocations();

}  // namespace frontseat_driver::bench
