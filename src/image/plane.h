#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

#include "image/plane_memory.h"

namespace kagefude {

/// Non-owning rectangle of pixels, row by row without gaps; (0,0) is the top-left pixel of the data
/// window. Copying a view copies no pixels. `View<const T>` is made from `View<T>` silently.
template <class T>
struct View {
  T* data = nullptr;
  int width = 0;
  int height = 0;

  View() = default;
  View(T* pixels, int w, int h) : data(pixels), width(w), height(h) {}
  template <class U>
  requires(std::is_same_v<const U, T> && !std::is_same_v<U, T>) View(const View<U>& other)
      : data(other.data), width(other.width), height(other.height) {}

  T* row(int y) const { return data + static_cast<ptrdiff_t>(y) * width; }
  /// Builds without NDEBUG stop at a pixel that is not there.
  T& operator()(int x, int y) const {
    assert(contains(x, y));
    return row(y)[x];
  }
  bool empty() const { return data == nullptr || width <= 0 || height <= 0; }
  size_t pixels() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
};

/// Owning rectangle of trivially copyable pixels, 64-byte aligned, with 64 readable bytes behind
/// the last pixel so that vector loads may run over the end. Pixels start undefined unless a value
/// is given. Movable, not copyable: a copy of a 4K plane should be asked for in so many words.
template <class T>
class Plane {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Plane() = default;
  Plane(int width, int height) : width_(width), height_(height) {
    data_.reset(static_cast<T*>(takePlaneMemory(bytes())));
    data_.get_deleter().bytes = bytes();
  }
  Plane(int width, int height, T value) : Plane(width, height) { fill(value); }

  void fill(T value) {
    T* const end = data_.get() + view().pixels();
    for (T* p = data_.get(); p != end; ++p) *p = value;
  }
  Plane clone() const {
    Plane copy(width_, height_);
    for (size_t i = 0; i < view().pixels(); ++i) copy.data_.get()[i] = data_.get()[i];
    return copy;
  }

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return !data_; }
  T* row(int y) { return view().row(y); }
  const T* row(int y) const { return view().row(y); }
  T& operator()(int x, int y) { return view()(x, y); }
  const T& operator()(int x, int y) const { return view()(x, y); }
  View<T> view() { return {data_.get(), width_, height_}; }
  View<const T> view() const { return {data_.get(), width_, height_}; }
  operator View<T>() { return view(); }
  operator View<const T>() const { return view(); }

 private:
  size_t bytes() const { return view().pixels() * sizeof(T) + 64; }

  struct Free {
    size_t bytes = 0;
    void operator()(T* p) const { givePlaneMemory(p, bytes); }
  };
  std::unique_ptr<T, Free> data_;
  int width_ = 0;
  int height_ = 0;
};

using Bytes = Plane<uint8_t>;
using Floats = Plane<float>;
using Labels = Plane<uint32_t>;

}  // namespace kagefude
