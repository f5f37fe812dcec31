#include <bit>
#include <set>

#include "base/glob.h"
#include "frame/cryptomatte.h"

namespace kagefude {
namespace {

uint32_t scramble(uint32_t k) { return std::rotl(k * 0xcc9e2d51u, 15) * 0x1b873593u; }

uint32_t littleEndianWord(const char* bytes, size_t count) {
  uint32_t word = 0;
  for (size_t i = 0; i < count; ++i) {
    word |= static_cast<uint32_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  }
  return word;
}

}  // namespace

uint32_t murmurHash3(std::string_view text, uint32_t seed) {
  uint32_t hash = seed;
  const size_t whole = text.size() / 4 * 4;
  for (size_t i = 0; i < whole; i += 4) {
    hash ^= scramble(littleEndianWord(text.data() + i, 4));
    hash = std::rotl(hash, 13) * 5 + 0xe6546b64u;
  }
  hash ^= scramble(littleEndianWord(text.data() + whole, text.size() - whole));
  hash ^= static_cast<uint32_t>(text.size());
  hash = (hash ^ (hash >> 16)) * 0x85ebca6bu;
  hash = (hash ^ (hash >> 13)) * 0xc2b2ae35u;
  return hash ^ (hash >> 16);
}

uint32_t cryptomatteId(std::string_view name) {
  const uint32_t hash = murmurHash3(name);
  const uint32_t exponent = (hash >> 23) & 255;
  return exponent == 0 || exponent == 255 ? hash ^ (1u << 23) : hash;
}

std::vector<uint32_t> matchingIds(const std::map<uint32_t, std::string>& names,
                                  std::string_view pattern) {
  std::set<uint32_t> ids;
  for (const auto& [id, name] : names) {
    if (matchesGlob(name, pattern)) ids.insert(id);
  }
  if (pattern.find_first_of("*?") == std::string_view::npos) ids.insert(cryptomatteId(pattern));
  return {ids.begin(), ids.end()};
}

}  // namespace kagefude
