#include "live/strip_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "live/page_paths.h"
#include "passes/strip/strip_paint.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

constexpr size_t mostStrips = 200;
constexpr int deepest = 3, mostHeight = 64;

constexpr std::string_view kinds[] = {".png",  ".exr",  ".tif", ".tiff", ".jpg",
                                      ".jpeg", ".webp", ".psd", ".tga"};

std::string kindOf(const fs::path& path) {
  std::string kind = path.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return kind;
}

bool isOffered(const fs::path& path, const fs::path& strips) {
  return isStripPicture(path) && (kindOf(path) != ".exr" || path.parent_path() == strips);
}

std::vector<std::string> picturesIn(const fs::path& folder, const fs::path& strips) {
  std::vector<std::string> found;
  std::error_code error;
  fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    const fs::path& path = at->path();
    std::error_code ignored;
    const bool hidden = path.filename().native().starts_with('.');
    if (hidden || at.depth() >= deepest || at->is_symlink(ignored)) at.disable_recursion_pending();
    if (!hidden && !at->is_symlink(ignored) && isOffered(path, strips) &&
        at->is_regular_file(ignored))
      found.push_back(path.lexically_relative(folder).generic_string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// The first of a strip's copies that is small enough to be shown.
const Strip::Level& smallLevelOf(const Strip& strip) {
  return *std::find_if(strip.levels.begin(), strip.levels.end() - 1,
                       [](const Strip::Level& level) { return level.height <= mostHeight; });
}

}  // namespace

bool isStripPicture(const fs::path& path) {
  return std::find(std::begin(kinds), std::end(kinds), kindOf(path)) != std::end(kinds);
}

std::string stripSuffixes() { return fmt::format("{}", fmt::join(kinds, " ")); }

std::vector<std::string> stripsToChoose(const fs::path& folder, const fs::path& strips) {
  std::vector<std::string> names;
  for (const std::string_view preset : stripPresets)
    names.push_back("builtin:" + std::string(preset));
  for (std::string& name : picturesIn(folder.empty() ? "." : folder, strips))
    if (names.size() < mostStrips) names.push_back(std::move(name));
  return names;
}

ShownPixels showStrip(const LivePicture& picture, const Look& onDisk, const std::string& name) {
  Look look;
  look.folder = picture.look->folder;
  look.colour = picture.look->colour;
  look.styles.push_back({{}, look.passes});
  look.styles.back().style.strip = name;
  refuseForeignPaths(onDisk, look);
  const StripSet set(look, *picture.colour);
  const View<const Rgba> texels =
      smallLevelOf(set.strips()[static_cast<size_t>(set.indexOf(name))]).texels;
  Vec3Plane colours(texels.width, texels.height);
  for (int y = 0; y < texels.height; ++y)
    for (int x = 0; x < texels.width; ++x) {
      const Rgba& texel = texels(x, y);
      colours.set(x, y, {texel[0], texel[1], texel[2]});
    }
  return showColours(picture, colours.view(), {});
}

}  // namespace kagefude
