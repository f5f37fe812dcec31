// The nearest-site search against the peers that people would use instead: OpenCV's exact distance
// transform, whole and per object, and scipy's with indices. 3840 x 2160, two threads.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "bench_frame.h"
#include "contest.h"
#include "image/clones.h"
#include "passes/search/nearest_site.h"
#ifdef KAGEFUDE_HAVE_OPENCV
#include <opencv2/imgproc.hpp>
#endif

namespace kagefude::bench {
namespace {

constexpr int width = 3840, height = 2160;
constexpr auto umbra = static_cast<uint8_t>(ShadowClass::umbra);
constexpr auto penumbra = static_cast<uint8_t>(ShadowClass::penumbra);
constexpr auto lit = static_cast<uint8_t>(ShadowClass::lit);

const LabelledShadow& frame() {
  static const LabelledShadow made(width, height);
  return made;
}

#ifdef KAGEFUDE_HAVE_OPENCV

/// Roots where a distance was wanted; stretches without any are only looked at.
KAGEFUDE_CLONES void takeRoots(const uint32_t* squared, int count, float* distance) {
  constexpr int stretch = 64;
  for (int first = 0; first < count; first += stretch) {
    const int end = std::min(first + stretch, count);
    uint32_t all = noSite;
    for (int i = first; i < end; ++i) all &= squared[i];
    if (all == noSite) continue;
    for (int i = first; i < end; ++i)
      distance[i] = squared[i] == noSite ? -1.0f : std::sqrt(static_cast<float>(squared[i]));
  }
}

/// Distances of the wanted pixels as the peer gives them: the root is part of the work.
void distances(const SiteSearch& search, View<uint32_t> squared, View<float> distance) {
  findNearestSites(search, findLabelBoxes(search), squared);
  parallelRows(height, [&](int first, int end) {
    takeRoots(squared.row(first), (end - first) * width, distance.row(first));
  });
}

/// 0 where a pixel is a site, as distanceTransform wants it.
cv::Mat zeroAtSites(uint8_t site) {
  cv::Mat mask(height, width, CV_8U);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      mask.at<uint8_t>(y, x) = frame().classes(x, y) == site ? 0 : 255;
  return mask;
}

bool sameAsOpenCv(const SiteSearch& search, View<const float> ours, const cv::Mat& theirs) {
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (search.wantedKinds(x, y) == search.wantedKind &&
          std::fabs(ours(x, y) - theirs.at<float>(y, x)) > 1e-3f)
        return false;
  return true;
}

void distanceAgainstOpenCv(benchmark::State& state, const SiteSearch& search, uint8_t site,
                           double gate) {
  cv::setNumThreads(2);
  const cv::Mat mask = zeroAtSites(site);
  cv::Mat theirs;
  Labels squared(width, height);
  Floats ours(width, height);
  for (auto _ : state) {
    const auto t =
        contest({[&] { distances(search, squared, ours); },
                 [&] { cv::distanceTransform(mask, theirs, cv::DIST_L2, cv::DIST_MASK_PRECISE); }});
    record(state, "OpenCV distanceTransform PRECISE", t[0], t[1], gate);
  }
  if (!sameAsOpenCv(search, ours, theirs))
    state.SkipWithError("the distances differ from OpenCV's");
}

void distancePenumbra(benchmark::State& state) {
  distanceAgainstOpenCv(state, {frame().classes, umbra, frame().classes, penumbra, {}}, umbra, 4);
}
BENCHMARK(distancePenumbra)->Iterations(1);

void distanceEveryPixel(benchmark::State& state) {
  const Bytes all(width, height, 1);
  distanceAgainstOpenCv(state, {frame().classes, umbra, all, 1, {}}, umbra, 1.2);
}
BENCHMARK(distanceEveryPixel)->Iterations(1);

/// Umbra and lit distances of every label's penumbra, by OpenCV on the box of each label.
void openCvWithinLabels(const std::vector<LabelBox>& boxes, cv::Mat& toUmbra, cv::Mat& toLit) {
  const cv::Mat labels(height, width, CV_32S, const_cast<uint32_t*>(frame().labels.row(0)));
  const cv::Mat classes(height, width, CV_8U, const_cast<uint8_t*>(frame().classes.row(0)));
  cv::Mat distance;
  for (const LabelBox& box : boxes) {
    const cv::Rect area(box.x0, box.y0, box.x1 - box.x0, box.y1 - box.y0);
    const cv::Mat own = labels(area) == static_cast<int>(box.label);
    const cv::Mat wanted = (classes(area) == penumbra) & own;
    for (const uint8_t site : {umbra, lit}) {
      const cv::Mat sites = (classes(area) == site) & own;
      cv::distanceTransform(~sites, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
      distance.copyTo((site == umbra ? toUmbra : toLit)(area), wanted);
    }
  }
}

void distanceWithinLabels(benchmark::State& state) {
  cv::setNumThreads(2);
  const LabelledShadow& f = frame();
  cv::Mat toUmbra(height, width, CV_32F), toLit(height, width, CV_32F);
  Labels squared(width, height);
  Floats ours(width, height);
  const SiteSearch search{f.classes, umbra, f.classes, penumbra, f.labels};
  const std::vector<LabelBox> boxes = findLabelBoxes(search);
  for (auto _ : state) {
    const auto t =
        contest({[&] {
                   for (const uint8_t site : {lit, umbra})
                     distances({f.classes, site, f.classes, penumbra, f.labels}, squared, ours);
                 },
                 [&] { openCvWithinLabels(boxes, toUmbra, toLit); }});
    record(state, "OpenCV per object on its box", t[0], t[1], 3);
  }
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (squared(x, y) != noSite && std::fabs(ours(x, y) - toUmbra.at<float>(y, x)) > 1e-3f)
        state.SkipWithError("the distances differ from OpenCV's");
}
BENCHMARK(distanceWithinLabels)->Iterations(1);

#endif

/// scipy times itself in a process of its own, on the same sites, and leaves its indices behind.
constexpr const char* scipyScript =
    "import sys,time,numpy as n;from scipy.ndimage import distance_transform_edt as d;"
    "m=n.fromfile(sys.argv[1],n.uint8).reshape(2160,3840)!=1;t=time.perf_counter();"
    "i=d(m,return_distances=True,return_indices=True)[1];t=time.perf_counter()-t;"
    "((i[0]*3840+i[1]).astype(n.uint32)).tofile(sys.argv[2]);"
    "open(sys.argv[3],'w').write(str(t))";

class Scipy {
 public:
  Scipy() : folder_(std::filesystem::temp_directory_path() / "kagefude_bench_scipy") {
    std::filesystem::create_directories(folder_);
    std::ofstream file(folder_ / "sites", std::ios::binary);
    file.write(reinterpret_cast<const char*>(frame().classes.row(0)), width * height);
  }
  ~Scipy() { std::filesystem::remove_all(folder_); }

  static bool present() {
    return std::system("/usr/bin/python3 -c 'import scipy.ndimage' 2>/dev/null") == 0;
  }

  double seconds() {
    const std::string at = folder_.string();
    const std::string call = std::string("/usr/bin/python3 -c \"") + scipyScript + "\" " + at +
                             "/sites " + at + "/indices " + at + "/time";
    if (std::system(call.c_str()) != 0) return 0;
    double taken = 0;
    std::ifstream(folder_ / "time") >> taken;
    return taken;
  }

  Labels indices() const {
    Labels read(width, height);
    std::ifstream(folder_ / "indices", std::ios::binary)
        .read(reinterpret_cast<char*>(read.row(0)), 4L * width * height);
    return read;
  }

 private:
  std::filesystem::path folder_;
};

int64_t squaredTo(int x, int y, uint32_t index) {
  const int64_t dx = static_cast<int>(index % width) - x, dy = static_cast<int>(index / width) - y;
  return dx * dx + dy * dy;
}

void distanceAndSite(benchmark::State& state) {
  if (!Scipy::present()) {
    state.SkipWithError("scipy is not installed");
    return;
  }
  Scipy scipy;
  const Bytes all(width, height, 1);
  const SiteSearch search{frame().classes, umbra, all, 1, {}};
  Labels squared(width, height), index(width, height);
  std::vector<double> theirs;
  for (auto _ : state) {
    const auto t =
        contest({[&] { findNearestSites(search, findLabelBoxes(search), squared, index); },
                 [&] { theirs.push_back(scipy.seconds()); }},
                3);
    std::nth_element(theirs.begin(), theirs.begin() + 2, theirs.end());
    record(state, "scipy distance_transform_edt with indices", t[0], theirs[2], 8);
  }
  const Labels found = scipy.indices();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (squaredTo(x, y, found(x, y)) != int64_t{squared(x, y)} ||
          squaredTo(x, y, index(x, y)) != int64_t{squared(x, y)}) {
        state.SkipWithError("the sites are not as near as scipy's");
        return;
      }
}
BENCHMARK(distanceAndSite)->Iterations(1);

}  // namespace
}  // namespace kagefude::bench
