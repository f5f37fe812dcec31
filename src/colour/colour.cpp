#include "colour/colour.h"

#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <sstream>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/plain_file.h"
#include "image/parallel.h"

namespace ocio = OCIO_NAMESPACE;

namespace kagefude {

struct Colour::State {
  std::string source;
  ocio::ConstConfigRcPtr config;

  // Name as the configuration has it, or a LookError.
  std::string requireSpace(std::string_view name) const;
  // The processor that `make` returns; a broken one (a missing LUT) is an InputError.
  template <class Make>
  ocio::ConstCPUProcessorRcPtr processor(const Make& make) const;
  // From the working space to a display, seen through a view.
  ocio::ConstCPUProcessorRcPtr displayProcessor(
      const std::pair<std::string, std::string>& shown) const;
  // Applies a processor.
  void apply(const ocio::ConstCPUProcessorRcPtr& cpu, View<float> red, View<float> green,
             View<float> blue) const;

  /// OCIO fills its list of displays when first asked, and makes processors, without minding other
  /// threads that ask as well.
  mutable std::mutex mutex;
  std::unique_lock<std::mutex> lock() const { return std::unique_lock(mutex); }
};

namespace {

ocio::ConstConfigRcPtr loadConfig(const std::string& path) {
  if (!path.empty()) return ocio::Config::CreateFromFile(path.c_str());
  std::istringstream text{std::string(builtInColourConfig())};
  return ocio::Config::CreateFromStream(text);
}

std::vector<std::string> spaceNames(const ocio::ConstConfigRcPtr& config) {
  std::vector<std::string> names;
  for (int i = 0; i < config->getNumColorSpaces(); ++i) {
    names.emplace_back(config->getColorSpaceNameByIndex(i));
  }
  return names;
}

std::string requireName(const std::string& given, std::string_view what,
                        const std::vector<std::string>& known, const std::string& source) {
  for (const std::string& name : known) {
    if (name == given) return given;
  }
  throw LookError(fmt::format("the colour configuration {} has no {} {}{} ({}s: {})", source, what,
                              given, didYouMean(given, known), what, listNames(known)));
}

}  // namespace

std::string Colour::State::requireSpace(std::string_view name) const {
  const auto alone = lock();
  const std::string given(name);
  if (const auto space = config->getColorSpace(given.c_str())) return space->getName();
  return requireName(given, "space", spaceNames(config), source);
}

template <class Make>
ocio::ConstCPUProcessorRcPtr Colour::State::processor(const Make& make) const {
  try {
    // OCIO's own power functions are used on every machine, so results do not depend on the C
    // library's choice of code for the processor.
    const auto alone = lock();
    return make()->getOptimizedCPUProcessor(ocio::OPTIMIZATION_DEFAULT);
  } catch (const ocio::Exception& problem) {
    throw InputError(
        fmt::format("the colour configuration {} cannot be used: {}", source, problem.what()));
  }
}

ocio::ConstCPUProcessorRcPtr Colour::State::displayProcessor(
    const std::pair<std::string, std::string>& shown) const {
  return processor([&] {
    return config->getProcessor(ocio::ROLE_SCENE_LINEAR, shown.first.c_str(), shown.second.c_str(),
                                ocio::TRANSFORM_DIR_FORWARD);
  });
}

void Colour::State::apply(const ocio::ConstCPUProcessorRcPtr& cpu, View<float> red,
                          View<float> green, View<float> blue) const {
  if (cpu->isNoOp()) return;
  parallelRows(red.height, [&](int first, int end) {
    ocio::PlanarImageDesc rows(red.row(first), green.row(first), blue.row(first), nullptr,
                               red.width, end - first);
    cpu->apply(rows);
  });
}

Colour::Colour(const std::string& config) : state_(std::make_unique<State>()) {
  const char* const environment = std::getenv("OCIO");
  std::string path = config;
  if (path.empty() && environment) path = environment;
  state_->source = path.empty() ? "built-in" : path;
  if (!path.empty()) requirePlainFile(path);
  try {
    state_->config = loadConfig(path);
  } catch (const ocio::Exception& problem) {
    throw InputError(fmt::format("the colour configuration {} cannot be used: {}", state_->source,
                                 problem.what()));
  }
  if (!state_->config->hasRole(ocio::ROLE_SCENE_LINEAR)) {
    throw InputError(
        fmt::format("the colour configuration {} has no scene_linear role", state_->source));
  }
}

Colour::~Colour() = default;
Colour::Colour(Colour&&) noexcept = default;
Colour& Colour::operator=(Colour&&) noexcept = default;

void Colour::toWorking(View<float> red, View<float> green, View<float> blue,
                       std::string_view fromSpace) const {
  const std::string from = state_->requireSpace(fromSpace);
  const auto make = [&] {
    return state_->config->getProcessor(from.c_str(), ocio::ROLE_SCENE_LINEAR);
  };
  state_->apply(state_->processor(make), red, green, blue);
}

void Colour::fromWorking(View<float> red, View<float> green, View<float> blue,
                         std::string_view toSpace) const {
  const std::string to = state_->requireSpace(toSpace);
  const auto make = [&] {
    return state_->config->getProcessor(ocio::ROLE_SCENE_LINEAR, to.c_str());
  };
  state_->apply(state_->processor(make), red, green, blue);
}

std::pair<std::string, std::string> Colour::shownThrough(std::string_view display,
                                                         std::string_view view) const {
  const auto alone = state_->lock();
  const auto& config = state_->config;
  const std::string defaultDisplay = config->getDefaultDisplay();
  const std::string shownOn = requireName(display.empty() ? defaultDisplay : std::string(display),
                                          "display", displays(), state_->source);
  const std::string defaultView = config->getDefaultView(shownOn.c_str());
  return {shownOn, requireName(view.empty() ? defaultView : std::string(view), "view",
                               views(shownOn), state_->source)};
}

void Colour::toDisplay(View<float> red, View<float> green, View<float> blue,
                       std::string_view display, std::string_view view) const {
  state_->apply(state_->displayProcessor(shownThrough(display, view)), red, green, blue);
}

bool Colour::mixesChannels(std::string_view display, std::string_view view) const {
  return state_->displayProcessor(shownThrough(display, view))->hasChannelCrosstalk();
}

std::string Colour::displaySpace(std::string_view display, std::string_view view) const {
  const auto [shownOn, seenAs] = shownThrough(display, view);
  const std::string space =
      state_->config->getDisplayViewColorSpaceName(shownOn.c_str(), seenAs.c_str());
  return space == "<USE_DISPLAY_NAME>" ? shownOn : space;
}

const std::string& Colour::source() const { return state_->source; }

std::filesystem::path Colour::file() const {
  return std::filesystem::is_regular_file(state_->source) ? state_->source : "";
}

std::string Colour::toWorkingId(std::string_view fromSpace) const {
  const std::string from = state_->requireSpace(fromSpace);
  return state_
      ->processor(
          [&] { return state_->config->getProcessor(from.c_str(), ocio::ROLE_SCENE_LINEAR); })
      ->getCacheID();
}

std::string Colour::toDisplayId(std::string_view display, std::string_view view) const {
  return state_->displayProcessor(shownThrough(display, view))->getCacheID();
}

std::string Colour::workingSpace() const {
  return state_->config->getColorSpace(ocio::ROLE_SCENE_LINEAR)->getName();
}

bool Colour::hasSpace(std::string_view name) const {
  return state_->config->getColorSpace(std::string(name).c_str()) != nullptr;
}

std::vector<std::string> Colour::spaces() const { return spaceNames(state_->config); }

std::vector<std::string> Colour::displays() const {
  std::vector<std::string> names;
  for (int i = 0; i < state_->config->getNumDisplays(); ++i) {
    names.emplace_back(state_->config->getDisplay(i));
  }
  return names;
}

std::vector<std::string> Colour::views(std::string_view display) const {
  const std::string name(display);
  std::vector<std::string> names;
  for (int i = 0; i < state_->config->getNumViews(name.c_str()); ++i) {
    names.emplace_back(state_->config->getView(name.c_str(), i));
  }
  return names;
}

}  // namespace kagefude
