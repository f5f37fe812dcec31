#include "sequence/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "base/folders.h"
#include "base/temp_file.h"
#include "image/box_reduce.h"
#include "sequence/report_page.h"

namespace kagefude {
namespace {

namespace fs = std::filesystem;

constexpr int kProxySide = 96;
constexpr int kBlock = 8;
constexpr size_t kNeighbours = 4;  // on each side

/// The mean of the pixels that each smaller pixel covers.
Thumbnail reduced(const Thumbnail& picture) {
  const int longest = std::max(picture.width, picture.height);
  if (longest <= kProxySide) return picture;
  Thumbnail small;
  small.width = std::max(1, picture.width * kProxySide / longest);
  small.height = std::max(1, picture.height * kProxySide / longest);
  small.rgb.resize(size_t{3} * small.width * small.height);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      const BoxSpan across = boxSpan(x, picture.width, small.width);
      const BoxSpan down = boxSpan(y, picture.height, small.height);
      for (int c = 0; c < 3; ++c) {
        const int sum = boxSum<int>(across, down, [&](int u, int v) {
          return picture.rgb[3 * (size_t(v) * picture.width + u) + c];
        });
        small.rgb[3 * (size_t(y) * small.width + x) + c] =
            static_cast<uint8_t>(sum / pixelsIn(across, down));
      }
    }
  return small;
}

bool isEmpty(const Thumbnail& picture) { return picture.width <= 0 || picture.height <= 0; }

std::string imageName(const ReportFrame& frame) {
  std::string view = frame.view;
  for (char& c : view)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return view.empty() ? fmt::format("thumbs/{:04}.png", frame.frame)
                      : fmt::format("thumbs/{}.{:04}.png", view, frame.frame);
}

}  // namespace

FrameChange frameChange(const Thumbnail& before, const Thumbnail& after) {
  if (before.width != after.width || before.height != after.height) return {255, 255};
  if (isEmpty(after)) return {};
  FrameChange change;
  int64_t total = 0;
  for (int top = 0; top < after.height; top += kBlock)
    for (int left = 0; left < after.width; left += kBlock) {
      const int bottom = std::min(top + kBlock, after.height);
      const int right = std::min(left + kBlock, after.width);
      int64_t sum = 0;
      for (int y = top; y < bottom; ++y)
        for (int i = 3 * left; i < 3 * right; ++i) {
          const size_t at = size_t(y) * after.width * 3 + i;
          sum += std::abs(int{after.rgb[at]} - int{before.rgb[at]});
        }
      total += sum;
      const double values = 3.0 * (bottom - top) * (right - left);
      change.largest = std::max(change.largest, static_cast<double>(sum) / values);
    }
  change.mean = static_cast<double>(total) / static_cast<double>(after.rgb.size());
  return change;
}

std::vector<size_t> findPops(const std::vector<double>& changes) {
  std::vector<size_t> pops;
  for (size_t i = 0; i < changes.size(); ++i) {
    std::vector<double> around;
    const size_t last = std::min(i + kNeighbours, changes.size() - 1);
    for (size_t j = i > kNeighbours ? i - kNeighbours : 0; j <= last; ++j)
      if (j != i && changes[j] >= 0) around.push_back(changes[j]);
    if (around.size() < 2) continue;
    const auto middle = around.begin() + static_cast<ptrdiff_t>(around.size() / 2);
    std::nth_element(around.begin(), middle, around.end());
    if (changes[i] > 2 * *middle + 3) pops.push_back(i);
  }
  return pops;
}

Report::Report(fs::path folder, ReportHeader header, WriteImage writeImage)
    : folder_(std::move(folder)), header_(std::move(header)), writeImage_(std::move(writeImage)) {
  makeFolders(folder_ / "thumbs");
  removeLeftovers(folder_);
  removeLeftovers(folder_ / "thumbs");
}

void Report::add(const ReportFrame& frame, const Thumbnail& picture) {
  ReportEntry entry;
  entry.frame = frame;
  if (!isEmpty(picture)) {
    entry.image = imageName(frame);
    entry.proxy = reduced(picture);
    writeImage_(folder_ / entry.image, picture);
  }
  std::lock_guard lock(mutex_);
  entries_[{frame.view, frame.frame}] = std::move(entry);
}

void Report::finish() const {
  std::lock_guard lock(mutex_);
  std::vector<ReportStrip> strips;
  for (const auto& [key, entry] : entries_) {
    if (strips.empty() || strips.back().view != key.first) strips.push_back({key.first, {}, {}});
    ReportStrip& strip = strips.back();
    const ReportEntry* before = strip.entries.empty() ? nullptr : strip.entries.back();
    const bool known = before && !isEmpty(before->proxy) && !isEmpty(entry.proxy);
    strip.changes.push_back(known ? frameChange(before->proxy, entry.proxy) : FrameChange{-1, -1});
    strip.entries.push_back(&entry);
  }
  writeFileAtomically(folder_ / "index.html", reportPage(header_, strips));
}

}  // namespace kagefude
