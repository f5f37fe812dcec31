#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace kagefude {

/// Bytes from "8G", "512M", "1.5 GiB", "2000000"; K, M, G and T are powers of 1024. UsageError for
/// anything else, zero, or less than one byte.
size_t parseMemory(std::string_view text);

/// "1.5 GiB", for messages.
std::string formatMemory(size_t bytes);

/// Three quarters of the memory that is free for this process now: the machine's (MemAvailable) or
/// what its control group leaves, whichever is less. 1 GiB where the system does not say.
size_t defaultMemoryBound();

}  // namespace kagefude
