#pragma once

#include "exr/fast_kernels.h"

namespace kagefude {

/// The kernels for AVX2 with F16C, or null where the processor has not both.
const ExrKernels* avx2ExrKernels();

}  // namespace kagefude
