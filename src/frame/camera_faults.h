#pragma once

#include <string>

#include "image/vec.h"

namespace kagefude::detail {

/// Whether it maps columns affinely, its last row being 0 0 0 1.
bool isAffine(const Transform& t);

/// Which way a matrix turns: negative for one that mirrors.
double handedness(const Transform& t);

/// What keeps the matrix from being a turn and a move of columns, as the end of a sentence; "" for
/// none. Mirroring is no fault of its own.
std::string rigidFault(const Transform& t);

/// What keeps a projection of columns from being that of a camera that looks along -z, as the end
/// of a sentence; "" for none: its last row must be 0 0 -w 0, or 0 0 0 1 of a parallel one, its
/// numbers finite, and its picture neither a point nor wider than any lens has.
std::string projectionFault(const Transform& clipFromCamera);

}  // namespace kagefude::detail
