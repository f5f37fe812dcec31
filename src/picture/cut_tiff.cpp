#include "picture/cut_tiff.h"

#include <algorithm>
#include <fstream>

namespace kagefude {
namespace {

struct Entry {
  uint64_t tag = 0, type = 0, count = 0, place = 0;  ///< place of the values
};

class Tiff {
 public:
  Tiff(const std::filesystem::path& path, uint64_t fileBytes)
      : file_(path, std::ios::binary), fileBytes_(fileBytes) {
    char order[2] = {};
    file_.read(order, 2);
    bigEndian_ = order[0] == 'M';
    const uint64_t version = number(2, 2);
    big_ = version == 43;
    isTiff_ = file_ && order[0] == order[1] && (order[0] == 'M' || order[0] == 'I') &&
              (version == 42 || big_);
  }

  bool isCut() {
    if (!isTiff_) return false;
    const uint64_t at = big_ ? number(8, 8) : number(4, 4), head = big_ ? 8 : 2;
    const uint64_t entries = number(at, head);
    Entry places, sizes;
    for (uint64_t i = 0; i < std::min(entries, mostEntries) && file_; ++i) {
      const Entry entry = entryAt(at + head + i * entryBytes());
      if (entry.tag == stripPlaces || entry.tag == tilePlaces) places = entry;
      if (entry.tag == stripSizes || entry.tag == tileSizes) sizes = entry;
    }
    return !file_ || anyEndsBehind(places, sizes);
  }

 private:
  static constexpr uint64_t stripPlaces = 273, stripSizes = 279, tilePlaces = 324, tileSizes = 325;
  static constexpr uint64_t mostEntries = 65535;

  uint64_t entryBytes() const { return big_ ? 20 : 12; }
  uint64_t wordBytes() const { return big_ ? 8 : 4; }

  // 0, and a file that is no longer good, for what lies behind the end.
  uint64_t number(uint64_t place, uint64_t bytes) {
    unsigned char raw[8] = {};
    file_.seekg(static_cast<std::streamoff>(std::min(place, fileBytes_)));
    file_.read(reinterpret_cast<char*>(raw), static_cast<std::streamsize>(bytes));
    uint64_t value = 0;
    for (uint64_t i = 0; i < bytes; ++i) value = value << 8 | raw[bigEndian_ ? i : bytes - 1 - i];
    return value;
  }

  /// Values that fit into the entry stand in it.
  Entry entryAt(uint64_t at) {
    Entry entry{number(at, 2), number(at + 2, 2), number(at + 4, wordBytes()),
                at + 4 + wordBytes()};
    if (entry.count > wordBytes() / valueBytes(entry))
      entry.place = number(entry.place, wordBytes());
    return entry;
  }
  static uint64_t valueBytes(const Entry& entry) {
    constexpr uint64_t shortType = 3, long8Type = 16;
    return entry.type == shortType ? 2 : entry.type == long8Type ? 8 : 4;
  }

  bool anyEndsBehind(const Entry& places, const Entry& sizes) {
    const uint64_t count = std::min(places.count, sizes.count);
    for (uint64_t i = 0; i < count; ++i) {
      const uint64_t place = number(places.place + i * valueBytes(places), valueBytes(places));
      const uint64_t size = number(sizes.place + i * valueBytes(sizes), valueBytes(sizes));
      if (!file_ || place > fileBytes_ || size > fileBytes_ - place) return true;
    }
    return false;
  }

  std::ifstream file_;
  uint64_t fileBytes_;
  bool bigEndian_ = false, big_ = false, isTiff_ = false;
};

}  // namespace

bool tiffIsCutShort(const std::filesystem::path& path, uint64_t fileBytes) {
  return Tiff(path, fileBytes).isCut();
}

}  // namespace kagefude
