#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

namespace kagefude {

/// Names what a frame was made from, so that `--existing update` can tell a stale output from a
/// right one: feed it the program's version, the look with every value resolved, and each input
/// file; equal hexes mean equal inputs. Order counts, and each piece is hashed with its label and
/// length, so no two different lists run together. It is the 128 bits of XXH3
/// and the same on every machine; it tells change, it does not guard against forgery.
class Fingerprint {
 public:
  Fingerprint();

  Fingerprint& add(std::string_view label, std::string_view bytes);
  Fingerprint& add(std::string_view label, int64_t number);

  /// A file by its name without folders, its size, and what is in it. Up to 1 MiB the whole content
  /// counts and the time does not, so a sidecar written anew with the same values stays the same.
  /// Beyond that, reading everything would cost as much as making the frame: there it is the time
  /// of last change in nanoseconds together with 64 samples of 4 KiB, the first and last included,
  /// which hold an EXR's header and chunk table and so the packed size of every chunk. The folder
  /// is left out because farms see one file under different mounts. A missing file counts as such.
  /// InputError when it is there but cannot be read.
  Fingerprint& addFile(std::string_view label, const std::filesystem::path& file);

  /// 32 lower-case hexadecimal digits.
  std::string hex() const;

 private:
  std::string digest_;
};

/// Digests of files that many frames share (meshes of things that do not deform), each worked out
/// once in a run and again only when the file has changed. Thread-safe.
class FileDigests {
 public:
  /// As Fingerprint::addFile.
  std::string of(const std::filesystem::path& file);

 private:
  struct Known {
    std::string state;  ///< identity, size and times
    std::string digest;
  };
  std::mutex mutex_;
  std::map<std::filesystem::path, Known> known_;
};

}  // namespace kagefude
