#pragma once

#include <cstddef>

namespace kagefude {

/// Memory for the pixels of a plane, 64-byte aligned; from 4 MiB on it starts on a huge page and
/// asks for them. Undefined content. Throws bad_alloc.
///
/// The memory of large planes is kept when it is given back, and handed to the next plane of the
/// same size: the system clears fresh pages at their first touch, which costs as much as a pass
/// over them (measured: 29 to 38 % of the nine-mask search and of PCF at 4K). Kept and used memory
/// together never exceed the most that was used at once, so keeping adds nothing to that peak.
void* takePlaneMemory(size_t bytes);

/// Gives back what takePlaneMemory gave for `bytes`. Null is allowed.
void givePlaneMemory(void* memory, size_t bytes) noexcept;

/// Frees what is kept and forgets the peak before now, as a new process; to measure memory.
void releaseKeptPlaneMemory();

}  // namespace kagefude
