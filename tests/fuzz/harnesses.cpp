#include "fuzz/harness.h"

namespace kagefude::fuzz {

std::span<const Harness> harnesses() {
  static constexpr Harness all[] = {{"look", fuzzLook},
                                    {"override", fuzzOverride},
                                    {"frame_range", fuzzFrameRange},
                                    {"save", fuzzSave},
                                    {"page_guard", fuzzPageGuard},
                                    {"manifest", fuzzManifest},
                                    {"sidecar", fuzzSidecar},
                                    {"casters", fuzzCasters},
                                    {"exr_header", fuzzExrHeader},
                                    {"exr_chunks", fuzzExrChunks},
                                    {"png", fuzzPng},
                                    {"palette", fuzzPalette}};
  return all;
}

}  // namespace kagefude::fuzz
