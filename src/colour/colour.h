#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "image/plane.h"

namespace kagefude {

/// Colour transforms by an OpenColorIO configuration. Colour only: never hand data planes to it.
/// Transforms are the configuration's own, on the CPU, by OCIO's portable code: the same bits for
/// any number of threads, and one object serves several at a time. Planes are changed in place; all
/// three must be of one size.
class Colour {
 public:
  /// `config` is a path; empty: the file that $OCIO names, else the built-in configuration (spaces
  /// "Linear Rec.709", "sRGB", "Raw"; display "sRGB" with views "Standard" and "Raw"). Throws
  /// InputError when it cannot be read or has no scene_linear role. Its spaces and views are looked
  /// at when they are used, not before.
  explicit Colour(const std::string& config = "");
  ~Colour();
  Colour(Colour&&) noexcept;
  Colour& operator=(Colour&&) noexcept;

  /// From a named space (or role, or alias) to the working space (role scene_linear). Throws
  /// LookError naming the nearest space when it is unknown.
  void toWorking(View<float> red, View<float> green, View<float> blue,
                 std::string_view fromSpace) const;
  /// From the working space to a named one.
  void fromWorking(View<float> red, View<float> green, View<float> blue,
                   std::string_view toSpace) const;
  /// From the working space to what a display shows; empty names mean the configuration's default
  /// display and that display's default view. Throws LookError naming the nearest.
  void toDisplay(View<float> red, View<float> green, View<float> blue,
                 std::string_view display = {}, std::string_view view = {}) const;

  /// Whether a channel of what toDisplay gives depends on the other two. Throws as toDisplay.
  bool mixesChannels(std::string_view display = {}, std::string_view view = {}) const;

  /// The space of what toDisplay gives, as the configuration names it.
  std::string displaySpace(std::string_view display = {}, std::string_view view = {}) const;

  /// Where the configuration comes from: a path or "built-in".
  const std::string& source() const;
  /// The configuration's own file; empty for the built-in one.
  std::filesystem::path file() const;
  /// Names what a transform does: equal for equal numbers. Tables (wherever the search path, a
  /// subfolder or a context variable finds them) count with their content. Throws LookError for an
  /// unknown name, and InputError when the transform cannot be made, such as for a missing table or
  /// an unset variable: so it is also how a space or a view in use is made sure of, while the
  /// others of the configuration may be as they like.
  std::string toWorkingId(std::string_view fromSpace) const;
  std::string toDisplayId(std::string_view display = {}, std::string_view view = {}) const;
  std::string workingSpace() const;
  bool hasSpace(std::string_view name) const;
  std::vector<std::string> spaces() const;
  std::vector<std::string> displays() const;
  std::vector<std::string> views(std::string_view display) const;

 private:
  std::pair<std::string, std::string> shownThrough(std::string_view display,
                                                   std::string_view view) const;

  struct State;
  std::unique_ptr<State> state_;
};

/// The text of the built-in OCIO configuration.
std::string_view builtInColourConfig();

}  // namespace kagefude
