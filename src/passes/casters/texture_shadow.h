#pragma once

#include <array>
#include <span>

#include "base/parameter.h"
#include "image/plane.h"
#include "image/vec.h"

namespace kagefude {

enum class BlobBlend { alpha, multiply };
inline constexpr std::array<std::string_view, 2> blobBlends = {"alpha", "multiply"};

struct BlobParams {
  float width = 1.5f;   ///< of the object's size across its heading
  float length = 1.5f;  ///< of the object's size along its heading
  float heading = 0;    ///< turns, added to the object's own
  float reach = 0.05f;  ///< of the blob's larger side
  float strength = 0.6f;
  BlobBlend blend = BlobBlend::alpha;
};

inline constexpr std::array blobParameters = {
    number<&BlobParams::width>("width", 0, 100, "object widths",
                               "Size of the blob across the object's heading."),
    number<&BlobParams::length>("length", 0, 100, "object lengths",
                                "Size of the blob along the object's heading."),
    number<&BlobParams::heading>("heading", -1, 1, "turns",
                                 "Turns the blob on the ground, on top of the object's heading."),
    number<&BlobParams::reach>("reach", 0, 100, "blob sizes",
                               "How far above or below the blob's height surfaces still take it."),
    number<&BlobParams::strength>("strength", 0, 1, "", "Darkness of the blob where it is black."),
    choice<&BlobParams::blend>("blend", blobBlends,
                               "Lays black over the light by the blob's darkness, or blends as "
                               "dst*src + src*(1-src), which is lighter and ends softer."),
};

inline constexpr ParameterTable blobTable = {
    "blob", "A painted blob laid on the ground under each object.", "003", blobParameters};

/// Where one object's blob lies: a rectangle on the ground, in world space.
struct BlobPlace {
  V3d centre{0, 0, 0};  ///< under the object's middle, at the ground's height
  V3d across{1, 0, 0};  ///< unit, in the ground; the picture's left to right
  V3d along{0, 1, 0};   ///< unit, in the ground; the picture's bottom to top
  double width = 1, length = 1;
};

/// The rectangle under an object with the bounds [low, high] in its own space: its centre and
/// heading come from the matrix, its size from the bounds' two extents that lie flattest, its
/// height from the ground. `up` is the unit normal of the ground, `height` its distance from the
/// origin along up. An object whose axes all stand upright has no heading and gets the world's.
BlobPlace blobUnder(const Transform& worldFromObject, const V3d& low, const V3d& high,
                    const V3d& up, double height, const BlobParams& params);

/// Share of the light that the blobs leave at each pixel: full light blended with the tone of the
/// blobs, which is 1 where there is none and 1 - strength at their darkest. `picture`
/// is the painted blob, 0 black to 1 untouched, row 0 at the far end of `along`; an empty one
/// stands for a round soft blob. Where blobs meet the darkest counts, once. Pixels with ID
/// 0, and those of an object in `ownIds` under its own blob (same index as places; 0 = none), stay
/// 1, as do surfaces farther than `reach` above or below the ground and positions that are not
/// finite. Bilinear inside the picture, 1 outside.
Floats blobTone(Vec3View position, View<const uint32_t> ids, std::span<const BlobPlace> places,
                std::span<const uint32_t> ownIds, View<const float> picture,
                const BlobParams& params);

/// What is left of `destination` under a blob of the given tone, by the lecture's two blends (003):
/// alpha, with a black blob: dst*tone; multiply: tone*(1 - tone) + dst*tone.
float blendBlob(float destination, float tone, BlobBlend blend);

}  // namespace kagefude
