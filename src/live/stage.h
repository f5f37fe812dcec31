#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "live/stage_key.h"

namespace kagefude {

/// What a stage made. No two results have one version, so a version in the key of a later stage
/// stands for all that the earlier one depends on.
template <class T>
struct Made {
  std::shared_ptr<const T> value;
  uint64_t version = 0;

  const T& operator*() const { return *value; }
  const T* operator->() const { return value.get(); }
};

/// A version that no other result has. From any thread.
uint64_t nextVersion();

/// A newer change waits, so the picture that was begun is not wanted any more.
class Superseded : public std::exception {
 public:
  const char* what() const noexcept override { return "superseded by a newer change"; }
};

/// One run through the stages: says which of them had to be made, and gives up between two of them
/// when it is asked to (a pass itself is not interrupted).
struct StageRun {
  std::stop_token stop{};
  std::vector<std::string> made{};  ///< names of the stages that were made, in order
};

/// One stage of a frame: its last result, and the key that it was made from. The result before is
/// let go when the new one is there, so memory holds one result a stage whatever is turned; who
/// still shows the old one (the last good picture) holds it by its pointer. When making throws, the
/// stage stays as it was.
template <class T>
class Stage {
 public:
  /// The kept result where `key` is that of the last time, else what `make` gives: a T, or a
  /// shared_ptr to one. Throws Superseded, and whatever `make` throws.
  template <class Make>
  const Made<T>& at(StageRun& run, std::string name, StageKey key, const Make& make) {
    if (key_ && *key_ == key) return made_;
    if (run.stop.stop_requested()) throw Superseded();
    std::shared_ptr<const T> value;
    if constexpr (std::is_convertible_v<decltype(make()), std::shared_ptr<const T>>)
      value = make();
    else
      value = std::make_shared<const T>(make());
    made_ = {std::move(value), nextVersion()};
    key_ = std::move(key);
    run.made.push_back(std::move(name));
    return made_;
  }

 private:
  std::optional<StageKey> key_;
  Made<T> made_;
};

}  // namespace kagefude
